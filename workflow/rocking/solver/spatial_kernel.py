"""The compiled step loop of a block in three dimensions, see `spatial`."""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled, inlined, looped

from .inputs import drive, verdict
from .law import rub, since_closed

COLUMNS = 13


class Spatial(NamedTuple):
    """The block and its nodes.

    Attributes
    ----------
    first : ndarray of int, shape (lines + 1,)
        Line i, straight and against one plane, has the nodes first[i]:first[i + 1].
    arm_m, normal : ndarray, shape (n, 3)
        Of a node from the reference centroid; from the support into the block.
    level_m : ndarray, shape (n,)
        The plane: points with normal·r = level, from the reference centroid.
    support : ndarray of int, shape (n,)
        Column of its support's motion; −1: it moves with the reference.
    kn_n_m, ks_n_m, beta_s, friction : ndarray, shape (n,)
        Stiffnesses, dashpots over them, tan φ.
    inertia_kg_m2 : ndarray, shape (3,)
        About axes that turn with the block.
    place_m, turn : ndarray, shape (3,), (4,)
        Centroid from its reference place and quaternion (w, x, y, z) at the start.
    monitor_m : ndarray, shape (3,)
    mass_kg, gravity_m_s2, thickness_m, step_s : float
    """

    first: np.ndarray
    arm_m: np.ndarray
    normal: np.ndarray
    level_m: np.ndarray
    support: np.ndarray
    kn_n_m: np.ndarray
    ks_n_m: np.ndarray
    beta_s: np.ndarray
    friction: np.ndarray
    inertia_kg_m2: np.ndarray
    place_m: np.ndarray
    turn: np.ndarray
    monitor_m: np.ndarray
    mass_kg: float
    gravity_m_s2: float
    thickness_m: float
    step_s: float


@inlined
def _rotation(q, out):
    w, x, y, z = q
    out[0, 0] = 1 - 2 * (y * y + z * z)
    out[0, 1] = 2 * (x * y - z * w)
    out[0, 2] = 2 * (x * z + y * w)
    out[1, 0] = 2 * (x * y + z * w)
    out[1, 1] = 1 - 2 * (x * x + z * z)
    out[1, 2] = 2 * (y * z - x * w)
    out[2, 0] = 2 * (x * z - y * w)
    out[2, 1] = 2 * (y * z + x * w)
    out[2, 2] = 1 - 2 * (x * x + y * y)


@inlined
def _spin(r, inertia, momentum, out):
    """ω = R J⁻¹ Rᵀ L."""
    for i in range(3):
        out[i] = 0.0
    for k in range(3):
        own = r[0, k] * momentum[0] + r[1, k] * momentum[1] + r[2, k] * momentum[2]
        for i in range(3):
            out[i] += r[i, k] * own / inertia[k]


@inlined
def _turned(q, spin, dt, out):
    """Quaternion after a turn by ω dt, in the frame of the ground."""
    size = math.sqrt(spin[0] ** 2 + spin[1] ** 2 + spin[2] ** 2)
    half = 0.5 * dt * size
    c, s = math.cos(half), 0.5 * dt
    if half > 1e-9:
        s = math.sin(half) / size
    x, y, z = s * spin[0], s * spin[1], s * spin[2]
    w0, x0, y0, z0 = q
    out[0] = c * w0 - x * x0 - y * y0 - z * z0
    out[1] = c * x0 + x * w0 + y * z0 - z * y0
    out[2] = c * y0 + y * w0 + z * x0 - x * z0
    out[3] = c * z0 + z * w0 + x * y0 - y * x0


@compiled
def roll(q, momentum, inertia, dt, spin, matrix, other):
    """Turn the pose q by a step under its angular momentum, in place; the rest is room to work.

    ω = R J⁻¹ Rᵀ L is that of the pose in the middle of the step: second order, and a free
    body keeps its momentum exactly.
    """
    _rotation(q, matrix)
    _spin(matrix, inertia, momentum, spin)
    _turned(q, spin, 0.5 * dt, other)
    _rotation(other, matrix)
    _spin(matrix, inertia, momentum, spin)
    _turned(q, spin, dt, other)
    size = math.sqrt(other[0] ** 2 + other[1] ** 2 + other[2] ** 2 + other[3] ** 2)
    for m in range(4):
        q[m] = other[m] / size


