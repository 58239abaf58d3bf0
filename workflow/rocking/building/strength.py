"""How strong is a building: its base-shear coefficient V/W from wall areas and shear strength.

The simplified model of masonry palaces of the Italian guidelines for heritage (Linee Guida 2011,
DPCM 9 February 2011, §5.4.2, eq. 5.12 to 5.15): of every storey i in one direction

    V_i = ξ ζ A_i τ_i,   τ_i = (1.5 τ0/b) √(1 + σ_i/(1.5 τ0)),   V/W = min V_i / (κ_i W)

with A_i the area of the walls that resist in the direction (piers, at mid-height of the storey),
σ_i the mean compression there, κ_i the share of the base shear that the storey carries, Σ_{j ≥ i}
W_j z_j / Σ_j W_j z_j. τ_i is Turnšek and Čačovič's diagonal cracking (1971), whose tensile strength
is 1.5 τ0: Circolare 7/2019, C8.7.1.16, with b the height of a pier over its length, 1 to 1.5; the
guidelines take 1.5. ξ is 1 where the piers fail in shear and 0.8 in flexure, and ζ is 1 with strong
spandrels and 0.8 with weak ones. The guidelines multiply V_i by μ, the homogeneity of the piers,
and divide it by β ≥ 1, the irregularity of the plan. Both are 1 here: like piers, a regular plan.

How it was read: C8.7.1.16 with b in Sulla et al. (2023, Procedia Structural Integrity 44), table
C8.5.I in two public transcriptions, both at second hand. The guidelines' μ, ξ, ζ, β and κ could not
be read and stand here from memory: compare them with the text.
"""

import argparse
import math
from dataclasses import dataclass

import numpy as np

from rocking.configuration.files import read_yaml
from yade_scripts.model.building.plan import plan_from_dict

GRAVITY_M_S2 = 9.80665
DENSITY_KG_M3 = 1800.0  # of the masonry
# τ0 [MPa] of the Circolare 7/2019, table C8.5.I, lowest and highest (at second hand)
MASONRY = {
    "irregular stone": (0.018, 0.032),
    "roughly cut stone": (0.035, 0.051),
    "split stone, good bond": (0.056, 0.074),
    "irregular soft stone": (0.028, 0.042),
    "regular soft stone": (0.040, 0.080),
    "squared stone": (0.090, 0.120),
    "brick and lime mortar": (0.050, 0.130),
    "half-solid brick and cement mortar": (0.080, 0.170),
}
TENSILE = 1.5  # tensile strength over τ0, of diagonal cracking
SLENDER, SQUAT = 1.5, 1.0  # b of piers at least so many times as high as long, and no higher


@dataclass(frozen=True)
class Storey:
    """One storey in one direction.

    Attributes
    ----------
    area_m2 : float
        Of the piers along the direction, at mid-height.
    weight_n : float
        Of the floor above with half of the walls below and above it.
    height_m : float
        Of that floor above the ground.
    compression_pa : float
        Mean stress in the piers at mid-height.
    """

    area_m2: float
    weight_n: float
    height_m: float
    compression_pa: float


def base_shear_ratio(storeys, tau0_pa, *, piers=1.0, spandrels=1.0, shape=SLENDER):
    """Base-shear coefficient V/W of a building in one direction, and the storey that decides.

    Parameters
    ----------
    storeys : sequence of Storey
        From the lowest up.
    tau0_pa : float
        Shear strength without compression.
    piers, spandrels : float
        ξ and ζ, see above.
    shape : float
        b, height of the piers over their length, `SQUAT` to `SLENDER`.

    Returns
    -------
    float, int
        V/W, and the storey counted from 1.

    Raises
    ------
    ValueError
        In one line, for values that are not positive, or another shape.
    """
    if not SQUAT <= shape <= SLENDER:
        raise ValueError(f"shape = {shape}: expected b from {SQUAT:g} to {SLENDER:g}")
    if not tau0_pa > 0.0:
        raise ValueError(f"tau0_pa = {tau0_pa}: expected a number above 0")
    for number, storey in enumerate(storeys, 1):
        if not (storey.area_m2 > 0.0 and storey.weight_n > 0.0 and storey.compression_pa >= 0.0):
            raise ValueError(
                f"storey {number}: expected an area and a weight above 0, got {storey}"
            )
    weight = np.array([storey.weight_n for storey in storeys])
    moment = weight * np.array([storey.height_m for storey in storeys])
    above = np.cumsum(moment[::-1])[::-1] / moment.sum()
    strength = np.array(
        [storey.area_m2 * tau(storey.compression_pa, tau0_pa, shape) for storey in storeys]
    )
    ratios = piers * spandrels * strength / (above * weight.sum())
    return float(ratios.min()), int(ratios.argmin()) + 1


def tau(compression_pa, tau0_pa, shape=SLENDER):
    """Mean shear stress at diagonal cracking [Pa], (1.5 τ0/b) √(1 + σ/(1.5 τ0))."""
    tensile = TENSILE * tau0_pa
    return tensile / shape * math.sqrt(1.0 + compression_pa / tensile)


