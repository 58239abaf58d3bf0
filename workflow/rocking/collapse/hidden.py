"""What a scan may have missed below its lowest fall: windows in doubt, a bound on what hides."""

import math

import numpy as np

WINDOW = math.log(1.01)  # of amplitude, in which what is left unseen is counted
NEAR = 0.45  # d/b: where no peak comes as far, nothing that falls hides
SCATTER, FEW = 0.03, 5  # of d/b about one branch; histories that tell it
SHARE = 0.03  # collapse probability that a search finds with its power


def windows(low_g, high_g):
    """Lower ends of windows of the width ln(1.01) between two amplitudes, from the lower up [g].

    The first begins half a width above the lower one: levels 1 % apart lie within windows, where on
    their edges the last digit would say in which.
    """
    count = math.floor(math.log(high_g / low_g) / WINDOW - 0.5 + 1e-9)
    return low_g * np.exp(WINDOW * (0.5 + np.arange(max(count, 0))))


def doubtful(pga_g, d_over_b, low_g):
    """Windows of amplitude in which a fall could hide among what stood.

    One could if a peak d/b in it or within one window's width beside it is at least `NEAR`, and the
    peaks there scatter by more than `SCATTER` about a straight line in ln amplitude: where a
    façade's answers follow one branch, neighbours say what it does between them. Where too few were
    run to tell, or d/b is not known, one could.

    Parameters
    ----------
    pga_g, d_over_b : array_like, shape (n,)
        Of histories that stood, by ascending amplitude.
    low_g : array_like, shape (m,)
        Of `windows`.

    Returns
    -------
    ndarray of bool, shape (m,)
    """
    at, d_over_b = np.log(np.asarray(pga_g, float)), np.asarray(d_over_b, float)
    low = np.log(np.asarray(low_g, float))
    ends = np.searchsorted(at, low - WINDOW), np.searchsorted(at, low + 2.0 * WINDOW)
    found = np.zeros(low.size, bool)
    for k, (i, j) in enumerate(zip(*ends, strict=True)):
        near = d_over_b[max(i - 1, 0) : j + 1]
        if near.size and near.max() < NEAR:
            continue
        x, y = at[i:j], d_over_b[i:j]
        if y.size < FEW or np.isnan(y).any():
            found[k] = True
            continue
        x = x - x.mean()
        line = y.mean() + x * (x @ y) / max(x @ x, 1e-30)
        found[k] = np.abs(y - line).max() > SCATTER
    return found


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
        Of `outcomes`, by one solver: between two, peaks differ where nothing hides.
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
    doubt = doubtful(pga_g, stood["d_over_b"], low)
    doubt[-1:] |= high_g < runs["pga_g"].max()
    counts = counts[doubt]
    if not counts.size:
        return np.nan
    return 1.0 - (1.0 - confidence) ** (1.0 / counts.min()) if counts.min() else 1.0
