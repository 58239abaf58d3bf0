"""A part of a façade as a façade of its own, on the building at the height of its foot.

A mechanism takes what lies above a *foot*: all of it (it overturns), or what lies below a *held*
level, open at a *hinge* between the two (vertical bending). The part keeps its thickness, openings,
ties and floors, counted from its foot, and has as many courses if it overturns; what is below the
foot moves with the building, and the base of the part stands on that (`base_height_m`). The chain's
masses stay where they are (`building_height_m`). A part above all that the return walls hold, a
gable or a parapet, has none behind it and rocks to both sides; so has what lies above a height of
either.

What lies above a held level bears on it with its weight, and what holds it there holds the part.
"""

from yade_scripts.model.facades import Facade
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.shape import shape_of

NEAR_M = 1e-6
LEVEL_M = 0.3  # what holds no higher above a held level belongs to it, as ties below a floor
WHOLE = (0.0, None, None)


def part_of(section, foot_m, held_m=None, hinge_m=None, wedge=None):
    """Section facade of the part of a façade above a foot, in heights above the façade's base.

    A `wedge` of the return walls, (angle of its crack from the vertical in degrees, thickness of
    all walls), makes it one block, on the base of the elastic wall where the façade has courses. Of
    vertical bending `held_m` is the level that stays, `hinge_m` the joint that opens below it.
    ValueError of one line for heights that the façade has not, hinges that are stated already, or
    bending of a wall that leans.
    """
    if wedge and wedge[0]:
        return _with_wedge(section, (foot_m, held_m, hinge_m), *wedge)
    if (foot_m, held_m, hinge_m) == WHOLE:  # with hinges, courses or a tilt of its own
        return dict(section)
    _check(section, foot_m, held_m, hinge_m)
    shape, eaves = shape_of(section), section["height_m"]
    top = eaves if held_m is None else held_m
    base = section["base_height_m"]
    part = {
        **section,
        "base_height_m": _place(base + foot_m),
        "building_height_m": section.get("building_height_m") or _place(base + eaves),
        "base_stiffness_pa_m": None if foot_m else section["base_stiffness_pa_m"],
        "hinges_m": [] if hinge_m is None else [_place(hinge_m - foot_m)],
        "courses": section.get("courses", 0) if hinge_m is None else 0,
    }
    if foot_m >= eaves - NEAR_M:
        return part | _above_the_walls(section, shape, foot_m)
    floors = _rows(section["floors"], foot_m, top)
    if held_m is not None:
        part |= {"gable_height_m": 0.0, "parapet_height_m": 0.0}
        floors += _load(section, shape, held_m, _place(top - foot_m))
    back, front = shape.faces_at(min(foot_m + NEAR_M, eaves))
    thickness_m, top_m = front - back, None
    whole = Facade.of(section)
    if whole.top_thickness_m:
        thickness_m, top_m = (_place(whole.tapered_m(z)) for z in (foot_m, top))
    return part | {
        "height_m": _place(top - foot_m),
        "thickness_m": _place(thickness_m),
        "top_thickness_m": top_m,
        "thickness_steps": [
            {**row, "z_m": _place(row["z_m"] - foot_m)}
            for row in section["thickness_steps"]
            if foot_m + NEAR_M < row["z_m"] < top - NEAR_M
        ],
        "openings": _openings(section["openings"], foot_m, top),
        "cornices": _openings(section.get("cornices", ()), foot_m, top),
        "ties": _rows(section["ties"], foot_m, top),
        "thrusts": _rows(section.get("thrusts", ()), foot_m, top),
        "floors": floors,
    }


def _with_wedge(section, heights, deg, thickness_m):
    """A part with a wedge of the return walls."""
    foot_m, held_m, _ = heights
    if held_m is not None or foot_m >= section["height_m"] - NEAR_M:
        raise ValueError(
            f"part.wedge_deg = {deg:g}: expected 0 (°) for a part that bends, or that has no "
            "return walls behind it"
        )
    part = part_of({**section, "courses": 0}, *heights)
    elastic = section.get("courses") and not part["base_stiffness_pa_m"]
    base = "column" if elastic else section.get("base", "study")
    return part | {"wedge_deg": deg, "wedge_thickness_m": thickness_m, "base": base}


