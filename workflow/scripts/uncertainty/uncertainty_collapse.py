"""Collapse under one motion over the sample of material, for every form of the model."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
from rocking.assessment.collapse import STEP, Climb, lowest_start
from rocking.records import read_csv
from rocking.records.floors import floor_columns
from rocking.runtime.script import run
from rocking.tables import write_table
from rocking.uncertainty import sampling

BELOW = 0.5  # of the medians' first collapse: where the climb of another point begins
OTHER = {"start": 1.007, "step": 0.9}  # of a cell that is run again
COLUMNS = ["record", "direction", "model", "sample", "replicate"]
COLUMNS += ["pga_p10_g", "pga_median_g", "pga_max_g", "runs_planar"]


def main(job):
    p = job.params
    settings, record = json.loads(p.settings), read_csv(job.input.record)
    factors, limit = sampling.factors(settings), settings["max_pga_g"]
    rows = []
    for path in job.input.scenes:
        scene, first = json.loads(Path(path).read_text()), None
        for number, factor in enumerate(factors.to_dict("records")):
            case = sampling.varied(scene, factor)
            motion = floor_columns(record, case["smdof"])
            lowest = lowest_start(case)
            start = max(lowest, BELOW * first) if first else lowest
            for again in range(1 + (0 < number <= settings["replicates"])):
                step = STEP * OTHER["step"] if again else STEP
                climb = Climb(case, *motion, p.direction, step)
                found = climb.crossings(limit, start * OTHER["start"] if again else start)
                if number == sampling.MEDIAN:
                    first = found[0] if np.isfinite(found[0]) else None
                key = (record.name, p.direction, case["model"], number, again)
                rows.append((*key, *found, limit, climb.runs))
    table = pd.DataFrame(rows, columns=COLUMNS)
    write_table(table, job.output[0])


run(main, globals())
