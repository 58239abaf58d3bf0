"""Models of a façade beside the elastic wall that they stand for: how near, and at what cost.

The wall is a column (`mechanics.column`): its static curve is exact. Under a motion it is a stack
of rigid courses on elastic joints, which converges to it: of many. Rigid blocks on `facade.base`
`study` and `column` are compared with both, and stacks of fewer courses, equal or thin at the foot.
"""

import time
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd
from rocking.collapse.case import Case, Variant
from rocking.collapse.curve import collapse_curve
from rocking.collapse.probability import KEY
from rocking.collapse.quick import ENDS, PGA, RATIO, over_first
from rocking.collapse.ratios import spread
from rocking.collapse.scan import COURSES_STEP
from rocking.collapse.varied import collapses
from rocking.mechanics import column
from rocking.mechanics.closed_forms import capacity_compliant_base, capacity_rigid

from yade_scripts.model import base, facades

BASES = (facades.STUDY, facades.COLUMN)
FINE = 20  # equal courses of the stack whose static curve is drawn
WALL = (8, 1.2)  # courses, growth: stands for the wall; within 1.1 % of its static peak
CHOSEN = (4, 1.5)  # for a façade of one's own
STACKS = [(3, 1.0), CHOSEN, (5, 1.4)]
SCAN = {"power": 0.0, "level_ratio": 0.04}  # half collapse is wanted, not what is safe
SCAN |= {"realisations": 3, "amplitude_spread": 0.02}
D_OVER_B = np.array([0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8])
FACADES = {  # h, b [m], ρ [kg/m³], E [MPa]; none of them but the first chose the base's law
    "study": (6.48, 0.375, 1800.0, 1800.0),
    "half of E": (6.48, 0.375, 1800.0, 900.0),
    "three storeys": (9.0, 0.6, 1900.0, 1500.0),
    "thin": (3.2, 0.12, 1800.0, 2500.0),
    "Shawa": (3.0, 0.25, 1810.0, 4050.0),
    "slender": (4.5, 0.15, 1700.0, 800.0),
}
OWN, SHAKEN = "own", ("Shawa", "slender")  # under motions: Γ of the study's 0.019, 0.002, 0.084
STATIC = ["facade", "h_m", "b_m", "e_mpa", "gamma", "d_over_b", "lambda_rigid", "lambda_wall"]
STATIC += ["lambda_courses", *(f"lambda_base_{name}" for name in BASES)]
COLUMNS = [*KEY, "wall", "facade", *PGA, "pga_equivalent_g", *RATIO, *ENDS, "runs_planar"]
COLUMNS += ["failed", "cpu_s"]
SUMMARY = {"n": "n", "n_censored": "n_censored", "p10": 10, "median": 50, "p90": 90}
SUMMARY |= {"scatter": "scatter"}


def stack_name(courses, growth=1.0):
    """What tables call a stack, as "6 courses" or "6 courses, 1.35"."""
    return f"{courses} courses" + (f", {growth:g}" if growth != 1.0 else "")


STACK, CHOICE = stack_name(*WALL), stack_name(*CHOSEN)
HALF = f"{CHOICE}, half the step"


def variants():
    """The stack that stands for the wall, the rigid block on either base, then other stacks."""
    forms = [(STACK, facades.STUDY, *WALL), *((name, name, 0, 1.0) for name in BASES)]
    forms += [(stack_name(*stack), facades.STUDY, *stack) for stack in STACKS]
    keys = "facade.base", "facade.courses", "facade.courses_growth"
    return [
        Variant(name, dict(zip(keys, values, strict=True)), about={"facade": name})
        for name, *values in forms
    ]


def static(facades=None):
    """Static curves λ(d) of `FACADES` or others: rigid, the column, twenty courses, either base."""
    parts, usual = [], Case.configured("W1", {"facade.courses": 0}).facade
    for name, (h, b, density, e_mpa) in (facades or FACADES).items():
        gamma, ratio = column.compliance(h, b, density, 1e6 * e_mpa), b / h
        theta = np.arcsin(D_OVER_B * ratio)
        facade = replace(usual, height_m=h, thickness_m=b, density_kg_m3=density, e_mpa=e_mpa)
        curves = {
            "lambda_rigid": capacity_rigid(theta, h, b),
            "lambda_wall": column.capacity(D_OVER_B, gamma, ratio),
            "lambda_courses": column.capacity(D_OVER_B, gamma, ratio, column.courses(FINE)),
        }
        for law in BASES:
            jkn, edge = base.parts(replace(facade, base=law))
            capacity = capacity_compliant_base(theta, h, b, density, jkn, edge_pa=edge)
            curves[f"lambda_base_{law}"] = capacity
        about = {"facade": name, "h_m": h, "b_m": b, "e_mpa": e_mpa, "gamma": gamma}
        parts.append(pd.DataFrame({**about, "d_over_b": D_OVER_B, **curves}))
    return pd.concat(parts, ignore_index=True)[STATIC]


def walls(case):
    """Yield name and case of façades that are compared: the case's own, a stiff and a slender one.

    The others have return walls as thick as they are, and β by eq. 5.
    """
    yield OWN, case
    for name in SHAKEN:
        h, b, density, e_mpa = FACADES[name]
        changes: dict = {"facade.height_m": h, "facade.thickness_m": b, "facade.e_mpa": e_mpa}
        changes |= {"facade.density_kg_m3": density, "damping.law": "eq5"}
        yield name, case.varied({**changes, "return_wall.thickness_m": b}).calibrated()


def costed(case, motion, direction, step=None):
    """Half collapse of a dense scan with its ends, and the processor time that it took.

    `step` over the stable one, where it is to be another than the scan's own.
    """
    for few in ([1e-3], [1e-3, 2e-3, 3e-3]):  # what compiles or loads is no part of it
        collapse_curve(case, motion, direction, search="list", settings={"pga_g": few})
    start = time.process_time()
    curve = collapse_curve(case, motion, direction, settings=SCAN, fraction=step)
    row = curve.summary() | {"cpu_s": time.process_time() - start}
    return row | {"failed": int((curve.status == "failed").sum())}


def collapse(case, motion, direction):
    """Collapse of walls, of the block on either base and of stacks, under one motion: COLUMNS.

    ratio is of pga_median_g to that of the wall (`WALL`), with what the scatter of both leaves of
    it. `HALF` is the chosen stack at half its step.
    """
    tables = [of_wall(name, wall, motion, direction) for name, wall in walls(case)]
    return pd.concat(tables, ignore_index=True)


def of_wall(name, case, motion, direction):
    """Rows of `collapse` of one wall, which is a case of a rigid façade."""
    rows = collapses([case], motion, [direction], costed, variants())
    chosen = next(variant for variant in variants() if variant.name == CHOICE)
    half = partial(costed, step=0.5 * COURSES_STEP)
    alike = replace(chosen, about={"facade": HALF})
    rows += collapses([case], motion, [direction], half, [alike])
    return over_first(pd.DataFrame(rows).assign(wall=name).reindex(columns=COLUMNS))


def summary(table):
    """Spread of the ratios by model and base: 10, 50, 90 % of the curves, scatter of ln ratio."""
    others = table[table["facade"] != STACK]
    spreads = spread(others, ["model", "facade"], SUMMARY)
    time_s = others.groupby(["model", "facade"])["cpu_s"].median()
    return spreads.join(time_s.rename("cpu_s"), on=["model", "facade"])
