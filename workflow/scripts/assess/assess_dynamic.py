"""The dynamic answer for one façade: fragility of each model with its bands, rate of collapse."""

import pandas as pd
from rocking.assessment.dynamic_answer import CURVES, answer
from rocking.risk.hazard import read_hazard
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    p = job.params
    hazard = read_hazard(str(job.input.hazard), p.period_s, p.site) if job.input.hazard else None
    if hazard is not None and hazard.measure != "pga_g":
        hazard = None
    demand_g = pd.read_csv(job.input.checks)["pga_demand_g"].iloc[0]
    given = (p.stations, demand_g, hazard, p.resamples, p.seed)
    found = [answer(pd.read_csv(path), *given) for path in job.input.collapse]
    write_table([row for row, _ in found], job.output.table)
    curves = [curve for _, curve in found if curve is not None]
    write_table(pd.concat(curves) if curves else [], job.output.curves, CURVES)


run(main, globals())
