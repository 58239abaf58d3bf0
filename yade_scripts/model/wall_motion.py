"""What the return walls take from the masses of the chain: one rule for blocks and bricks.

The masses share out the height of the building, H: they stand at j·H/n above the ground. A façade
on the ground is as high as its building; one on a base further up, with the rest of it, may be less
than that. A piece of wall in storey j moves with

    top           mass j (the study's choice: a block a mass)
    middle        the mean of masses j − 1 and j, the chain's motion at the storey's middle
    interpolated  the masses below and above it, by height; a block of W2 is cut into PARTS

The ground counts as mass 0. A wall that carries the masses hands its reactions to them by the
same weights.
"""

from yade_scripts.lists import listed
from yade_scripts.model.motion import GROUND

PARTS = 5  # of a storey's block, each at its own height: a course of W3 by default


def floor_motion(j):
    """Name of the motion of lumped mass j, counted from 1 at the bottom; 0 is the ground."""
    return f"floor{j}" if j else GROUND


def storey_of(height_ratio, n):
    """Storey, counted from 0, at z/h; the top belongs to the last one."""
    return min(int(height_ratio * n), n - 1)


def weight_of(rule, height_ratio, n):
    """Weight of the mass above, in `storey_of`; the mass below has the rest.

    ValueError for an unknown rule.
    """
    place = height_ratio * n - storey_of(height_ratio, n)
    weights = {"top": 1.0, "middle": 0.5, "interpolated": place}
    if rule not in weights:
        raise ValueError(f"return_wall.motion = '{rule}': expected {listed(weights)}")
    return weights[rule]


def motion_of(rule, height_m, building_height_m, n, motions):
    """Name of the motion of a piece of wall whose centre is so high above the ground.

    Of n masses: the weights of a mixture go into `motions`, see `floor_motions.motion_columns`.
    """
    ratio = height_m / building_height_m
    storey, weight = storey_of(ratio, n), weight_of(rule, ratio, n)
    if weight == 1.0:
        return floor_motion(storey + 1)
    name = f"middle of storey {storey + 1}" if rule == "middle" else f"at {height_m:.4f} m"
    motions[name] = {floor_motion(storey): 1.0 - weight, floor_motion(storey + 1): weight}
    return name
