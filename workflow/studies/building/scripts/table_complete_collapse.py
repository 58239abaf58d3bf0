"""Collapse of the complete building's curves, in the form of the other models' tables.

The planar columns are the scan by the building's reduction; a level that YADE ran is its one
realisation there, and disagrees where the scan's outcomes within the spread are all the other way.
"""

import pandas as pd
from rocking.collapse import agreement, probability
from rocking.collapse.ida import by_curve, read_curve
from rocking.runtime.script import run
from rocking.tables import together, write_table


def main(job):
    curves = by_curve(job.input.ida, read_curve)
    spread, rows, parts = job.params.spread, [], []
    for key, scan in by_curve(job.input.scans).items():
        curve = curves.get(key, pd.DataFrame())
        named = dict(zip(probability.KEY, key, strict=True))
        row = named | probability.summary(scan, curve, pd.DataFrame(), spread)
        table = agreement.compared(scan, curve, spread)
        lone = (table["probability_yade"] - table["probability"]).abs() == 1.0
        rows.append(row | {"disagreements": int(lone.sum())})
        parts.append(table.assign(**named)[probability.PROBABILITY_COLUMNS])
    write_table(rows, job.output.collapse, probability.COLUMNS, digits="%.4f")
    write_table(together(parts), job.output.probability, digits="%.4f")


run(main, globals())
