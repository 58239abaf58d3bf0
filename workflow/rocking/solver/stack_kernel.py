"""The compiled step loop of several blocks in the plane.

The law of a node and the scheme are those of `kernel`, node by node: lines of nodes that
meet one plane together, which make that fast, are left out.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled, inlined

from . import bars
from .dashpots import couple, damp, solve, solve_row
from .inputs import drive, standing, verdict
from .law import bond_breaks, bonded, dry, released


class Pile(NamedTuple):
    """How the blocks of a stack move, and what their nodes remember.

    Attributes
    ----------
    place, rates, now, acceleration : ndarray, shape (blocks, 3)
        Of y, z and rotation: displacement, velocity half a step back and now.
    pose : ndarray, shape (blocks, 4)
        y, z, cosine and sine of the rotation.
    moves : ndarray of bool, shape (blocks, 3)
    force, own : ndarray, shape (blocks, 3), (blocks, 6)
        Forces, and dashpots that act: 00, 01, 02, 11, 12, 22 of each block's own.
    between : ndarray, shape (blocks, 3, 3)
        What joins each block of a row to the next; without rows unless `Stack.in_row`.
    slip : ndarray, shape (nodes,)
    closed, intact, gone : ndarray of bool, shape (nodes,)
        It touched at the last step; its bond holds; it is let go for good.
    """

    place: np.ndarray
    rates: np.ndarray
    now: np.ndarray
    acceleration: np.ndarray
    pose: np.ndarray
    moves: np.ndarray
    force: np.ndarray
    own: np.ndarray
    between: np.ndarray
    slip: np.ndarray
    closed: np.ndarray
    intact: np.ndarray
    gone: np.ndarray


@compiled
def _piled(p):
    """A stack before its motion."""
    blocks, nodes = p.mass_kg.size, p.kn_n_m.size
    return Pile(
        p.start[:, :3].copy(),
        p.start[:, 3:].copy(),
        np.zeros((blocks, 3)),
        np.zeros((blocks, 3)),
        np.zeros((blocks, 4)),
        p.free.copy(),
        np.zeros((blocks, 3)),
        np.zeros((blocks, 6)),
        np.zeros((blocks if p.in_row else 0, 3, 3)),
        np.zeros(nodes),
        np.zeros(nodes, np.bool_),
        p.bonded.copy(),
        np.zeros(nodes, np.bool_),
    )


@inlined
def _come_out(p, pile, a, b):
    """Take the debris among two blocks out of the scene, with all its nodes: it stays there."""
    for block in (a, b):
        if block < 0 or not p.debris[block] or not pile.moves[block].any():
            continue
        pile.moves[block, :] = False
        pile.rates[block, :] = 0.0
        pile.acceleration[block, :] = 0.0
        for i in range(pile.gone.size):
            pile.gone[i] = pile.gone[i] or p.body_a[i] == block or p.body_b[i] == block


@inlined
def _predict(p, pile, supports, half, dt):
    """Velocities at the whole step; guided blocks follow their supports."""
    for i in range(p.mass_kg.size):
        for m in range(3):
            pile.now[i, m] = pile.rates[i, m] + half * pile.acceleration[i, m]
        if p.guide[i] >= 0:
            j = p.guide[i]
            pile.place[i, 0], pile.now[i, 0] = supports.y[j], supports.vy[j]
            pile.rates[i, 0] = supports.dy[j] / dt
        pile.pose[i, 0], pile.pose[i, 1] = pile.place[i, 0], pile.place[i, 1]
        pile.pose[i, 2], pile.pose[i, 3] = math.cos(pile.place[i, 2]), math.sin(pile.place[i, 2])


@inlined
def _meet(p, pile, supports, i):
    """Where node i is: normal, its arms from the centres of a and b, penetration.

    The last, how far it is out of its plane, is negative within.
    """
    a, b, j = p.body_a[i], p.body_b[i], p.support[i]
    ny, nz = p.normal[i, 0], p.normal[i, 1]
    ay, az = p.arm_a_m[i, 0], p.arm_a_m[i, 1]
    if a >= 0:
        cos, sin = pile.pose[a, 2], pile.pose[a, 3]
        ay, az = cos * ay - sin * az, sin * ay + cos * az
        py = p.centre_m[a, 0] + pile.place[a, 0] + ay
        pz = p.centre_m[a, 1] + pile.place[a, 1] + az
    else:
        py, pz = ay + supports.y[j], az
    by, bz, out = p.arm_b_m[i, 0], p.arm_b_m[i, 1], -1.0
    if b < 0:
        depth = -ny * (py - by - supports.y[j]) - nz * (pz - bz)
        return ny, nz, ay, az, by, bz, depth, out
    cos, sin = pile.pose[b, 2], pile.pose[b, 3]
    ny, nz = cos * ny - sin * nz, sin * ny + cos * nz
    cy, cz = cos * by - sin * bz, sin * by + cos * bz
    by = py - p.centre_m[b, 0] - pile.place[b, 0]
    bz = pz - p.centre_m[b, 1] - pile.place[b, 1]
    depth = -ny * (by - cy) - nz * (bz - cz)
    oy, oz = p.rim[i, 0], p.rim[i, 1]
    if oy != 0.0 or oz != 0.0:
        out = (cos * oy - sin * oz) * by + (sin * oy + cos * oz) * bz - p.rim_m[i]
    return ny, nz, ay, az, by, bz, depth, out


@inlined
def _between(p, pile, supports, i, past, arms):
    """Velocity of node i past its plane, and its way past it in the last step."""
    a, b, j = p.body_a[i], p.body_b[i], p.support[i]
    ay, az, by, bz = arms
    w, v = pile.now, pile.rates
    if a >= 0:
        ry, rz = w[a, 0] - w[a, 2] * az, w[a, 1] + w[a, 2] * ay
        gy, gz = past * (v[a, 0] - v[a, 2] * az), past * (v[a, 1] + v[a, 2] * ay)
    else:
        ry, rz, gy, gz = supports.vy[j], 0.0, supports.dy[j], 0.0
    if b >= 0:
        ry, rz = ry - w[b, 0] + w[b, 2] * bz, rz - w[b, 1] - w[b, 2] * by
        gy -= past * (v[b, 0] - v[b, 2] * bz)
        gz -= past * (v[b, 1] + v[b, 2] * by)
    else:
        ry, gy = ry - supports.vy[j], gy - supports.dy[j]
    return ry, rz, gy, gz


@inlined
def _push(pile, body, sign, arm, force, directions, dashpots):
    """Add a node's force and its dashpots to a block."""
    if body < 0:
        return
    (ry, rz), (fy, fz), (ny, nz, ty, tz) = arm, force, directions
    pile.force[body, 0] += sign * fy
    pile.force[body, 1] += sign * fz
    pile.force[body, 2] += sign * (ry * fz - rz * fy)
    damp(pile.own, body, ny, nz, nz * ry - ny * rz, dashpots[0])
    damp(pile.own, body, ty, tz, tz * ry - ty * rz, dashpots[1])


