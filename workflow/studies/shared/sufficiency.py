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
from rocking.stations import interval, resampled


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


def slope(x, y, stations, confidence, resamples, seed):
    """`Slope` of y on x, logarithms (n,), by least squares; its interval from drawn stations.

    Rows without a finite value are left out, rows of one station drawn together
    (`rocking.stations`). NaN with fewer than three stations or where x does not vary.
    """
    x, y, stations = np.asarray(x, float), np.asarray(y, float), np.asarray(stations)
    known = np.isfinite(x) & np.isfinite(y)
    x, y, stations = x[known], y[known], stations[known]
    number = len(set(stations))
    if number < 3 or np.ptp(x) == 0.0:
        return Slope(np.nan, np.nan, np.nan, int(known.sum()))
    weights = np.vstack([np.ones(x.size), resampled(stations, resamples, seed)])
    total = weights.sum(axis=1)
    mean_x, mean_y = weights @ x / total, weights @ y / total
    spread = weights @ x**2 / total - mean_x**2
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = (weights @ (x * y) / total - mean_x * mean_y) / spread
    low, high = interval(slopes[1:][spread[1:] > 1e-12], number, confidence)
    return Slope(float(slopes[0]), float(low), float(high), int(known.sum()))
