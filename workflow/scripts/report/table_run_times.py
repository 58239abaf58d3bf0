"""Run times of every analysis: Snakemake's benchmark of the job beside YADE's own time in it.

Runs are single ones and the realisations of the ensemble, which one process takes.
"""

from pathlib import Path

import pandas as pd
from rocking.collapse.ida import read_curve
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table

COLUMNS = [
    "model",
    "record",
    "direction",
    "runs",
    "steps",
    "wall_runs_s",
    "wall_s",
    "cpu_s",
    "max_rss_mb",
]


def main(job):
    folder = Path(job.params.benchmarks)
    rows = []
    for path, ensemble in zip(job.input.ida, job.input.ensembles, strict=True):
        curve = read_curve(path)
        model, record, direction = (curve[k][0] for k in ("model", "record", "direction"))
        more = read_frame(ensemble)
        curve = pd.concat([curve, more]) if len(more) else curve
        row = [
            model,
            record,
            direction,
            len(curve),
            int(curve["steps"].sum()),
            curve["wall_s"].sum(),
        ]
        measured = folder / f"ida_{model}_{record}_{direction}.tsv"
        if measured.is_file():  # absent where results were copied from another place
            times = read_frame(measured, sep="\t").iloc[0]
            row += [times["s"], times["cpu_time"], times["max_rss"]]
        rows.append(row + [None] * (len(COLUMNS) - len(row)))
    write_table(rows, job.output[0], COLUMNS, digits="%.4g")


run(main, globals())