def _check(section, foot_m, held_m, hinge_m):
    eaves, top = section["height_m"], shape_of(section).top_m
    if section["hinges_m"]:
        raise ValueError("part of a façade: expected no facade.hinges_m")
    if section["tilt_deg"] and held_m is not None:
        raise ValueError("part that bends: expected no facade.tilt_deg, of a wall that leans")
    highest = top if held_m is None else held_m
    if not 0.0 <= foot_m < highest - NEAR_M:
        raise ValueError(f"part.foot_m = {foot_m:g}: expected 0 to less than {highest:g} (m)")
    if (held_m is None) != (hinge_m is None):
        raise ValueError("part.held_m, part.hinge_m: expected both (m), or none")
    if held_m is not None and not foot_m < hinge_m < held_m <= eaves + NEAR_M:
        raise ValueError(
            f"part.hinge_m = {hinge_m:g}: expected between part.foot_m = {foot_m:g} and "
            f"part.held_m = {held_m:g}, and that up to facade.height_m = {eaves:g} (m)"
        )


def _above_the_walls(section, shape, foot_m):
    """What differs of a gable or a parapet alone, from its foot or a height above that up.

    Its base moves with the foot of the gable or parapet. A gable narrows with height.
    """
    back, front = shape.crown if section["gable_height_m"] else shape.storeys[-1][2:]
    gable, eaves = section["gable_height_m"], section["height_m"]
    high = shape.top_m - max(foot_m, eaves)
    share = high / gable if gable else 1.0
    return {
        "base_height_m": _place(section["base_height_m"] + eaves),
        "width_m": section["width_m"] * min(share, 1.0),
        "height_m": _place(high),
        "thickness_m": _place(front - back),
        "outline": "triangle" if gable else "box",
        "courses": 0,
        "sides": "two",
        "gap_m": 0.0,
        "gable_height_m": 0.0,
        "parapet_height_m": 0.0,
        "thickness_steps": [],
        "openings": [],
        "ties": [],
        "thrusts": [],
        "cornices": [],
        "top_thickness_m": None,
        "floors": [],
    }


def _place(value):
    """A length without the rounding of a difference, to a nanometre."""
    return round(value, 9)


def _rows(rows, foot_m, top_m):
    """Ties or floors above a foot, those of the level at the top at its height."""
    return [
        {**row, "height_m": _place(min(row["height_m"], top_m) - foot_m)}
        for row in rows
        if foot_m + NEAR_M < row["height_m"] < top_m + LEVEL_M
    ]


def _openings(rows, foot_m, top_m):
    """Openings, or cornices, between two heights; of those that either cuts, what lies between."""
    kept = []
    for row in rows:
        low, high = max(row["z_m"], foot_m), min(row["z_m"] + row["height_m"], top_m)
        if high - low > NEAR_M:
            kept.append({**row, "z_m": _place(low - foot_m), "height_m": _place(high - low)})
    return kept


def _load(section, shape, held_m, height_m):
    """What lies above a held level, as a floor's load without friction on the part's top."""
    weight = moment = 0.0
    for z0, z1, y0, y1 in shape.storeys:
        area = max(z1 - max(z0, held_m), 0.0) * section["width_m"]
        for x0, x1, s, e in shape.openings:
            area -= (x1 - x0) * max(min(e, z1) - max(s, z0, held_m), 0.0)
        mass = section["density_kg_m3"] * area * (y1 - y0)
        weight, moment = weight + mass, moment + 0.5 * mass * (y0 + y1)
    for z0, z1, y0, y1 in shape.cornices:
        mass = section["density_kg_m3"] * max(z1 - max(z0, held_m), 0.0) * section["width_m"]
        mass *= y1 - y0
        weight, moment = weight + mass, moment + 0.5 * mass * (y0 + y1)
    if gable := section["gable_height_m"]:
        y0, y1 = shape.crown
        mass = 0.5 * section["density_kg_m3"] * gable * (y1 - y0) * section["width_m"]
        weight, moment = weight + mass, moment + 0.5 * mass * (y0 + y1)
    weight, moment = GRAVITY_M_S2 * weight, GRAVITY_M_S2 * moment
    for row in section["floors"]:
        if row["height_m"] >= held_m + LEVEL_M:
            back, front = shape.tapered_faces_at(row["height_m"])
            arm = 0.5 * (front - back) if row["arm_m"] is None else row["arm_m"]
            weight += 1e3 * row["load_kn"]
            moment += 1e3 * row["load_kn"] * (back + arm)
    if weight <= 1e-6:
        return []
    back, front = shape.faces_at(held_m)
    arm = min(max(moment / weight - back, 0.0), front - back)
    return [FLOOR | {"height_m": height_m, "load_kn": 1e-3 * weight, "arm_m": arm}]


FLOOR = {  # a dead load that nothing holds
    "joists": "across",
    "bearing": "point",
    "load_inertia": None,
    "friction": 0.0,
    "anchor_kn": 0.0,
    "anchor_reach_m": 0.2,
    "stiffness_kn_m": 20000.0,
    "mass_t": 0.0,
    "period_s": 0.3,
}
