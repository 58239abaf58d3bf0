"""Collapse intensities of every curve, and its collapse probability against PGA."""

import pandas as pd
from rocking.collapse import agreement, building, probability
from rocking.collapse.ida import by_curve, read_curve
from rocking.runtime.script import run
from rocking.tables import together, write_table


def main(job):
    scans, ensembles = by_curve(job.input.scans), by_curve(job.input.ensemble)
    curves = by_curve(job.input.ida, read_curve)
    spread, none = job.params.spread, pd.DataFrame()
    rows, parts = [], []
    for key in map(tuple, job.params.curves):
        scan, curve, realisations = scans.get(key), curves.get(key, none), ensembles.get(key, none)
        named = dict(zip(probability.KEY, key, strict=True))
        row = named | probability.summary(scan, curve, realisations, spread, job.params.slope)
        row |= building.told(scan, row, spread)
        table = building.joined(agreement.compared(scan, realisations, spread), scan, spread)
        table = table.assign(**named).reindex(columns=probability.PROBABILITY_COLUMNS)
        row["disagreements"] = agreement.disagreements(table)
        row["confirmed"] = agreement.confirmed(scan, curve, realisations, spread)
        rows.append(row)
        parts.append(table)
    write_table(rows, job.output.collapse, probability.COLUMNS, digits="%.4f")
    write_table(together(parts), job.output.probability, digits="%.4f")


run(main, globals())
