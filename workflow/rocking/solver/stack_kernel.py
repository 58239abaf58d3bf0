"""The compiled step loop of several blocks in the plane.

The law of a node (`law`) and the scheme are those of `kernel`, node by node: lines of nodes that
meet one plane together, which make that fast, are left out.
"""

import math

import numpy as np

from rocking.runtime.compiled import compiled

from .bars import act, advance, at_rest
from .dashpots import couple, damp, solve, solve_row
from .inputs import drive, verdict
from .law import bond_breaks, bonded, dry, released


@compiled
def _come_out(p, a, b, moves, v, acceleration, gone):
    """Take the debris among two blocks out of the scene with all its nodes; whether there is any.

    It stays where it is.
    """
    found = False
    for block in (a, b):
        if block < 0 or not p.debris[block] or not moves[block].any():
            continue
        found = True
        moves[block, :] = False
        v[block, :] = 0.0
        acceleration[block, :] = 0.0
        for i in range(gone.size):
            gone[i] = gone[i] or p.body_a[i] == block or p.body_b[i] == block
    return found


@compiled
def march_stack(p, bodies, table, factor, rules, motion_s, quiet_m_s2, max_speed_m_s, every, rows):
    """Advance one history until a rule ends it: as `kernel.march_block`.

    Supports and guided blocks are driven. A history's pose and rates are those of the first block.
    """
    dt, blocks, count = table.step_s, p.mass_kg.size, p.kn_n_m.size
    supports = table.place_m.shape[1]
    su, sv, sdu = np.zeros(supports + 1), np.zeros(supports + 1), np.zeros(supports + 1)
    sf = np.zeros(supports + 1)
    slip, closed, gone = np.zeros(count), np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    intact, moves = p.bonded.copy(), p.free.copy()
    memory, push = at_rest(p.bars), np.zeros((blocks, 3))
    q, v, acceleration = p.start[:, :3].copy(), p.start[:, 3:].copy(), np.zeros((blocks, 3))
    pose, w = np.zeros((blocks, 4)), np.zeros((blocks, 3))
    force, own = np.zeros((blocks, 3)), np.zeros((blocks, 6))
    between = np.zeros((blocks if p.in_row else 0, 3, 3))
    barred = p.bars.tie_k_n_m.size + p.bars.floor_k_n_m.size > 0
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
            for m in range(3):
                w[i, m] = v[i, m] + half * acceleration[i, m]
            if p.guide[i] >= 0:
                q[i, 0], w[i, 0] = su[p.guide[i]], sv[p.guide[i]]
                v[i, 0] = sdu[p.guide[i]] / dt
            pose[i, 0], pose[i, 1] = q[i, 0], q[i, 1]
            pose[i, 2], pose[i, 3] = math.cos(q[i, 2]), math.sin(q[i, 2])
        force[:] = 0.0
        own[:] = 0.0
        between[:] = 0.0
        elastic = 0.0
        for i in range(count):
            if gone[i]:
                continue
            a, b, j = p.body_a[i], p.body_b[i], p.support[i]
            ny, nz = p.normal[i, 0], p.normal[i, 1]
            # node: place, arm, velocity now and way since the last step
            ay, az = p.arm_a_m[i, 0], p.arm_a_m[i, 1]
            if a >= 0:
                cos, sin = pose[a, 2], pose[a, 3]
                ay, az = cos * ay - sin * az, sin * ay + cos * az
                py, pz = p.centre_m[a, 0] + q[a, 0] + ay, p.centre_m[a, 1] + q[a, 1] + az
            else:
                py, pz = ay + su[j], az
            by, bz = p.arm_b_m[i, 0], p.arm_b_m[i, 1]
            if b >= 0:
                cos, sin = pose[b, 2], pose[b, 3]
                ny, nz = cos * ny - sin * nz, sin * ny + cos * nz
                cy, cz = cos * by - sin * bz, sin * by + cos * bz
                by, bz = py - p.centre_m[b, 0] - q[b, 0], pz - p.centre_m[b, 1] - q[b, 1]
                depth = -ny * (by - cy) - nz * (bz - cz)
                oy, oz = p.rim[i, 0], p.rim[i, 1]
                if oy != 0.0 or oz != 0.0:
                    out = (cos * oy - sin * oz) * by + (sin * oy + cos * oz) * bz
                    if out > p.rim_m[i]:
                        fell = not p.partial[i]
                        fell = fell and _come_out(p, a, b, moves, v, acceleration, gone)
                        gone[i] = True
                        spent += 0.5 * p.kn_n_m[i] * p.shear_ratio[i] * slip[i] ** 2
                        spent += 0.5 * p.kn_n_m[i] * max(depth, 0.0) ** 2
                        continue
            else:
                depth = -ny * (py - by - su[j]) - nz * (pz - bz)
            if depth <= 0.0 and not intact[i]:
                if closed[i]:
                    spent += 0.5 * p.kn_n_m[i] * p.shear_ratio[i] * slip[i] ** 2
                    closed[i], slip[i] = False, 0.0
                continue
            if a >= 0:
                ry, rz = w[a, 0] - w[a, 2] * az, w[a, 1] + w[a, 2] * ay
                gy, gz = past * (v[a, 0] - v[a, 2] * az), past * (v[a, 1] + v[a, 2] * ay)
            else:
                ry, rz, gy, gz = sv[j], 0.0, sdu[j], 0.0
            if b >= 0:
                ry, rz = ry - w[b, 0] + w[b, 2] * bz, rz - w[b, 1] - w[b, 2] * by
                gy -= past * (v[b, 0] - v[b, 2] * bz)
                gz -= past * (v[b, 1] + v[b, 2] * by)
            else:
                ry, gy = ry - sv[j], gy - sdu[j]
            kn, beta, ratio, friction = p.kn_n_m[i], p.beta_s[i], p.shear_ratio[i], p.friction[i]
            ty, tz = -nz, ny
            rate, speed, way = -(ny * ry + nz * rz), ty * ry + tz * rz, ty * gy + tz * gz
            joint = beta, ratio, friction
            if intact[i]:
                grip = beta, 0.0 if p.tie[i] else ratio, friction  # a tie transmits no shear
                if bond_breaks(depth, slip[i] + way, (p.pull_m[i], p.hold_m[i]), grip):
                    spent += kn * released(depth, slip[i], grip[1])
                    intact[i], slip[i], way = False, 0.0, 0.0
                    closed[i] = depth > 0.0
                    broken += 1
                    if depth <= 0.0:
                        continue
            if intact[i]:
                joint = grip
                acts = bonded(depth, rate, speed, slip[i] + way, joint, dt)
            else:
                fresh = not closed[i] and k > 0
                acts = dry(depth, rate, speed, slip[i], way, fresh, joint, dt)
                closed[i] = True
            normal, shear, share, slip[i], pushes, sticks, stored, taken = acts
            spent += kn * taken
            elastic += kn * stored
            fy = share * kn * (ny * normal - ty * shear)
            fz = share * kn * (nz * normal - tz * shear)
            pressed = beta * kn if pushes else 0.0
            dragged = beta * kn * joint[1] if sticks else 0.0
            if a >= 0:
                force[a, 0] += fy
                force[a, 1] += fz
                force[a, 2] += ay * fz - az * fy
                damp(own, a, ny, nz, nz * ay - ny * az, pressed)
                damp(own, a, ty, tz, tz * ay - ty * az, dragged)
            if b >= 0:
                force[b, 0] -= fy
                force[b, 1] -= fz
                force[b, 2] -= by * fz - bz * fy
                damp(own, b, ny, nz, nz * by - ny * bz, pressed)
                damp(own, b, ty, tz, tz * by - ty * bz, dragged)
                if p.in_row and a >= 0:
                    la, lb = (
                        (nz * ay - ny * az, tz * ay - ty * az),
                        (
                            nz * by - ny * bz,
                            tz * by - ty * bz,
                        ),
                    )
                    if a < b:
                        couple(between, a, ny, nz, la[0], lb[0], pressed)
                        couple(between, a, ty, tz, la[1], lb[1], dragged)
                    else:
                        couple(between, b, ny, nz, lb[0], la[0], pressed)
                        couple(between, b, ty, tz, lb[1], la[1], dragged)
        for i in range(p.link_a.size):
            a, b = p.link_a[i], p.link_b[i]
            stretch, rate = q[a, 0], w[a, 0]
            if b >= 0:
                stretch, rate = stretch - q[b, 0], rate - w[b, 0]
            pull = p.link_n_m[i] * stretch + p.link_ns_m[i] * rate
            elastic += 0.5 * p.link_n_m[i] * stretch * stretch
            spent += dt * p.link_ns_m[i] * rate * rate
            force[a, 0] -= pull
            own[a, 0] += p.link_ns_m[i]
            if b >= 0:
                force[b, 0] += pull
                own[b, 0] += p.link_ns_m[i]
        gravity = p.gravity_m_s2 + abs(factor) * table.vertical_m_s2[now]
        if barred:
            heavier = gravity / p.gravity_m_s2
            stored, taken, lost = act(p.bars, memory, pose, half, (su, sv, sf), ag, heavier, push)
            elastic, spent, broken = elastic + stored, spent + taken, broken + lost
        for i in range(blocks):
            for m in range(6):
                own[i, m] *= half
            # a block's own dashpots belong to the velocity of this step, v + ½h a, not to w
            y, z, turn = acceleration[i, 0], acceleration[i, 1], acceleration[i, 2]
            force[i, 0] += push[i, 0] + own[i, 0] * y + own[i, 1] * z + own[i, 2] * turn
            force[i, 1] += push[i, 1] + own[i, 1] * y + own[i, 3] * z + own[i, 4] * turn
            force[i, 2] += push[i, 2] + own[i, 2] * y + own[i, 4] * z + own[i, 5] * turn
            force[i, 0] -= p.mass_kg[i] * ag
            force[i, 1] -= p.mass_kg[i] * gravity
            if not p.in_row:
                solve(own, i, p.mass_kg[i], p.inertia_kg_m2[i], moves, force)
        if p.in_row:
            for i in range(blocks - 1):
                for m in range(3):
                    for n in range(3):
                        between[i, m, n] *= half
                        force[i, m] += between[i, m, n] * acceleration[i + 1, n]
                        force[i + 1, n] += between[i, m, n] * acceleration[i, m]
            solve_row(own, between, p.mass_kg, p.inertia_kg_m2, force)
        for i in range(blocks):
            for m in range(3):
                acceleration[i, m] = force[i, m]
        d = speed = 0.0
        for point in range(p.watched.size):
            i = p.watched[point]
            my, mz = p.monitor_m[point, 0], p.monitor_m[point, 1]
            at = q[i, 0] + pose[i, 2] * my - pose[i, 3] * mz - my
            if point == 0 or not abs(at) <= abs(d):
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
        if barred:
            advance(p.bars, memory, ahead, dt)
        k += 1
        time = k * dt
    return peak, status, time, written, broken
