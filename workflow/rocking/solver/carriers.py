"""What carries the supports and feels the block: masses of a chain, or modes of a building."""

from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled, inlined


class Bodies(NamedTuple):
    """Coordinates that carry the supports: M ü + C u̇ + K u = −M r a_g + Hᵀ·forces and moments.

    They are the masses of a chain, or the modes of a building. Supports move by H u.

    Attributes
    ----------
    mass_kg : ndarray, shape (n,)
        Without masses the supports are driven.
    k_n_m, c_n_s_m : ndarray, shape (n, n)
    hang, lift, roll : ndarray, shape (supports, n)
        H: what each coordinate adds to a support's motion along y, along z, and to its rotation
        about x; `lift` and `roll` without rows where supports only move along y, or do not turn.
    ground : ndarray, shape (n,)
        r: motion of the coordinates when everything moves by one with the ground.
    """

    mass_kg: np.ndarray
    k_n_m: np.ndarray
    c_n_s_m: np.ndarray
    hang: np.ndarray
    lift: np.ndarray
    roll: np.ndarray
    ground: np.ndarray


_NONE = np.zeros((0, 0))
NO_BODIES = Bodies(np.zeros(0), _NONE, _NONE, _NONE, _NONE, _NONE, np.zeros(0))


def bodies(mass_kg, stiffness_n_m, damping_n_s_m, hang=None, lift=None, roll=None, ground=None):
    """Masses that carry the supports and feel the block (see `Bodies`).

    Parameters
    ----------
    mass_kg : array_like, shape (n,)
        From the bottom up.
    stiffness_n_m, damping_n_s_m : array_like, shape (n, n)
    hang : array_like, shape (m, n), or None
        Motion of each support along y, in the order of `moving_supports(scene)`; None: support i
        moves with mass i.
    lift, roll : array_like, shape (m, n), or None
        The same along z, and rotation about x; None: none.
    ground : array_like, shape (n,), or None
        None: masses, which the ground moves by one.

    Raises
    ------
    ValueError
        If shapes differ or a mass is not positive.
    """
    m, k, c = (np.array(v, float, order="C") for v in (mass_kg, stiffness_n_m, damping_n_s_m))
    if m.ndim != 1 or k.shape != (m.size,) * 2 or c.shape != k.shape or not np.all(m > 0.0):
        raise ValueError("bodies: expected n positive masses and two matrices of shape (n, n)")
    hang = np.eye(m.size) if hang is None else np.array(hang, float, order="C")
    lift, roll = (
        np.zeros((0, m.size)) if rows is None else np.array(rows, float, order="C")
        for rows in (lift, roll)
    )
    ground = np.ones(m.size) if ground is None else np.array(ground, float)
    shapes = ((0, m.size), hang.shape)
    if (
        hang.ndim != 2
        or hang.shape[1] != m.size
        or lift.shape not in shapes
        or roll.shape not in shapes
        or len(ground) != m.size
    ):
        raise ValueError(
            f"bodies: expected {m.size} columns of hang, lift and roll, rows of ground"
        )
    return Bodies(m, k, c, hang, lift, roll, ground)


class Ride(NamedTuple):
    """How the carriers move, and their matrices as the loop reads them.

    Attributes
    ----------
    hang, lift, roll : ndarray, shape (n, supports)
        Transposed, so that the inner loop over the supports runs in parallel lanes.
    u, v, w, a, force : ndarray, shape (n,)
        Displacement, velocity half a step back and now, acceleration, forces of the block.
    band : int
        How far from the diagonal their matrices have entries: modes have none beside it.
    """

    hang: np.ndarray
    lift: np.ndarray
    roll: np.ndarray
    u: np.ndarray
    v: np.ndarray
    w: np.ndarray
    a: np.ndarray
    force: np.ndarray
    band: int


@compiled
def at_rest(bodies):
    """Carriers before the motion."""
    n, band = bodies.mass_kg.size, 0
    for i in range(n):
        for j in range(n):
            if bodies.k_n_m[i, j] != 0.0 or bodies.c_n_s_m[i, j] != 0.0:
                band = max(band, abs(i - j))
    return Ride(
        np.ascontiguousarray(bodies.hang.T),
        np.ascontiguousarray(bodies.lift.T),
        np.ascontiguousarray(bodies.roll.T),
        *(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)),
        band,
    )


@inlined
def _move(shape, ride, past_s, place, speed, way):
    """Supports by H u along or about one axis."""
    place[:] = 0.0
    speed[:] = 0.0
    way[:] = 0.0
    for i in range(shape.shape[0]):
        u, w, du = ride.u[i], ride.w[i], past_s * ride.v[i]
        for j in range(shape.shape[1]):
            place[j] += shape[i, j] * u
            speed[j] += shape[i, j] * w
            way[j] += shape[i, j] * du


@inlined
def carry(ride, half_s, past_s, supports):
    """Move the supports with what carries them, velocities predicted for this step."""
    for i in range(ride.u.size):
        ride.w[i] = ride.v[i] + half_s * ride.a[i]
    _move(ride.hang, ride, past_s, supports.y, supports.vy, supports.dy)
    if ride.lift.size > 0:
        _move(ride.lift, ride, past_s, supports.z, supports.vz, supports.dz)
    if ride.roll.size > 0:
        _move(ride.roll, ride, past_s, supports.turn, supports.spin, supports.dturn)


@inlined
def accelerate(bodies, ride, supports, ground_m_s2, quiet_m_s2):
    """Accelerations of the carriers; whether one still feels more than `quiet_m_s2`."""
    n, shaken = ride.u.size, False
    lifted, turned = ride.lift.size > 0, ride.roll.size > 0
    ride.force[:] = 0.0
    for i in range(ride.hang.shape[1]):
        if supports.fy[i] != 0.0 or supports.fz[i] != 0.0:
            for j in range(n):
                ride.force[j] += bodies.hang[i, j] * supports.fy[i]
            if lifted:
                for j in range(n):
                    ride.force[j] += bodies.lift[i, j] * supports.fz[i]
            if turned:
                for j in range(n):
                    ride.force[j] += bodies.roll[i, j] * supports.moment[i]
    for j in range(n):
        pull = ride.force[j]
        for i in range(max(0, j - ride.band), min(n, j + ride.band + 1)):
            pull -= bodies.k_n_m[j, i] * ride.u[i] + bodies.c_n_s_m[j, i] * ride.w[i]
        ride.a[j] = pull / bodies.mass_kg[j] - bodies.ground[j] * ground_m_s2
        shaken = shaken or abs(ride.a[j] + bodies.ground[j] * ground_m_s2) > quiet_m_s2
    return shaken


@inlined
def travel(ride, ahead_s, step_s):
    """Move the carriers on by a step."""
    for j in range(ride.u.size):
        ride.v[j] += ahead_s * ride.a[j]
        ride.u[j] += step_s * ride.v[j]
