"""Collapse intensities of every curve (tables/ida_collapse.csv)."""

import pandas as pd
from rocking.curves.ensemble import collapse_percentiles
from rocking.curves.ida import COLLAPSE_COLUMNS, collapse_row, curve_key, read_curve
from rocking.runtime.script import run


def main(job):
    ensembles = [pd.read_csv(path) for path in getattr(job.input, "ensemble", [])]
    bands = {
        curve_key(table): collapse_percentiles(table, job.params.percentiles)
        for table in ensembles
        if len(table)
    }
    rows = []
    for path in job.input.ida:
        curve = read_curve(path)
        row = collapse_row(curve)
        blank = (None, None, None)
        row["pga_median_g"], row["pga_p10_g"], row["pga_p90_g"] = bands.get(curve_key(curve), blank)
        rows.append(row)
    table = pd.DataFrame(rows, columns=COLLAPSE_COLUMNS)
    table.to_csv(job.output[0], index=False, float_format="%.4f", lineterminator="\n")


run(main, globals())
