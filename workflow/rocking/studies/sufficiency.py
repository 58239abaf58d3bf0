"""Sufficiency of an intensity measure: does the collapse intensity still depend on the motion?

Given the intensity, collapse should not depend on what else the motion is (Luco & Cornell, 2007,
Earthquake Spectra 23, 357). Of the curves' middle collapse intensities the slope

    ln IM_collapse = a + c ln X + ε

is fitted by least squares, for a property X of the motion that scaling does not change. An
interval of c without zero means that the measure leaves X out: two motions of equal intensity
and different X do not collapse alike.
"""

from dataclasses import dataclass

import numpy as np

from rocking.records import G_M_S2, measures


@dataclass(frozen=True)
class Slope:
    """Slope c with its interval, number of curves used."""

    value: float
    low: float
    high: float
    n: int


PROPERTIES = {
    "significant_duration_s": "duration 5–95 %",
    "pgv_over_pga_s": "PGV/PGA",
}


def properties(record):
    """Properties of a record that do not change when it is scaled, by the names of PROPERTIES.

    Duration between 5 and 95 % of the Arias intensity [s]; PGV/PGA [s], long for pulses.
    """
    peaks = measures(record)
    return {
        "significant_duration_s": peaks["significant_duration_s"],
        "pgv_over_pga_s": 0.01 * peaks["pgv_cm_s"] / (peaks["pga_g"] * G_M_S2),
    }


def slope(x, y, groups, confidence, resamples, seed):
    """Slope of y on x by least squares; interval from groups drawn with replacement.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        Logarithms; rows without a finite value are left out.
    groups : sequence, length n
        Name of the record of each row; rows of one are drawn together.
    confidence : float
    resamples, seed : int

    Returns
    -------
    Slope
        NaN with fewer than three groups or where x does not vary.
    """
    x, y, groups = np.asarray(x, float), np.asarray(y, float), np.asarray(groups)
    known = np.isfinite(x) & np.isfinite(y)
    x, y = x[known], y[known]
    names, index = np.unique(groups[known], return_inverse=True)
    if len(names) < 3 or np.ptp(x) == 0.0:
        return Slope(np.nan, np.nan, np.nan, int(known.sum()))
    rng = np.random.default_rng(seed)
    counts = rng.multinomial(len(names), np.full(len(names), 1.0 / len(names)), resamples)
    weights = np.vstack([np.ones(x.size), counts[:, index]])
    total = weights.sum(axis=1)
    mean_x, mean_y = weights @ x / total, weights @ y / total
    spread = weights @ x**2 / total - mean_x**2
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = (weights @ (x * y) / total - mean_x * mean_y) / spread
    drawn = slopes[1:][spread[1:] > 1e-12]
    tail = 50.0 * (1.0 - confidence)
    low, high = np.percentile(drawn, [tail, 100.0 - tail])
    return Slope(float(slopes[0]), float(low), float(high), int(known.sum()))
