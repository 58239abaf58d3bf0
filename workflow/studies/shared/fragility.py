"""Fragility: lognormal collapse intensity fitted to the brackets that an IDA gives.

A curve of an incremental dynamic analysis does not say where the façade collapses but
between which intensities: above the highest that stood, at or below the first that overturned.
A curve without collapse says only "above the highest". Both enter the likelihood as they are,
so curves that never collapsed pull the median up instead of being dropped:

    P(collapse | im) = Φ[ln(im/θ)/β],
    ln L = Σ_i w_i ln{Φ[ln(high_i/θ)/β] − Φ[ln(low_i/θ)/β]},  low = 0 or high = ∞ allowed.

With x = ln im, a = ln θ/β and t = 1/β this is concave in (a, t) (Burridge, 1981, JRSS B 43, 41–45),
so Newton's method finds the one maximum. For stripes of equal runs at common intensities it
is the binomial likelihood of Shinozuka et al. (2000) and Baker (2015, Earthquake Spectra 31, 579).
θ is the median and β the dispersion (standard deviation of the logarithm).
"""

from dataclasses import dataclass

import numpy as np
from rocking.stations import interval, resampled
from scipy.special import log_ndtr, ndtr, ndtri

MIN_DISPERSION = 0.01  # brackets that all overlap would let it go to zero
MAX_DISPERSION = 5.0
TOUCHING = 1e-9  # brackets whose ends differ by less, of the intensity, meet in one point
_STEPS = 200
_LOG_ROOT_2PI = 0.5 * np.log(2.0 * np.pi)


@dataclass(frozen=True)
class Fragility:
    """A fitted curve: median θ [unit of the measure] and dispersion β [-], NaN where undefined."""

    median: float
    dispersion: float

    def probability(self, intensity):
        """P(collapse) at the given intensities."""
        return ndtr(np.log(np.asarray(intensity, float) / self.median) / self.dispersion)


@dataclass(frozen=True)
class Bootstrap:
    """Fits to resampled stations: medians and dispersions, each of shape (resamples,)."""

    median: np.ndarray
    dispersion: np.ndarray
    stations: int

    def interval(self, values, confidence):
        """`rocking.stations.interval` of values of the draws, shape (resamples, ...)."""
        return interval(values, self.stations, confidence)

    def band(self, intensity, confidence):
        """Lower and upper P(collapse) at the given intensities, each of shape (n,)."""
        x = np.log(np.asarray(intensity, float))[None, :]
        with np.errstate(invalid="ignore"):
            curves = ndtr((x - np.log(self.median)[:, None]) / self.dispersion[:, None])
        curves[~np.isfinite(self.median)] = 0.0
        return self.interval(curves, confidence)


def checked_brackets(low, high):
    """Brackets as float arrays: highest safe and lowest collapsing intensity.

    low = 0 or NaN where nothing stood, high = ∞ or NaN where nothing collapsed (right-censored). A
    ValueError if there is no bracket, or one is not 0 ≤ low < high.
    """
    low = np.nan_to_num(np.asarray(low, float), nan=0.0, posinf=np.inf)
    high = np.nan_to_num(np.asarray(high, float), nan=np.inf, posinf=np.inf)
    if low.ndim != 1 or low.shape != high.shape or low.size == 0:
        raise ValueError("brackets: expected as many lower as upper intensities, at least one")
    bad = ~((low >= 0.0) & (low < high) & np.isfinite(low))
    if bad.any():
        i = int(np.argmax(bad))
        raise ValueError(f"bracket {i + 1}: {low[i]:g} to {high[i]:g}; expected 0 ≤ low < high")
    return low, high


def brackets_about(collapse, largest, width):
    """Brackets of collapses that are known but for a relative half width, or never came.

    NaN where nothing collapsed up to `largest`; see `checked_brackets`.
    """
    collapse, known = np.asarray(collapse, float), np.isfinite(collapse)
    low = np.where(known, collapse * (1.0 - width), np.asarray(largest, float))
    return low, np.where(known, collapse * (1.0 + width), np.inf)


