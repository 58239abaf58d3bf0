"""What a roof's load and friction are worth: collapse intensities by the planar solver."""

from functools import partial

import pandas as pd
from rocking.collapse import probability
from rocking.collapse.case import Variant
from rocking.collapse.varied import collapses, intensities

BELOW, ABOVE = 0.95, 1.05  # of the 10 and 90 % intensities: where few and most should fall
INTENSITIES = tuple(f"pga_{name}_g" for name in ("collapse", "p10", "median", "p90", "max"))
COLUMNS = [*probability.KEY, "load_kn", "friction", "capacity_kn", *INTENSITIES]
SCANNED = partial(intensities, power=0.0)  # nothing is called safe here
AHEAD = {"height_m": ".6g", "force_kn": ".6g"}  # columns of YADE's table


def roof(height_m, load_kn, friction):
    """Variant of a façade with one more floor on its top; none without load."""
    row = {"height_m": height_m, "load_kn": load_kn, "friction": friction}
    about = {"load_kn": load_kn, "friction": friction, "capacity_kn": load_kn * friction}
    return Variant("roof", added={"facade.floors": [row] if load_kn else []}, about=about)


def variants(height_m, settings):
    """The façade as it is, then every load with every friction."""
    pairs = [(p, mu) for p in settings["loads_kn"] for mu in settings["frictions"]]
    return [roof(height_m, load, friction) for load, friction in [(0.0, 0.0), *pairs]]


def collapse(case, motion, direction, settings):
    """Collapse intensities by load and friction of section restraint, those without a load first.

    COLUMNS; capacity_kn is μ P.
    """
    roofs = variants(case["facade"]["height_m"], settings)
    return pd.DataFrame(collapses([case], motion, [direction], SCANNED, roofs), columns=COLUMNS)


def to_confirm(case, motion, table, settings):
    """For YADE's command `runs`: the largest load with least and most friction.

    Below and above collapse, realisations of an ensemble each; none beyond what was scanned.
    """
    most = table[table["load_kn"] == table["load_kn"].max()]
    height = case["facade"]["height_m"]
    cases = [
        {
            "about": {"height_m": height, "force_kn": round(row.capacity_kn, 6)},
            "pga_g": [round(pga_g, 4)],
            "changes": {
                "facade": case.varied(roof(height, row.load_kn, row.friction))["facade"],
            },
            "realisations": True,
        }
        for row in most.iloc[[0, -1]].itertuples()
        for pga_g in (BELOW * row.pga_p10_g, ABOVE * row.pga_p90_g)
        if pga_g <= row.pga_max_g
    ]
    return {"ahead": AHEAD, "cases": cases}
