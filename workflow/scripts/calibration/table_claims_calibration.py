"""The study's statements on damping beside what was measured (tables/claims_calibration.csv)."""

import json

import pandas as pd
from rocking.calibration.claims import evaluate
from rocking.runtime.script import run
from rocking.statements import COLUMNS
from rocking.tables import write_table


def main(job):
    tables = [pd.read_csv(path) for path in (job.input.free, job.input.fits, job.input.walls)]
    release = json.loads(job.params.settings)["calibration"]["release_ratio"]
    rows = evaluate(*tables, release=release)
    write_table(rows, job.output[0], COLUMNS, digits=None)


run(main, globals())
