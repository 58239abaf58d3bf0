"""The dynamic answer for one façade: fragility of each model with its bands, rate of collapse."""

import numpy as np
import pandas as pd
from rocking.assessment.comparison import EXACT
from rocking.risk.hazard import read_hazard
from rocking.risk.rates import collapse_rate
from rocking.runtime.script import run
from rocking.studies.fragility import bootstrap, fit
from rocking.tables import write_table

POINTS = 101


def main(job):
    p = job.params
    hazard = read_hazard(str(job.input.hazard), p.period_s, p.site) if job.input.hazard else None
    if hazard is not None and hazard.measure != "pga_g":
        hazard = None
    demand = pd.read_csv(job.input.checks)["pga_demand_g"].iloc[0]
    rows, curves = [], []
    for path in job.input.collapse:
        table = pd.read_csv(path)
        known = table["pga_median_g"].notna()
        low = np.where(known, table["pga_median_g"] * (1.0 - EXACT), table["pga_max_g"])
        high = np.where(known, table["pga_median_g"] * (1.0 + EXACT), np.inf)
        stations = table["record"].map(p.stations)
        found = fit(low, high)
        draws = bootstrap(low, high, stations, p.resamples, p.seed)
        median_ci = draws.interval("median", 0.95)
        band = draws.band([demand], 0.95)
        row = {
            "model": table["model"].iloc[0],
            "curves": len(table),
            "stations": stations.nunique(),
            "never_collapsed": int((~known).sum()),
            "median_pga_g": found.median,
            "ci_low_g": median_ci[0],
            "ci_high_g": median_ci[1],
            "dispersion": found.dispersion,
            "pga_demand_g": demand,
            "probability": float(found.probability(demand)),
            "probability_low": float(band[0][0]),
            "probability_high": float(band[1][0]),
            "histories": int(table["runs_planar"].sum()),
        }
        if hazard is not None:
            rate, outside = collapse_rate(hazard, found.median, found.dispersion)
            many, _ = collapse_rate(hazard, draws.median, draws.dispersion)
            ends = np.percentile(many, (2.5, 97.5), method="inverted_cdf")
            row |= {"annual_rate": float(rate[0]), "rate_outside": float(outside[0])}
            row |= {"rate_low": float(ends[0]), "rate_high": float(ends[1])}
        rows.append(row)
        pga_g = found.median * np.exp(np.linspace(-3.0, 3.0, POINTS) * found.dispersion)
        lower, upper = draws.band(pga_g, 0.95)
        curves.append(
            pd.DataFrame(
                {
                    "model": row["model"],
                    "pga_g": pga_g,
                    "probability": found.probability(pga_g),
                    "band_low": lower,
                    "band_high": upper,
                }
            )
        )
    write_table(rows, job.output.table)
    write_table(pd.concat(curves), job.output.curves)


run(main, globals())
