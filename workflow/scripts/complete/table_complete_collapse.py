"""Collapse of the complete building's curves, in the form of the other models' tables.

The planar columns are the scan by the building's reduction; a level that YADE ran is its one member
there, and disagrees where the scan's outcomes within the spread are all the other way.
"""

import pandas as pd
from rocking.collapse import probability
from rocking.collapse.ida import curve_key, read_curve
from rocking.runtime.script import run


def main(job):
    curves = {curve_key(curve): curve for curve in map(read_curve, job.input.ida)}
    spread, rows, parts = job.params.spread, [], []
    for scan in map(pd.read_csv, job.input.scans):
        key = curve_key(scan)
        curve = curves.get(key, pd.DataFrame())
        named = dict(zip(probability.KEY, key, strict=True))
        row = named | probability.summary(scan, curve, pd.DataFrame(), spread)
        table = probability.beside(scan, curve, spread)
        lone = (table["probability_yade"] - table["probability"]).abs() == 1.0
        rows.append(row | {"disagreements": int(lone.sum())})
        parts.append(table.assign(**named)[probability.PROBABILITY_COLUMNS])
    options = {"index": False, "float_format": "%.4f", "lineterminator": "\n"}
    pd.DataFrame(rows, columns=probability.COLUMNS).to_csv(job.output.collapse, **options)
    pd.concat(parts).to_csv(job.output.probability, **options)


run(main, globals())
