"""YADE's word on histories of the code's dynamic check: the nearest to d_SLV, then the largest.

They are of the model and mechanism that come nearest to their d_SLV, or furthest beyond.
"""

import json
import shlex
import subprocess
from pathlib import Path

from rocking import Case
from rocking.records import load_as
from rocking.records.floors import floor_columns
from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, write_table
from studies.assess.dynamic_check import leans_by, width_of
from studies.assess.shaken import cases, settled
from studies.assess.verdict import decided_by, deciding

from yade_scripts.model import floor_motions

LIMIT_S = 3600.0  # of one run in YADE
USUAL = 1  # history of a block; of courses none, which take minutes
COLUMNS = ["model", "record", "direction", "part", "which", "pga_g", "d_m", "d_yade_m"]
COLUMNS += ["status_yade"]


def main(job):
    settings = json.loads(job.params.settings)
    count, courses = settings["assessment"]["yade_histories"], settings["facade.courses"]
    count = (0 if courses else USUAL) if count is None else count
    rows, folder = [], Path(job.params.folder)
    folder.mkdir(parents=True, exist_ok=True)
    verdicts, table = read_tables(job.input.verdicts), read_tables(job.input.histories)
    asked = ("nearest", "worst")[:count] if len(verdicts) else ()
    if asked:
        given = job.input.cases, verdicts, table, job.input.shaken, settings["assessment"]
        case, verdict, table = _governing(*given)
        kept = folder / f"{case.model}.json"
        kept.write_text(case.to_json())
    for which in asked:
        histories = table[(table["record"] == verdict[which]) & (table["realisation"] == 0)]
        row = histories.loc[(histories["d_m"] - verdict[f"{which}_d_m"]).abs().idxmin()]
        record = load_as(settings, row["record"], job.params.table)
        time_s, columns = floor_columns(record, case.sections["smdof"])
        vertical = columns.pop(floor_motions.VERTICAL, None)
        ground, *floors = columns.values()
        name = f"{case.model}_{row['record']}_{row['direction']}"
        motion, plan = folder / f"{name}.csv", folder / f"{name}.json"
        output, journal = folder / f"{name}_yade.csv", folder / f"{name}.jsonl"
        floor_motions.write(str(motion), time_s, ground, floors, vertical)
        plan.write_text(json.dumps({"runs": [round(row["pga_g"], 6)], "levels": []}))
        words = ["ida", "--scene", kept, "--motion", motion, "--plan", plan]
        words += ["--record", row["record"], "--direction", row["direction"]]
        words += ["--journal", journal, "--output", output]
        command = [*shlex.split(job.params.yade), *map(str, words)]
        subprocess.run(command, check=True, timeout=LIMIT_S)
        yade = read_frame(output).iloc[-1]
        facade = case.sections["facade"]
        d = width_of(facade) * min(yade["d_over_b"], 1.0) - leans_by(facade)
        values = (verdict["part"], which, row["pga_g"], row["d_m"], d, yade["status"])
        rows.append((case.model, row["record"], row["direction"], *values))
    write_table(rows, job.output[0], COLUMNS)


def _governing(scenes, verdicts, histories, shaken, assessment):
    """Case, verdict and histories of the model and mechanism that decide."""
    worst = deciding(verdicts).set_index("model")
    verdict = worst.loc[decided_by(verdicts)]
    every = {case.model: settled(case, assessment) for case in map(Case.read, scenes)}
    parts = cases(every[verdict.name], read_frame(shaken))
    case = {row.part: part for row, part in parts}[verdict["part"]]
    mine = (histories["part"] == verdict["part"]) & (histories["model"] == verdict.name)
    return case, verdict, histories[mine]


run(main, globals())
