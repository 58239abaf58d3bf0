"""Which intensity of an expensive curve to run next, given where a cheap model collapses.

Levels lie at start·(1 + ratio)^k, so the same curve asks for the same levels whatever was run
before it. From the start, the cheap model's lowest collapse, the curve climbs in strides of two
levels until something falls. Below the lowest that fell, levels must stand so many times in a row;
above, they must fall so many times in a row, and the cheap model's islands in between are looked
at: near collapse a façade may fall, stand and fall again.
"""

import math

from yade_scripts.studies.intensities import DIGITS

STRIDE = 2


def next_level(done, settings, start_g, islands=()):
    """Return the next PGA to run [g], or None when the curve is complete.

    Parameters
    ----------
    done : dict of float to str
        Status of each PGA already run; a failed run neither stands nor falls.
    settings : dict
        level_ratio, below, beyond, max_runs, max_pga_g.
    start_g : float
    islands : sequence of float
        Intensities to run beside the levels, where they lie between the lowest fall and the end.
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
    for g in sorted(round(v, DIGITS) for v in islands):
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