class SpatialState(NamedTuple):
    """How the block and its supports move, and what its nodes remember.

    Attributes
    ----------
    x, q : ndarray, shape (3,), (4,)
        Centroid from its reference place, quaternion (w, x, y, z).
    v, momentum : ndarray, shape (3,)
        Velocity and angular momentum half a step back.
    a, torque : ndarray, shape (3,)
        Acceleration, and what turned it, at the last step.
    turn, spin : ndarray, shape (3, 3), (3,)
        Rotation matrix; angular velocity half a step back.
    now_v, now_spin : ndarray, shape (3,)
        Predicted for this step.
    u, us, du : ndarray, shape (2, supports + 1)
        Place, velocity and last way of the supports along x and y.
    slip, closed : ndarray, shape (nodes, 3), (nodes,)
    touching : ndarray of int, shape (lines,)
        Nodes of each line at the last step.
    """

    x: np.ndarray
    q: np.ndarray
    v: np.ndarray
    momentum: np.ndarray
    a: np.ndarray
    torque: np.ndarray
    turn: np.ndarray
    spin: np.ndarray
    now_v: np.ndarray
    now_spin: np.ndarray
    u: np.ndarray
    us: np.ndarray
    du: np.ndarray
    slip: np.ndarray
    closed: np.ndarray
    touching: np.ndarray


def at_rest(p, supports):
    """The block before its motion, and room for a step."""
    nodes, moving = p.level_m.size, supports + 1
    x, q, turn = p.place_m.copy(), p.turn.copy(), np.zeros((3, 3))
    v, momentum, a, torque = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    u, us, du = np.zeros((2, moving)), np.zeros((2, moving)), np.zeros((2, moving))
    slip, closed = np.zeros((nodes, 3)), np.zeros(nodes, np.bool_)
    touching = np.zeros(p.first.size - 1, np.int64)
    spin, now_v, now_spin = np.zeros(3), np.zeros(3), np.zeros(3)
    rates = v, momentum, a, torque, turn, spin, now_v, now_spin
    motion = SpatialState(x, q, *rates, u, us, du, slip, closed, touching)
    return motion, (np.zeros(3), np.zeros((4, 3)), np.zeros((3, 3)), np.zeros(4))


@inlined
def _predict(p, m, half, ahead_l):
    """Rotation, angular velocity half a step back, and rates at the whole step."""
    _rotation(m.q, m.turn)
    _spin(m.turn, p.inertia_kg_m2, m.momentum, m.spin)
    for i in range(3):
        m.now_v[i] = m.v[i] + half * m.a[i]
        ahead_l[i] = m.momentum[i] + half * m.torque[i]
    _spin(m.turn, p.inertia_kg_m2, ahead_l, m.now_spin)


@inlined
def _gap(p, m, i, r):
    """Penetration of node i; its arm into r."""
    for k in range(3):
        r[k] = m.turn[k, 0] * p.arm_m[i, 0] + m.turn[k, 1] * p.arm_m[i, 1]
        r[k] += m.turn[k, 2] * p.arm_m[i, 2]
    j = p.support[i]
    depth = p.level_m[i] - p.normal[i, 0] * (m.x[0] + r[0] - m.u[0, j])
    return depth - (p.normal[i, 1] * (m.x[1] + r[1] - m.u[1, j]) + p.normal[i, 2] * (m.x[2] + r[2]))


@inlined
def _past(v, spin, r, other, j, scale, out):
    """Way of a node past its plane at these rates."""
    out[0] = scale * (v[0] + spin[1] * r[2] - spin[2] * r[1]) - other[0, j]
    out[1] = scale * (v[1] + spin[2] * r[0] - spin[0] * r[2]) - other[1, j]
    out[2] = scale * (v[2] + spin[0] * r[1] - spin[1] * r[0])


