"""Which building did the study have? Variants of a plan against the four periods it gives.

A variant changes what the study does not state: the openings of each side wall and of the
façades, how the façades bond to the side walls, the stiffness of the floors' contacts, what
SBDEM keeps of the corners and the density of the masonry. The floor load is fitted to
CBDEM's translation; joint stiffnesses are the study's and stay. Each variant is read in two
ways:

mass
    the translation along y is the mode with the largest effective mass along y, the rotation
    the mode with the largest effective inertia about z among the others;
order
    the study's own words: "only the modes of vibration with significant effective modal mass
    in the Y axis were considered", so its first and second mode are the two longest with at
    least SIGNIFICANT of the mass along y (5 %, as in EN 1998-1, 4.3.3.3.1).
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize
from scipy.stats import qmc

from yade_scripts.model.building.plan import PlanError

from .case import (
    MODELS,
    PAPER_PERIODS_S,
    build_model,
    load_of_period,
    translation_mode,
    twist_mode,
)
from .loads import HEAVY_KG_M2, LoadedModes

READINGS = ("mass", "order")
SIGNIFICANT = 0.05
SMALLEST_OPENING_M = 0.1
LOGARITHMIC = ("facade_bond", "timber_scale")
WANTED = [(model, kind) for kind in ("y", "rz") for model in MODELS]


@dataclass(frozen=True)
class PlanVariant:
    """What distinguishes a variant from the plan and settings it starts from.

    Widths in metres, an opening narrower than SMALLEST_OPENING_M is bricked up;
    `timber_scale` multiplies the contact stiffnesses of beams and panels; the others are
    named as in `Plan` and in the section `building`.
    """

    opening_left_m: float
    opening_right_m: float
    opening_facade_m: float
    facade_bond: float
    timber_scale: float
    corner_m: float
    density_kg_m3: float

    def plan(self, plan):
        """Return `plan` with this variant's openings, bond and corners.

        The walls that carry the floors are left and right; openings keep their middle and
        height.
        """
        left, right = plan.floors[0].walls
        width = {left: self.opening_left_m, right: self.opening_right_m}
        walls = tuple(
            replace(w, openings=_resized(w.openings, width.get(w.name, self.opening_facade_m)))
            for w in plan.walls
        )
        return replace(plan, walls=walls, facade_bond=self.facade_bond, corner_m=self.corner_m)

    def settings(self, settings):
        """Return the section `building` with this variant's stiffness and density."""
        timber = {
            key: self.timber_scale * settings[key] for key in ("timber_jkn_pa_m", "timber_jks_pa_m")
        }
        return {**settings, **timber, "density_kg_m3": self.density_kg_m3}


def _resized(openings, width_m):
    if width_m < SMALLEST_OPENING_M:
        return ()
    return tuple(
        replace(o, from_start_m=o.from_start_m + 0.5 * (o.width_m - width_m), width_m=width_m)
        for o in openings
    )


def variant(ranges, place):
    """Return the variant at a place of the unit cube, its fields in order.

    `ranges` has (low, high) of each; those in LOGARITHMIC are divided evenly in their logarithm.
    """
    values = {}
    for name, part in zip(PlanVariant.__dataclass_fields__, np.clip(place, 0.0, 1.0), strict=True):
        low, high = ranges[name]
        if name in LOGARITHMIC:
            values[name] = float(np.exp(np.log(low) + part * (np.log(high) - np.log(low))))
        else:
            values[name] = float(low + part * (high - low))
    return PlanVariant(**values)


def sample(count, seed):
    """Return `count` places of the unit cube, a scrambled Sobol sequence (Owen, 1998)."""
    fields = len(PlanVariant.__dataclass_fields__)
    return qmc.Sobol(fields, rng=seed).random(count)


def modes_of_study(modes, reading):
    """Return the indices of the study's translation and rotation, or None where there is none."""
    if reading == "mass":
        return translation_mode(modes), twist_mode(modes)
    found = np.flatnonzero(modes.effective_ratio[:, 1] >= SIGNIFICANT)
    return (int(found[0]), int(found[1])) if len(found) > 1 else None


