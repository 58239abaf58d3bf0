"""Collapse of the complete building's curves, in the form of the other models' tables.

The planar columns are the scan by the building's reduction; a level that YADE ran is its one member
there, and disagrees where the scan's outcomes within the spread are all the other way.
"""

import pandas as pd
from rocking.curves import collapse
from rocking.curves.ida import curve_key, read_curve
from rocking.runtime.script import run


def main(job):
    scans = {curve_key(table): table for table in map(pd.read_csv, job.input.scans)}
    spread, rows, parts = job.params.spread, [], []
    for curve in map(read_curve, job.input.ida):
        key = curve_key(curve)
        named = dict(zip(("model", "record", "direction"), key, strict=True))
        row = named | collapse.summary(scans[key], curve, pd.DataFrame(), spread)
        table = collapse.beside(scans[key], curve, spread)
        lone = (table["probability_yade"] - table["probability"]).abs() == 1.0
        rows.append(row | {"disagreements": int(lone.sum())})
        parts.append(table.assign(**named)[collapse.PROBABILITY_COLUMNS])
    options = {"index": False, "float_format": "%.4f", "lineterminator": "\n"}
    pd.DataFrame(rows, columns=collapse.COLUMNS).to_csv(job.output.collapse, **options)
    pd.concat(parts).to_csv(job.output.probability, **options)


run(main, globals())