@inlined
def _levers(arms, y, z):
    """Of two arms about a direction."""
    return z * arms[0] - y * arms[1], z * arms[2] - y * arms[3]


@inlined
def _contact(p, pile, supports, past, dt):
    """Forces of all nodes on the blocks: energy stored and taken in this step, bonds that broke."""
    elastic = spent = 0.0
    broken = 0
    for i in range(p.kn_n_m.size):
        if pile.gone[i]:
            continue
        ny, nz, ay, az, by, bz, depth, out = _meet(p, pile, supports, i)
        kn, slip, holds = p.kn_n_m[i], pile.slip[i], pile.intact[i]
        if out > 0.0:
            if not p.partial[i]:
                _come_out(p, pile, p.body_a[i], p.body_b[i])
            pile.gone[i] = True
            spent += 0.5 * kn * (p.shear_ratio[i] * slip**2 + max(depth, 0.0) ** 2)
            continue
        if depth <= 0.0 and not holds:
            if pile.closed[i]:
                spent += 0.5 * kn * p.shear_ratio[i] * slip**2
                pile.closed[i], pile.slip[i] = False, 0.0
            continue
        ry, rz, gy, gz = _between(p, pile, supports, i, past, (ay, az, by, bz))
        ty, tz = -nz, ny
        rate, speed, step = -(ny * ry + nz * rz), ty * ry + tz * rz, ty * gy + tz * gz
        ratio = 0.0 if holds and p.tie[i] else p.shear_ratio[i]
        joint, strength = (p.beta_s[i], ratio, p.friction[i]), (p.pull_m[i], p.hold_m[i])
        if holds and bond_breaks(depth, slip + step, strength, joint):
            spent += kn * released(depth, slip, ratio)
            holds, slip, step, ratio = False, 0.0, 0.0, p.shear_ratio[i]
            joint = p.beta_s[i], ratio, p.friction[i]
            pile.intact[i], pile.slip[i], pile.closed[i] = False, 0.0, depth > 0.0
            broken += 1
        if holds:
            found = bonded(depth, rate, speed, slip + step, joint, dt)
        elif depth > 0.0:
            fresh = not pile.closed[i] and past > 0.0
            found = dry(depth, rate, speed, slip, step, fresh, joint, dt)
            pile.closed[i] = True
        else:
            continue
        normal, shear, share, pile.slip[i], pressed, sticks, stored, taken = found
        elastic, spent = elastic + kn * stored, spent + kn * taken
        force = share * kn * (ny * normal - ty * shear), share * kn * (nz * normal - tz * shear)
        drag = p.beta_s[i] * kn
        dashpots = drag if pressed else 0.0, drag * ratio if sticks else 0.0
        directions = ny, nz, ty, tz
        _push(pile, p.body_a[i], 1.0, (ay, az), force, directions, dashpots)
        _push(pile, p.body_b[i], -1.0, (by, bz), force, directions, dashpots)
        if p.in_row and p.body_a[i] >= 0 and p.body_b[i] >= 0:
            arms = (ay, az, by, bz) if p.body_a[i] < p.body_b[i] else (by, bz, ay, az)
            low = min(p.body_a[i], p.body_b[i])
            couple(pile.between, low, ny, nz, *_levers(arms, ny, nz), dashpots[0])
            couple(pile.between, low, ty, tz, *_levers(arms, ty, tz), dashpots[1])
    return elastic, spent, broken


