"""Where a probability first reaches a level, and between which amplitudes that may be.

A share p of n realisations is known but for its scatter. By Wilson's interval (1927), with z
standard errors either side, it lies within

    [p + z²/2n ± z √(p(1 − p)/n + z²/4n²)] / (1 + z²/n).

Below the lowest fall it is 0, and above the highest that stood 1: there neighbours say the same. A
level is first reached between the amplitude at which the upper end does and the one at which the
lower end does. A level near one takes more realisations than lie within ± spread: there those
further up count too, once the share itself is reached. Where a façade falls all at once the two
amplitudes are close together; on a plateau near the level they may be far apart, and the crossing
between them is one of many.
"""

import numpy as np

Z = 1.645  # 90 %
FURTHER = (1, 2)  # windows over which a level is asked to hold


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


def between(pga_g, collapsed, width, spread, level):
    """Amplitudes between which the share that collapses first reaches a level [g].

    Realisations by ascending amplitude, shape (n,): collapsed 0 or 1, `width` for how much of ln
    amplitude each stands. The share counts over ± spread of the amplitude. NaN where it may not, or
    need not, reach the level.
    """
    pga_g, width = np.asarray(pga_g, float), np.asarray(width, float)
    fell = np.asarray(collapsed, float) > 0.0
    if not fell.any():
        return np.nan, np.nan
    sums = [np.append(0.0, np.cumsum(weights)) for weights in (width, width * fell, width**2)]
    first = np.searchsorted(pga_g, pga_g * (1.0 - spread) * (1.0 - 1e-12))
    for many in FURTHER:
        ends = pga_g * (1.0 - spread) * ((1.0 + spread) / (1.0 - spread)) ** many
        last = np.searchsorted(pga_g, ends * (1.0 + 1e-12), side="right")
        wide, part, squared = (total[last] - total[first] for total in sums)
        with np.errstate(invalid="ignore", divide="ignore"):
            share = np.where(wide > 0.0, part / wide, fell)
            count = np.where(squared > 0.0, wide**2 / squared, 1.0)  # that weigh alike
        low, high = wilson(np.clip(share, 0.0, 1.0), count)
        if many == 1:
            maybe = np.where(pga_g * (1.0 + spread) >= pga_g[fell].min(), high, 0.0)
            surely = low
            # so few that all of them would have to fall, and would not do
            further = (share >= level) & (wilson(1.0, count)[0] < level)
        surely = np.where(further, np.maximum(surely, low), surely)
    if fell[-1] and not fell.all():
        surely[pga_g * (1.0 - spread) > pga_g[~fell].max()] = 1.0
    return first_crossing(pga_g, maybe, level), first_crossing(pga_g, surely, level)