def first_mode(modes, reading):
    """Return the index of the study's translation alone; one always carries enough mass."""
    if reading == "mass":
        return translation_mode(modes)
    return int(np.argmax(modes.effective_ratio[:, 1] >= SIGNIFICANT))


def loaded(settings, plan, coarsening):
    """Return {model: LoadedModes} of a plan."""
    return {
        model: LoadedModes(build_model(settings, plan, model, 0.0, coarsening)) for model in MODELS
    }


def fitted(models, reading):
    """Fit the floor load to CBDEM's translation and return the four periods.

    That is load_kg_m2, and for every model and kind of WANTED {model}_{kind}_s, with the mode's
    effective ratios _mass_y and _inertia_z; largest_error_s and rms_error_s over the four periods,
    the latter what is refined: a simplex stops at the kinks of the former. None where the reading
    finds no two modes.
    """

    def period(load):
        modes = models["CBDEM"].modes(load)
        return modes.period_s[first_mode(modes, reading)]

    load = load_of_period(period, PAPER_PERIODS_S["CBDEM", "y"], HEAVY_KG_M2, 0.01)
    row = {"load_kg_m2": load}
    errors = []
    for model in MODELS:
        modes = models[model].modes(load)
        found = modes_of_study(modes, reading)
        if found is None:
            return None
        for kind, mode in zip(("y", "rz"), found, strict=True):
            name = f"{model.lower()}_{kind}"
            row[f"{name}_s"] = float(modes.period_s[mode])
            row[f"{name}_mass_y"] = float(modes.effective_ratio[mode, 1])
            row[f"{name}_inertia_z"] = float(modes.effective_ratio[mode, 5])
            errors.append(row[f"{name}_s"] - PAPER_PERIODS_S[model, kind])
    row["largest_error_s"] = float(np.abs(errors).max())
    row["rms_error_s"] = float(np.sqrt(np.mean(np.square(errors))))
    return row


def evaluate(settings, plan, coarsening):
    """Return {reading: row of `fitted`} of a plan; empty where it cannot be built."""
    try:
        models = loaded(settings, plan, coarsening)
    except PlanError:
        return {}
    rows = {reading: fitted(models, reading) for reading in READINGS}
    return {reading: row for reading, row in rows.items() if row is not None}


def refine(score, start, evaluations):
    """Improve a place of the unit cube by the simplex of Nelder and Mead (1965).

    `score` turns a place to a number, and is called at most `evaluations` times.
    """
    step = np.where(start > 0.5, -0.15, 0.15)
    simplex = np.vstack([start, start + np.diag(step)])
    found = minimize(
        lambda x: score(_folded(x)),
        start,
        method="Nelder-Mead",
        options={"maxfev": evaluations, "initial_simplex": simplex, "xatol": 0.0, "fatol": 0.0},
    )
    return _folded(found.x)


def _folded(x):
    """Mirror a point into the unit cube: a simplex cut off at the bounds would lose its volume."""
    part = np.mod(x, 2.0)
    return np.where(part > 1.0, 2.0 - part, part)


def reached(table, near_s):
    """Which rows of a search have both of CBDEM's periods, and which of these are not bettered.

    Rows are of `fitted`; a period may be off by `near_s`. Not bettered: in all four periods
    together, see `not_dominated`.
    """
    found = table[[f"{model.lower()}_{kind}_s" for model, kind in WANTED]].to_numpy()
    off = np.abs(found - [PAPER_PERIODS_S[key] for key in WANTED])
    met = np.all(off[:, [model == "CBDEM" for model, _ in WANTED]] <= near_s, axis=1)
    best = met.copy()
    best[met] = not_dominated(off[met])
    return met, best


def not_dominated(errors):
    """Return which rows of `errors` no other row equals or betters in every column."""
    errors = np.asarray(errors, float)
    better = np.all(errors[None, :, :] <= errors[:, None, :], axis=2)
    better &= np.any(errors[None, :, :] < errors[:, None, :], axis=2)
    return ~better.any(axis=1)
