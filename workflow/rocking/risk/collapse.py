"""Risk of collapse of every model of a run: rate, probability in time, and by intensity."""

import numpy as np

from rocking import stations
from rocking.risk import rates
from rocking.studies import fragility

MUCH = 0.1  # share of the rate from beyond the hazard table that is worth a word
COLUMNS = ["model", "im", "median", "dispersion", "annual_rate", "rate_low", "rate_high"]
COLUMNS += ["years", "probability", "probability_low", "probability_high"]
COLUMNS += ["outside_share", "n_records", "n_stations", "remark"]
PARTS = ["model", "im", "intensity_low", "intensity_high", "annual_rate"]
PARTS += ["share", "share_low", "share_high"]


def risk_of(model, part, hazard, risk, settings):
    """Annual rate of collapse of a model, and where on the intensities it comes from.

    Intervals come from stations drawn with replacement, as those of the fragility curves do.

    Parameters
    ----------
    model : str
    part : DataFrame
        Its brackets in the hazard's measure, see `studies.fragility_tables.brackets`.
    hazard : rocking.risk.hazard.Hazard
    risk, settings : dict
        Sections risk (years, bins) and fragility (confidence, resamples, min_stations; seed).

    Returns
    -------
    dict, list of tuple
        A row with COLUMNS, NaN where the brackets determine no fragility; rows with PARTS.
    """
    fit, draws = fragility.fit_table(part, settings)
    many, confidence = (part["record"].nunique(), draws.stations), settings["confidence"]
    few = stations.remark(*many, settings["min_stations"])
    if not np.isfinite(fit.median):
        known = {"model": model, "im": hazard.measure, "years": risk["years"]}
        known |= dict(zip(("n_records", "n_stations"), many, strict=True))
        return known | {"remark": remark(np.nan, 0.0, few)}, []
    (rate,), (outside,) = rates.collapse_rate(hazard, fit.median, fit.dispersion)
    drawn, _ = rates.collapse_rate(hazard, draws.median, draws.dispersion)
    ends = draws.interval(drawn, confidence)
    within = rates.probability_within([rate, *ends], risk["years"])
    words = remark(rate, outside, few)
    own = (model, hazard.measure, fit.median, fit.dispersion, rate, *ends, risk["years"])
    row = dict(zip(COLUMNS, (*own, *within, outside, *many, words), strict=True))
    inner = np.geomspace(hazard.intensity[0], hazard.intensity[-1], risk["bins"] + 1)
    inner[[0, -1]] = hazard.intensity[[0, -1]]
    edges, (by_bin,) = _bins(hazard, fit.median, fit.dispersion, inner)
    _, by_bin_drawn = _bins(hazard, draws.median, draws.dispersion, inner)
    usable = np.isfinite(drawn) & (drawn > 0.0)
    lower, upper = draws.interval(by_bin_drawn[usable] / drawn[usable, None], confidence)
    bins = zip(edges[:-1], edges[1:], by_bin, by_bin / rate, lower, upper, strict=True)
    return row, [(model, hazard.measure, *values) for values in bins]


def remark(rate, outside, few):
    """What the reader of a row has to know, in a few words; `few` of `stations.remark`."""
    words = [few] if few else []
    if not np.isfinite(rate):
        words.append("fragility not determined")
    if outside > MUCH:
        words.append(f"{100 * outside:.0f} % of the rate from beyond the hazard table")
    return "; ".join(words)


def _bins(hazard, median, dispersion, inner):
    """Rate by the intervals between `inner` and beyond its ends."""
    edges, rate = rates.by_interval(hazard, median, dispersion, inner)
    wanted = np.concatenate([[0.0], inner])
    first = np.searchsorted(edges, wanted)
    return np.append(wanted, np.inf), np.add.reduceat(rate, first, axis=1)
