"""Several rigid blocks that stand on each other, in the plane: arrays, matrices and step loop.

The law of a node and the scheme are those of `kernel`, node by node: lines of nodes that
meet one plane together, which make that fast, are left out. Dashpots between
all blocks act at the velocity of the whole step, by one solve.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled

from .bars import Bars, act, advance, at_rest, elements
from .inputs import drive, since_closed, verdict


class Stack(NamedTuple):
    """Blocks in the y–z plane, in the frame of the reference support.

    Attributes
    ----------
    mass_kg, inertia_kg_m2 : ndarray, shape (blocks,)
    centre_m, monitor_m : ndarray, shape (blocks, 2)
        Reference centroids (y, z), and from them the points of which the farthest moves by d.
    start : ndarray, shape (blocks, 6)
        y, z [m] and rotation about x [rad] of each block, and their rates.
    body_a, body_b, support : ndarray of int, shape (nodes,)
        Block that carries the node and block with the plane, −1 for a support, and the column of
        that support's motion (−1: it stands still).
    arm_a_m, arm_b_m, normal : ndarray, shape (nodes, 2)
        The node and a point of the plane from the centroids of their blocks (of a support from
        the origin); normal from b into a.
    kn_n_m, shear_ratio, beta_s, friction : ndarray, shape (nodes,)
    gravity_m_s2, thickness_m, height_m : float
    bars : Bars
    """

    mass_kg: np.ndarray
    inertia_kg_m2: np.ndarray
    centre_m: np.ndarray
    monitor_m: np.ndarray
    start: np.ndarray
    body_a: np.ndarray
    body_b: np.ndarray
    support: np.ndarray
    arm_a_m: np.ndarray
    arm_b_m: np.ndarray
    normal: np.ndarray
    kn_n_m: np.ndarray
    shear_ratio: np.ndarray
    beta_s: np.ndarray
    friction: np.ndarray
    gravity_m_s2: float
    thickness_m: float
    height_m: float
    bars: Bars


def stacked(scene, own, column, bars):
    """Reduce a scene to its plane.

    Parameters
    ----------
    scene : Scene
        Its free blocks move in y, z and about x; every node joins two of them, or one to a support.
    own : list of int
        The free blocks.
    column : dict of str to int
        Of each support's motion.
    bars : Bars

    Returns
    -------
    Stack

    Raises
    ------
    ValueError
        One line if a node is bonded or joins no free block.
    """
    nodes, blocks = scene.nodes, scene.blocks
    number = np.full(len(blocks), -1, np.int64)
    number[own] = np.arange(len(own))
    a, b = number[nodes.a], number[nodes.b]
    if np.any((a < 0) & (b < 0)) or nodes.bonded.any():
        raise ValueError("screening: between hinges expected dry nodes that meet a free block")
    centre = np.array([block.centre_m[1:] for block in blocks], float)
    watched = {scene.index(name): np.array(point)[1:] for name, point in scene.watched}
    from_a, from_b = (
        np.where((number[side] >= 0)[:, None], centre[side], 0.0) for side in (nodes.a, nodes.b)
    )
    normal = nodes.normal[:, 1:]
    plane = nodes.position_m[:, 1:] - nodes.gap_m[:, None] * normal
    still = np.where(a < 0, nodes.a, nodes.b)
    support = [column.get(blocks[i].motion, -1) for i in still]
    poses = [
        [
            *block.displacement_m[1:],
            block.rotation_rad[0],
            *block.velocity_m_s[1:],
            block.angular_velocity_rad_s[0],
        ]
        for block in (blocks[i] for i in own)
    ]
    top = max(point[1] for point in watched.values())
    return Stack(
        mass_kg=np.array([blocks[i].mass_kg for i in own], float),
        inertia_kg_m2=np.array([blocks[i].inertia_kg_m2[0] for i in own], float),
        centre_m=centre[own],
        monitor_m=np.array([watched[i] - centre[i] for i in own]),
        start=np.array(poses, float),
        body_a=a,
        body_b=b,
        support=np.where((a >= 0) & (b >= 0), -1, np.array(support, np.int64)),
        arm_a_m=nodes.position_m[:, 1:] - from_a,
        arm_b_m=plane - from_b,
        normal=np.ascontiguousarray(normal),
        kn_n_m=nodes.kn_n_m,
        shear_ratio=nodes.ks_n_m / nodes.kn_n_m,
        beta_s=nodes.beta_s,
        friction=np.tan(nodes.friction_rad),
        gravity_m_s2=float(scene.gravity_m_s2),
        thickness_m=float(scene.thickness_m),
        height_m=float(top - nodes.position_m[:, 2].min()),
        bars=bars,
    )


def stack_matrices(stack):
    """Mass, stiffness and damping of blocks and floors with a mass, nodes closed, ties taut.

    Returns
    -------
    mass : ndarray, shape (3·blocks + floors,)
    k, c : ndarray, shape (3·blocks + floors, 3·blocks + floors)
    """
    p, n = stack, len(stack.mass_kg)
    floors = p.bars.mass_kg[p.bars.mass_kg > 0.0]
    k, c = np.zeros((2, 3 * n + floors.size, 3 * n + floors.size))
    node = p.arm_a_m + np.where((p.body_a >= 0)[:, None], p.centre_m[p.body_a], 0.0)
    for i, (ny, nz) in enumerate(p.normal):
        for (y, z), stiffness in (((ny, nz), 1.0), ((-nz, ny), p.shear_ratio[i])):
            row = np.zeros(len(k))
            for body, sign in ((p.body_a[i], 1.0), (p.body_b[i], -1.0)):
                if body >= 0:
                    ry, rz = node[i] - p.centre_m[body]
                    row[3 * body : 3 * body + 3] = sign * np.array([y, z, z * ry - y * rz])
            element = stiffness * p.kn_n_m[i] * np.outer(row, row)
            k += element
            c += p.beta_s[i] * element
    for stiffness, dashpot, row in elements(p.bars, 0, n):
        k += stiffness * np.outer(row, row)
        c += dashpot * np.outer(row, row)
    mass = np.stack([p.mass_kg, p.mass_kg, p.inertia_kg_m2], axis=1).ravel()
    return np.concatenate((mass, floors)), k, c


@compiled
def _solve(matrix, right):
    """Solve a symmetric positive definite system in place; the answer stands in `right`."""
    n = right.size
    for i in range(n):
        for j in range(i + 1, n):
            if matrix[i, j] != 0.0:
                share = matrix[i, j] / matrix[i, i]
                for m in range(j, n):
                    matrix[j, m] -= share * matrix[i, m]
                right[j] -= share * right[i]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            right[i] -= matrix[i, j] * right[j]
        right[i] /= matrix[i, i]


@compiled
def march_stack(p, bodies, table, factor, rules, motion_s, quiet_m_s2, max_speed_m_s, every, rows):
    """Advance one history until a rule ends it: parameters and return as `kernel.march`.

    Supports are driven. A history's pose and rates are those of the lowest block.
    """
    dt, blocks, count = table.step_s, p.mass_kg.size, p.kn_n_m.size
    supports = table.place_m.shape[1]
    su, sv, sdu = np.zeros(supports + 1), np.zeros(supports + 1), np.zeros(supports + 1)
    sf = np.zeros(supports + 1)
    slip, closed = np.zeros(count), np.zeros(count, np.bool_)
    memory, push = at_rest(p.bars), np.zeros((blocks, 3))
    q, v, acceleration = p.start[:, :3].copy(), p.start[:, 3:].copy(), np.zeros((blocks, 3))
    pose, w = np.zeros((blocks, 4)), np.zeros((blocks, 3))
    force, damping = np.zeros(3 * blocks), np.zeros((3 * blocks, 3 * blocks))
    past_a = np.zeros(3 * blocks)
    row_n, row_t = np.zeros(6), np.zeros(6)
    peak = moving_until = spent = 0.0
    written, broken, k = 0, 0, 0
    last = table.ground_m_s2.size - 1
    time = 0.0
    while True:
        half, past = (0.5 * dt, dt) if k > 0 else (0.0, 0.0)
        now = min(k, last)
        ag = factor * table.ground_m_s2[now]
        drive(table, factor, k, past, su, sv, sdu)
        for i in range(blocks):
            pose[i, 0], pose[i, 1] = q[i, 0], q[i, 1]
            pose[i, 2], pose[i, 3] = math.cos(q[i, 2]), math.sin(q[i, 2])
            for m in range(3):
                w[i, m] = v[i, m] + half * acceleration[i, m]
                past_a[3 * i + m] = acceleration[i, m]
        force[:] = 0.0
        damping[:] = 0.0
        elastic = 0.0
        for i in range(count):
            a, b, j = p.body_a[i], p.body_b[i], p.support[i]
            ny, nz = p.normal[i]
            # node: place, arm, velocity now and way since the last step
            ay, az = p.arm_a_m[i]
            if a >= 0:
                cos, sin = pose[a, 2], pose[a, 3]
                ay, az = cos * ay - sin * az, sin * ay + cos * az
                py, pz = p.centre_m[a, 0] + q[a, 0] + ay, p.centre_m[a, 1] + q[a, 1] + az
                ry, rz = w[a, 0] - w[a, 2] * az, w[a, 1] + w[a, 2] * ay
                gy, gz = past * (v[a, 0] - v[a, 2] * az), past * (v[a, 1] + v[a, 2] * ay)
            else:
                py, pz = ay + su[j], az
                ry, rz, gy, gz = sv[j], 0.0, sdu[j], 0.0
            by, bz = p.arm_b_m[i]
            if b >= 0:
                cos, sin = pose[b, 2], pose[b, 3]
                ny, nz = cos * ny - sin * nz, sin * ny + cos * nz
                cy, cz = p.centre_m[b, 0] + q[b, 0], p.centre_m[b, 1] + q[b, 1]
                depth = -ny * (py - cy - (cos * by - sin * bz))
                depth -= nz * (pz - cz - (sin * by + cos * bz))
                by, bz = py - cy, pz - cz
                ry, rz = ry - w[b, 0] + w[b, 2] * bz, rz - w[b, 1] - w[b, 2] * by
                gy -= past * (v[b, 0] - v[b, 2] * bz)
                gz -= past * (v[b, 1] + v[b, 2] * by)
            else:
                depth = -ny * (py - by - su[j]) - nz * (pz - bz)
                ry, gy = ry - sv[j], gy - sdu[j]
            kn, beta, ratio = p.kn_n_m[i], p.beta_s[i], p.shear_ratio[i]
            if depth <= 0.0:
                spent += 0.5 * kn * ratio * slip[i] ** 2
                closed[i], slip[i] = False, 0.0
                continue
            ty, tz = -nz, ny
            rate, speed, step = -(ny * ry + nz * rz), ty * ry + tz * rz, ty * gy + tz * gz
            share = 1.0
            if not closed[i] and rate > 0.0 and k > 0:
                share, part = since_closed(depth, rate, dt)
                step *= part
            closed[i] = True
            normal = max(depth + beta * rate, 0.0)
            limit, held = p.friction[i] * normal, ratio * (slip[i] + step)
            sticks = abs(held) <= limit
            if sticks:
                slip[i] += step
                shear = held + ratio * beta * speed
                spent += share * dt * kn * ratio * beta * speed * speed
            else:
                shear = math.copysign(limit, held)
                spent += kn * limit * abs(held - shear) / ratio
                slip[i] = shear / ratio
            elastic += 0.5 * kn * (depth * depth + ratio * slip[i] * slip[i])
            spent += share * dt * kn * (normal - depth) * rate
            fy = share * kn * (ny * normal - ty * shear)
            fz = share * kn * (nz * normal - tz * shear)
            row_n[:] = 0.0
            row_t[:] = 0.0
            if a >= 0:
                force[3 * a] += fy
                force[3 * a + 1] += fz
                force[3 * a + 2] += ay * fz - az * fy
                row_n[0], row_n[1], row_n[2] = ny, nz, nz * ay - ny * az
                row_t[0], row_t[1], row_t[2] = ty, tz, tz * ay - ty * az
            if b >= 0:
                force[3 * b] -= fy
                force[3 * b + 1] -= fz
                force[3 * b + 2] -= by * fz - bz * fy
                row_n[3], row_n[4], row_n[5] = -ny, -nz, ny * bz - nz * by
                row_t[3], row_t[4], row_t[5] = -ty, -tz, ty * bz - tz * by
            pressed = beta * kn if normal > 0.0 else 0.0
            dragged = beta * kn * ratio if sticks else 0.0
            for m in range(6):
                one = 3 * (a if m < 3 else b) + m % 3
                if one < 0:
                    continue
                for o in range(6):
                    two = 3 * (a if o < 3 else b) + o % 3
                    if two >= 0:
                        damping[one, two] += pressed * row_n[m] * row_n[o]
                        damping[one, two] += dragged * row_t[m] * row_t[o]
        gravity = p.gravity_m_s2 + abs(factor) * table.vertical_m_s2[now]
        heavier = gravity / p.gravity_m_s2
        stored, taken, lost = act(p.bars, memory, pose, half, (su, sv, sf), ag, heavier, push)
        elastic, spent, broken = elastic + stored, spent + taken, broken + lost
        force += half * (damping @ past_a)
        damping *= half
        for i in range(blocks):
            force[3 * i] += push[i, 0] - p.mass_kg[i] * ag
            force[3 * i + 1] += push[i, 1] - p.mass_kg[i] * gravity
            force[3 * i + 2] += push[i, 2]
            damping[3 * i, 3 * i] += p.mass_kg[i]
            damping[3 * i + 1, 3 * i + 1] += p.mass_kg[i]
            damping[3 * i + 2, 3 * i + 2] += p.inertia_kg_m2[i]
        _solve(damping, force)
        d = speed = 0.0
        for i in range(blocks):
            for m in range(3):
                acceleration[i, m] = force[3 * i + m]
            my, mz = p.monitor_m[i]
            at = q[i, 0] + pose[i, 2] * my - pose[i, 3] * mz - my
            if i == 0 or not abs(at) <= abs(d):
                d = at
                speed = w[i, 0] - w[i, 2] * (pose[i, 3] * my + pose[i, 2] * mz)
        peak = max(peak, abs(d))
        if k % every == 0 and written < rows.shape[0]:
            rows[written, 0], rows[written, 1], rows[written, 2] = time, d, speed
            rows[written, 9], rows[written, 10] = elastic, spent
            for m in range(3):
                rows[written, 3 + m] = q[0, m]
                rows[written, 6 + m] = v[0, m] + half * acceleration[0, m]
            for j in range(supports):
                rows[written, rows.shape[1] - 2 * supports + j] = su[j]
                rows[written, rows.shape[1] - supports + j] = sv[j]
            written += 1
        over, status, moving_until = verdict(
            rules, motion_s, max_speed_m_s, k, dt, d, speed, False, moving_until
        )
        if over:
            break
        ahead = dt if k > 0 else 0.5 * dt
        for i in range(blocks):
            for m in range(3):
                v[i, m] += ahead * acceleration[i, m]
                q[i, m] += dt * v[i, m]
        advance(p.bars, memory, ahead, dt)
        k += 1
        time = k * dt
    return peak, status, time, written, broken
