"""What a scan may have missed below its lowest fall: windows in doubt, a bound on what hides.

A façade may fall in a later swing than its largest: in a narrow range of amplitude the largest peak
stays where its neighbours' are, and one that follows goes over. So all of a history is looked at,
second by second. Let y be the largest d/b of one second of a history, and r how far it lies from
the straight line between its neighbours in amplitude, the next or the next but one. Where a
history repeats r is next to nothing. What parts after an impact, or near the unstable place, parts
the more the closer one looks, and r says how much is known of what lies between. A window hides
nothing if, of every second,

    max y + `FURTHER` · max r < `UNSTABLE`:

no swing would come to where the façade has no way back, were it to part four times as far as any
was seen to.
"""

import math

import numpy as np

WINDOW = math.log(1.01)  # of amplitude, in which what is left unseen is counted
UNSTABLE = 1.0  # d/b from which there is no way back
FURTHER = 4.0  # times as far as neighbours were seen to part
NEAR = 0.45  # d/b: where no peak comes as far, a scan's own steps meet what falls
FEW = 5  # histories that tell it
SHARE = 0.03  # collapse probability that a search finds with its power


def windows(low_g, high_g):
    """Lower ends of windows of the width ln(1.01) between two amplitudes, from the lower up [g].

    The first begins half a width above the lower one: levels 1 % apart lie within windows, where on
    their edges the last digit would say in which.
    """
    count = math.floor(math.log(high_g / low_g) / WINDOW - 0.5 + 1e-9)
    return low_g * np.exp(WINDOW * (0.5 + np.arange(max(count, 0))))


def parted(at, swings):
    """How far swings lie from the line between neighbours, the next or the next but one.

    Parameters
    ----------
    at : ndarray, shape (n,)
        ln of amplitudes, ascending.
    swings : ndarray, shape (n, seconds)
        d/b.

    Returns
    -------
    ndarray, shape (n, seconds)
        0 at both ends.
    """
    apart = np.zeros(swings.shape)
    for k in (1, 2):
        if len(at) > 2 * k:
            low, high = swings[: -2 * k], swings[2 * k :]
            share = (at[k:-k] - at[: -2 * k]) / np.maximum(at[2 * k :] - at[: -2 * k], 1e-12)
            between = low + share[:, None] * (high - low)
            apart[k:-k] = np.maximum(apart[k:-k], np.abs(swings[k:-k] - between))
    return apart


def reach(pga_g, swings, low_g):
    """D/b that some swing in the window of each history could come to, see above.

    Parameters
    ----------
    pga_g : array_like, shape (n,)
        Of histories that stood, by ascending amplitude.
    swings : array_like, shape (n, seconds) or (n,)
        Largest d/b of each second, or of the whole history.
    low_g : float
        Where the windows begin, see `windows`.

    Returns
    -------
    ndarray, shape (n,)
        Of what lies in the window and in those beside it: the largest peak, where none comes to
        `NEAR`; NaN where d/b is not known or fewer than `FEW` were run.
    """
    at, swings = np.log(np.asarray(pga_g, float)), np.asarray(swings, float)
    if not at.size:
        return np.zeros(0)
    swings = swings.reshape(len(at), -1)
    window = np.floor((at - math.log(low_g)) / WINDOW - 0.5 + 1e-9).astype(int)
    occupied, first, count = np.unique(window, return_index=True, return_counts=True)
    most = np.maximum.reduceat(swings, first)
    apart = np.maximum.reduceat(parted(at, swings), first)
    reach_d_over_b = np.zeros(occupied.size)
    for k, (i, j) in enumerate(
        zip(*np.searchsorted(occupied, (occupied - 1, occupied + 2)), strict=True)
    ):
        high = most[i:j].max(axis=0)
        reach_d_over_b[k] = high.max()
        if reach_d_over_b[k] >= NEAR:
            further = (high + FURTHER * apart[i:j].max(axis=0)).max()
            reach_d_over_b[k] = further if count[i:j].sum() >= FEW else np.nan
    return np.repeat(reach_d_over_b, count)


def doubtful(pga_g, d_over_b, reach_d_over_b, low_g):
    """Windows of amplitude in which a fall could hide among what stood.

    One could where `reach` says so, or does not know. Where nothing was run in a window one could
    unless the peaks next to it are below `NEAR`.

    Parameters
    ----------
    pga_g, d_over_b, reach_d_over_b : array_like, shape (n,)
        Of histories that stood, by ascending amplitude.
    low_g : array_like, shape (m,)
        Of `windows`.

    Returns
    -------
    ndarray of bool, shape (m,)
    """
    pga_g, d_over_b = np.asarray(pga_g, float), np.asarray(d_over_b, float)
    reach_d_over_b, low_g = np.asarray(reach_d_over_b, float), np.asarray(low_g, float)
    edges = low_g * (1.0 - 1e-9), low_g * (math.exp(WINDOW) - 1e-9)
    hides = np.zeros(low_g.size, bool)
    for k, (i, j) in enumerate(zip(*(np.searchsorted(pga_g, edge) for edge in edges), strict=True)):
        beside = d_over_b[max(i - 1, 0) : j + 1]
        safe = reach_d_over_b[i:j] < UNSTABLE if j > i else beside < NEAR
        hides[k] = not safe.all()
    return hides


def needed(power, share=SHARE):
    """How many in a window find a range of so large a share p: 1 − (1 − p)ⁿ ≥ power."""
    return math.ceil(math.log1p(-power) / math.log1p(-share))


def unseen(runs, low_g, high_g, confidence=0.95):
    """Collapse probability that may hide in 1 % of amplitude below the lowest fall: an upper bound.

    Of n histories in a window that all stood the bound is 1 − (1 − confidence)^(1/n) (Clopper and
    Pearson, 1934); returned is that of the window with the fewest, of those that are `doubtful` and
    the one next to the lowest fall.

    Parameters
    ----------
    runs : DataFrame
        Of `outcomes`, by one solver: between two, peaks differ where nothing hides. With what the
        search said of `reach`, where it did; else that of the largest peaks counts.
    low_g, high_g : float
        Where the windows begin and end [g]; nothing fell between.

    Returns
    -------
    float
        NaN where nothing fell and no window is doubtful.
    """
    stood = runs[(runs["collapsed"] == 0) & (runs["pga_g"] < high_g)]
    if not len(stood) or not low_g < high_g:
        return np.nan
    low, pga_g = windows(low_g, high_g), stood["pga_g"].to_numpy()
    counts = np.diff(np.searchsorted(pga_g, np.append(low, low[-1:] * math.exp(WINDOW))))
    if "reach" not in stood or stood["reach"].isna().all():
        stood = stood.assign(reach=reach(pga_g, stood["d_over_b"], low_g))
    doubt = doubtful(pga_g, stood["d_over_b"], stood["reach"], low)
    doubt[-1:] |= high_g < runs["pga_g"].max()
    counts = counts[doubt]
    if not counts.size:
        return np.nan
    return 1.0 - (1.0 - confidence) ** (1.0 / counts.min()) if counts.min() else 1.0
