"""YADE's word on two histories of the code's dynamic check: the worst and the nearest to d_SLV.

They are of the mechanism that comes nearest to its d_SLV or furthest beyond, by the mean.
"""

import json
import shlex
import subprocess
from pathlib import Path

import pandas as pd
from rocking import Case
from rocking.assessment.dynamic_check import width_of
from rocking.assessment.shaken import cases
from rocking.records import load_as
from rocking.records.floors import floor_columns
from rocking.runtime.script import run
from rocking.tables import read_tables, write_table

from yade_scripts.model import floor_motions

LIMIT_S = 3600.0  # of one run in YADE
COLUMNS = [
    "model",
    "record",
    "direction",
    "part",
    "which",
    "pga_g",
    "d_m",
    "d_yade_m",
    "status_yade",
]


def main(job):
    case = Case.read(job.input.scene)
    settings = json.loads(job.params.settings)
    rows, folder = [], Path(job.params.folder)
    folder.mkdir(parents=True, exist_ok=True)
    verdicts, table = read_tables(job.input.verdicts), read_tables(job.input.histories)
    if len(verdicts):
        case, found, table = _governing(case, verdicts, table, pd.read_csv(job.input.shaken))
    scene, kept = case.scene, folder / f"{case.model}.json"
    kept.write_text(case.to_json())
    for which in ("worst", "nearest"):
        if verdicts.empty:
            break
        own = table[(table["record"] == found[which]) & (table["realisation"] == 0)]
        row = own.sort_values("d_m").iloc[-1]
        record = load_as(settings, row["record"], job.params.table)
        time_s, columns = floor_columns(record, scene["smdof"])
        vertical = columns.pop(floor_motions.VERTICAL, None)
        ground, *floors = columns.values()
        name = f"{scene['model']}_{row['record']}"
        motion, plan = folder / f"{name}.csv", folder / f"{name}.json"
        output, journal = folder / f"{name}_yade.csv", folder / f"{name}.jsonl"
        floor_motions.write(str(motion), time_s, ground, floors, vertical)
        plan.write_text(json.dumps({"runs": [round(row["pga_g"], 6)], "levels": []}))
        words = ["ida", "--scene", kept, "--motion", motion, "--plan", plan]
        words += ["--record", row["record"], "--direction", row["direction"]]
        words += ["--journal", journal, "--output", output]
        command = [*shlex.split(job.params.yade), *map(str, words)]
        subprocess.run(command, check=True, timeout=LIMIT_S)
        yade = pd.read_csv(output).iloc[-1]
        d = width_of(scene["facade"]) * min(yade["d_over_b"], 1.0)
        values = (found["part"], which, row["pga_g"], row["d_m"], d, yade["status"])
        rows.append((case.model, row["record"], row["direction"], *values))
    write_table(rows, job.output[0], COLUMNS)


def _governing(case, verdicts, histories, shaken):
    """Case, verdict and histories of the mechanism with the largest mean over d_SLV."""
    found = verdicts.iloc[(verdicts["mean_d_m"] / verdicts["d_slv_m"]).argmax()]
    own = {row.part: part for row, part in cases(case, shaken)}[found["part"]]
    return own, found, histories[histories["part"] == found["part"]]


run(main, globals())
