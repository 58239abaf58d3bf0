"""What a first shock leaves for the second: collapse PGA of a motion after another one.

The first shock has a stated PGA, the second is searched for collapse, on the same façade and in the
same direction, after a pause in which the façade comes to rest. What the first leaves is what
the model remembers: bonds and headers that broke, bricks that slid, and where the façade stands.
"""

import math

import pandas as pd
from rocking.collapse.case import Variant
from rocking.collapse.curve import collapse_curve, history
from rocking.collapse.quick import ENDS, crossings, over_first
from rocking.collapse.ratios import spread
from rocking.collapse.scan import STEPS
from rocking.collapse.varied import collapses

from yade_scripts.commands.perturb import NODE_CHOICES

KEY = ["model", "record", "first", "direction"]
COLUMNS = [*KEY, "first_pga_g", "fell_first", "left_d_over_b", "left_broken"]
COLUMNS += ["pga_p10_g", "pga_median_g", "ratio", "runs_planar", "first_probability"]
COLUMNS += [*ENDS, "ratio_low", "ratio_high"]
BY = ["model", "first_pga_g"]
SPREAD = {"n": "n", "n_censored": "n_censored", "median": 50, "least": 0, "most": 100}
SPREAD |= {"below_095": lambda ratios: ratios.share(high=0.95)}
REALISATIONS = math.lcm(NODE_CHOICES, STEPS)  # of the first shock: every layout and step once
OFTEN = 0.1  # share of them that falls, above which the second's would be the first's collapse


def variants(settings, first):
    """The façade as it is, then after the first shock at every PGA of section sequence."""
    levels = [0.0, *settings["first_pga_g"]]
    pause = {"first": first, "pause_s": settings["pause_s"]}
    return [
        Variant(
            f"after {g:g} g",
            motion={**pause, "first_pga_g": g},
            about={"first": first.name, "first_pga_g": g},
        )
        for g in levels
    ]


def alone(case, first, direction, pga_g):
    """Share of the first shock's realisations that overturn the façade, by their nodes and steps.

    The second's realisations each begin with one of them.
    """
    how = {"pga_g": [pga_g] * REALISATIONS, "scatter": True}
    curve = collapse_curve(case, first, direction, search="list", settings=how)
    return float(curve.table["collapsed"].mean())


def left_by(case, first, direction, pga_g):
    """What the first shock leaves: whether the façade fell, d/b at rest, joints that broke."""
    if not pga_g:
        return {"fell_first": 0, "left_d_over_b": 0.0, "left_broken": 0, "first_probability": 0.0}
    shaken = history(case, first, direction, pga_g)
    share = alone(case, first, direction, pga_g)
    if shaken.status == "overturned" or share > OFTEN:
        return {"fell_first": 1, "first_probability": share}
    rest = float(shaken.table["d_over_b"].iloc[-1])
    left = {"left_d_over_b": rest, "left_broken": shaken.broken, "first_probability": share}
    return {"fell_first": 0, **left}


def after_first(case, motion, direction):
    """What the first shock of a motion leaves, and of the second where 10 and 50 % collapse."""
    left = left_by(case, motion.first, direction, motion.first_pga_g)
    if left["fell_first"]:
        return left
    return left | crossings(case, motion, direction, step=None, ends=True)


def collapse(case, second, direction, first, settings):
    """Collapse of the second shock after the first, by the first one's PGA: COLUMNS.

    ratio is of pga_median_g to that of the façade as it is, blank where the first shock alone
    overturns it or nothing falls up to ida.max_pga_g; ratio_low and ratio_high with each of the two
    where its own realisations leave it, blank where they leave it open.
    """
    rows = collapses([case], second, [direction], after_first, variants(settings, first))
    table = pd.DataFrame(rows).reindex(columns=COLUMNS)
    return over_first(table)


def summary(table):
    """Spread of the ratios by model and the first shock's PGA: BY, then SPREAD.

    below_095 is the share that loses over 5 %. Where the first shock alone overturns the façade it
    counts in n_fell_first.
    """
    damaged = table[table["first_pga_g"] > 0.0]
    spreads = spread(damaged, BY, SPREAD)
    fell = damaged.groupby(BY, sort=False)["fell_first"].sum().to_numpy()
    spreads.insert(3, "n_fell_first", fell)
    return spreads.assign(n_censored=spreads["n_censored"] - fell)
