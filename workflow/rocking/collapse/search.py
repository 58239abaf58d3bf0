"""Searches for collapse: which intensities a curve is asked for, whatever runs them.

A search yields intensities and is sent their outcomes (`yade_scripts.commands.search`). Nothing
here knows a façade, a motion or a solver::

    listed     stated intensities
    first      the lowest of ascending levels that falls
    climb      levels up to where all have fallen over a factor
    scan       a climb, realisations about every change of outcome, and more below the lowest fall
               until what could hide there would have been found: the dense scan
    crossings  where 10 and 50 % of the realisations first collapse: a short climb for many curves
"""

import math
from typing import Any, NamedTuple

import numpy as np

from rocking.collapse.crossing import first_crossing
from rocking.collapse.hidden import SHARE, WINDOW, doubtful, needed, reach, windows
from rocking.collapse.probability import probability
from yade_scripts.commands.search import Ask

BLOCK = 32  # amplitudes between two looks at whether the façade has fallen for good
MARGIN = 0.15  # of the PGA, by which the fine scan reaches beyond the first and the last change
CALM = 0.3  # d/b from which a scan runs realisations
CALM_RATIO = 1.1  # a scan begins where a façade stays below d/b of CALM over a range this wide
ROUNDED = 1e-9
LEAST_G = 1e-4  # no façade that stands by itself falls below
EDGE = 2  # windows below the lowest fall that are always filled: another solver's lies in them
AT_ONCE = 8  # windows that get more realisations between two looks
AHEAD = 1.25  # ratio of the levels that a short climb asks for until one comes to d/b of CALM
BELOW_FIRST = 1.03  # ratio of the levels below the first fall of a short climb
SPREAD = 0.03  # half width of the window over which its realisations count
MEMBERS = 6  # in that window
CHUNK = 6  # its amplitudes between two looks
LEVELS = (0.10, 0.50)


class Answer(NamedTuple):
    """What a search may be sent in place of a status each: that, peak d/b, and swings.

    Attributes
    ----------
    status : sequence of str
    d_over_b : sequence of float
        At most 1; NaN where a history failed.
    swings : ndarray, shape (n, seconds), optional
        Largest d/b of each second; without it the largest of all counts as the only swing.
    """

    status: Any
    d_over_b: Any
    swings: Any = None


class Seen:
    """Amplitudes that a search has asked for, and their outcomes; d/b is NaN where unknown."""

    def __init__(self):
        """Nothing is known."""
        self.pga_g, self.status = np.zeros(0), np.zeros(0, object)
        self.d_over_b = np.zeros(0)
        self.swings = np.zeros((0, 1))

    def ask(self, pga_g, realisations=False):
        """Ask for amplitudes and remember what they did; for `yield from`."""
        answer = yield Ask(pga_g, realisations)
        if not isinstance(answer, Answer):
            answer = Answer(answer, np.full(len(pga_g), np.nan))
        self.pga_g = np.append(self.pga_g, pga_g)
        self.status = np.append(self.status, np.asarray(answer.status, object))
        self.d_over_b = np.append(self.d_over_b, answer.d_over_b)
        swings = answer.d_over_b if answer.swings is None else answer.swings
        self.swings = stacked(
            (self.swings, np.reshape(np.asarray(swings, float), (len(pga_g), -1)))
        )

    @property
    def reach(self):
        """Of each what `hidden.reach` says; NaN of what did not stand."""
        reached, stood = np.full(self.pga_g.size, np.nan), np.flatnonzero(self.status == "ok")
        stood = stood[np.argsort(self.pga_g[stood], kind="stable")]
        low_g = self.pga_g.min(initial=math.inf)
        reached[stood] = reach(self.pga_g[stood], self.swings[stood], low_g)
        return reached

    def reaches(self, d_over_b):
        """Mask of the amplitudes that fell or came so far."""
        return self.fell | (self.d_over_b >= d_over_b)

    @property
    def fell(self):
        """Mask of those that overturned."""
        return self.status == "overturned"


def stacked(tables):
    """Rows below each other, shorter ones filled up with zeros."""
    columns = max(table.shape[1] for table in tables)
    return np.concatenate([np.pad(t, ((0, 0), (0, columns - t.shape[1]))) for t in tables])


