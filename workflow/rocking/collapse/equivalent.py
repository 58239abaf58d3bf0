"""One number of a curve that stands and falls in turns: the threshold with the same annual rate.

A façade that falls with the probability P(x) at an amplitude x falls as often in a year as one that
falls from an amplitude c on, if

    λ(c) = ∫ P(x) |dλ(x)|,   which for a hazard λ ∝ x⁻ᵏ is   c = [∫ P(x) k x⁻ᵏ⁻¹ dx]^(−1/k).

Unlike a first crossing c counts every range of collapse by how often the shaking lies in it, so it
does not jump where the top of one range passes one half. Above the largest amplitude that was run P
stays what it is there. The same of the amplitudes at which P exceeds p, instead of P itself, gives
a threshold for every p; their −k-th powers have the mean c⁻ᵏ.
"""

import math

import numpy as np

SLOPE = 2.0  # k; of hazard curves in PGA about 1.5 to 3 from 100 to 2,500 years


def cells(pga_g):
    """Ends of the amplitudes for which each of ascending ones stands, by their ratio, to ∞ [g].

    The first begins at its own amplitude.
    """
    pga_g = np.asarray(pga_g, float)
    edge = np.sqrt(pga_g[1:] * pga_g[:-1])
    return np.append(pga_g[:1], edge), np.append(edge, math.inf)


def equivalent(pga_g, share, slope=SLOPE):
    """PGA of the threshold that falls as often in a year [g]; NaN where nothing falls.

    The share is the collapse probability by ascending amplitude, shape (n,), the slope k > 0 of the
    hazard.
    """
    share = np.asarray(share, float)
    if not share.size or not share.max() > 0.0:
        return math.nan
    low, high = cells(pga_g)
    return float((share @ (low**-slope - high**-slope)) ** (-1.0 / slope))


def thresholds(pga_g, share, levels, slope=SLOPE):
    """Between which PGA the thresholds lie that fall as often as P exceeds each level, (m,) [g].

    Arguments as of `equivalent`, levels of P from 0 to 1. Low and high are alike where P exceeds
    the level at the largest amplitude that was run. Where it does not, what it does beyond is not
    known: `high` says that it never exceeds it again, ∞ where it never did, `low` that it always
    does.
    """
    pga_g, share = np.asarray(pga_g, float), np.asarray(share, float)
    begin, end = cells(pga_g)
    end[-1] = pga_g[-1]
    rate = begin**-slope - end**-slope
    within = (share[None, :] > np.asarray(levels, float)[:, None]) @ rate
    beyond = pga_g[-1] ** -slope
    known = share[-1] > np.asarray(levels, float)
    with np.errstate(divide="ignore"):
        high = np.where(known, within + beyond, within) ** (-1.0 / slope)
    return (within + beyond) ** (-1.0 / slope), high
