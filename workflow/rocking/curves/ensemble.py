"""Statistics of perturbed ensembles: bands of d/b, collapse probability, members needed.

An ensemble table has one row a member and intensity (columns pga_g, member,
d_over_b, collapsed, status). Failed runs say nothing about the façade and are
left out; an overturned run counts as d/b = 1.
"""

import math

import numpy as np
import pandas as pd


def _valid(rows):
    """Rows as a table, without failed runs, overturned ones at d/b = 1."""
    table = pd.DataFrame(rows)
    if table.empty:
        return table
    table = table[table["status"] != "failed"].copy()
    table["pga_g"] = table["pga_g"].astype(float)
    table["collapsed"] = table["collapsed"].astype(float)
    table["d_over_b"] = table["d_over_b"].astype(float).where(table["collapsed"] == 0.0, 1.0)
    return table


def bands(ensemble_rows, percentiles=(10.0, 90.0)):
    """Median and percentiles of d/b and the share of collapses, by PGA.

    Parameters
    ----------
    ensemble_rows : DataFrame or list of dict
    percentiles : pair of float
        [%]

    Returns
    -------
    DataFrame
        pga_g, members, probability, d_over_b_low, d_over_b_median, d_over_b_high; ascending PGA.
    """
    columns = [
        "pga_g",
        "members",
        "probability",
        "d_over_b_low",
        "d_over_b_median",
        "d_over_b_high",
    ]
    table = _valid(ensemble_rows)
    if table.empty:
        return pd.DataFrame(columns=columns)
    out = []
    for pga_g, group in table.groupby("pga_g", sort=True):
        low, middle, high = np.percentile(group["d_over_b"], [percentiles[0], 50.0, percentiles[1]])
        out.append((pga_g, len(group), group["collapsed"].mean(), low, middle, high))
    return pd.DataFrame(out, columns=columns)


def monotone(values, weights):
    """Non-decreasing sequence nearest to `values` in weighted least squares.

    Pool-adjacent-violators (Ayer et al., 1955): with shares of collapses and
    numbers of runs this is the maximum-likelihood estimate of a probability that
    cannot fall with intensity.
    """
    blocks: list[list[float]] = []  # mean, weight, count
    for value, weight in zip(values, weights, strict=True):
        blocks.append([float(value), float(weight), 1])
        while len(blocks) > 1 and blocks[-2][0] > blocks[-1][0]:
            mean, total, count = blocks.pop()
            before = blocks[-1]
            both = before[1] + total
            blocks[-1] = [(before[0] * before[1] + mean * total) / both, both, before[2] + count]
    return np.concatenate([np.full(int(n), mean) for mean, _, n in blocks] or [np.zeros(0)])


def crossing(pga_g, probability, level):
    """PGA at which a non-decreasing probability reaches `level`; NaN if it is not bracketed."""
    above = np.flatnonzero(np.asarray(probability) >= level)
    if above.size == 0:
        return math.nan
    k = int(above[0])
    if k == 0:
        return float(pga_g[0]) if probability[0] == level else math.nan
    share = (level - probability[k - 1]) / (probability[k] - probability[k - 1])
    return float(pga_g[k - 1] + share * (pga_g[k] - pga_g[k - 1]))


def collapse_percentiles(ensemble_rows, percentiles=(10.0, 90.0)):
    """PGA at which half, and the lower and upper percentile, of the members collapse [g].

    The share of collapses by PGA, made non-decreasing, and linear between intensities.

    Parameters
    ----------
    ensemble_rows : DataFrame or list of dict
    percentiles : pair of float
        [%]

    Returns
    -------
    median, low, high : float
        NaN where the intensities that were run do not bracket it.
    """
    table = bands(ensemble_rows)
    if table.empty:
        return math.nan, math.nan, math.nan
    pga_g = table["pga_g"].to_numpy()
    smooth = monotone(table["probability"].to_numpy(), table["members"].to_numpy())
    low, high = percentiles
    return tuple(crossing(pga_g, smooth, p / 100.0) for p in (50.0, low, high))


def median_spread(values, counts, seed, resamples=2000):
    """Standard deviation of the median of `n` members drawn from a large ensemble (bootstrap).

    Parameters
    ----------
    values : array_like
        d/b of a large ensemble.
    counts : sequence of int
        Ensemble sizes n.
    seed : int

    Returns
    -------
    ndarray, shape (len(counts),)
    """
    rng = np.random.default_rng(seed)
    values = np.asarray(values, float)
    return np.array([np.median(rng.choice(values, (resamples, n)), axis=1).std() for n in counts])


def members_needed(values, tolerance, seed, limit=201):
    """Smallest odd number of members whose median stays within ± tolerance in 90 % of draws.

    Returns
    -------
    int or None
        None if more than `limit` are needed.
    """
    rng = np.random.default_rng(seed)
    values = np.asarray(values, float)
    centre = np.median(values)
    for n in range(3, limit + 1, 2):
        medians = np.median(rng.choice(values, (2000, n)), axis=1)
        if np.mean(np.abs(medians - centre) <= tolerance) >= 0.9:
            return n
    return None
