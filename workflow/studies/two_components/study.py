"""Collapse under both horizontal components beside that of the planar scene under one.

Both scenes have the same nodes out of plane, so what is between them is the second component. Under
one component the planar solver runs, under both YADE.
"""

import math

import numpy as np
import pandas as pd
from rocking.collapse.case import Case
from rocking.collapse.ratios import spread
from rocking.collapse.scan import driving
from rocking.collapse.varied import collapses
from rocking.collapse.yade import YadeRuns
from rocking.solver.plane import to_plane
from rocking.solver.runs import STEP_FRACTION, peaks, stable_step

from studies.two_components.neighbour import neighbour
from yade_scripts.commands.perturb import NODE_KEYS
from yade_scripts.commands.search import drive
from yade_scripts.model import floor_motions, models
from yade_scripts.model.motion import amplitude

FOUND = ["one_g", "again_g", "two_g", "half_g", "d_one", "d_two", "twist_rad", "slid_m"]
FOUND += ["last_g", "last_d_two", "last_twist_rad", "last_slid_m"]
COLUMNS = ["model", "record", "second", "direction", "second_ratio", *FOUND]
NODES = 9  # across the thickness and up each block of the walls, in both scenes
AGAIN_STEP = 0.9  # of the planar solver's step, with one more node: what a repetition moves
YADE_STEP = 0.2  # of the critical step: d/b as at a quarter of it, to 2e-5
AT_ONCE = 3  # levels that one start of YADE runs, of the climb under both
HALF = 0.5  # of the planar collapse: where histories repeat
SUMMARY = {"curves": "n_known", "median": 50, "p10": 10, "p90": 90, "lowest": 0}
SUMMARY |= {"below_095": lambda ratios: ratios.share(high=np.nextafter(0.95, 0.0))}


def with_nodes(case, more=0):
    """Scene file with the nodes of this comparison, and so many more, along every edge."""
    numerics = {**case["numerics"], **dict.fromkeys(NODE_KEYS, NODES + more)}
    return {**case, "numerics": numerics}


def full(case, settings):
    """Scene file of the scene in three dimensions, with the columns of section two_components."""
    sections = with_nodes(case)
    sections["numerics"] |= {"step_s": None, "step_fraction": YADE_STEP}
    return {**sections, "width_nodes": settings["nodes_width"]}


class Comparison:
    """One model, record and direction under one component and under both.

    `case` is that of W1 or W2, the motions are floor motions across the façade and along it, and
    settings those of section two_components. "neg" turns the building by half a turn: both
    components change sign.
    """

    def __init__(self, case, motion, second, direction, settings):
        """Prepare both scenes."""
        given, self.direction, self.settings = case.sections, direction, settings
        time_s, columns = floor_motions.with_second(*motion.floors, *second.floors)
        self.ground, self.numerics, self.planes = columns["ground"], given["numerics"], []
        for more in (0, 1):
            scene = models.build_scene(with_nodes(given, more))
            plane = to_plane(scene)
            self.planes.append((plane, driving(scene, time_s, columns), stable_step(plane)))
        in_space = Case(full(given, settings))
        self.yade = YadeRuns(in_space, motion, direction, second=second)
        self.start_g, self.max_g = 0.5 * self.yade.static_g, given["ida"]["max_pga_g"]

    def one(self, pga_g, again=False):
        """Peak d/b of the planar scene, 1 if it overturns; `again`: a node more, a shorter step."""
        plane, motions, stable = self.planes[int(again)]
        step = STEP_FRACTION * stable * (AGAIN_STEP if again else 1.0)
        factor = amplitude(self.ground, self.direction, pga_g)
        outcome = peaks(plane, motions, self.numerics, [factor], step_s=step)
        return float(np.minimum(outcome.d_over_b[0], 1.0))

    def level(self, k):
        """PGA of level k [g]."""
        return self.start_g * (1.0 + self.settings["level_ratio"]) ** k

    def lowest(self, outcomes, first=0, block=1):
        """Lowest level that falls, from `first` up, or down if that falls; None if none does.

        `outcomes` says the status of amplitudes, of which it is asked for `block` at once.
        """
        strategy = neighbour(self.level, self.max_g, first, block)
        return drive(strategy, lambda ask: outcomes(ask.pga_g))

    def compare(self):
        """Values of `FOUND`; NaN where nothing falls up to ida.max_pga_g."""

        def alone(again):
            return lambda pga_g: ["ok" if self.one(g, again) < 1.0 else "overturned" for g in pga_g]

        one = self.lowest(alone(again=False))
        each = math.log(1.0 + self.settings["level_ratio"])
        top = math.ceil(math.log(self.max_g / self.start_g) / each)
        back = math.ceil(math.log(self.settings["start_ratio"]) / each)
        first = max(0, (top if one is None else one) + back)
        again = self.lowest(alone(again=True), first)
        two = self.lowest(lambda pga_g: self.yade.run(pga_g)["status"].tolist(), first, AT_ONCE)
        half = HALF * self.level(top if one is None else one)
        last = self.level(top if two is None else max(two - 1, 0))
        of_yade = self.yade.run([half, last])[["d_over_b", "twist_rad", "slid_m"]].to_numpy()
        return (
            *(math.nan if k is None else self.level(k) for k in (one, again, two)),
            *(half, self.one(half), *of_yade[0]),
            *(last, *of_yade[1]),
        )


def collapse(cases, motion, directions, second, settings):
    """Collapse under one component and under both, of cases of W1 or W2: COLUMNS.

    Motions are floor motions; second_ratio is of the peak along the façade to that out of plane.
    """
    ratio = np.abs(second.floors[1]["ground"]).max() / np.abs(motion.floors[1]["ground"]).max()
    about = {"second": second.name, "second_ratio": ratio}

    def find(case, _, direction):
        values = Comparison(case, motion, second, direction, settings).compare()
        return about | dict(zip(FOUND, values, strict=True))

    return pd.DataFrame(collapses(cases, motion, directions, find), columns=COLUMNS)


def summary(table):
    """Ratios of collapse and of d/b by model, under both components and in the repetition.

    model, compared, then SUMMARY (below_095: share of curves): of two_g/one_g, of again_g/one_g
    and, at half the planar collapse, of d_one/d_two.
    """
    compared = {
        "both components": table["two_g"] / table["one_g"],
        "repetition": table["again_g"] / table["one_g"],
        "d/b at half": table["d_one"] / table["d_two"],
    }
    ratios = pd.DataFrame({"model": table["model"], **compared})
    long = ratios.melt("model", var_name="compared", value_name="ratio")
    long = long.sort_values("model", kind="stable")
    return spread(long, ["model", "compared"], SUMMARY)