def listed(pga_g, realisations=False):
    """Ask for stated intensities, all at once; realisations have nodes and step of their own."""
    yield Ask(np.sort(np.asarray(pga_g, float)), realisations)


def rising(low, high, ratio):
    """Amplitudes from `low` on by a ratio, `high` the last; none if it is below [g]."""
    if high < low:
        return np.zeros(0)
    return np.minimum(low * ratio ** np.arange(1 + math.ceil(math.log(high / low, ratio))), high)


def first(levels, block=1):
    """Find the lowest of ascending levels that falls [g]; NaN if none does."""
    for at in range(0, len(levels), block):
        seen = Seen()
        yield from seen.ask(levels[at : at + block])
        if seen.fell.any():
            return float(seen.pga_g[seen.fell].min())
    return math.nan


def first_beyond_calm(levels, ratio):
    """Find the lowest of ascending levels that falls [g], as `first`, with fewer where all is calm.

    Levels `AHEAD` apart are asked for up to one that comes to d/b of `CALM`; those between only
    from the one before that. Without d/b all of them are.

    Parameters
    ----------
    levels : ndarray
    ratio : float
        From one to the next.
    """
    seen, stride = Seen(), max(1, round(math.log(AHEAD) / math.log(ratio)))
    coarse, calm = levels[::stride], 0
    for at in range(0, len(coarse), CHUNK):
        yield from seen.ask(coarse[at : at + CHUNK])
        calm = int(np.logical_and.accumulate(seen.d_over_b < CALM).sum())
        if calm < seen.pga_g.size:
            break
    lowest = min(seen.pga_g[seen.fell], default=math.inf)
    rest = levels[stride * max(calm - 1, 0) :]
    rest = rest[(rest < lowest) & ~np.isin(rest, seen.pga_g)]
    lower = yield from first(rest, CHUNK)
    return float(np.fmin(lower, lowest if math.isfinite(lowest) else math.nan))


def climb(start_g, settings, block=BLOCK):
    """Ask for levels from `start_g` up, at steps of `level_ratio`.

    It ends when the façade has fallen at every level over a factor `beyond`, or at `max_pga_g`.
    Where it falls at the start or comes near, levels below follow until it stays below `CALM`.

    Parameters
    ----------
    start_g : float
    settings : dict
        level_ratio, beyond, max_pga_g.
    block : int
        Levels asked for at once.

    Returns
    -------
    Seen
    """
    ratio, last = 1.0 + settings["level_ratio"], settings["max_pga_g"]
    start = min(start_g, last)
    levels = start * ratio ** np.arange(1 + math.ceil(math.log(last / start) / math.log(ratio)))
    levels[-1] = last
    run = math.ceil(math.log(settings["beyond"]) / math.log(ratio))
    seen = Seen()
    for at in range(0, levels.size, block):
        yield from seen.ask(levels[at : at + block])
        if seen.pga_g.size >= run and seen.fell[-run:].all():
            break
    calm, low = math.ceil(math.log(CALM_RATIO) / math.log(ratio)), start
    while low > LEAST_G and seen.reaches(CALM)[np.argsort(seen.pga_g)[:calm]].any():
        yield from seen.ask(low * ratio ** np.arange(-block, 0.0))
        low *= ratio**-block
    return seen


def scan(start_g, settings, block=BLOCK):
    """Ask for a `climb`, then for finer amplitudes wherever outcomes may change, then `below`.

    The second pass has `realisations` amplitudes within ± `amplitude_spread` of any, from where the
    climb comes beyond `CALM`.

    Parameters
    ----------
    start_g, settings, block
        As of `climb`; settings has realisations, amplitude_spread, power and safe_share too.
    """
    seen = yield from climb(start_g, settings, block)
    power, standing = settings["power"], seen.pga_g[~seen.fell]
    near = seen.pga_g[seen.reaches(CALM if power else 1.0)]
    if not near.size:
        return
    # windows below the first level beyond need neighbours too
    low = near.min() / (1.0 + settings["level_ratio"]) * math.exp(-3.0 * WINDOW)
    high = settings["max_pga_g"]
    if seen.fell.any():
        first = seen.pga_g[seen.fell].min()
        low = min(low, (1.0 - MARGIN) * first)
        high = (1.0 + MARGIN) * max(standing.max(initial=0.0), first)
    fine = 1.0 + 2.0 * settings["amplitude_spread"] / settings["realisations"]
    count = math.ceil(math.log(high / low) / math.log(fine))
    yield from seen.ask(low * fine ** np.arange(count + 1), realisations=True)
    if power:
        yield from below(seen, needed(power, settings.get("safe_share", SHARE)))


