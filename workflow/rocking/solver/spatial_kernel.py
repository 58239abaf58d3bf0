"""The compiled step loop of a block in three dimensions, see `spatial`."""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled

from .inputs import drive, since_closed, verdict

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


@compiled
def _rotation(q, out):
    w, x, y, z = q
    out[0, 0], out[0, 1], out[0, 2] = (
        1 - 2 * (y * y + z * z),
        2 * (x * y - z * w),
        2 * (x * z + y * w),
    )
    out[1, 0], out[1, 1], out[1, 2] = (
        2 * (x * y + z * w),
        1 - 2 * (x * x + z * z),
        2 * (y * z - x * w),
    )
    out[2, 0], out[2, 1], out[2, 2] = (
        2 * (x * z - y * w),
        2 * (y * z + x * w),
        1 - 2 * (x * x + y * y),
    )


@compiled
def _spin(r, inertia, momentum, out):
    """ω = R J⁻¹ Rᵀ L."""
    for i in range(3):
        out[i] = 0.0
    for k in range(3):
        own = r[0, k] * momentum[0] + r[1, k] * momentum[1] + r[2, k] * momentum[2]
        for i in range(3):
            out[i] += r[i, k] * own / inertia[k]


@compiled
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


@compiled
def _open(p, i, turn, x, us):
    """Whether node i does not touch its plane."""
    j, depth = p.support[i], p.level_m[i]
    for m in range(3):
        place = x[m] - (us[m, j] if m < 2 else 0.0)
        for n in range(3):
            place += turn[m, n] * p.arm_m[i, n]
        depth -= p.normal[i, m] * place
    return depth <= 0.0


