"""Fragility of a class of façades by the formula: what differs between façades and between motions.

A façade of the class falls at IM ~ Lognormal(θ_i, δ_i) over ground motions. Over the class θ
scatters too: with weights w_i

    ln θ = Σ w_i ln θ_i,   β_f² = Σ w_i (ln θ_i − ln θ)²,   β_m² = Σ w_i δ_i²,

and a lognormal curve with β² = β_f² + β_m² has the mean and the variance of the mixture's
logarithm. The class of one façade has β_f = 0 and is that façade's curve.
"""

import math

import numpy as np
import pandas as pd
from rocking.formula import groups, law
from scipy.special import ndtr, ndtri

from studies.shared.fragility import Fragility

COLUMNS = ["model", "measure", "median", "dispersion", "by_facade", "by_motion", "by_formula"]
COLUMNS += ["n", "n_outside"]
OUTSIDE = 0.05  # share of a class that may lie outside of the formula's limits
ASKS = {  # keys of a row by its distribution
    "value": ("median",),
    "uniform": ("low", "high"),
    "lognormal": ("median", "spread"),
    "choice": ("values",),
}
DRAWN = (*groups.DIMENSIONS, "thickness_m")  # what a distribution may be of


def combined(medians, dispersions, weights=None):
    """Median θ of a class, its dispersion β, and the parts β_f by façade and β_m by motion.

    Of θ_i, δ_i and w_i, each of shape (n,); without weights all count alike.
    """
    x, spread = np.log(np.asarray(medians, float)), np.asarray(dispersions, float)
    w = np.ones(x.size) if weights is None else np.asarray(weights, float)
    w = w / w.sum()
    mean = float(w @ x)
    by_facade = math.sqrt(max(0.0, float(w @ (x - mean) ** 2)))
    by_motion = math.sqrt(float(w @ spread**2))
    return math.exp(mean), math.hypot(by_facade, by_motion), by_facade, by_motion


def mixture(intensity, medians, dispersions, weights=None):
    """Probability that a façade drawn from the class falls, without a lognormal for it."""
    w = np.ones(np.size(medians)) if weights is None else np.asarray(weights, float)
    z = np.log(np.asarray(intensity, float)[..., None] / np.asarray(medians, float))
    return ndtr(z / np.asarray(dispersions, float)) @ (w / w.sum())


def quantile(row, u):
    """Value of a distribution at probabilities u, an array.

    The row has distribution (value, uniform, lognormal or choice) and what it asks for: median
    [unit of the parameter], spread (standard deviation of the logarithm), low and high, values, all
    alike. A lognormal one is cut at low and high, where they are given.
    """
    kind = row["distribution"]
    if kind == "value":
        return np.full_like(u, row["median"])
    if kind == "uniform":
        return row["low"] + (row["high"] - row["low"]) * u
    if kind == "choice":
        values = np.asarray(row["values"], float)
        return values[np.minimum((u * values.size).astype(int), values.size - 1)]
    ends = [row.get("low") or 0.0, row.get("high") or math.inf]
    with np.errstate(divide="ignore"):
        low, high = ndtr(np.log(np.array(ends) / row["median"]) / row["spread"])
    return row["median"] * np.exp(row["spread"] * ndtri(low + (high - low) * u))


def check_row(row):
    """Refuse a row that lacks what its distribution asks for, or whose ends do not ascend.

    A ValueError of one line.
    """
    asks = ASKS[row["distribution"]]
    said = f"facade_class.parameters: {row['parameter']}: {row['distribution']}"
    if lacks := [key for key in asks if row.get(key) is None]:
        raise ValueError(f"{said} without {lacks[0]}; expected {' and '.join(asks)}")
    low, high = row.get("low"), row.get("high")
    if None not in (low, high) and low >= high:
        raise ValueError(f"{said} from {low:g} to {high:g}; expected low < high")


def sampled(settings):
    """Façades of a class: Sobol' points over its distributions, the parameters independent.

    By section facade_class (samples, seed, parameters) a table of `groups.DIMENSIONS`; a thickness
    takes the place of the slenderness. A ValueError of one line for a parameter that is missing or
    named twice, and as of `check_row`.
    """
    from scipy.stats import qmc

    rows = settings["parameters"]
    names = [row["parameter"] for row in rows]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"facade_class.parameters: {name} stands there twice; expected once")
    for row in rows:
        check_row(row)
    maker = qmc.Sobol(len(rows), rng=np.random.default_rng(settings["seed"]))
    points = maker.random(settings["samples"])
    table = pd.DataFrame(
        {row["parameter"]: quantile(row, u) for row, u in zip(rows, points.T, strict=True)}
    )
    if "thickness_m" in table and "slenderness" not in table:
        table["slenderness"] = table["height_m"] / table["thickness_m"]
    if missing := [name for name in groups.DIMENSIONS if name not in table]:
        raise ValueError(
            f"facade_class.parameters: {missing[0]} is missing; expected {', '.join(DRAWN)}, "
            "thickness_m or slenderness"
        )
    return table[list(groups.DIMENSIONS)]


def fragility(facades, model, measure="pga_g", base=None, known=None):
    """Curve of a class by the formula: COLUMNS.

    `facades` have `groups.DIMENSIONS`, and weight if they do not count alike; else as of
    `law.said`, `known` of `law.read`. An OutsideError of one line where more than `OUTSIDE` of the
    class lies outside of the formula's limits; less is left out, and counted.
    """
    said, weights, outside = [], [], 0.0
    given = facades.get("weight", pd.Series(1.0, facades.index))
    last = None
    for row, weight in zip(facades[list(groups.DIMENSIONS)].to_dict("records"), given, strict=True):
        try:
            said.append(law.said(row, model, measure, base, known))
            weights.append(weight)
        except groups.OutsideError as error:
            outside, last = outside + weight, error
    if outside > OUTSIDE * given.sum():
        raise groups.OutsideError(
            f"class: {100 * outside / given.sum():.0f} % of it lie outside of the formula: {last}"
        )
    medians, spreads, errors = (np.array(part) for part in zip(*said, strict=True))
    curve = combined(medians, spreads, weights)
    rms_error = float(np.sqrt(np.average(errors**2, weights=weights)))
    values = (model, measure, *curve, rms_error, len(said), len(facades) - len(said))
    return dict(zip(COLUMNS, values, strict=True))


def curves(table):
    """`Fragility` of every model of a table of `fragility`, for `risk.nrml.document`."""
    return {row["model"]: Fragility(row["median"], row["dispersion"]) for row in table}
