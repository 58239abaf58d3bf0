"""Dense searches for the mechanisms of a façade that are weakest, apart from `weakest`."""

import math

import numpy as np
from studies.assess.sites import CORNERS, LEAST_PART_M


def kind_of(family, one):
    """What a mechanism is compared with: its side, the level up to which it bends, or neither."""
    if one.side:
        return f"{CORNERS[one.side]} corner"
    if one.held_m is None:
        return "overturning"
    low = max(z for z in family.levels() if z <= one.foot_m + 1e-6)
    return f"bending from {low:g} to {one.held_m:g}"


def least_by_kind(family, mechanisms):
    """Least PGA of each kind [g]."""
    found = {}
    for one in mechanisms:
        kind = kind_of(family, one)
        found[kind] = min(found.get(kind, math.inf), family.slv(one))
    return {kind: pga_g for kind, pga_g in found.items() if math.isfinite(pga_g)}


def dense_mechanisms(family, foot_m, hinge_m, near=None):
    """Every part above a foot, both corners and bending to every level, by so many metres.

    Bending below a level whose onset alone, which the check never falls short of, lies above the
    least PGA of `near` (by kind) is left out: it is not the weakest. An infinite `hinge_m` leaves
    bending out.
    """
    top = family.masonry.top_m - LEAST_PART_M
    for z in np.arange(0.0, top + 1e-9, foot_m):
        yield family.part(float(z), "part")
    for side in CORNERS if family.wall["count"] else ():
        for z in np.arange(0.0, family.height_m - LEAST_PART_M + 1e-9, foot_m):
            yield family.corner(side, float(z))
    levels = family.levels() if math.isfinite(hinge_m) else []
    for k, low in enumerate(levels[:-1]):
        for high in levels[k + 1 :]:
            known = (near or {}).get(f"bending from {low:g} to {high:g}", math.inf)
            for foot in np.arange(low, levels[k + 1], foot_m):
                for hinge in np.arange(foot + 0.1, high - 0.1 + 1e-9, hinge_m):
                    one = family.span(low, float(foot), float(hinge), high)
                    if onset_g(family, one) < known:
                        yield one


def onset_g(family, one):
    """PGA at which a mechanism begins by the code, of ground and floor the less [g]."""
    alpha, ratio = one.mechanism.multiplier(), one.mechanism.participation()[1]
    start = alpha / (ratio * family.slv.factor)
    places = family.slv.places(one).values()
    return min(d.pga_g * start / d.acceleration(one.t0_s) for d, _ in places)
