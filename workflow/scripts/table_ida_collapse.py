"""Collapse intensities of every curve (tables/ida_collapse.csv)."""

import pandas as pd
from rocking.ida import COLLAPSE_COLUMNS, collapse_row, read_curve
from rocking.script import run


def main(job):
    rows = [collapse_row(read_curve(path)) for path in job.input.ida]
    table = pd.DataFrame(rows, columns=COLLAPSE_COLUMNS)
    table.to_csv(job.output[0], index=False, float_format="%.4f", lineterminator="\n")


run(main, globals())
