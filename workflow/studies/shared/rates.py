"""Annual rate of collapse: of a curve as it is, and of a lognormal fragility in closed form.

With the hazard λ(x), a rate of exceedance, and the fragility F(x) = Φ[ln(x/θ)/β],

    λ_c = ∫ F(x) |dλ(x)| = ∫ λ(x) F′(x) dx                       (Cornell & Krawinkler, 2000)

With a curve's own collapse probability P(x), which may fall again, the first form is a sum: P is
that of the nearest amplitude that was run. Where λ = k₀ x⁻ᵏ, the second is exact on any interval
with a fragility F, by completing the square:

    ∫_a^b k₀ x⁻ᵏ dF = k₀ θ⁻ᵏ exp(k²β²/2) {Φ[ln(b/θ)/β + kβ] − Φ[ln(a/θ)/β + kβ]},

and over all x it is Jalayer's (2003) k₀ θ⁻ᵏ exp(k²β²/2). A table of hazard is such a power law
between its points; the outer ones go on beyond its ends, and the share of the rate that comes from
there is stated. Collapse within t years has the probability 1 − exp(−λ_c t) of a Poisson process.
"""

import numpy as np
from rocking.collapse.equivalent import cells
from scipy.special import ndtr

from studies.shared.fragility import log_mass


def _pieces(hazard, edges):
    """ln k₀ and k of the power laws between consecutive points of edges (m + 1 of them)."""
    x, y = np.log(hazard.intensity), np.log(hazard.annual_rate)
    slope = np.diff(y) / np.diff(x)
    middle = np.log(edges[:-1]) + np.where(np.isinf(edges[1:]), 1.0, 0.0)
    middle[0] = x[0] - 1.0  # below the table
    i = np.clip(np.searchsorted(x, middle, side="right") - 1, 0, len(slope) - 1)
    return y[i] - slope[i] * x[i], -slope[i]


def by_interval(hazard, median, dispersion):
    """Edges of intervals of intensity, (n + 1,), and rates of collapse there, (m, n) [1/year].

    Over an interval (a, b) it is ∫ F |dλ| = λ(a)F(a) − λ(b)F(b) + ∫ λ dF, for m fragilities of θ
    and β; ∞ or 0 for a median of 0 or ∞. Edges are 0, the hazard's intensities and ∞.
    """
    theta = np.atleast_1d(np.asarray(median, float))[:, None]
    beta = np.atleast_1d(np.asarray(dispersion, float))[:, None]
    edges = np.concatenate([[0.0], hazard.intensity, [np.inf]])
    with np.errstate(divide="ignore", invalid="ignore"):
        log_k0, k = _pieces(hazard, edges)
        z = np.log(edges[None, :] / theta) / beta
        low, high = z[:, :-1] + k * beta, z[:, 1:] + k * beta
        density = np.exp(log_k0 - k * np.log(theta) + 0.5 * (k * beta) ** 2 + log_mass(low, high))
        at = hazard.rate(hazard.intensity) * ndtr(z[:, 1:-1])
    at = np.pad(at, ((0, 0), (1, 1)))  # λF vanishes at 0 and at ∞
    rate = np.nan_to_num(at[:, :-1] - at[:, 1:] + density, nan=0.0)
    rate[np.isinf(theta[:, 0])] = 0.0
    rate[theta[:, 0] == 0.0] = np.inf
    return edges, rate


def of_curve(hazard, intensity, share, edges):
    """Rate of collapse of a curve by intervals of intensity, ∫ P |dλ| [1/year].

    `share` is the collapse probability by ascending intensity in the hazard's measure; below the
    first nothing falls, above the last it stays what it is there. Edges ascend from 0 to ∞.
    """
    low, _ = cells(intensity)
    points = np.unique(np.concatenate([low, edges]))
    place = np.searchsorted(low, points[:-1], side="right") - 1
    falls = np.where(place < 0, 0.0, np.asarray(share, float)[np.maximum(place, 0)])
    exceeded = np.append(hazard.rate(points[1:-1]), 0.0)
    drop = np.where(falls > 0.0, np.append(np.inf, exceeded[:-1]) - exceeded, 0.0)
    return np.add.reduceat(falls * drop, np.searchsorted(points, edges[:-1]))


def collapse_rate(hazard, median, dispersion):
    """Annual rate of collapse [1/year], and the share of it from beyond the hazard table."""
    _, rate = by_interval(hazard, median, dispersion)
    total = rate.sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return total, np.where(total > 0.0, (rate[:, 0] + rate[:, -1]) / total, 0.0)


def probability_within(rate, years):
    """Probability of at least one collapse within `years`, 1 − exp(−rate·years)."""
    return -np.expm1(-np.asarray(rate, float) * years)
