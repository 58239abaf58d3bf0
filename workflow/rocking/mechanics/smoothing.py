"""Capacity curves of bricks, without the saw teeth of their slips."""

import numpy as np

WIDTH = 0.02  # of d/b, over which a curve is smoothed


def smoothed(curve, column):
    """Mean of a column over ±WIDTH/2 in d/b at each point: slips make the curve a saw tooth."""
    d, value = curve["d_over_b"].to_numpy(), curve[column].to_numpy()
    total = np.concatenate(([0.0], np.cumsum(value)))
    # at least the neighbours, at most the window; symmetric near the start
    half = np.minimum(0.5 * WIDTH, np.maximum(d - d[0], 0.0)) + 1e-9
    low = np.searchsorted(d, d - half, side="left")
    high = np.searchsorted(d, d + half, side="right")
    return (total[high] - total[low]) / np.maximum(high - low, 1)
