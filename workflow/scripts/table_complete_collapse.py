"""Collapse of the complete building's curves, in the form of the other models' tables.

No planar solver stands in for it, so the columns of one are blank; what YADE ran at a level is its
one member there.
"""

import pandas as pd
from rocking.curves import collapse
from rocking.curves.ida import curve_key, read_curve
from rocking.runtime.script import run


def main(job):
    rows, parts = [], []
    for curve in map(read_curve, job.input.ida):
        named = dict(zip(("model", "record", "direction"), curve_key(curve), strict=True))
        row = named | collapse.summary(None, curve, pd.DataFrame(), job.params.spread)
        table = collapse.beside(None, curve, job.params.spread)
        rows.append(row | {"disagreements": 0})
        parts.append(table.assign(**named)[collapse.PROBABILITY_COLUMNS])
    options = {"index": False, "float_format": "%.4f", "lineterminator": "\n"}
    pd.DataFrame(rows, columns=collapse.COLUMNS).to_csv(job.output.collapse, **options)
    pd.concat(parts).to_csv(job.output.probability, **options)


run(main, globals())
