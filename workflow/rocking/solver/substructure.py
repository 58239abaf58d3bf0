"""What carries the supports and feels the block: masses of a chain, or modes of a building."""

from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined
from yade_scripts.model.storeys import NO_STOREYS, StoreyRules

from .storeys import MEMORY, SHEAR, WORK, less
from .vectors import alone, like, lone, put, some, take


class Bodies(NamedTuple):
    """Coordinates that carry the supports: M ü + C u̇ + K u = −M r a_g + Hᵀ·forces and moments.

    They are the masses of a chain, or the modes of a building. Supports move by H u. Storeys of a
    chain may yield: what that takes off K u is Bᵀ r, with B u their drifts.
    """

    mass_kg: np.ndarray  # (n,) without masses the supports are driven
    k_n_m: np.ndarray  # (n, n)
    c_n_s_m: np.ndarray
    hang: np.ndarray  # (supports, n) H along y
    lift: np.ndarray  # along z; without rows where supports only move along y
    roll: np.ndarray  # about x; without rows where they do not turn
    ground: np.ndarray  # (n,) r: motion when everything moves by one with the ground
    moves: tuple  # hang, lift and roll transposed: a loop over the supports runs along them
    band: int  # how far from the diagonal the matrices have entries: modes have none beside it
    carriers: np.ndarray  # (supports, 2), int: from which to before which coordinate H has entries
    carried: np.ndarray  # (n, 2), int: the same by coordinates
    storeys: StoreyRules  # of a chain whose masses are the coordinates; none: K holds at any drift


CHAIN = 5  # a chain has no more masses; modes are more
_NONE, _NO_ENDS = np.zeros((0, 0)), np.zeros((0, 2), np.int64)
NO_BODIES = Bodies(
    np.zeros(0), *(_NONE,) * 5, np.zeros(0), (_NONE,) * 3, 0, _NO_ENDS, _NO_ENDS, NO_STOREYS
)


