"""Scenes of a block that stands on corners of its own outline, for every solver.

A corner is a node: it presses with kn times its depth and β·kn times the rate of it, and never
pulls. An impact on one corner ends without a rebound of its own where β is large, and conserves the
moment of momentum about it, which is Housner's condition: the restitution of rocking follows from
where the corners are, and no value of it is stated.
"""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize

from studies.overturning.geometry import STEEPEST_RAD, barrier
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.scene import DOFS, Block, Interface, NodeList, Scene
from yade_scripts.model.stiffness import critical_step

BLOCK, TABLE = "block", "table"
ARM_M = 10.0  # above the centre of mass: what is watched there moves by tilt and hardly by sliding
NUMERICS = {
    "quiet_ratio": 0.02,  # of the motion's peak or of uplift
    "after_motion_s": 4.0,
    "overturn_ratio": 1.0,
    "rest_velocity_m_s": 1e-2,
    "rest_time_s": 0.5,
    "max_speed_ratio": 1e4,
}
AT_ONCE = 6  # corners that touch at a time, of those in space


class Standing(NamedTuple):
    """One draw of how a block stands.

    Attributes
    ----------
    corners_m : ndarray, shape (n, 2) or (n, 3)
        (y, z) or (x, y, z) from the centre of mass, z up; y is the direction of shaking.
    mass_kg : float
    inertia_kg_m2 : tuple
        Principal moments along x, y, z.
    friction_rad : float
    contact_n_m : float
        kn of every corner.
    beta_s : float
    fallen_rad : float
        Tilt from which the block has fallen.
    """

    corners_m: np.ndarray
    mass_kg: float
    inertia_kg_m2: tuple
    friction_rad: float
    contact_n_m: float
    beta_s: float
    fallen_rad: float


def fallen_tilt(chain):
    """Tilt of the higher of the two barriers: whoever leans farther falls to either side [rad]."""
    return min(max(barrier(chain, side)[1] for side in (1, -1)), STEEPEST_RAD)


def rest_pose(standing):
    """Sinking [m] and rotation about x [rad] at rest: least of Σ kn δ²/2 + m g z, in the plane."""
    y, z = standing.corners_m[:, -2:].T
    weight = standing.mass_kg * STANDARD_GRAVITY_M_S2
    scale = weight / standing.contact_n_m
    low = z.min()

    def energy(x):
        sunk, turn = x[0] * scale, x[1] * scale / np.abs(y).max()
        depth = np.maximum(sunk - (z - low) - turn * y, 0.0)
        lift = -low * (math.cos(turn) - 1.0)  # of the centre of mass about what it stands on
        force = standing.contact_n_m * depth
        value = 0.5 * force @ depth + weight * (lift - sunk)
        slope = force.sum() - weight, -(force @ y) + weight * low * math.sin(turn)
        unit = weight * scale
        return value / unit, np.array(
            [slope[0] * scale / unit, slope[1] * scale / np.abs(y).max() / unit]
        )

    least = minimize(energy, [1.0, 0.0], jac=True, method="BFGS", options={"gtol": 1e-10})
    return float(least.x[0] * scale), float(least.x[1] * scale / np.abs(y).max())


def scene(standing):
    """`Scene` of a block on a table: in the plane for corners (y, z), else with six freedoms."""
    corners = np.asarray(standing.corners_m, float)
    planar = corners.shape[1] == 2
    if planar:
        corners = np.column_stack([np.zeros(len(corners)), corners])
    height = -corners[:, 2].min()
    places = corners + np.array([0.0, 0.0, height])
    sunk, turn = rest_pose(standing) if planar else (settled(standing), 0.0)
    size = tuple(2.0 * np.abs(corners).max(axis=0).clip(0.05))
    blocks = [
        Block(TABLE, (0.0, 0.0, -0.5), (4.0, 4.0, 1.0), 1.0, (1.0,) * 3, free="", motion=GROUND),
        Block(
            BLOCK,
            (0.0, 0.0, height),
            size,
            standing.mass_kg,
            standing.inertia_kg_m2,
            free="yzX" if planar else DOFS,
            displacement_m=(0.0, 0.0, -sunk),
            rotation_rad=(turn, 0.0, 0.0),
        ),
    ]
    nodes = NodeList()
    for number, place in enumerate(places):
        nodes.add_joint(
            f"corner {number}",
            *(1, 0),
            place,
            (0.0, 0.0, 1.0),
            1.0,
            Interface(
                standing.contact_n_m,
                standing.contact_n_m,
                beta_s=standing.beta_s,
                friction_rad=standing.friction_rad,
                gap_m=place[2],
            ),
        )
    return Scene(
        blocks,
        nodes.joints,
        nodes.done(),
        monitor=BLOCK,
        monitor_point_m=(0.0, 0.0, height + ARM_M),
        reference=TABLE,
        thickness_m=ARM_M * math.sin(standing.fallen_rad),
        gravity_m_s2=STANDARD_GRAVITY_M_S2,
    )


def settled(standing):
    """Sinking of a block in space whose lowest three corners or more bear alike [m]."""
    z = standing.corners_m[:, 2]
    weight = standing.mass_kg * STANDARD_GRAVITY_M_S2
    bears = np.count_nonzero(z < z.min() + 1e-6)
    return weight / (standing.contact_n_m * max(bears, 1))


def beta(mass_kg, contact_n_m, damping):
    """β [s] of a corner whose dashpot is a share of critical under the whole mass, 2ζ√(m/kn)."""
    return 2.0 * damping * math.sqrt(mass_kg / contact_n_m)


def with_step(made):
    """The scene with its critical step noted: of its lowest corners, for no others touch at once.

    Of all of them at once, which no pose closes, it would be a tenth of that.
    """
    lowest = np.argsort(made.nodes.position_m[:, 2], kind="stable")[:AT_ONCE]
    few = replace(made, nodes=made.nodes.select(np.sort(lowest)))
    return replace(made, notes={**made.notes, "critical_step_s": critical_step(few)})
