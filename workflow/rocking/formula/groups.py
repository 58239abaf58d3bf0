"""Dimensionless groups of a façade and its building, and what the formula does not describe.

A rigid block of height h and thickness b begins to rock at a horizontal acceleration of g tan α,
tan α = b/h. How long that must last for it to overturn follows from Housner's p = √(3g/4R), with R
half the diagonal: the block is the slower, the larger. The walls behind it move in the period T1.
Γ = ρgh³/(E b²) says how much a wall leans under its own weight (`mechanics.column`); m/M how much
of the building's mass it can push. z = β ω_c is twice the share of critical damping with which the
façade lies on its walls, ω_c = √(E r/(L ρ b)), L = h/2, r the walls' thickness over the width: what
an impact takes.
"""

import math

from rocking.configuration import schema
from rocking.configuration.schema import show
from rocking.mechanics import beta
from rocking.mechanics.closed_forms import block
from yade_scripts.model.chain import yields
from yade_scripts.model.facades import Facade
from yade_scripts.model.gravity import GRAVITY_M_S2

PERIOD_S = 0.27  # at which the logarithm of T1 is zero
DIMENSIONS = (  # of a façade, as the atlas draws them
    "height_m",
    "slenderness",
    "e_mpa",
    "density_kg_m3",
    "friction_deg",
    "period_s",
    "mass_ratio",
    "contact_damping",
    "storeys",
)
# sections and keys that the groups hold, or that change nothing under these models
HELD = {
    "facade": {
        "height_m",
        "thickness_m",
        "width_m",
        "density_kg_m3",
        "e_mpa",
        "friction_deg",
        "base",
        "courses",
        "courses_growth",
        "base_stiffness_pa_m",
        "flush_face",
        "parapet_thickness_m",
        "building_height_m",
    },
    "return_wall": {
        "count",
        "thickness_m",
        "friction_deg",
        "cohesion_mpa",
        "tension_mpa",
        "building_mass_kg",
    },
    "smdof": {"n_dof", "period_s", "tail_s", "base_shear_ratio", "fallen_drift_ratio"},
}


class OutsideError(ValueError):
    """A façade that the formula does not describe; the text is one line."""


def tan_alpha(row):
    """b/h."""
    return 1.0 / row["slenderness"]


def p_rad_s(row):
    """p = √(3g/4R) of the rigid block, R half its diagonal [rad/s]."""
    return block(row["height_m"], row["height_m"] / row["slenderness"]).p_rad_s


def gamma(row):
    """Γ = ρ g h³/(E b²)."""
    weight = row["density_kg_m3"] * GRAVITY_M_S2 * row["height_m"]
    return weight * row["slenderness"] ** 2 / (1e6 * row["e_mpa"])


def terms(row):
    """Every group that a law may take, by name, of a façade's `DIMENSIONS`."""
    p, t1 = p_rad_s(row), math.log(row["period_s"] / PERIOD_S)
    return {
        "1": 1.0,
        "ln p": math.log(p),
        "ln z": math.log(row["contact_damping"]),
        "G": gamma(row),
        "ln T1": t1,
        "ln2 T1": t1 * t1,
        "m/M": 1.0 / row["mass_ratio"],
        "m/M ln T1": t1 / row["mass_ratio"],
    }


def dimensions(case):
    """`DIMENSIONS` of a case: a plain box on return walls with a chain of default damping.

    With base_shear_ratio, V/W, where its building yields. An OutsideError of one line names the
    first key that the groups do not hold.
    """
    defaults = schema.sections()
    for name, held in HELD.items():
        known = schema.complete({}, defaults[name])
        if name == "smdof" and not case.kind.chain:
            known = case[name]  # no building moves the walls
        for key, value in case[name].items():
            if key not in held and value != known[key]:
                raise OutsideError(
                    f"formula: {name}.{key} = {show(value)}: the formula is of façades with "
                    f"{show(known[key])}"
                )
    facade, wall, chain = Facade.of(case["facade"]), case["return_wall"], case["smdof"]
    h, b, w = facade.height_m, facade.thickness_m, facade.width_m
    if facade.building_height_m not in (None, h):
        raise OutsideError(
            f"formula: facade.building_height_m = {show(facade.building_height_m)}: the formula "
            "is of façades as high as their building"
        )
    if facade.base_stiffness_pa_m is not None:
        raise OutsideError("formula: facade.base_stiffness_pa_m: the formula is of bases by E")
    if wall["friction_deg"] != facade.friction_deg:
        raise OutsideError(
            f"formula: return_wall.friction_deg = {show(wall['friction_deg'])}: the formula is of "
            "façades with the friction of their base"
        )
    mass, facade_kg = wall["building_mass_kg"], facade.density_kg_m3 * h * b * w
    if case.kind.two_way and not mass:
        raise OutsideError(
            "formula: return_wall.building_mass_kg: expected the building's mass, stated, with "
            f"model {case.model}"
        )
    return {
        "height_m": h,
        "slenderness": h / b,
        "e_mpa": facade.e_mpa,
        "density_kg_m3": facade.density_kg_m3,
        "friction_deg": facade.friction_deg,
        "period_s": chain["period_s"],
        "mass_ratio": mass / facade_kg if mass else None,
        "contact_damping": case["beta_s"] * beta.groups(case.sections)["omega_c_rad_s"],
        "storeys": chain["n_dof"],
        **({"base_shear_ratio": chain["base_shear_ratio"]} if yields(chain) else {}),
    }
