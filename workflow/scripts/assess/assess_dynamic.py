"""The dynamic answer for one façade: fragility of each model with its bands, rate of collapse."""

import numpy as np
import pandas as pd
from rocking.assessment.comparison import EXACT
from rocking.risk.hazard import read_hazard
from rocking.risk.rates import FEWEST, collapse_rate
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
        enough = stations.nunique() >= FEWEST and np.isfinite(found.median)
        median_ci, band = (np.nan, np.nan), ([np.nan], [np.nan])
        if enough:
            draws = bootstrap(low, high, stations, p.resamples, p.seed)
            median_ci, band = draws.interval("median", 0.95), draws.band([demand], 0.95)
        row = {
            "model": table["model"].iloc[0],
            "curves": len(table),
            "stations": stations.nunique(),
            "never_collapsed": int((~known).sum()),
            "median_pga_g": found.median if len(table) > 1 else table["pga_median_g"].iloc[0],
            "least_pga_g": table["pga_median_g"].min(),
            "fell_at_demand": int((table["pga_median_g"] <= demand).sum()),
            "ci_low_g": median_ci[0],
            "ci_high_g": median_ci[1],
            "dispersion": found.dispersion,
            "pga_demand_g": demand,
            "probability": float(found.probability(demand)) if enough else np.nan,
            "probability_low": float(band[0][0]),
            "probability_high": float(band[1][0]),
            "histories": int(table["runs_planar"].sum()),
        }
        if hazard is not None and enough:
            rate, outside = collapse_rate(hazard, found.median, found.dispersion)
            many, _ = collapse_rate(hazard, draws.median, draws.dispersion)
            ends = np.percentile(many, (2.5, 97.5), method="inverted_cdf")
            row |= {"annual_rate": float(rate[0]), "rate_outside": float(outside[0])}
            row |= {"rate_low": float(ends[0]), "rate_high": float(ends[1])}
        rows.append(row)
        if not enough:  # a curve drawn from so few motions says nothing
            continue
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
    names = ["model", "pga_g", "probability", "band_low", "band_high"]
    write_table(pd.concat(curves) if curves else [], job.output.curves, names)


run(main, globals())
