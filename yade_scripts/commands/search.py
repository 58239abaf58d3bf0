"""Searches for collapse that YADE runs: which intensity comes next, as pure functions.

A strategy is a generator: it yields what is to be run (`Ask`), is sent the status of each
("ok", "overturned", "failed"), and ends when it has seen enough. It knows neither façade nor
solver. Here stand the strategies for runs that take minutes, one at a time; those that ask for
many at once stand in `rocking.collapse.search`, which names them all.
"""

import itertools
import math
from typing import Any, NamedTuple

DIGITS = 4  # intensities are rounded to 1e-4 g so that tables and caches agree
FINE = 0.2  # of the window of an ensemble: distance between its amplitudes where outcomes change
STRIDE = 2  # levels from one run of a first climb to the next


class Ask(NamedTuple):
    """Ascending intensities that a strategy wants to see [g].

    As `realisations` each is one of an ensemble, with nodes and step of its own, where a solver
    varies them.
    """

    pga_g: Any
    realisations: bool = False


def drive(strategy, run):
    """Run what a strategy asks for until it has seen enough; return what it found.

    `run` takes an `Ask` and returns the status of each of its intensities.
    """
    answer = None
    while True:
        try:
            ask = strategy.send(answer)
        except StopIteration as end:
            return end.value
        answer = run(ask)


def one_by_one(following, known=()):
    """Strategy that asks for one intensity after the other.

    `following` takes the status by PGA of what was run, first `known`, and returns the next PGA
    [g], or None.
    """
    done = dict(known)
    while (pga_g := following(done)) is not None:
        (done[pga_g],) = yield Ask([pga_g])
    return done


# a list


def next_listed(done, settings, plan=None):
    """Return the next PGA of a list to run [g], or None when the curve is complete.

    `done` has the status of each PGA already run, `plan` what a dense scan asks for [g]; with
    ida.mode "grid" the list of section ida counts. ValueError of one line, without either.
    """
    if settings["mode"] == "grid":
        plan = settings["grid_g"]
    if plan is None:
        raise ValueError("ida.mode = adaptive: expected the plan of a dense scan (--plan)")
    left = [round(g, DIGITS) for g in plan if round(g, DIGITS) not in done]
    return min(left, default=None)


def climb_sequence(settings):
    """Intensities of the climb [g]: from start_g by the factor `growth` up to max_pga_g."""
    count = math.ceil(math.log(settings["max_pga_g"] / settings["start_g"], settings["growth"]))
    climb = [settings["start_g"] * settings["growth"] ** i for i in range(count)]
    return [round(g, DIGITS) for g in (*climb, settings["max_pga_g"])]


# levels about the collapse of a cheaper model


def next_level(done, settings, start_g, ranges=()):
    """Return the next PGA of an expensive curve [g], or None when it is complete.

    Levels lie at start·(1 + ratio)^k, so the same curve asks for the same levels whatever was run
    before it. From the start, a cheap model's lowest collapse, the curve climbs in strides of two
    levels until something falls. Below the lowest that fell, levels must stand so many times in a
    row; above, they must fall so many times in a row, and the cheap model's ranges in between are
    looked at: near collapse a façade may fall, stand and fall again. A failed run neither stands
    nor falls.

    Settings: level_ratio, below, beyond, max_runs, max_pga_g.
    """
    ratio, limit = 1.0 + settings["level_ratio"], settings["max_pga_g"]
    if len(done) >= settings["max_runs"]:
        return None

    def level(k):
        return round(min(start_g * ratio**k, limit), DIGITS)

    top = max(0, math.ceil(math.log(limit / start_g) / math.log(ratio)))
    fallen = [g for g, status in done.items() if status == "overturned"]
    if not fallen:
        climb = [*range(0, top, STRIDE), top]
        return next((g for k in climb if (g := level(k)) not in done), None)
    lowest = min(fallen)
    at = math.log(lowest / start_g) / math.log(ratio)
    nearest = math.ceil(at - 1e-2) - 1  # the first level below the lowest that fell
    for k in range(nearest, nearest - settings["below"], -1):
        g = level(k)
        if g not in done and g >= 10**-DIGITS:
            return g
    for g in sorted(round(v, DIGITS) for v in ranges):
        if lowest < g < max(done) and g not in done:
            return g
    k, row = nearest + 1, 0
    while row < settings["beyond"] and level(k) < limit:
        if (g := level(k)) not in done:
            return g
        # failed runs say nothing: they neither break the row nor lengthen it
        row = {"overturned": row + 1, "ok": 0}.get(done[g], row)
        k += 1
    return None


# the band in which outcomes change


def next_amplitude(outcomes, settings, ida):
    """Next amplitude of a search for the collapse band [g], or None when the band is known.

    From the lowest collapse on, gaps wider than `search_ratio` are closed up to a factor
    `search_beyond` over the highest amplitude that stood; then neighbours of different outcome are
    halved, the lowest first, down to FINE of the window ± amplitude_spread, and what is left of
    that window about each change is filled as densely. Gaps in which a run failed are left.
    """
    valid = sorted(g for g, status in outcomes.items() if status != "failed")
    fell = [g for g in valid if outcomes[g] == "overturned"]
    if not fell:
        return None
    spread = settings["amplitude_spread"]
    fine, step = 2.0 * spread * FINE, ida["search_ratio"]
    highest = max([fell[0], *(g for g in valid if outcomes[g] == "ok")])
    top = min(highest * ida["search_beyond"], ida["max_pga_g"])
    pairs = list(itertools.pairwise(valid))
    changes = [(a, b) for a, b in pairs if outcomes[a] != outcomes[b]]
    low, high = 1.0 - spread, 1.0 + spread
    centres = [math.sqrt(a * b) for a, b in changes]
    near = [(a, b) for a, b in pairs if any(b > low * c and a < high * c for c in centres)]
    if valid[-1] < top:
        pairs.append((valid[-1], top))
    above = [(a, b) for a, b in pairs if fell[0] <= a < top]
    for gaps, width in ((above, step), (changes, fine), (near, fine)):
        for a, b in gaps:
            parts = max(2, math.ceil(math.log(b / a) / math.log1p(width))) if gaps is above else 2
            middle = round(a * (b / a) ** (1.0 / parts), DIGITS)
            if b / a > 1.0 + 1.25 * width and a < middle < b and middle not in outcomes:
                return middle
    return None


# what a curve says


def fallen_or_highest(done):
    """Lowest PGA at which a curve's façade fell [g]; the highest that was run if it never did."""
    return collapse_bounds(done)[1] or max(done)


def collapse_bounds(done):
    """Highest safe PGA below the first collapse, and the lowest that collapsed [g], or None."""
    collapsed = [g for g, status in done.items() if status == "overturned"]
    first = min(collapsed) if collapsed else None
    safe = [g for g, s in done.items() if s == "ok" and (first is None or g < first)]
    return (max(safe) if safe else None), first
