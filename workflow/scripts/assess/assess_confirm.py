"""YADE's word on two histories of the code's dynamic check: the worst and the nearest to d_SLV."""

import json
import shlex
import subprocess
from pathlib import Path

import pandas as pd
from rocking.assessment.dynamic_check import width_of
from rocking.records import load_as
from rocking.records.floors import floor_columns
from rocking.runtime.script import run
from rocking.tables import read_json, write_table

from yade_scripts.model import floor_motions

LIMIT_S = 3600.0  # of one run in YADE
COLUMNS = ["model", "record", "direction", "which", "pga_g", "d_m", "d_yade_m", "status_yade"]


def main(job):
    scene = read_json(job.input.scene)
    settings = json.loads(job.params.settings)
    table, (found,) = pd.read_csv(job.input.histories), _rows(job.input.verdict)
    rows, folder = [], Path(job.params.folder)
    folder.mkdir(parents=True, exist_ok=True)
    for which in ("worst", "nearest"):
        if found is None:
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
        words = ["ida", "--scene", job.input.scene, "--motion", motion, "--plan", plan]
        words += ["--record", row["record"], "--direction", row["direction"]]
        words += ["--journal", journal, "--output", output]
        command = [*shlex.split(job.params.yade), *map(str, words)]
        subprocess.run(command, check=True, timeout=LIMIT_S)
        yade = pd.read_csv(output).iloc[-1]
        d = width_of(scene["facade"]) * min(yade["d_over_b"], 1.0)
        values = (which, row["pga_g"], row["d_m"], d, yade["status"])
        rows.append((scene["model"], row["record"], row["direction"], *values))
    write_table(rows, job.output[0], COLUMNS)


def _rows(path):
    found = pd.read_csv(path).to_dict("records")
    return found or [None]


run(main, globals())