def bodies(mass_kg, stiffness_n_m, damping_n_s_m, hang=None, lift=None, roll=None, ground=None):
    """Masses that carry the supports and feel the block (see `Bodies`).

    Parameters
    ----------
    mass_kg, stiffness_n_m, damping_n_s_m, ground : array_like
        Of the masses from the bottom up; without `ground` it moves all of them by one.
    hang, lift, roll : array_like, shape (m, n), or None
        In the order of `moving_supports(scene)`; without `hang` support i moves with mass i.

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
    moves = tuple(np.ascontiguousarray(rows.T) for rows in (hang, lift, roll))
    i, j = np.nonzero((k != 0.0) | (c != 0.0))
    band, has = int(abs(i - j).max(initial=0)), hang != 0.0
    for rows in (lift, roll):
        has |= (rows != 0.0) if len(rows) else False
    ends = _ends(has), _ends(has.T)
    return Bodies(m, k, c, hang, lift, roll, ground, moves, band, *ends, NO_STOREYS)


def _ends(rows):
    """From which to before which column each row is true, shape (rows, 2)."""
    columns = [np.flatnonzero(row) for row in rows]
    return np.array([(at[0], at[-1] + 1) if at.size else (0, 0) for at in columns]).reshape(-1, 2)


class Ride(NamedTuple):
    """How the carriers move, in rows."""

    u: np.ndarray
    v: np.ndarray  # half a step back
    w: np.ndarray  # velocity now
    a: np.ndarray
    force: np.ndarray  # of the block
    storeys: np.ndarray  # what storeys remember


@inlined
def rows_of(bodies):
    """How many rows `Ride` has."""
    return 5 * bodies.mass_kg.size + MEMORY * bodies.storeys.k_n_m.size


@inlined
def riding(bodies, rows):
    """`Ride` in `rows_of` rows."""
    n = bodies.mass_kg.size
    return Ride(
        *(rows[:n], rows[n : 2 * n], rows[2 * n : 3 * n], rows[3 * n : 4 * n]),
        *(rows[4 * n : 5 * n], rows[5 * n :]),
    )


@inlined
def _move(shape, moves, carriers, ride, past_s, place, speed, way):
    """Supports by H u along or about one axis; `moves` is H transposed, `carriers` of `Bodies`."""
    if alone(take(ride.u, 0)) and shape.shape[1] > CHAIN:  # along the supports, as vectors
        for j in range(shape.shape[0]):
            put(place, j, 0.0)
            put(speed, j, 0.0)
            put(way, j, 0.0)
        for i in range(shape.shape[1]):
            u, w, du = take(ride.u, i), take(ride.w, i), past_s * take(ride.v, i)
            for j in range(shape.shape[0]):
                put(place, j, take(place, j) + moves[i, j] * u)
                put(speed, j, take(speed, j) + moves[i, j] * w)
                put(way, j, take(way, j) + moves[i, j] * du)
        return
    for j in range(shape.shape[0]):
        y = v = dy = like(0.0, take(ride.u, 0))
        for i in range(carriers[j, 0], carriers[j, 1]):
            y += shape[j, i] * take(ride.u, i)
            v += shape[j, i] * take(ride.w, i)
            dy += shape[j, i] * (past_s * take(ride.v, i))
        put(place, j, y)
        put(speed, j, v)
        put(way, j, dy)


@inlined
def carry(bodies, ride, half_s, past_s, supports):
    """Move the supports with what carries them, velocities predicted for this step."""
    for i in range(bodies.mass_kg.size):
        put(ride.w, i, take(ride.v, i) + half_s * take(ride.a, i))
    (hang, lift, roll), ends = bodies.moves, bodies.carriers
    _move(bodies.hang, hang, ends, ride, past_s, supports.y, supports.vy, supports.dy)
    if lift.size > 0:
        _move(bodies.lift, lift, ends, ride, past_s, supports.z, supports.vz, supports.dz)
    if roll.size > 0:
        turns = supports.turn, supports.spin, supports.dturn
        _move(bodies.roll, roll, ends, ride, past_s, *turns)


@inlined
def _collect(shape, force, onto):
    """Forces of the coordinates by Hᵀ·force of one support."""
    for j in range(shape.size):
        put(onto, j, take(onto, j) + shape[j] * force)


@inlined
def accelerate(bodies, ride, supports, ground_m_s2, quiet_m_s2):
    """Accelerations of the carriers; whether one still feels more than `quiet_m_s2`."""
    n, lifted, turned = bodies.mass_kg.size, bodies.lift.size > 0, bodies.roll.size > 0
    shaken = like(False, quiet_m_s2)
    for j in range(n):
        force = like(0.0, quiet_m_s2)
        if not lifted:
            for i in range(bodies.carried[j, 0], bodies.carried[j, 1]):
                force += bodies.hang[i, j] * take(supports.fy, i)
        put(ride.force, j, force)
    for i in range(bodies.hang.shape[0] if lifted else 0):
        fy, fz, moment = take(supports.fy, i), take(supports.fz, i), take(supports.moment, i)
        if some((abs(fy) > 0.0) | (abs(fz) > 0.0)):  # few ends of a building touch
            _collect(bodies.hang[i], fy, ride.force)
            _collect(bodies.lift[i], fz, ride.force)
            if turned:
                _collect(bodies.roll[i], moment, ride.force)
    if bodies.storeys.k_n_m.size > 0:
        _yield(bodies, ride)
    for j in range(n):
        pull = take(ride.force, j)
        for i in range(max(0, j - bodies.band), min(n, j + bodies.band + 1)):
            pull -= bodies.k_n_m[j, i] * take(ride.u, i) + bodies.c_n_s_m[j, i] * take(ride.w, i)
        # what it feels itself is its acceleration with the ground's
        rise = pull / bodies.mass_kg[j] - bodies.ground[j] * ground_m_s2
        put(ride.a, j, rise)
        shaken = shaken | (abs(rise + bodies.ground[j] * ground_m_s2) > quiet_m_s2)
    return shaken


@inlined
def _yield(bodies, ride):
    """Give the masses what yielding takes off the springs below and above them."""
    storeys, n = bodies.storeys, bodies.mass_kg.size
    under = like(0.0, take(ride.u, 0))
    for j in range(n):
        place = take(ride.u, j)
        taken_n = less(storeys, j, ride.storeys, MEMORY * j, place - under)
        put(ride.force, j, take(ride.force, j) + taken_n)
        if j > 0:
            put(ride.force, j - 1, take(ride.force, j - 1) - taken_n)
        under = place


@inlined
def held_by(bodies, ride):
    """Energy that springs store, and that their yielding has taken [J]; of one history."""
    held = taken = 0.0
    n, storeys = bodies.mass_kg.size, bodies.storeys
    for j in range(storeys.k_n_m.size):
        shear = lone(take(ride.storeys, MEMORY * j + SHEAR))
        stored = 0.5 * shear * shear / storeys.k_n_m[j]
        held, taken = held + stored, taken + lone(take(ride.storeys, MEMORY * j + WORK)) - stored
    for j in range(n if storeys.k_n_m.size == 0 else 0):
        for i in range(n):
            held += 0.5 * bodies.k_n_m[j, i] * lone(take(ride.u, j)) * lone(take(ride.u, i))
    return held, taken


@inlined
def travel(ride, ahead_s, step_s):
    """Move the carriers on by a step."""
    for j in range(len(ride.u)):
        speed = take(ride.v, j) + ahead_s * take(ride.a, j)
        put(ride.v, j, speed)
        put(ride.u, j, take(ride.u, j) + step_s * speed)
