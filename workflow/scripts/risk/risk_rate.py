"""Annual rate of collapse of every model at a site, its probability in time, and by intensity.

Writes tables/risk.csv and risk/deaggregation.csv. Intervals come from records
drawn with replacement, as those of the fragility curves do.
"""

import numpy as np
import pandas as pd
from rocking.risk import rates
from rocking.risk.hazard import read_hazard
from rocking.runtime.script import run
from rocking.studies import fragility
from rocking.tables import write_table

MUCH = 0.1  # share of the rate from beyond the hazard table that is worth a word
COLUMNS = [
    *("model", "im", "median", "dispersion", "annual_rate", "rate_low", "rate_high"),
    *("years", "probability", "probability_low", "probability_high"),
    *("outside_share", "n_records", "remark"),
]


def remark(rate, outside, records, settings):
    """What the reader of a row has to know, in a few words."""
    words = []
    if not np.isfinite(rate):
        words.append("fragility not determined")
    if outside > MUCH:
        words.append(f"{outside:.0%} of the rate from beyond the hazard table")
    if records < rates.FEWEST:
        words.append(f"no interval: {records} of at least {rates.FEWEST} records")
    elif records < settings["min_records"]:
        words.append(f"indicative: {records} records")
    return "; ".join(words)


def main(job):
    risk, settings = job.params.risk, job.params.fragility
    hazard = read_hazard(str(job.input.hazard), job.params.period_s, risk["site"])
    table = pd.read_csv(job.input.brackets)
    table = table[table["im"] == hazard.measure]
    inner = np.geomspace(hazard.intensity[0], hazard.intensity[-1], risk["bins"] + 1)
    inner[[0, -1]] = hazard.intensity[[0, -1]]
    tails = 50.0 * (1.0 - settings["confidence"]) * np.array([1.0, -1.0]) + [0.0, 100.0]
    rows, parts = [], []
    for model, part in table.groupby("model", sort=False):
        low, high, weight = (part[column].to_numpy() for column in ("low", "high", "weight"))
        fit = fragility.fit(low, high, weight)
        records = part["record"].nunique()
        if not np.isfinite(fit.median):
            blank = dict.fromkeys(COLUMNS, np.nan)
            words = remark(np.nan, 0.0, records, settings)
            known = {"model": model, "im": hazard.measure, "years": risk["years"]}
            rows.append(blank | known | {"n_records": records, "remark": words})
            continue
        draws = fragility.bootstrap(
            low, high, part["record"], settings["resamples"], settings["seed"], weight
        )
        (rate,), (outside,) = rates.collapse_rate(hazard, fit.median, fit.dispersion)
        drawn, _ = rates.collapse_rate(hazard, draws.median, draws.dispersion)
        few = records < rates.FEWEST
        ends = [np.nan] * 2 if few else np.percentile(drawn, tails, method="inverted_cdf")
        words = remark(rate, outside, records, settings)
        within = rates.probability_within([rate, *ends], risk["years"])
        values = (rate, *ends, risk["years"], *within, outside, records, words)
        own = (model, hazard.measure, fit.median, fit.dispersion)
        rows.append(dict(zip(COLUMNS, (*own, *values), strict=True)))
        edges, by_bin = _bins(hazard, fit.median, fit.dispersion, inner)
        _, by_bin_drawn = _bins(hazard, draws.median, draws.dispersion, inner)
        usable = np.isfinite(drawn) & (drawn > 0.0)
        shares = by_bin_drawn[usable] / drawn[usable, None]
        lower, upper = np.percentile(shares, tails, axis=0)
        if few:
            lower, upper = np.full((2, lower.size), np.nan)
        for i, value in enumerate(by_bin[0]):
            ends = (edges[i], edges[i + 1], value, value / rate, lower[i], upper[i])
            parts.append((model, hazard.measure, *ends))
    write_table(rows, job.output.table, COLUMNS)
    names = ["model", "im", "intensity_low", "intensity_high", "annual_rate"]
    names += ["share", "share_low", "share_high"]
    write_table(parts, job.output.deaggregation, names)


def _bins(hazard, median, dispersion, inner):
    """Rate by the intervals between `inner` and beyond its ends."""
    edges, rate = rates.by_interval(hazard, median, dispersion, inner)
    wanted = np.concatenate([[0.0], inner])
    first = np.searchsorted(edges, wanted)
    return np.append(wanted, np.inf), np.add.reduceat(rate, first, axis=1)


run(main, globals())