@inlined
def _pull(p, pile, dt):
    """Forces of the links: energy stored, and taken in this step."""
    elastic = spent = 0.0
    for i in range(p.link_a.size):
        a, b = p.link_a[i], p.link_b[i]
        stretch, rate = pile.place[a, 0], pile.now[a, 0]
        if b >= 0:
            stretch, rate = stretch - pile.place[b, 0], rate - pile.now[b, 0]
        pull = p.link_n_m[i] * stretch + p.link_ns_m[i] * rate
        elastic += 0.5 * p.link_n_m[i] * stretch * stretch
        spent += dt * p.link_ns_m[i] * rate * rate
        pile.force[a, 0] -= pull
        pile.own[a, 0] += p.link_ns_m[i]
        if b >= 0:
            pile.force[b, 0] += pull
            pile.own[b, 0] += p.link_ns_m[i]
    return elastic, spent


@inlined
def _accelerate(p, pile, push, ground, gravity, half):
    """Accelerations, a block's own dashpots at the velocity of this step, v + ½h a."""
    force, own = pile.force, pile.own
    for i in range(p.mass_kg.size):
        for m in range(6):
            own[i, m] *= half
        y, z, turn = pile.acceleration[i, 0], pile.acceleration[i, 1], pile.acceleration[i, 2]
        force[i, 0] += push[i, 0] + own[i, 0] * y + own[i, 1] * z + own[i, 2] * turn
        force[i, 1] += push[i, 1] + own[i, 1] * y + own[i, 3] * z + own[i, 4] * turn
        force[i, 2] += push[i, 2] + own[i, 2] * y + own[i, 4] * z + own[i, 5] * turn
        force[i, 0] -= p.mass_kg[i] * ground
        force[i, 1] -= p.mass_kg[i] * gravity
        if not p.in_row:
            solve(own, i, p.mass_kg[i], p.inertia_kg_m2[i], pile.moves, force)
    if p.in_row:
        for i in range(p.mass_kg.size - 1):
            for m in range(3):
                for n in range(3):
                    pile.between[i, m, n] *= half
                    force[i, m] += pile.between[i, m, n] * pile.acceleration[i + 1, n]
                    force[i + 1, n] += pile.between[i, m, n] * pile.acceleration[i, m]
        solve_row(own, pile.between, p.mass_kg, p.inertia_kg_m2, force)
    pile.acceleration[:] = force


