"""Intermediate hinges: a façade of rigid pieces that stand on each other on compliant joints.

A joint between two pieces is the base's over again: Gauss–Lobatto nodes across the thickness that
both have there, on the width that openings leave, that take no tension; the base's friction, and
jkn = E/L with L half the height of the two pieces together; a jkn stated for the base is the base's
alone. A piece meets the return walls behind it alone.

Pieces start at rest: each settled under what stands on it, and leaning where that is off the middle
of a joint (`statics`).
"""

from dataclasses import replace

import numpy as np

from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.rest import initial_pose, moved


def hinge_stiffness(e_mpa, shape):
    """Joint stiffness jkn of each hinge from the lowest up [Pa/m]."""
    edges = np.array([0.0, *shape.hinges_m, shape.height_m])
    return e_mpa * 1e6 / (0.5 * (edges[2:] - edges[:-2]))


def pieces(floors, stiffness, shape, whole, tilt_rad=0.0):
    """Blocks of the pieces from the lowest up, at rest on each other as the whole on its base.

    `floors` are those of the façade, `stiffness` as of `hinge_stiffness`; the whole leans outward
    by `tilt_rad`, turned about its toe.
    """
    risen = moved(shape.lever_m, tilt_rad)[1]
    sunk, blocks = risen - whole.displacement_m[2], []
    joints = [shape.joint_at(z) for z in shape.hinges_m]
    areas = np.array([(y1 - y0) * (shape.width_m - lost) for y0, y1, lost in joints])
    settling = [0.0, *(1.0 / (areas * stiffness))]
    parts = shape.pieces
    for k, (mass, centre, tensor, size) in enumerate(parts):
        rows = [row for row in floors if shape.piece_at(row.height_m) >= k]
        above = GRAVITY_M_S2 * sum(part[0] for part in parts[k:])
        sunk += settling[k] * sum([above, *(row.load_n for row in rows)])
        lever = shape.thickness_m - centre[1], centre[2]
        place, turned = initial_pose(lever, tilt_rad, sunk)
        blocks.append(
            replace(
                whole,
                name=f"{whole.name} {k + 1}",
                centre_m=tuple(centre.tolist()),
                size_m=size,
                mass_kg=mass,
                inertia_kg_m2=tuple(np.diag(tensor).tolist()),
                displacement_m=place,
                rotation_rad=turned,
                lever_m=None,
            )
        )
    return blocks
