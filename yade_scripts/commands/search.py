"""How a search asks for runs, and which intensities YADE's own curves run, as pure functions.

A strategy is a generator: it yields what is to be run (`Ask`), is sent the status of each
("ok", "overturned", "failed"), and ends when it has seen enough. It knows neither façade nor
solver. The strategies stand in `rocking.collapse.search`.
"""

import math
from typing import Any, NamedTuple

DIGITS = 4  # intensities are rounded to 1e-4 g so that tables and caches agree
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


# a list


def intensities(settings, plan=None):
    """Return the list of intensities that are run, ascending [g].

    `plan` has what a dense scan asks for [g]; with ida.mode "grid" the list of section ida counts.
    ValueError of one line, without either.
    """
    if settings["mode"] == "grid":
        plan = settings["grid_g"]
    if plan is None:
        raise ValueError("ida.mode = adaptive: expected the plan of a dense scan (--plan)")
    return sorted({round(g, DIGITS) for g in plan})


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
