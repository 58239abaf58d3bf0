"""The study's statements on damping beside what was measured (tables/claims_calibration.csv)."""

import json

import pandas as pd
from rocking.calibration.claims import evaluate
from rocking.runtime.script import run
from rocking.statements import COLUMNS


def main(job):
    tables = [pd.read_csv(path) for path in (job.input.free, job.input.fits, job.input.walls)]
    release = json.loads(job.params.settings)["calibration"]["release_ratio"]
    rows = evaluate(*tables, release=release)
    pd.DataFrame(rows, columns=COLUMNS).to_csv(job.output[0], index=False, lineterminator="\n")


run(main, globals())
