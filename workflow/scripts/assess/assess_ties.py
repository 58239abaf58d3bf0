"""Rows of ties with which the façade passes: by hand, then under the chosen motions.

The rows stand as YAML too, to be given beside the façade's own file: to the last digit, and with
the range of periods by which the motions were chosen, so that it is held to the same ones.
"""

import json
from concurrent.futures import ThreadPoolExecutor

import yaml
from rocking import Case, Motion
from rocking.assessment import selection, site, ties, ties_shaken
from rocking.assessment.dynamic_check import surely
from rocking.assessment.verdict import relied_on
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, write_table

ADDED = """# Rows of ties with which the façade passes; give this file after the façade's own:
# .venv/bin/snakemake --cores 2 --configfile my_facade.yaml {path} -- assess
"""


def main(job):
    threads = int(getattr(job, "threads", 1))  # the compiled loops let others run
    with ThreadPoolExecutor(threads) as pool:
        _added(job, pool.map, threads)


def _added(job, many, at_once):
    """Tables and YAML of the job; the histories of a mechanism run `at_once` side by side."""
    settings = json.loads(job.params.settings)
    records = {n: load_as(settings, n, job.params.table) for n in job.params.records}
    given = settings, list(records.values()), job.input.spectrum, job.input.hazard
    demand = site.demand_from(*given)
    tied, longest_s = ties.Tied(settings, demand), selection.longest_period(settings, demand)
    chosen = read_frame(job.input.motions)
    motions = [(Motion(records[row.record]), row.pga_g) for row in chosen.itertuples()]
    verdicts, shaken, relied = read_tables(job.input.verdicts), None, ""
    if motions:
        cases = [Case.read(path) for path in job.input.cases]
        relied = relied_on([case.model for case in cases])
        cases.sort(key=lambda case: case.model != relied)
        shaken = ties_shaken.Shaken(cases, tied, motions, settings["directions"], many, at_once)
    stands = bool(len(verdicts)) and bool(surely(verdicts).all())

    def say(text):
        with open(str(job.log), "a", encoding="utf-8") as log:
            log.write(f"{text}\n")

    found = ties.found(tied, shaken, stands, say)
    there = any(row.force_n for row in found.rows)
    as_sold = ties.sold(tied, found, shaken, say) if there else None
    rows = ties.table_of(found, settings["strengthening"], relied, as_sold)
    write_table(rows, job.output.rows, ties.ROWS)
    write_table(ties.after(tied, found, shaken), job.output.after, ties.AFTER)
    write_table(shaken.rows if shaken else [], job.output.tried, ties_shaken.TRIED)
    rows = [*settings["facade"]["ties"], *tied.entries(found.rows)]
    rows = [{k: float(v) if isinstance(v, float) else v for k, v in r.items()} for r in rows]
    given = {"run": f"{job.params.run}_tied", "facade": {"ties": rows}}
    if motions:  # a tied façade's own longest period would choose others
        given["assessment"] = {"match_high_s": float(longest_s)}
    text = yaml.safe_dump(given, sort_keys=False)
    with open(job.output.yaml, "w", encoding="utf-8") as file:
        file.write(ADDED.format(path=job.output.yaml) + text)


run(main, globals())
