"""Annual rate of collapse from a hazard curve and a lognormal fragility, in closed form.

With the hazard λ(x), a rate of exceedance, and the fragility F(x) = Φ[ln(x/θ)/β],

    λ_c = ∫ F(x) |dλ(x)| = ∫ λ(x) F′(x) dx                       (Cornell & Krawinkler, 2000)

Where λ = k₀ x⁻ᵏ, the second form is exact on any interval, by completing the square:

    ∫_a^b k₀ x⁻ᵏ dF = k₀ θ⁻ᵏ exp(k²β²/2) {Φ[ln(b/θ)/β + kβ] − Φ[ln(a/θ)/β + kβ]},

and over all x it is Jalayer's (2003) k₀ θ⁻ᵏ exp(k²β²/2). A table of hazard is such a power law
between its points; the outer ones go on beyond its ends, and the share of the rate that comes from
there is stated. Collapse within t years has the probability 1 − exp(−λ_c t) of a Poisson process.
"""

import numpy as np
from scipy.special import ndtr

from rocking.studies.fragility import log_mass


def _pieces(hazard, edges):
    """ln k₀ and k of the power laws between consecutive points of edges (m + 1 of them)."""
    x, y = np.log(hazard.intensity), np.log(hazard.annual_rate)
    slope = np.diff(y) / np.diff(x)
    middle = np.log(edges[:-1]) + np.where(np.isinf(edges[1:]), 1.0, 0.0)
    middle[0] = x[0] - 1.0  # below the table
    i = np.clip(np.searchsorted(x, middle, side="right") - 1, 0, len(slope) - 1)
    return y[i] - slope[i] * x[i], -slope[i]


def by_interval(hazard, median, dispersion, inner=()):
    """Rate of collapse by intervals of intensity, at which the shaking lies that fells the façade.

    Over an interval (a, b) it is ∫ F |dλ| = λ(a)F(a) − λ(b)F(b) + ∫ λ dF.

    Parameters
    ----------
    hazard : rocking.risk.hazard.Hazard
    median, dispersion : array_like, shape (m,) or scalar
        θ and β of one fragility or of many.
    inner : array_like
        Further edges of intervals.

    Returns
    -------
    edges : ndarray, shape (n + 1,)
        The hazard's intensities and `inner`, ascending, between 0 and ∞.
    rate : ndarray, shape (m, n)
        [1/year]; ∞ or 0 for a median of 0 or ∞.
    """
    theta = np.atleast_1d(np.asarray(median, float))[:, None]
    beta = np.atleast_1d(np.asarray(dispersion, float))[:, None]
    points = np.unique(np.concatenate([hazard.intensity, np.asarray(inner, float)]))
    edges = np.concatenate([[0.0], points, [np.inf]])
    with np.errstate(divide="ignore", invalid="ignore"):
        log_k0, k = _pieces(hazard, edges)
        z = np.log(edges[None, :] / theta) / beta
        low, high = z[:, :-1] + k * beta, z[:, 1:] + k * beta
        density = np.exp(log_k0 - k * np.log(theta) + 0.5 * (k * beta) ** 2 + log_mass(low, high))
        at = hazard.rate(points) * ndtr(z[:, 1:-1])
    at = np.pad(at, ((0, 0), (1, 1)))  # λF vanishes at 0 and at ∞
    rate = np.nan_to_num(at[:, :-1] - at[:, 1:] + density, nan=0.0)
    rate[np.isinf(theta[:, 0])] = 0.0
    rate[theta[:, 0] == 0.0] = np.inf
    return edges, rate


def collapse_rate(hazard, median, dispersion):
    """Annual rate of collapse, and the share of it from beyond the hazard table.

    Returns
    -------
    rate, outside : ndarray, shape (m,)
        [1/year], [-].
    """
    _, rate = by_interval(hazard, median, dispersion)
    total = rate.sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return total, np.where(total > 0.0, (rate[:, 0] + rate[:, -1]) / total, 0.0)


def probability_within(rate, years):
    """Probability of at least one collapse within `years`, 1 − exp(−rate·years)."""
    return -np.expm1(-np.asarray(rate, float) * years)
