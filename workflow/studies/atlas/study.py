"""An atlas: half collapse over a space-filling design of façades, under recorded motions.

The façades are Sobol' points (Sobol', 1967; scrambled after Owen, 1998, by SciPy) over what the
answer may depend on. A longer design of the same seed begins with the shorter one, so an atlas
grows without being computed anew. The formula of `rocking.formula` rests on its table.
"""

import math
import warnings
from functools import partial

import numpy as np
import pandas as pd
from rocking.collapse.quick import PGA, crossings
from rocking.collapse.varied import collapses
from rocking.formula.groups import dimensions
from rocking.mechanics.beta import LAW_FILE, RangeWarning

PIECE = 8  # façades of one job
WALLS = 2  # return walls, each as thick as the façade
LOG, EVEN, WHOLE = "log", "even", "whole"  # how a dimension is filled between its ends
DIMENSIONS = {  # in the order of the points' coordinates: a change of it is another design
    "height_m": LOG,
    "slenderness": LOG,
    "e_mpa": LOG,
    "density_kg_m3": EVEN,
    "friction_deg": EVEN,
    "period_s": LOG,
    "mass_ratio": LOG,
    "width_m": LOG,
    "storeys": WHOLE,
    "beta_factor": LOG,
}
OWN = "own"  # name of the base that the run's façade has
COLUMNS = ["facade", "base", "model", "record", "direction", *PGA, "runs_planar"]


def design(settings):
    """Façades of the design of section atlas: facade (from 1 on), and `DIMENSIONS`.

    h [m], h/b, E [MPa], ρ [kg/m³], friction of both joints [°], T1 [s], mass of the building over
    the façade's, width [m], masses of the chain, β over that of the case's law.
    """
    from scipy.stats import qmc  # slow to load, and a plan needs none

    maker = qmc.Sobol(len(DIMENSIONS), rng=np.random.default_rng(settings["seed"]))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # a first part of a power of two is meant
        points = maker.random(settings["facades"])
    columns: dict = {"facade": 1 + np.arange(len(points))}
    for (name, kind), u in zip(DIMENSIONS.items(), points.T, strict=True):
        low, high = settings["ranges"][name]
        if kind == LOG:
            columns[name] = low * (high / low) ** u
        elif kind == EVEN:
            columns[name] = low + (high - low) * u
        else:
            columns[name] = (low + np.floor((high - low + 1) * u)).astype(int)
    return pd.DataFrame(columns)


def facade(case, row, changes=None, law=LAW_FILE):
    """Case of a façade of the design: its return walls are as thick as itself.

    β is that of the case's law for these dimensions, times `beta_factor`; `changes` are more new
    values by dotted key, as of another base.
    """
    b = row["height_m"] / row["slenderness"]
    mass_kg = row["density_kg_m3"] * row["height_m"] * b * row["width_m"]
    varied = case.varied(
        {
            "facade.height_m": float(row["height_m"]),
            "facade.thickness_m": float(b),
            "facade.width_m": float(row["width_m"]),
            "facade.e_mpa": float(row["e_mpa"]),
            "facade.density_kg_m3": float(row["density_kg_m3"]),
            "facade.friction_deg": float(row["friction_deg"]),
            "return_wall.friction_deg": float(row["friction_deg"]),
            "return_wall.thickness_m": float(b),
            "return_wall.count": WALLS,
            "return_wall.building_mass_kg": float(row["mass_ratio"] * mass_kg),
            "smdof.period_s": float(row["period_s"]),
            "smdof.n_dof": int(row["storeys"]),
            **(changes or {}),
        }
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # the design is wider than its walls
        beta = varied.calibrated(law)["beta_s"]
    return varied.varied({"beta_s": beta * row["beta_factor"]})


def described(case, table, law=LAW_FILE):
    """`formula.groups.DIMENSIONS` of the façades of a design, by facade; the case has them all."""
    rows = [dimensions(facade(case, row, law=law)) for row in table.to_dict("records")]
    return pd.DataFrame(rows, index=pd.Index(table["facade"], name="facade"))


def parts(settings, records):
    """Base, number and record of every piece of the design: the run's own base, then the others'.

    A row of `others` may take the first records of the run alone.
    """
    bases = [(OWN, settings["facades"], None)]
    bases += [(row["name"], row["facades"], row["records"]) for row in settings["others"]]
    return [
        {"base": name, "piece": piece, "record": record}
        for name, count, first in bases
        for piece in range(1, 1 + math.ceil(min(count, settings["facades"]) / PIECE))
        for record in records[:first]
    ]


def collapse(cases, motion, directions, settings, base=OWN, piece=1, law=LAW_FILE):
    """Where a piece of the design, from 1 on, collapses under a motion: COLUMNS.

    Façade and building of each case are varied; `base` is a row of `others`, or `OWN`. How many
    façades section atlas has decides nothing.
    """
    changes = {} if base == OWN else _of_base(settings, base)
    drawn = design({**settings, "facades": PIECE * piece}).iloc[-PIECE:]
    find = partial(crossings, settings={"max_pga_g": settings["max_pga_g"]})
    rows = []
    for row in drawn.to_dict("records"):
        here = [facade(case, row, changes, law) for case in cases]
        key = {"facade": row["facade"], "base": base}
        curves = collapses(here, motion, directions, find)
        rows += [key | curve for curve in curves]
    return pd.DataFrame(rows, columns=COLUMNS)


def _of_base(settings, name):
    """Changes of a case for a row of `others`."""
    (row,) = (row for row in settings["others"] if row["name"] == name)
    return {f"facade.{key}": row[key] for key in ("base", "courses", "courses_growth")}