def with_interval(storeys, tau0_pa, shape=SLENDER):
    """V/W with its ends: the low one with the lower τ0 and 0.8 for ξ and ζ, the high one with 1.

    Parameters
    ----------
    storeys : sequence of Storey
    tau0_pa : tuple of 2 floats
        Lowest and highest, as `MASONRY` has them in MPa.
    shape : float
        b of `base_shear_ratio`.

    Returns
    -------
    middle, low, high : float
        The middle is the geometric mean of the ends.
    """
    low, _ = base_shear_ratio(storeys, tau0_pa[0], piers=0.8, spandrels=0.8, shape=shape)
    high, _ = base_shear_ratio(storeys, tau0_pa[1], shape=shape)
    return math.sqrt(low * high), low, high


def storeys_of(area_share, floors, floor_pa, storey_m, walls_share=None):
    """Storeys of a building that is known by a few numbers, per square metre of floor.

    Parameters
    ----------
    area_share : float
        Area of the walls along the direction over that of the floor.
    floors : int
    floor_pa : float
        Weight of a floor, with the live load that counts.
    storey_m : float
        Height of a storey.
    walls_share : float, optional
        Area of all walls, openings filled, over that of the floor, for their weight; by default
        twice that of those along.

    Returns
    -------
    list of Storey
    """
    total, storeys = walls_share or 2.0 * area_share, []
    wall = DENSITY_KG_M3 * GRAVITY_M_S2 * storey_m * total
    for level in range(1, floors + 1):
        here = wall if level < floors else 0.5 * wall
        above = (floors - level + 1) * floor_pa + (floors - level + 0.5) * wall
        storeys.append(Storey(area_share, floor_pa + here, level * storey_m, above / total))
    return storeys


def storeys_of_plan(plan, floor_pa, axis="y"):
    """Storeys of a plan in the direction x or y; façades count as weight, not as resistance.

    A plan is `yade_scripts.model.building.plan.Plan`. Piers are what openings leave of the walls
    along the direction at mid-height of each storey; their mean compression is that of all walls.

    Returns
    -------
    list of Storey
    """
    levels = [floor.level_m for floor in plan.floors]
    edges, storeys = [0.0, *levels], []
    gravity = DENSITY_KG_M3 * GRAVITY_M_S2
    wide, deep = (max(w.length_m for w in plan.walls if w.axis == k) for k in (0, 1))
    area, along = wide * deep, "xy".index(axis)
    top = max(wall.top_m for wall in plan.walls)

    def section(z):
        return sum(_pier_area(w, z) for w in plan.walls)

    def masonry(low, high):
        heights = np.linspace(low, high, 200)
        return gravity * float(np.trapezoid([section(z) for z in heights], heights))

    for k, level in enumerate(levels):
        middle = 0.5 * (edges[k] + level)
        upper = 0.5 * (level + levels[k + 1]) if k + 1 < len(levels) else top
        above = masonry(middle, top) + floor_pa * area * (len(levels) - k)
        piers = [w for w in plan.walls if w.axis == along and not w.facade]
        weight = masonry(middle, upper) + floor_pa * area
        resists = sum(_pier_area(w, middle) for w in piers)
        if not resists > 0.0:
            raise ValueError(f"plan {plan.name}: no wall along {axis} but façades")
        storeys.append(Storey(resists, weight, level, above / section(middle)))
    return storeys


def _pier_area(wall, z):
    """Area of a wall at a height, its openings left out [m²]."""
    if not 0.0 <= z <= wall.top_m:
        return 0.0
    open_m = sum(o.width_m for o in wall.openings if o.sill_m <= z < o.head_m)
    return wall.thickness_m * (wall.length_m - open_m)


def main(arguments=None):
    """Print V/W of a plan, or of a few numbers, with its interval."""
    parser = argparse.ArgumentParser(
        prog="python -m rocking.building.strength", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--plan", help="plan file; without one, the four numbers below")
    parser.add_argument("--axis", default="y", choices=("x", "y"), help="direction of the plan")
    parser.add_argument("--masonry", default="brick and lime mortar", choices=tuple(MASONRY))
    parser.add_argument(
        "--area-share", type=float, default=0.05, help="walls along over floor area"
    )
    parser.add_argument(
        "--pier-shape", type=float, default=SLENDER, help="height over length of piers, 1 to 1.5"
    )
    parser.add_argument("--storeys", type=int, default=2)
    parser.add_argument("--floor-kpa", type=float, default=3.0, help="weight of a floor")
    parser.add_argument("--storey-m", type=float, default=3.0, help="height of a storey")
    args = parser.parse_args(arguments)
    tau0 = tuple(1e6 * value for value in MASONRY[args.masonry])
    if args.plan:
        plan = plan_from_dict(read_yaml(args.plan), args.plan)
        storeys = storeys_of_plan(plan, 1e3 * args.floor_kpa, axis=args.axis)
    else:
        storeys = storeys_of(args.area_share, args.storeys, 1e3 * args.floor_kpa, args.storey_m)
    try:
        middle, low, high = with_interval(storeys, tau0, shape=args.pier_shape)
    except ValueError as error:
        parser.error(str(error))
    for number, storey in enumerate(storeys, 1):
        print(
            f"storey {number}: walls {storey.area_m2:.3g} m², "
            f"weight {1e-3 * storey.weight_n:.3g} kN, "
            f"compression {1e-6 * storey.compression_pa:.3g} MPa"
        )
    print(f"V/W = {middle:.2f}, {low:.2f} to {high:.2f} ({args.masonry})")
    print(f"smdof:\n  base_shear_ratio: {middle:.2f}")


if __name__ == "__main__":
    main()
