"""Weighted mean error between two sampled curves (eq. 1 of the study)."""

import numpy as np


def _curve(x, y, name):
    """Return x and y as float arrays after checking that they form a curve."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    if x.ndim != 1 or x.shape != y.shape or x.size < 2:
        raise ValueError(f"{name}: expected x and y of equal length, at least 2")
    if not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
        raise ValueError(f"{name}: x and y must be finite")
    if np.any(np.diff(x) <= 0.0):
        raise ValueError(f"{name}: x must increase strictly")
    return x, y


def weighted_mean_error(x, y_reference, y_other):
    """WME = ∫|y_reference − y_other| dx / ∫|y_reference| dx by the trapezoidal rule.

    Eq. 1 of the study, where the reference is the DEM building; x is time, period
    or frequency. The result does not depend on the units of x or, taken together,
    of y.

    Parameters
    ----------
    x : array_like, shape (n,)
        Strictly increasing common grid.
    y_reference, y_other : array_like, shape (n,)

    Returns
    -------
    float

    Raises
    ------
    ValueError
        If a curve is unusable or the reference is zero everywhere.
    """
    x, reference = _curve(x, y_reference, "reference")
    _, other = _curve(x, y_other, "other curve")
    scale = np.trapezoid(np.abs(reference), x)
    if scale == 0.0:
        raise ValueError("reference: zero everywhere, the weighted mean error is undefined")
    return float(np.trapezoid(np.abs(reference - other), x) / scale)


def common_grid(x_reference, y_reference, x_other, y_other, x_range=None):
    """Two curves on the union of their grids, by linear interpolation.

    The union keeps every sample of both, so nothing of either curve is lost.

    Parameters
    ----------
    x_reference, y_reference : array_like, shape (n,)
    x_other, y_other : array_like, shape (m,)
    x_range : (float, float) or None
        Interval of comparison, which both curves must cover; None takes the
        interval that they share.

    Returns
    -------
    x, y_reference, y_other : ndarray, shape (k,)

    Raises
    ------
    ValueError
        If a curve is unusable, the curves share no interval, or one does not
        cover `x_range`.
    """
    x1, y1 = _curve(x_reference, y_reference, "reference")
    x2, y2 = _curve(x_other, y_other, "other curve")
    low, high = max(x1[0], x2[0]), min(x1[-1], x2[-1])
    if not low < high:
        raise ValueError(
            f"curves do not overlap: reference {x1[0]:g} to {x1[-1]:g}, "
            f"other {x2[0]:g} to {x2[-1]:g}"
        )
    if x_range is not None:
        start, end = x_range
        slack = 1e-9 * (high - low)
        if not (low - slack <= start < end <= high + slack):
            raise ValueError(
                f"x_range {start:g} to {end:g}: the curves share only {low:g} to {high:g}"
            )
        low, high = max(low, start), min(high, end)
    x = np.unique(np.concatenate((x1, x2, [low, high])))
    x = x[(x >= low) & (x <= high)]
    # samples that differ by rounding alone (two steps that divide each other) count once
    keep = np.append(np.diff(x) > 1e-12 * max(abs(low), abs(high)), True)
    x = x[keep]
    return x, np.interp(x, x1, y1), np.interp(x, x2, y2)