@inlined
def _node(p, m, i, depth, r, past, dt, rel, step, force):
    """Force of a node that touches its plane, by the law of `law.dry` with slip as a vector.

    Returns energy stored and taken.
    """
    normal, slip, j = p.normal[i], m.slip[i], p.support[i]
    kn, ks, beta = p.kn_n_m[i], p.ks_n_m[i], p.beta_s[i]
    ratio = ks / kn
    _past(m.now_v, m.now_spin, r, m.us, j, 1.0, rel)
    _past(m.v, m.spin, r, m.du, j, past, step)
    rate = -(normal[0] * rel[0] + normal[1] * rel[1] + normal[2] * rel[2])
    across = normal[0] * step[0] + normal[1] * step[1] + normal[2] * step[2]
    share, part, size, before = 1.0, 1.0, 0.0, 0.0
    if not m.closed[i] and rate > 0.0 and past > 0.0:
        share, part = since_closed(depth, rate, dt)
    m.closed[i] = True
    for k in range(3):
        before += slip[k] ** 2
        slip[k] += part * (step[k] - across * normal[k])
        rel[k] += rate * normal[k]  # what is left lies in the joint's plane
        size += slip[k] ** 2
    size = math.sqrt(size)
    pressed = max(depth + beta * rate, 0.0)
    _, kept, taken, sticks = rub(size, pressed, ratio, p.friction[i], math.sqrt(before))
    drag, square, stored = beta if sticks else 0.0, 0.0, depth * depth + ratio * kept * kept
    for k in range(3):
        if not sticks:
            slip[k] *= kept / size
        step[k] = ratio * (slip[k] + drag * rel[k])  # spring and dashpot together
        square += step[k] ** 2
    most, power = p.friction[i] * pressed, (pressed - depth) * rate
    held = most / math.sqrt(square) if square > most * most else 1.0
    for k in range(3):
        step[k] *= held
        force[k] = share * kn * (pressed * normal[k] - step[k])
        power += (step[k] - ratio * slip[k]) * rel[k]
    return 0.5 * kn * stored, kn * (taken + share * dt * power)


@inlined
def _opened(p, m, i):
    """Forget the slip of a node that does not touch; what it loses."""
    lost = 0.0
    if m.closed[i]:
        for k in range(3):
            lost += 0.5 * p.ks_n_m[i] * m.slip[i, k] ** 2
            m.slip[i, k] = 0.0
        m.closed[i] = False
    return lost


@inlined
def _contact(p, m, past, dt, force, room):
    """Forces and torque of all nodes into `force` and m.torque.

    Returns energy stored, taken, and the power of the supports; `room`: four vectors to work in.
    """
    elastic = spent = power = 0.0
    r, rel, step, one = room[0], room[1], room[2], room[3]
    for g in range(p.first.size - 1):
        low, high = p.first[g], p.first[g + 1]
        if m.touching[g] == 0 and _gap(p, m, low, r) <= 0.0 and _gap(p, m, high - 1, r) <= 0.0:
            continue  # penetration is linear along the line
        m.touching[g] = 0
        for i in range(low, high):
            depth = _gap(p, m, i, r)
            if depth <= 0.0:
                spent += _opened(p, m, i)
                continue
            stored, taken = _node(p, m, i, depth, r, past, dt, rel, step, one)
            elastic, spent = elastic + stored, spent + taken
            m.touching[g] += 1
            power += one[0] * m.us[0, p.support[i]] + one[1] * m.us[1, p.support[i]]
            for k in range(3):
                force[k] += one[k]
            m.torque[0] += r[1] * one[2] - r[2] * one[1]
            m.torque[1] += r[2] * one[0] - r[0] * one[2]
            m.torque[2] += r[0] * one[1] - r[1] * one[0]
    return elastic, spent, power


@inlined
def _kinetic(p, m, half, room):
    """Kinetic energy at the whole step [J]."""
    energy, ahead_l, spin = 0.0, room[0], room[1]
    for k in range(3):
        energy += 0.5 * p.mass_kg * (m.v[k] + half * m.a[k]) ** 2
        ahead_l[k] = m.momentum[k] + half * m.torque[k]
    _spin(m.turn, p.inertia_kg_m2, ahead_l, spin)
    for k in range(3):
        energy += 0.5 * ahead_l[k] * spin[k]
    return energy


