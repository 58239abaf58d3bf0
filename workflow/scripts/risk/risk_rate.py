"""Annual rate of collapse of every model at a site, its probability in time, and by intensity.

Writes tables/risk.csv and risk/deaggregation.csv.
"""

import pandas as pd
from rocking.risk.collapse import COLUMNS, PARTS, risk_of
from rocking.risk.hazard import read_hazard
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    risk, settings = job.params.risk, job.params.fragility
    hazard = read_hazard(str(job.input.hazard), job.params.period_s, risk["site"])
    table = pd.read_csv(job.input.brackets)
    rows, parts = [], []
    for model, part in table[table["im"] == hazard.measure].groupby("model", sort=False):
        row, bins = risk_of(model, part, hazard, risk, settings)
        rows.append(row)
        parts += bins
    write_table(rows, job.output.table, COLUMNS)
    write_table(parts, job.output.deaggregation, PARTS)


run(main, globals())
