"""Lowest amplitudes at which 10 and 50 % of the members collapse, for many façades and motions.

The dense scan (`rocking.collapse.scan`) finds every island of a curve. Where only the first
crossings are wanted, of thousands of curves, this climbs at `CLIMB` to a first collapse, looks for
a lower one at `RATIO` over two of its steps below, and runs members from there up to the crossing
of one half. Members differ in amplitude, node layout and step, as those of the dense scan do. An
island further below, narrower than a step of the climb, may be missed: what that changes is
measured in docs/assessment.md.
"""

import math

import numpy as np
import pandas as pd

from rocking.collapse.probability import first_crossing, from_scan
from rocking.collapse.scan import Screen
from rocking.records.floors import floor_columns
from rocking.solver import peaks, stable_step
from yade_scripts.model import models, registry
from yade_scripts.model.motion import amplitude

CLIMB = {"one": 1.12, "floors": 1.03}  # from one amplitude of the climb to the next, by walls
RATIO = 1.03  # below the first collapse that the climb finds
SPREAD = 0.03  # half width of the window over which members count
MEMBERS = 6  # in a window
STEP = 0.3  # of the stable step: some four times that of the dense scan
START = {"one": 0.7, "floors": 0.5}  # of b/h, by the kind of return walls
CHUNK = 6  # amplitudes between two looks
LEVELS = (0.10, 0.50)


def _levels(low, high, ratio):
    """Amplitudes from `low` on by a ratio, `high` the last; none if it is below."""
    if high < low:
        return np.zeros(0)
    return np.minimum(low * ratio ** np.arange(1 + math.ceil(math.log(high / low, ratio))), high)


class Climb:
    """First crossings of one model, record and direction.

    Parameters
    ----------
    job : dict
        A scene file.
    time_s, columns, direction
        As of `Screen`.
    step : float
        Of the stable step.
    """

    def __init__(self, job, time_s, columns, direction, step=STEP):
        """Prepare the scene in every layout of nodes, each with a step of its own."""
        self.screen = Screen(job, time_s, columns, direction)
        self.walls = registry.model(job["model"]).walls
        planes = self.screen.planes
        self.steps = [step * stable_step(p) * (1.0 - 0.03 * i) for i, p in enumerate(planes)]
        self.runs = 0

    def _run(self, pga_g, scatter):
        s = self.screen
        layout = np.arange(pga_g.size) % len(s.planes) * bool(scatter)
        factor = np.array([amplitude(s.ground, s.direction, g) for g in pga_g])
        status = np.full(pga_g.size, "ok", object)
        for i, plane in enumerate(s.planes):
            mine = np.flatnonzero(layout == i)
            if mine.size:
                found = peaks(
                    plane,
                    s.motions,
                    s.numerics,
                    factor[mine],
                    carried=s.carried,
                    step_s=self.steps[i],
                )
                status[mine[found.overturned]] = "overturned"
                status[mine[found.failed]] = "failed"
        self.runs += pga_g.size
        fell = (status == "overturned").astype(int)
        return pd.DataFrame({"pga_g": pga_g, "status": status, "collapsed": fell})

    def _first(self, levels, otherwise=math.nan):
        """Lowest of ascending amplitudes at which the scene's own layout falls."""
        for i in range(0, levels.size, CHUNK):
            table = self._run(levels[i : i + CHUNK], scatter=False)
            fell = table.loc[table["collapsed"] == 1, "pga_g"]
            if len(fell):
                return float(fell.min())
        return otherwise

    def crossings(self, max_pga_g, start_g):
        """PGA at which 10 and 50 % of the members first collapse [g]; NaN up to `max_pga_g`.

        Returns
        -------
        tuple of float
            In the order of `LEVELS`.
        """
        climb = CLIMB[self.walls]
        first = self._first(_levels(start_g, max_pga_g, climb))
        if not math.isfinite(first):
            return (math.nan,) * len(LEVELS)
        if climb > RATIO:
            below = _levels(max(start_g, first / climb**2), first / RATIO, RATIO)
            first = self._first(below, first)
        fine = 1.0 + 2.0 * SPREAD / MEMBERS
        low, k, parts, found = first / RATIO * (1.0 - SPREAD), 0, [], (math.nan,) * len(LEVELS)
        while low * fine**k <= max_pga_g * (1.0 + SPREAD):
            parts.append(self._run(low * fine ** np.arange(k, k + CHUNK), scatter=True))
            k += CHUNK
            members = pd.concat(parts, ignore_index=True)
            share = from_scan(members, SPREAD)
            pga_g, p = share["pga_g"].to_numpy(), share["probability"].to_numpy()
            found = tuple(first_crossing(pga_g, p, level) for level in LEVELS)
            if pga_g.size and pga_g[-1] >= found[-1] * (1.0 + SPREAD):
                break
        return found


def collapse_pga(job, record, directions, max_pga_g):
    """First crossings under one record: (direction, p10, median, histories run) each [g]."""
    motion = floor_columns(record, job["smdof"])
    start = START[registry.model(job["model"]).walls] * models.static_multiplier(job)
    for direction in directions:
        climb = Climb(job, motion[0], motion[1], direction)
        yield direction, *climb.crossings(max_pga_g, start), climb.runs
