"""The dynamic answer for one façade and model: fragility with its bands, rate of collapse."""

import numpy as np
import pandas as pd
from rocking.stations import FEWEST

from studies.assess.comparison import EXACT
from studies.shared.fragility import bootstrap, brackets_about, fit, points
from studies.shared.rates import collapse_rate

POINTS, REACH = 101, 3.0  # of a curve; dispersions either side of the median
CONFIDENCE = 0.95
CURVES = ["model", "pga_g", "probability", "band_low", "band_high"]
RATES = ["model", "hazard", "pga_first_g", "pga_last_g", "annual_rate", "rate_low", "rate_high"]
RATES += ["outside_share"]
LEFT_OUT = ["model", "part", "hazard", "pga_fails_g", "median_pga_g", "dispersion", "rate_bound"]
USUAL_RATIO, USUAL_DISPERSION = 0.5, 0.6  # where no mechanism that was shaken tells


def weakest(table):
    """Of several mechanisms' collapse PGAs the least under each motion, with all their histories.

    Rows are as of `answer`, with part and direction, NaN where nothing fell.
    """
    by_curve = table.groupby(["model", "record", "direction"], sort=False)
    least = by_curve[["record_pga_g", "pga_p10_g", "pga_median_g", "pga_max_g"]].min()
    return least.assign(runs_planar=by_curve["runs_planar"].sum()).reset_index()


def answer(table, stations, demand_g, hazards, resamples, seed):
    """What the collapse PGAs of one model say at the demand's PGA: row, curve and rates.

    The table has a row a curve: model, record, pga_median_g (NaN where nothing fell), pga_max_g,
    runs_planar. Records of one station are drawn together. Hazards are of the PGA; the first is
    that of the row's columns `annual_rate` and so on.

    The row has medians and probability with their intervals, and the annual rate; NaN from fewer
    than `FEWEST` stations, of which there is no curve (CURVES) either. Rates (RATES) are a row a
    hazard.
    """
    collapse = table["pga_median_g"]
    low, high = brackets_about(collapse, table["pga_max_g"], EXACT)
    fragility, place = fit(low, high), table["record"].map(stations)
    row = {
        "model": table["model"].iloc[0],
        "curves": len(table),
        "stations": place.nunique(),
        "never_collapsed": int(collapse.isna().sum()),
        "median_pga_g": fragility.median if len(table) > 1 else collapse.iloc[0],
        "least_pga_g": collapse.min(),
        "fell_at_demand": int((collapse <= demand_g).sum()),
        **dict.fromkeys(("ci_low_g", "ci_high_g"), np.nan),
        "dispersion": fragility.dispersion,
        "pga_demand_g": demand_g,
        **dict.fromkeys(("probability", "probability_low", "probability_high"), np.nan),
        "histories": int(table["runs_planar"].sum()),
    }
    if hazards:
        row |= dict.fromkeys(("annual_rate", "rate_outside", "rate_low", "rate_high"), np.nan)
    if place.nunique() < FEWEST or not np.isfinite(fragility.median):
        return row, None, []
    draws = bootstrap(low, high, place, resamples, seed)
    row["ci_low_g"], row["ci_high_g"] = draws.interval(draws.median, CONFIDENCE)
    row["probability"] = float(fragility.probability(demand_g))
    (row["probability_low"],), (row["probability_high"],) = draws.band([demand_g], CONFIDENCE)
    rates = []
    for name, hazard in hazards.items():
        (rate,), (outside,) = collapse_rate(hazard, fragility.median, fragility.dispersion)
        many, _ = collapse_rate(hazard, draws.median, draws.dispersion)
        low, high = draws.interval(many, CONFIDENCE)
        about = row["model"], name, hazard.intensity[0], hazard.intensity[-1]
        rates.append(dict(zip(RATES, (*about, rate, low, high, outside), strict=True)))
    if rates:
        row |= {key: rates[0][key] for key in ("annual_rate", "rate_low", "rate_high")}
        row["rate_outside"] = rates[0]["outside_share"]
    drawn = points(fragility, draws, CONFIDENCE, POINTS, REACH)
    return row, pd.DataFrame([(row["model"], *p) for p in drawn], columns=CURVES), rates


def left_out(parts, shaken, hazards):
    """Bounds on the annual rates of the mechanisms that were not shaken (LEFT_OUT).

    By hand each fails at a PGA. Of the mechanisms that were shaken, and fell under half of their
    curves or more, the least ratio of half collapse to that PGA, no more than 1, and the largest
    dispersion are taken: so early, against its check by hand, does none of those fall.

    Parameters
    ----------
    parts : DataFrame
        Rows of `answer`, by part.
    shaken : DataFrame
        See `shaken.chosen`.
    hazards : dict of str to Hazard
    """
    rows, by_hand = [], shaken.set_index("part")["pga_fails_g"]
    for model, answers in parts.groupby("model", sort=False):
        fell = answers[
            (answers["never_collapsed"] <= 0.5 * answers["curves"]) & answers["dispersion"].notna()
        ]
        ratios = fell["median_pga_g"] / fell["part"].map(by_hand)
        ratio = min(1.0, ratios.min()) if len(fell) else USUAL_RATIO
        dispersion = fell["dispersion"].max() if len(fell) else USUAL_DISPERSION
        for row in shaken[shaken["shaken"] == 0].itertuples():
            for name, hazard in hazards.items():
                median = ratio * row.pga_fails_g
                (rate,), _ = collapse_rate(hazard, median, dispersion)
                about = model, row.part, name, row.pga_fails_g, median, dispersion, rate
                rows.append(dict(zip(LEFT_OUT, about, strict=True)))
    return pd.DataFrame(rows, columns=LEFT_OUT)