def below(seen, wanted):
    """Ask for realisations below the lowest fall until what could hide there would have been found.

    Windows of amplitude that are `doubtful`, from the lowest up, get `wanted` realisations; so do
    the `EDGE` next to the lowest fall, since realisations do not all fall at the same amplitude. It
    ends below the lowest fall, that of these realisations included.

    Parameters
    ----------
    seen : Seen
    wanted : int
        See `needed`.
    """
    while True:
        lowest = seen.pga_g[seen.fell].min(initial=seen.pga_g.max())
        low = windows(seen.pga_g.min(), lowest)
        edges = np.append(low, low[-1:] * math.exp(WINDOW))
        there = np.diff(np.searchsorted(np.sort(seen.pga_g), edges))
        stood = np.flatnonzero(seen.status == "ok")
        stood = stood[np.argsort(seen.pga_g[stood], kind="stable")]
        doubt = doubtful(seen.pga_g[stood], seen.d_over_b[stood], seen.reach[stood], low)
        doubt[-EDGE:] |= seen.fell.any()
        few = np.flatnonzero(doubt & (there < wanted))[:AT_ONCE]
        if not few.size:
            return
        # a third of them may tell already that nothing hides there
        third = math.ceil(wanted / 3)
        aim = np.where(there[few] < third, third, wanted)
        places = [(np.arange(n) + 0.5) / n for n in aim - there[few]]
        realisations = [low[k] * np.exp(WINDOW * part) for k, part in zip(few, places, strict=True)]
        yield from seen.ask(np.concatenate(realisations), realisations=True)


def crossings(start_g, max_pga_g, ratio):
    """Find where 10 and 50 % of the realisations first collapse, for many curves.

    It climbs at `ratio` (at `AHEAD` where it is calm) to a first collapse, from half of `start_g`
    and so on where that falls, looks for a lower one at `BELOW_FIRST` over two of its steps below,
    and runs realisations from there up to the
    crossing of one half.

    Parameters
    ----------
    start_g, max_pga_g, ratio : float

    Returns
    -------
    tuple of float
        In the order of `LEVELS` [g]; NaN up to `max_pga_g`.
    """
    lowest = yield from first_beyond_calm(rising(start_g, max_pga_g, ratio), ratio)
    while start_g > LEAST_G and lowest <= start_g * (1.0 + ROUNDED):  # as a push of seconds does
        levels, start_g = rising(0.5 * start_g, start_g, ratio)[:-1], 0.5 * start_g
        lower = yield from first_beyond_calm(levels, ratio)
        lowest = float(np.fmin(lower, lowest))
    if not math.isfinite(lowest):
        return (math.nan,) * len(LEVELS)
    if ratio > BELOW_FIRST:
        below = rising(max(start_g, lowest / ratio**2), lowest / BELOW_FIRST, BELOW_FIRST)
        lower = yield from first(below, CHUNK)
        lowest = lower if math.isfinite(lower) else lowest
    fine = 1.0 + 2.0 * SPREAD / MEMBERS
    low, k, seen, crossed = lowest / BELOW_FIRST * (1.0 - SPREAD), 0, Seen(), (math.nan,) * 2
    while low * fine**k <= max_pga_g * (1.0 + SPREAD):
        yield from seen.ask(low * fine ** np.arange(k, k + CHUNK), realisations=True)
        k += CHUNK
        valid = seen.status != "failed"
        pga_g = seen.pga_g[valid]
        share, _ = probability(pga_g, seen.fell[valid], pga_g, SPREAD)
        crossed = tuple(first_crossing(pga_g, share, level) for level in LEVELS)
        if pga_g.size and pga_g[-1] >= crossed[-1] * (1.0 + SPREAD):
            break
    return crossed