@looped
def march_spatial(p, start, across, beside, factor, rules, motion_s, max_speed_m_s, every, rows):
    """Advance one history until a rule ends it.

    Parameters
    ----------
    p : Spatial
    start : tuple
        See `at_rest`.
    across, beside : SteppedMotion
        Motions along y and x; the vertical one with the first.
    factor : float
        On both; its size on the vertical one, which a half turn of the building leaves as it is.
    rules : Rules
    motion_s, max_speed_m_s : float
        End of the motion that matters; speed from which the run has failed.
    every, rows : int, ndarray (n, COLUMNS)
        Every so many steps a row is written while rows last: time, d, its rate, x, y, z of the
        centroid, rotations about x and z, then kinetic, potential, elastic energy, what
        dashpots and friction have taken, and the work of supports and inertia [J].

    Returns
    -------
    peak_m, status, time_s, written, twist_rad, slid_m
        Largest |d|; largest rotation about z, and displacement of the centroid along x.
    """
    dt, last = across.step_s, across.ground_m_s2.size - 1
    m, (force, room, middle, other) = start
    peak = twist = slid = spent = work = moving_until = time = 0.0
    written, k = 0, 0
    while True:
        half, past = (0.5 * dt, dt) if k > 0 else (0.0, 0.0)
        row = min(k, last)
        ax, ay = factor * beside.ground_m_s2[row], factor * across.ground_m_s2[row]
        az = abs(factor) * across.vertical_m_s2[row]
        drive(beside, factor, k, past, m.u[0], m.us[0], m.du[0])
        drive(across, factor, k, past, m.u[1], m.us[1], m.du[1])
        _predict(p, m, half, room[0])
        for i in range(3):
            force[i] = m.torque[i] = 0.0
        elastic, taken, power = _contact(p, m, past, dt, force, room)
        spent += taken
        d = m.x[1] - p.monitor_m[1]
        arm0 = arm2 = 0.0
        for i in range(3):
            d += m.turn[1, i] * p.monitor_m[i]
            arm0 += m.turn[0, i] * p.monitor_m[i]
            arm2 += m.turn[2, i] * p.monitor_m[i]
        speed = m.now_v[1] + m.now_spin[2] * arm0 - m.now_spin[0] * arm2
        peak, slid = max(peak, abs(d)), max(slid, abs(m.x[0]))
        about_z = math.atan2(m.turn[1, 0], m.turn[0, 0])
        twist = max(twist, abs(about_z))
        m.a[0] = force[0] / p.mass_kg - ax
        m.a[1] = force[1] / p.mass_kg - ay
        m.a[2] = force[2] / p.mass_kg - p.gravity_m_s2 - az
        inertia = ax * m.now_v[0] + ay * m.now_v[1] + az * m.now_v[2]
        work += dt * (power - p.mass_kg * inertia)
        if k % every == 0 and written < rows.shape[0]:
            out = rows[written]
            out[0], out[1], out[2] = time, d, speed
            out[3], out[4], out[5] = m.x[0], m.x[1], m.x[2]
            out[6], out[7] = math.atan2(m.turn[2, 1], m.turn[2, 2]), about_z
            out[8], out[9] = _kinetic(p, m, half, room), p.mass_kg * p.gravity_m_s2 * m.x[2]
            out[10], out[11], out[12] = elastic, spent, work
            written += 1
        over, status, moving_until = verdict(
            rules, motion_s, max_speed_m_s, k, dt, d, speed, False, moving_until
        )
        if over:
            break
        ahead = dt if k > 0 else 0.5 * dt
        for i in range(3):
            m.v[i] += ahead * m.a[i]
            m.momentum[i] += ahead * m.torque[i]
            m.x[i] += dt * m.v[i]
        roll(m.q, m.momentum, p.inertia_kg_m2, dt, m.spin, middle, other)
        k += 1
        time = k * dt
    return peak, status, time, written, twist, slid
