"""Where a probability first reaches a level, and between which amplitudes that may be.

A share p of n realisations is known to its standard error only. By Wilson's interval (1927), with z
standard errors either side, it lies within

    [p + z²/2n ± z √(p(1 − p)/n + z²/4n²)] / (1 + z²/n).

A level is first reached between the amplitude at which the upper end does and the one at which the
lower end does. Where a façade falls all at once the two are a step of the scan apart; on a plateau
near the level they may be far apart, and the crossing between them is one of many.
"""

import numpy as np

Z = 1.0  # with two, eleven realisations that all fall would not be 90 % yet


def first_crossing(pga_g, share, level):
    """Lowest amplitude at which a share is first reached [g]; NaN if it never is.

    Linear between the amplitudes before and at the crossing.
    """
    above = np.flatnonzero(np.asarray(share) >= level)
    if above.size == 0:
        return np.nan
    k = int(above[0])
    if k == 0 or not share[k - 1] < level:
        return float(pga_g[k])
    weight = (level - share[k - 1]) / (share[k] - share[k - 1])
    return float(pga_g[k - 1] + weight * (pga_g[k] - pga_g[k - 1]))


def wilson(share, count, z=Z):
    """Lower and upper end of the interval of a share of so many realisations."""
    share, count = np.asarray(share, float), np.asarray(count, float)
    middle = share + 0.5 * z**2 / count
    half = z * np.sqrt(share * (1.0 - share) / count + 0.25 * (z / count) ** 2)
    ends = ((middle + side) / (1.0 + z**2 / count) for side in (-half, half))
    return tuple(np.clip(end, 0.0, 1.0) for end in ends)


def between(pga_g, share, count, level):
    """Amplitudes between which a share first reaches a level [g].

    Parameters
    ----------
    pga_g, share : ndarray, shape (n,)
        Where nothing fell yet, the share is no more than it says.
    count : ndarray, shape (n,)
        Realisations behind each.
    level : float

    Returns
    -------
    low, high : float
        NaN where the share, or its interval's lower end, never reaches it.
    """
    low, high = wilson(share, np.maximum(count, 1.0))
    if not np.any(share >= level):
        return np.nan, np.nan
    known = np.where(np.maximum.accumulate(share) > 0.0, high, 0.0)
    return first_crossing(pga_g, known, level), first_crossing(pga_g, low, level)
