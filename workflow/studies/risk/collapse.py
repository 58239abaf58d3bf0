"""Risk of collapse of every model of a run: rate, probability in time, and by intensity."""

import numpy as np
from rocking import stations

from studies.shared import fragility, rates

MUCH = 0.1  # share of the rate from beyond the hazard table, or from above all runs: worth a word
COLUMNS = ["model", "im", "median", "dispersion", "annual_rate", "rate_low", "rate_high"]
COLUMNS += ["years", "probability", "probability_low", "probability_high"]
COLUMNS += ["outside_share", "n_records", "n_stations", "rate_lognormal", "remark"]
BUILDING = ["building_rate", "building_low", "building_high", "building_probability"]
BUILDING += ["share_before_building"]  # of the façade's rate; beyond it the building is down
PARTS = ["model", "im", "intensity_low", "intensity_high", "annual_rate"]
PARTS += ["share", "share_low", "share_high"]


def risk_of(model, curves, stations_of, brackets, hazard, risk, settings):
    """Annual rate of collapse of a model, and where on the intensities it comes from.

    The rate is the mean over the curves of ∫ P |dλ| with each one's own collapse probability P, so
    that a façade which stands again above a collapse counts as it is. Beside it stands that of the
    lognormal fragility. Intervals come from stations drawn with replacement.

    `curves` (`fragility_tables.shares`) have intensity and share in the hazard's measure by
    model, record and direction, `brackets` (of the same module) the share that falls; `risk` and
    `settings` are sections risk (years, bins) and fragility (confidence, resamples, min_stations;
    seed). Returns a row of COLUMNS, NaN where nothing falls, and rows of PARTS.
    """
    places, confidence = [stations_of[key[1]] for key in curves], settings["confidence"]
    many = (len({key[1] for key in curves}), len(set(places)))
    few = stations.remark(*many, settings["min_stations"])
    edges = np.geomspace(hazard.intensity[0], hazard.intensity[-1], risk["bins"] + 1)
    edges[[0, -1]] = hazard.intensity[[0, -1]]
    edges = np.concatenate([[0.0], edges, [np.inf]])
    of_curves = np.array([rates.of_curve(hazard, x, p, edges) for x, p in curves.values()])
    by_bin = of_curves.mean(axis=0) if len(of_curves) else np.zeros(len(edges) - 1)
    rate = by_bin.sum()
    if not rate > 0.0:
        known = {"model": model, "im": hazard.measure, "years": risk["years"]}
        known |= dict(zip(("n_records", "n_stations"), many, strict=True))
        return known | {"remark": remark(np.nan, 0.0, 0.0, few)}, []
    counts = stations.resampled(places, settings["resamples"], settings["seed"])
    drawn_by_bin = counts @ of_curves / counts.sum(axis=1, keepdims=True)
    drawn = drawn_by_bin.sum(axis=1)
    ends = stations.interval(drawn, many[1], confidence)
    within = rates.probability_within([rate, *ends], risk["years"])
    outside = (by_bin[0] + by_bin[-1]) / rate
    fit = fragility.fit(*(brackets[name].to_numpy() for name in ("low", "high", "weight")))
    lognormal = np.nan
    if np.isfinite(fit.median):
        lognormal = rates.collapse_rate(hazard, fit.median, fit.dispersion)[0][0]
    words = remark(rate, outside, above(curves.values(), hazard) / rate, few)
    of_model = (model, hazard.measure, fit.median, fit.dispersion, rate, *ends, risk["years"])
    row = dict(zip(COLUMNS, (*of_model, *within, outside, *many, lognormal, words), strict=True))
    usable = drawn > 0.0
    shares = drawn_by_bin[usable] / drawn[usable, None]
    lower, upper = stations.interval(shares, many[1], confidence)
    bins = zip(edges[:-1], edges[1:], by_bin, by_bin / rate, lower, upper, strict=True)
    return row, [(model, hazard.measure, *values) for values in bins]


def beside_building(curves, stations_of, hazard, risk, settings):
    """What a building that yields does in a year, beside the façade: columns BUILDING of a row.

    Its rate is the mean over the curves of ∫ P_b |dλ|, with P_b the probability that a storey has
    come to its drift; above the largest intensity that was run P_b stays what it is there.
    `share_before_building` is ∫ P (1 − P_b) |dλ| over ∫ P |dλ|: how much of the façade's rate is of
    a façade whose building stands.

    `curves` (`fragility_tables.building_shares`) have intensity, P and P_b by model, record and
    direction; others are as of `risk_of`. Nothing without curves.
    """
    if not curves:
        return {}
    edges = np.array([0.0, np.inf])
    places = [stations_of[key[1]] for key in curves]
    rate, falls, before = (
        np.array([rates.of_curve(hazard, x, p, edges).sum() for x, p in some])
        for some in (
            [(x, down) for x, _, down in curves.values()],
            [(x, fell) for x, fell, _ in curves.values()],
            [(x, fell * (1.0 - down)) for x, fell, down in curves.values()],
        )
    )
    counts = stations.resampled(places, settings["resamples"], settings["seed"])
    drawn = counts @ rate / counts.sum(axis=1)
    low, high = stations.interval(drawn, len(set(places)), settings["confidence"])
    whole = falls.sum()
    share = before.sum() / whole if whole > 0.0 else np.nan
    within = float(rates.probability_within(rate.mean(), risk["years"]))
    return dict(zip(BUILDING, (rate.mean(), low, high, within, share), strict=True))


def above(curves, hazard):
    """What the rate may rise by if all curves fell above the largest intensity that was run."""
    return np.mean([(1.0 - share[-1]) * hazard.rate(x[-1]) for x, share in curves])


def remark(rate, outside, unknown, few):
    """What the reader of a row has to know, in a few words; `few` of `stations.remark`."""
    words = [few] if few else []
    if not np.isfinite(rate):
        words.append("no collapse")
    if outside > MUCH:
        words.append(f"{100 * outside:.0f} % of the rate from beyond the hazard table")
    if unknown > MUCH:
        words.append(f"up to {100 * unknown:.0f} % more from above what was run")
    return "; ".join(words)