@inlined
def _farthest(p, pile):
    """Displacement and speed of the watched point that has gone farthest."""
    d = speed = 0.0
    for point in range(p.watched.size):
        i = p.watched[point]
        my, mz = p.monitor_m[point, 0], p.monitor_m[point, 1]
        cos, sin = pile.pose[i, 2], pile.pose[i, 3]
        at = pile.place[i, 0] + cos * my - sin * mz - my
        if point == 0 or not abs(at) <= abs(d):
            d, speed = at, pile.now[i, 0] - pile.now[i, 2] * (sin * my + cos * mz)
    return d, speed


@compiled
def march_stack(p, bodies, table, factor, rules, motion_s, quiet_m_s2, max_speed_m_s, every, rows):
    """Advance one history until a rule ends it: arguments and values as `kernel.march_block`.

    Supports and guided blocks are driven. A history's pose and rates are those of the first block.
    """
    dt, count = table.step_s, table.place_m.shape[1]
    supports, pile = standing(count), _piled(p)
    memory, push = bars.at_rest(p.bars), np.zeros((p.mass_kg.size, 3))
    held = (supports.y, supports.vy, supports.fy)
    barred = p.bars.tie_k_n_m.size + p.bars.floor_k_n_m.size > 0
    peak = moving_until = spent = time = 0.0
    written, broken, k = 0, 0, 0
    last = table.ground_m_s2.size - 1
    while True:
        half, past = (0.5 * dt, dt) if k > 0 else (0.0, 0.0)
        row = min(k, last)
        ag = factor * table.ground_m_s2[row]
        gravity = p.gravity_m_s2 + abs(factor) * table.vertical_m_s2[row]
        drive(table, factor, k, past, supports.y, supports.vy, supports.dy)
        _predict(p, pile, supports, half, dt)
        pile.force[:] = 0.0
        pile.own[:] = 0.0
        pile.between[:] = 0.0
        elastic, taken, lost = _contact(p, pile, supports, past, dt)
        stored, dragged = _pull(p, pile, dt)
        elastic, spent, broken = elastic + stored, spent + taken + dragged, broken + lost
        if barred:
            heavier = gravity / p.gravity_m_s2
            found = bars.act(p.bars, memory, pile.pose, half, held, ag, heavier, push)
            elastic, spent, broken = elastic + found[0], spent + found[1], broken + found[2]
        _accelerate(p, pile, push, ag, gravity, half)
        d, speed = _farthest(p, pile)
        peak = max(peak, abs(d))
        if k % every == 0 and written < rows.shape[0]:
            out = rows[written]
            out[0], out[1], out[2], out[9], out[10] = time, d, speed, elastic, spent
            for m in range(3):
                out[3 + m] = pile.place[0, m]
                out[6 + m] = pile.rates[0, m] + half * pile.acceleration[0, m]
            out[out.size - 2 * count : out.size - count] = supports.y[:-1]
            out[out.size - count :] = supports.vy[:-1]
            written += 1
        over, status, moving_until = verdict(
            rules, motion_s, max_speed_m_s, k, dt, d, speed, False, moving_until
        )
        if over:
            break
        ahead = dt if k > 0 else 0.5 * dt
        for i in range(p.mass_kg.size):
            for m in range(3):
                pile.rates[i, m] += ahead * pile.acceleration[i, m]
                pile.place[i, m] += dt * pile.rates[i, m]
        if barred:
            bars.advance(p.bars, memory, ahead, dt)
        k += 1
        time = k * dt
    return peak, status, time, written, broken
