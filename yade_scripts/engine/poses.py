"""Rotations and vectors between numbers and YADE."""

import math

import numpy as np


def quaternion(turn):
    """YADE's quaternion of a rotation vector."""
    from yade.minieigenHP import Quaternion, Vector3

    angle = float(np.linalg.norm(turn))
    axis = Vector3(*(float(v) / angle for v in turn)) if angle else Vector3(1, 0, 0)
    return Quaternion(axis, angle)


def vector(values):
    """YADE's vector of three numbers."""
    from yade.minieigenHP import Vector3

    return Vector3(*(float(v) for v in values))


def rotation(quaternion):
    """Rotation matrix of a quaternion (x, y, z, w), by rows: nine floats."""
    x, y, z, w = quaternion
    return (
        *(1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        *(2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        *(2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )


def planar_turn(state, unturned):
    """Rotation of a free block about x [rad], for planar motion; `unturned` see `adapter.Built`."""
    q = state.ori * unturned
    sign = 1.0 if q[3] >= 0.0 else -1.0  # q and −q are the same rotation
    return 2.0 * math.atan2(sign * q[0], sign * q[3])
