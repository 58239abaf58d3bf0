"""The study's statements on damping beside what was measured (tables/claims_calibration.csv)."""

import json

from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.calibration.claims import evaluate
from studies.shared.statements import COLUMNS


def main(job):
    tables = [read_frame(path) for path in (job.input.free, job.input.fits, job.input.walls)]
    release = json.loads(job.params.settings)["calibration"]["release_ratio"]
    rows = evaluate(*tables, release=release)
    write_table(rows, job.output[0], COLUMNS, digits=None)


run(main, globals())
