"""Rows of ties with which the façade passes: by hand, then under the chosen motions.

The rows stand as YAML too, to be given beside the façade's own file: to the last digit, and with
the range of periods by which the motions were chosen, so that it is held to the same ones.
"""

import json
from concurrent.futures import ThreadPoolExecutor

import yaml
from rocking import Case, Motion
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.assess import selection, site, ties, ties_shaken, ties_share, ties_tables
from studies.assess.anchors import completed_settings
from studies.assess.shaken import settled
from studies.assess.verdict import relied_on

ADDED = """# Rows of ties with which the façade passes; give this file after the façade's own:
# .venv/bin/snakemake --cores 2 --configfile my_facade.yaml {path} -- assess
"""


def main(job):
    threads = int(getattr(job, "threads", 1))  # the compiled loops let others run
    with ThreadPoolExecutor(threads) as pool:
        _added(job, pool.map, threads)


def _added(job, many, at_once):
    """Tables and YAML of the job; the histories of a mechanism run `at_once` side by side."""
    settings = completed_settings(json.loads(job.params.settings))
    assessment, records = settings["assessment"], {}
    for name in job.params.records:
        records[name] = load_as(settings, name, job.params.table)
    given = settings, list(records.values()), job.input.spectrum, job.input.hazard
    demand = site.demand_from(*given)
    tied, longest_s = ties.Tied(settings, demand), selection.longest_period(settings, demand)
    chosen = read_frame(job.input.motions)
    motions = [(Motion(records[row.record]), row.pga_g) for row in chosen.itertuples()]
    shaken, relied, cases = None, "", []
    if motions or assessment["tie_share"]:
        cases = [settled(Case.read(path), assessment) for path in job.input.cases]
    if motions:
        relied = relied_on([case.model for case in cases])
        cases.sort(key=lambda case: case.model != relied)
        shaken = ties_shaken.Shaken(cases, tied, motions, settings["directions"], many, at_once)

    def say(text):
        with open(str(job.log), "a", encoding="utf-8") as log:
            log.write(f"{text}\n")

    recommended = ties.recommended(tied, shaken, say)
    write_table(ties_tables.table_of(tied, recommended, relied), job.output.rows, ties_tables.ROWS)
    write_table(ties_tables.of_models(recommended), job.output.models, ties_tables.MODELS)
    write_table(ties_tables.after(tied, recommended, shaken), job.output.after, ties_tables.AFTER)
    write_table(shaken.rows if shaken else [], job.output.tried, ties_shaken.TRIED)
    entries = tied.entries(recommended.built)
    share = []
    if assessment["tie_share"]:
        every = [
            (Motion(record), way) for record in records.values() for way in settings["directions"]
        ]
        share = ties_share.shares(cases, entries, every, demand.pga_g)
    write_table(share, job.output.share, ties_share.COLUMNS)
    rows = [*settings["facade"]["ties"], *entries]
    rows = [{k: float(v) if isinstance(v, float) else v for k, v in r.items()} for r in rows]
    given = {"run": f"{job.params.run}_tied", "facade": {"ties": rows}}
    if motions:  # a tied façade's own longest period would choose others
        given["assessment"] = {"match_high_s": float(longest_s)}
    text = yaml.safe_dump(given, sort_keys=False)
    with open(job.output.yaml, "w", encoding="utf-8") as file:
        file.write(ADDED.format(path=job.output.yaml) + text)


run(main, globals())
