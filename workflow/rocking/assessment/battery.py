"""All checks of one façade under one demand, and which mechanism of it they are applied to."""

import numpy as np
from scipy.optimize import minimize_scalar

from rocking.assessment import checks
from rocking.assessment.demand import RecordDemand, floor_demand
from rocking.assessment.mechanism import Facade, overturning, two_blocks
from rocking.mechanics.closed_forms import G_M_S2
from rocking.mechanics.rocking_block import overturning_pga
from yade_scripts.model.motion import SIGNS
from yade_scripts.model.shape import refuse
from yade_scripts.model.ties import rod

ADDED_REACH_M = 0.2  # elongation of a rod of 4 m that snaps at 5 %

CHECKS = {  # key of the tables: what figures call it
    "linear_ground": "linear q = 2, ground",
    "linear_height": "linear q = 2, floor",
    "slv_ground": "non-linear 0.4 d0, ground",
    "slv_height": "non-linear 0.4 d0, floor",
    "slc_ground": "non-linear 0.6 d0, ground",
    "slc_height": "non-linear 0.6 d0, floor",
    "slv_both": "non-linear 0.4 d0, the less",
    "slc_both": "non-linear 0.6 d0, the less",
    "parts_ground": "NZS parts, rigid, ground",
    "parts_height": "NZS parts, rigid, floor",
    "parts_slow": "NZS parts, T_SLV, floor",
    "housner": "Housner's energy",
    "oscillator": "rocking oscillator",
}


def facade_of(section, settings):
    """The façade of sections facade and assessment as its mechanisms see it."""
    refuse(section, "the assessment")
    h, b = section["height_m"], section["thickness_m"]
    arm = settings["roof_arm_m"]
    return Facade(
        h,
        b,
        section["density_kg_m3"] * G_M_S2 * h * b * section["width_m"],
        settings["hinge_inset_m"],
        1e3 * settings["roof_load_kn"],
        0.5 * b if arm is None else arm,
    )


def ties_of(section, added_n=0.0):
    """Rows of ties of section facade as pulls of `overturning`, rigid up to their capacity.

    Parameters
    ----------
    section : dict
        Section facade; each row pulls with what `rod` gives until its elongation.
    added_n : float
        Capacity of one more row at the height of the highest, at the top where there is none.
    """
    rows = section["ties"]
    pulls = []
    for row in rows:
        _, capacity, elongation = rod(row)
        pulls.append((capacity, row["height_m"], elongation + 1e-3 * row["slack_mm"], False))
    if added_n > 0.0:
        height = max((row["height_m"] for row in rows), default=section["height_m"])
        pulls.append((added_n, height, ADDED_REACH_M, False))
    return pulls


def weakest_hinge(section):
    """Height of the hinge with the least α0 of `two_blocks`, the top held [m].

    Parameters
    ----------
    section : dict
        Section facade, whose floors stand at its top.
    """
    loads = [1e3 * row["load_kn"] for row in section["floors"]]
    h, b = section["height_m"], section["thickness_m"]
    arms = [0.5 * b if row["arm_m"] is None else row["arm_m"] for row in section["floors"]]
    total = sum(loads)
    arm = sum(p * s for p, s in zip(loads, arms, strict=True)) / total if total else 0.0
    settings = {"roof_load_kn": 1e-3 * total, "roof_arm_m": arm, "hinge_inset_m": 0.0}
    facade = facade_of({**section, "hinges_m": ()}, settings)
    found = minimize_scalar(
        lambda z: two_blocks(facade, z).multiplier(), bounds=(0.02 * h, 0.98 * h), method="bounded"
    )
    return float(found.x)


def mechanism_of(section, settings):
    """Overturning of the whole façade with its roof load and ties."""
    return overturning(facade_of(section, settings), ties_of(section))


def battery(mechanism, facade, chain, settings, demand):
    """Every check under one demand, but the oscillator's and those that combine two.

    Parameters
    ----------
    mechanism : Mechanism
    facade : dict
        Section facade.
    chain : dict
        Section smdof.
    settings : dict
        Section assessment.
    demand : RecordDemand or TableDemand
        Of the ground.

    Returns
    -------
    dict of str to Check
        By the keys of `CHECKS`.
    """
    h, share = facade["height_m"], settings["height_ratio"]
    fc, q = settings["confidence_factor"], settings["behaviour_factor"]
    floor = floor_demand(demand, share, chain)
    places = {"ground": (demand, "on the ground"), "height": (floor, f"at {share:g} of the height")}
    found = {}
    for key, (at, where) in places.items():
        found[f"linear_{key}"] = checks.linear(
            mechanism, at, where, confidence_factor=fc, behaviour=q
        )
        for limit in checks.LIMITS:
            found[f"{limit.lower()}_{key}"] = checks.nonlinear(
                mechanism, at, where, limit, confidence_factor=fc
            )
    slow = next(v for s, _, v, _ in found["slv_ground"].steps if s == "T_SLV")
    for key, height, period in (
        ("parts_ground", 0.0, 0.0),
        ("parts_height", share * h, 0.0),
        ("parts_slow", share * h, slow),
    ):
        found[key] = checks.parts(
            mechanism, demand, height, h, period, response_factor=settings["response_factor"]
        )
    found["housner"] = checks.housner(h, facade["thickness_m"], demand)
    return found


def failing_pga(mechanism, facade, chain, settings, record, directions, max_pga_g):
    """PGA at which each check just fails under one record, its own spectrum scaled [g].

    The rocking oscillator is integrated, so its answer depends on the direction; NaN where it
    stands up to `max_pga_g`.

    Returns
    -------
    list of (direction, key, pga_g)
    """
    demand = RecordDemand(record.acceleration_m_s2, record.dt_s)
    own = battery(mechanism, facade, chain, settings, demand)
    alike = {key: check.failing_pga_g for key, check in own.items()}
    for limit in ("slv", "slc"):  # whoever applies both takes the larger demand
        alike[f"{limit}_both"] = min(alike[f"{limit}_ground"], alike[f"{limit}_height"])
    rows = []
    for direction in directions:
        rows += [(direction, key, pga_g) for key, pga_g in alike.items()]
        alone = overturning_pga(
            record.acceleration_m_s2,
            record.dt_s,
            facade["height_m"],
            facade["thickness_m"],
            SIGNS[direction],
            max_pga_g,
        )
        rows.append((direction, "oscillator", alone))
    return rows


def pulse_share(record):
    """Share of ∫v² dt that lies in the half cycle of velocity with the largest peak [-].

    Near 1 for a single pulse, small for a long train of cycles. A half cycle lies between two zero
    crossings.
    """
    a = record.acceleration_m_s2
    v = np.concatenate(([0.0], np.cumsum(0.5 * record.dt_s * (a[1:] + a[:-1]))))
    v = v - np.linspace(0.0, v[-1], v.size)
    cycle = np.concatenate(([0], np.cumsum(np.signbit(v[1:]) != np.signbit(v[:-1]))))
    mine = cycle == cycle[np.abs(v).argmax()]
    return float(np.sum(v[mine] ** 2) / np.sum(v**2))