@compiled
def march(p, across, beside, factor, rules, motion_s, max_speed_m_s, every, rows):
    """Advance one history until a rule ends it.

    Parameters
    ----------
    p : Spatial
    across, beside : Table
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
    dt, count = across.step_s, p.level_m.size
    last, moving = across.ground_m_s2.size - 1, across.place_m.shape[1]
    us, vs = np.zeros((2, moving + 1)), np.zeros((2, moving + 1))
    slip, closed = np.zeros((count, 3)), np.zeros(count, np.bool_)
    touching = np.zeros(p.first.size - 1, np.int64)  # nodes of each line at the last step
    x, q, v, momentum = p.place_m.copy(), p.turn.copy(), np.zeros(3), np.zeros(3)
    a, torque, pv, pw, hw = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    force, r, u = np.zeros(3), np.zeros(3), np.zeros(3)
    turn, middle, other = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(4)
    du, rel, step, ahead_l = np.zeros((2, moving + 1)), np.zeros(3), np.zeros(3), np.zeros(3)
    peak = twist = slid = spent = work = moving_until = 0.0
    written, k, time = 0, 0, 0.0
    while True:
        half, past = (0.5 * dt, dt) if k > 0 else (0.0, 0.0)
        row = min(k, last)
        ax, ay = factor * beside.ground_m_s2[row], factor * across.ground_m_s2[row]
        az = abs(factor) * across.vertical_m_s2[row]
        drive(beside, factor, k, past, us[0], vs[0], du[0])
        drive(across, factor, k, past, us[1], vs[1], du[1])
        _rotation(q, turn)
        _spin(turn, p.inertia_kg_m2, momentum, hw)  # half a step back
        for i in range(3):
            pv[i] = v[i] + half * a[i]
            ahead_l[i] = momentum[i] + half * torque[i]
        _spin(turn, p.inertia_kg_m2, ahead_l, pw)
        for i in range(3):
            force[i] = torque[i] = 0.0
        elastic = power = 0.0
        for g in range(p.first.size - 1):
            low, high = p.first[g], p.first[g + 1]
            if touching[g] == 0 and _open(p, low, turn, x, us) and _open(p, high - 1, turn, x, us):
                continue  # penetration is linear along the line
            touching[g] = 0
            for i in range(low, high):
                for m in range(3):
                    r[m] = turn[m, 0] * p.arm_m[i, 0] + turn[m, 1] * p.arm_m[i, 1]
                    r[m] += turn[m, 2] * p.arm_m[i, 2]
                n0, n1, n2 = p.normal[i, 0], p.normal[i, 1], p.normal[i, 2]
                j = p.support[i]
                depth = p.level_m[i] - n0 * (x[0] + r[0] - us[0, j])
                depth -= n1 * (x[1] + r[1] - us[1, j]) + n2 * (x[2] + r[2])
                kn, ks, beta = p.kn_n_m[i], p.ks_n_m[i], p.beta_s[i]
                if depth <= 0.0:
                    if closed[i]:
                        size = slip[i, 0] ** 2 + slip[i, 1] ** 2 + slip[i, 2] ** 2
                        spent += 0.5 * ks * size
                        closed[i] = False
                        slip[i, 0] = slip[i, 1] = slip[i, 2] = 0.0
                    continue
                rel[0] = pv[0] + pw[1] * r[2] - pw[2] * r[1] - vs[0, j]
                rel[1] = pv[1] + pw[2] * r[0] - pw[0] * r[2] - vs[1, j]
                rel[2] = pv[2] + pw[0] * r[1] - pw[1] * r[0]
                step[0] = past * (v[0] + hw[1] * r[2] - hw[2] * r[1]) - du[0, j]
                step[1] = past * (v[1] + hw[2] * r[0] - hw[0] * r[2]) - du[1, j]
                step[2] = past * (v[2] + hw[0] * r[1] - hw[1] * r[0])
                rate = -(n0 * rel[0] + n1 * rel[1] + n2 * rel[2])
                along_n = n0 * step[0] + n1 * step[1] + n2 * step[2]
                share, part = 1.0, 1.0
                if not closed[i] and rate > 0.0 and k > 0:
                    share, part = since_closed(depth, rate, dt)
                closed[i] = True
                touching[g] += 1
                normal = max(kn * (depth + beta * rate), 0.0)
                held = 0.0
                for m in range(3):
                    slip[i, m] += part * (step[m] - along_n * p.normal[i, m])
                    rel[m] += rate * p.normal[i, m]  # what is left lies in the joint's plane
                    held += slip[i, m] ** 2
                held = ks * math.sqrt(held)
                most = p.friction[i] * normal
                viscous = ks * beta
                if held > most:
                    back = most / held
                    spent += most * (held - most) / ks
                    viscous = 0.0
                    for m in range(3):
                        slip[i, m] *= back
                square = 0.0
                for m in range(3):
                    u[m] = share * (normal * p.normal[i, m] - ks * slip[i, m] - viscous * rel[m])
                    square += rel[m] ** 2
                    elastic += 0.5 * ks * slip[i, m] ** 2
                    force[m] += u[m]
                elastic += 0.5 * kn * depth * depth
                spent += share * dt * ((normal - kn * depth) * rate + viscous * square)
                power += u[0] * vs[0, j] + u[1] * vs[1, j]
                torque[0] += r[1] * u[2] - r[2] * u[1]
                torque[1] += r[2] * u[0] - r[0] * u[2]
                torque[2] += r[0] * u[1] - r[1] * u[0]
        d = x[1] - p.monitor_m[1]
        arm0 = arm2 = 0.0
        for m in range(3):
            d += turn[1, m] * p.monitor_m[m]
            arm0 += turn[0, m] * p.monitor_m[m]
            arm2 += turn[2, m] * p.monitor_m[m]
        speed = pv[1] + pw[2] * arm0 - pw[0] * arm2
        peak, slid = max(peak, abs(d)), max(slid, abs(x[0]))
        about_z = math.atan2(turn[1, 0], turn[0, 0])
        twist = max(twist, abs(about_z))
        a[0] = force[0] / p.mass_kg - ax
        a[1] = force[1] / p.mass_kg - ay
        a[2] = force[2] / p.mass_kg - p.gravity_m_s2 - az
        work += dt * (power - p.mass_kg * (ax * pv[0] + ay * pv[1] + az * pv[2]))
        if k % every == 0 and written < rows.shape[0]:
            kinetic = 0.0
            for m in range(3):
                mean = v[m] + half * a[m]
                kinetic += 0.5 * p.mass_kg * mean**2
                ahead_l[m] = momentum[m] + half * torque[m]
            _spin(turn, p.inertia_kg_m2, ahead_l, pw)
            for m in range(3):
                kinetic += 0.5 * ahead_l[m] * pw[m]
            rows[written, 0], rows[written, 1], rows[written, 2] = time, d, speed
            rows[written, 3], rows[written, 4], rows[written, 5] = x[0], x[1], x[2]
            rows[written, 6] = math.atan2(turn[2, 1], turn[2, 2])
            rows[written, 7], rows[written, 8] = about_z, kinetic
            rows[written, 9] = p.mass_kg * p.gravity_m_s2 * x[2]
            rows[written, 10], rows[written, 11], rows[written, 12] = elastic, spent, work
            written += 1
        over, status, moving_until = verdict(
            rules, motion_s, max_speed_m_s, k, dt, d, speed, False, moving_until
        )
        if over:
            break
        ahead = dt if k > 0 else 0.5 * dt
        for m in range(3):
            v[m] += ahead * a[m]
            momentum[m] += ahead * torque[m]
            x[m] += dt * v[m]
        roll(q, momentum, p.inertia_kg_m2, dt, hw, middle, other)
        k += 1
        time = k * dt
    return peak, status, time, written, twist, slid
