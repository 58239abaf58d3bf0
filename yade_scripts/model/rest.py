"""Where a façade stands before it is shaken: how far it sinks into its base, and leans."""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.model.thrusts import leaning


class DoesNotStandError(ValueError):
    """A façade that falls by its own weight, before anything shakes it."""


def settlement(weight_n, kn_n_m, lift_m):
    """Settlement s at which the base nodes carry the weight, Σ kn·max(0, s − lift) = W [m].

    Piecewise linear and increasing in s: nodes come into contact in order of their lift.
    """
    order = np.argsort(lift_m)
    lift, kn = lift_m[order], kn_n_m[order]
    for closed in range(1, len(lift) + 1):
        settlement = (weight_n + kn[:closed] @ lift[:closed]) / kn[:closed].sum()
        if closed == len(lift) or settlement <= lift[closed]:
            return float(settlement)
    raise AssertionError("unreachable: the last node closes the loop")


def lean(weight, lever, kn_n_m, points, b, walls_stand):
    """Outward rotation at which a façade of eccentric weight rests on its base [rad].

    About the toe Σ F_i a_i cos φ = W (b_g cos φ − z_g sin φ), with a_i the nodes' places inward
    from it and (b_g, z_g) the lever of its weight and loads. Return walls hold what leans on them;
    DoesNotStandError where nothing holds it.
    """
    (arm, height), place = lever, (1.0 - points) * b

    def excess(angle):
        lift = place * math.sin(angle)
        force = kn_n_m * np.maximum(0.0, settlement(weight, kn_n_m, lift) - lift)
        about = arm * math.cos(angle) - height * math.sin(angle)
        return math.cos(angle) * (force @ place) - weight * about

    side = math.copysign(1.0, 0.5 * b - arm)
    if abs(arm - 0.5 * b) < 1e-9 * b or (side < 0.0 and walls_stand):
        return 0.0
    steps = side * math.atan2(arm, height) * np.linspace(0.0, 1.0, 201)
    balanced = [i for i, angle in enumerate(steps) if side * excess(angle) <= 0.0]
    if not balanced:
        raise DoesNotStandError(
            f"facade: weight and loads stand {arm:.3g} m from the front of the base and the façade "
            "does not stand on it; expected them nearer the middle"
        )
    low, high = steps[balanced[0] - 1], steps[balanced[0]]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if side * excess(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def at_rest(facade, shape, kn_n_m, points, release_ratio, walls_stand):
    """Displacement and rotation in which a façade starts: tilted, released or leaning, and settled.

    kn and places over the thickness from the back are those of the base's nodes. With a
    `release_ratio` θ₀/α of 0 it leans as its eccentric weight asks for, unless return walls hold
    it.
    """
    b = facade.thickness_m
    weight, lever = leaning(facade.floors, facade.thrusts, shape)
    angle = release_ratio * math.atan2(*shape.lever_m)
    if not (release_ratio or shape.hinges_m):
        angle = lean(weight, lever, kn_n_m, points, b, walls_stand)
    # lift of each base node in the pose turned about the toe; debris lies under a tilted base
    lift = (1.0 - points) * b * math.sin(angle)
    tilt = math.radians(facade.tilt_deg)
    return initial_pose(shape.lever_m, tilt + angle, settlement(weight, kn_n_m, lift))


def initial_pose(lever_m, angle, sunk_m):
    """Pose turned outward by `angle` about the front toe and settled; outward is about −x."""
    arm = np.array([-lever_m[0], lever_m[1]])  # toe → centroid, in (y, z)
    c, s = math.cos(angle), math.sin(angle)
    turned = np.array([c * arm[0] + s * arm[1], -s * arm[0] + c * arm[1]])
    dy, dz = turned - arm
    return (0.0, float(dy), float(dz - sunk_m)), (-angle, 0.0, 0.0)


def moved(lever_m, tilt_rad):
    """By how much a point at a lever from the toe, inward and up, moves as it leans (y, z) [m]."""
    return initial_pose(lever_m, tilt_rad, 0.0)[0][1:]


def held_as_it_leans(bars, facade):
    """Ties and floors that hold a leaning façade from where it stands; it leaned before."""
    tilt = math.radians(facade.tilt_deg)
    return [_from_there(bar, facade.thickness_m, tilt) for bar in bars] if tilt else bars


def _from_there(bar, toe_m, tilt):
    """A tie or a floor of a façade whose toe is at y = `toe_m`."""
    _, y, z = point = getattr(bar, "end_a_m", None) or bar.position_m
    out, up = moved((toe_m - y, z), tilt)
    if point is getattr(bar, "position_m", None):
        return replace(bar, from_m=out)
    longer = math.dist((point[0], y + out, z + up), bar.end_b_m) - bar.length_m
    return replace(bar, slack_m=bar.slack_m + longer)