def fit(low, high, weights=None):
    """Maximum-likelihood fit of a lognormal distribution to brackets (`checked_brackets`).

    Weights are equal where none are given. NaN where the brackets do not determine it: fewer than
    two, none with a collapse, or none with an intensity that stood.
    """
    low, high = checked_brackets(low, high)
    weights = np.ones(low.size) if weights is None else np.asarray(weights, float)
    median, dispersion = _fit_weighted(low, high, weights[None, :])
    known = low.size > 1 and np.isfinite(median[0]) and median[0] > 0.0
    return Fragility(median[0], dispersion[0]) if known else Fragility(np.nan, np.nan)


def bootstrap(low, high, stations, resamples, seed, weights=1.0):
    """Fits to stations drawn with replacement (`rocking.stations`), one of each bracket.

    Percentile intervals are too narrow for few stations: of 400 lognormal samples, the 90 %
    interval of the median held the true one in 75 % of those with 4 stations, 85 % with 8, 86 %
    with 12 and about 90 % from 22. The median is ∞ for a resample without any collapse, 0 for one
    in which nothing stood.
    """
    low, high = checked_brackets(low, high)
    counts = resampled(stations, resamples, seed) * np.asarray(weights, float)
    median, dispersion = _fit_weighted(low, high, counts)
    return Bootstrap(median, dispersion, len(set(stations)))


def fit_table(brackets, settings):
    """Fit of a table of brackets, and the fits to its stations drawn again.

    Columns are station, low, high, weight; settings resamples, seed.
    """
    low, high, weight = (brackets[name].to_numpy() for name in ("low", "high", "weight"))
    draws = bootstrap(
        low, high, brackets["station"], settings["resamples"], settings["seed"], weight
    )
    return fit(low, high, weight), draws


def points(fitted, draws, confidence, count, reach):
    """A fitted curve from `reach` dispersions below its median to as many above, with its band.

    Intensity, evenly in its logarithm, probability, lower and upper end of the band.
    """
    x = fitted.median * np.exp(np.linspace(-reach, reach, count) * fitted.dispersion)
    return zip(x, fitted.probability(x), *draws.band(x, confidence), strict=True)


def log_mass(a, b):
    """ln[Φ(b) − Φ(a)] for a < b, without cancellation in either tail."""
    flip = a > 0.0
    a, b = np.where(flip, -b, a), np.where(flip, -a, b)
    upper = log_ndtr(b)
    with np.errstate(divide="ignore", over="ignore"):
        return upper + np.log1p(-np.exp(np.minimum(log_ndtr(a) - upper, -1e-300)))


def _fit_weighted(low, high, weights):
    """Newton's method for m weightings, shape (m, n), of the same brackets at once."""
    with np.errstate(divide="ignore"):
        x = np.stack([np.log(low), np.log(high)])  # −∞ and ∞ where open
    origin = x[np.isfinite(x)].mean()  # so that the unit of the intensities changes nothing below
    x = x - origin
    centre = np.where(
        np.isfinite(x[0]) & np.isfinite(x[1]),
        0.5 * (x[0] + x[1]),
        np.where(np.isfinite(x[0]), x[0], x[1]),
    )
    total = weights.sum(axis=1)
    shift = weights @ centre / total
    spread = np.sqrt(weights @ centre**2 / total - shift**2 + 1e-12)
    t = 1.0 / np.clip(spread, 0.05, 2.0)
    a = shift * t
    value = _log_likelihood(a, t, x, weights)
    active = np.ones(len(a), bool)
    for _ in range(_STEPS):
        rows = np.flatnonzero(active)
        if rows.size == 0:
            break
        step = _newton_step(a[rows], t[rows], x, weights[rows])
        scale = np.ones(rows.size)
        better = np.zeros(rows.size, bool)
        for _ in range(30):  # halve until the likelihood rises
            t_new = np.clip(t[rows] + scale * step[1], 1 / MAX_DISPERSION, 1 / MIN_DISPERSION)
            a_new = a[rows] + scale * step[0]
            new = _log_likelihood(a_new, t_new, x, weights[rows])
            better = new >= value[rows] - 1e-10 * (1.0 + np.abs(value[rows]))
            if better.all():
                break
            scale = np.where(better, scale, 0.5 * scale)
        moved = np.abs(a_new - a[rows]) + np.abs(t_new - t[rows])
        small = moved < 1e-9 * (1.0 + np.abs(a[rows]) + t[rows])
        a[rows] = np.where(better, a_new, a[rows])
        t[rows] = np.where(better, t_new, t[rows])
        value[rows] = np.where(better, new, value[rows])
        active[rows[small | ~better]] = False
    median = np.exp(np.clip(a / t, -700.0, 700.0))
    # without a collapse, or without an intensity that stood, the maximum lies at infinity or zero
    collapses, stands = weights @ np.isfinite(x[1]), weights @ np.isfinite(x[0])
    limit, narrow = _narrowest(x, weights)
    median = np.exp(origin) * np.where(narrow, limit, median)
    median = np.where(collapses == 0, np.inf, np.where(stands == 0, 0.0, median))
    return median, np.where(narrow, MIN_DISPERSION, 1.0 / t)


def _narrowest(x, weights):
    """Median where the likelihood grows, or stays, to the smallest dispersion; whether it does.

    Brackets with a common part determine no dispersion: the middle of that part. If all of them
    meet in one point c, the likelihood tends to its bound ever more slowly as β falls; there, with
    the weights n₁ of the brackets below c and n₂ above, Φ[ln(c/θ)/β] = n₁/(n₁ + n₂), which the ends
    of the brackets no longer change.
    """
    inner_low = np.where(weights > 0, x[0], -np.inf).max(axis=1)
    inner_high = np.where(weights > 0, x[1], np.inf).min(axis=1)
    with np.errstate(over="ignore", invalid="ignore"):
        middle, overlap = 0.5 * (inner_low + inner_high), inner_high - inner_low
        below = np.sum(weights * (x[1] <= inner_high[:, None] + TOUCHING), axis=1)
        above = np.sum(weights * (x[0] >= inner_low[:, None] - TOUCHING), axis=1)
        share = ndtri(below / np.maximum(below + above, 1e-300))
        met = np.exp(middle - share * MIN_DISPERSION)
        median = np.where(np.abs(overlap) <= TOUCHING, met, np.exp(middle))
    return median, overlap >= -TOUCHING


def _log_likelihood(a, t, x, weights):
    z = t[:, None, None] * x[None] - a[:, None, None]
    return np.sum(weights * np.maximum(log_mass(z[:, 0], z[:, 1]), -1e6), axis=1)


def _newton_step(a, t, x, weights):
    """Step −H⁻¹g in (a, t); steepest ascent where H is not usable."""
    z = t[:, None, None] * x[None] - a[:, None, None]
    mass = np.maximum(log_mass(z[:, 0], z[:, 1]), -600.0)[:, None]
    finite = np.isfinite(x)[None]
    z, x = np.where(finite, z, 0.0), np.where(np.isfinite(x), x, 0.0)[None]
    ratio = np.where(finite, np.exp(np.minimum(-0.5 * z**2 - _LOG_ROOT_2PI - mass, 600.0)), 0.0)

    def difference(values):
        return values[:, 1] - values[:, 0]

    g_a, g_t = -difference(ratio), difference(x * ratio)
    h_aa = -difference(z * ratio) - g_a**2
    h_at = difference(z * x * ratio) - g_a * g_t
    h_tt = -difference(z * x**2 * ratio) - g_t**2
    g = np.stack([np.sum(weights * part, axis=1) for part in (g_a, g_t)])
    aa, at, tt = (np.sum(weights * part, axis=1) for part in (h_aa, h_at, h_tt))
    determinant = aa * tt - at**2
    usable = (aa < 0.0) & (determinant > 1e-14 * np.abs(aa * tt))
    determinant = np.where(usable, determinant, 1.0)
    newton = np.stack([-(tt * g[0] - at * g[1]), -(aa * g[1] - at * g[0])]) / determinant
    uphill = 0.1 * g / np.maximum(np.abs(g).max(axis=0), 1e-300)
    return np.where(usable, newton, uphill)
