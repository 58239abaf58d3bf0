"""Several blocks in a step: their contact and their accelerations; see `march`.

Bricks meet node by node, by the law of `law`; pieces by groups of nodes (`pieces`), courses along
lines (`lines`). The scheme is that of one block; one text for one history and for many.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined, looped

from . import lines, pieces
from .dashpots import apart, beyond, placed, push, rates, resist, solve_row, solved, three, turned
from .groups import untouched
from .law import bond_breaks, node, released
from .march import TO_THE_END, Loop, advance, march_many
from .sines import cos_sin
from .vectors import align_stack, alone, choose, dot, like, lone, plus, put, put_where, some, take

OPEN, CLOSED, HOLDS, GONE = 0.0, 1.0, 2.0, 3.0  # states of a node


class StackMemory(NamedTuple):
    """What nodes and blocks remember, in rows."""

    slip: np.ndarray  # a row a node
    state: np.ndarray  # a row a node
    goes: np.ndarray  # a row a block: 0 where it came out of its slot and takes no part any more
    lines: np.ndarray  # `lines.MEMORY` rows a line, see `lines.press`
    held: np.ndarray  # three rows a line and a group: what its block's rates do along y
    groups: np.ndarray  # rows of `groups.touched`


@inlined
def _nodes(p, rows):
    """`StackMemory` in the rows of `_start`."""
    count, goes = p.kn_n_m.size, 2 * p.kn_n_m.size + p.mass_kg.size
    even = goes + lines.MEMORY * p.lines.half_m.size
    held = even + 3 * (p.lines.half_m.size + p.groups.level_m.size)
    of_nodes = rows[:count], rows[count : 2 * count]
    of_lines = rows[2 * count : goes], rows[goes:even], rows[even:held]
    return StackMemory(*of_nodes, *of_lines, rows[held:])


def _start(p):
    """Rows of nodes that have not met their planes yet, and of blocks that all go; see `Loop`."""
    slip, state = np.zeros(p.kn_n_m.size), np.where(p.bonded, HOLDS, OPEN)
    even = np.zeros(lines.MEMORY * p.lines.half_m.size)
    held = np.zeros(3 * (p.lines.half_m.size + p.groups.level_m.size))
    groups, whole = untouched(p.groups)
    rows = np.concatenate((slip, state, np.ones(p.mass_kg.size), even, held, groups))
    return rows, whole, (0.0, 0.0, 0.0)


@inlined
def _predict(p, parts, time, alive):
    """Rates at the whole step, cosines and sines of all blocks; forces and dashpots at nothing."""
    half, _, dt = time
    ahead = half * (1.0 - 2.0 * p.lead)  # led, rates that swing from step to step open joints
    for m in range(len(parts.place)):
        put(parts.now, m, plus(take(parts.rate, m), ahead, take(parts.rise, m)))
        put(parts.force, m, 0.0)
    for block in range(p.mass_kg.size):
        j, y = p.guide[block], 3 * block
        if j >= 0:
            put(parts.place, y, take(parts.supports.y, j))
            put(parts.now, y, take(parts.supports.vy, j))
            put(parts.rate, y, take(parts.supports.dy, j) / dt)
        cos, sin = cos_sin(take(parts.place, y + 2), alive)
        put(parts.turn, 2 * block, cos)
        put(parts.turn, 2 * block + 1, sin)
    for m in range(len(parts.own)):
        put(parts.own, m, 0.0)
    if p.in_row:
        for m in range(len(parts.between)):
            put(parts.between, m, 0.0)


@inlined
def _come_out(p, i, parts, nodes, out):
    """Take the debris that meets node i out of the scene where it is out, with all its nodes.

    It stays where it is.
    """
    for block in (p.body_a[i], p.body_b[i]):
        if block < 0 or not p.debris[block] or not p.free[block].any():
            continue
        falls = out & (take(nodes.goes, block) > 0.0)
        if not some(falls):
            continue
        put_where(nodes.goes, block, falls, 0.0)
        for m in range(3 * block, 3 * block + 3):
            put_where(parts.rate, m, falls, 0.0)
            put_where(parts.rise, m, falls, 0.0)
        for other in range(p.body_a.size):
            if p.body_a[other] == block or p.body_b[other] == block:
                put_where(nodes.state, other, falls, GONE)


@inlined
def _force(p, i, j, parts, nodes, where, arms, time, acts):
    """What node i does to its blocks where it acts; energy stored, taken, and bonds that broke."""
    a, b = p.body_a[i], p.body_b[i]
    (ny, nz, depth), (ay, az, by, bz), (_, past_s, dt) = where, arms, time
    touching, holds, was = acts
    none = like(0.0, depth)
    sv, sdu = take(parts.supports.vy, j), take(parts.supports.dy, j)
    if a >= 0:
        ry, rz, gy, gz = rates(parts, a, (ay, az), past_s)
    else:
        ry, rz, gy, gz = sv, none, sdu, none
    if b >= 0:
        ry, rz, gy, gz = apart(parts, b, (by, bz), past_s, (ry, rz, gy, gz))
    else:
        ry, gy = ry - sv, gy - sdu
    kn, beta, ratio, friction = p.kn_n_m[i], p.beta_s[i], p.shear_ratio[i], p.friction[i]
    ahead = beta + p.lead * dt  # of the dashpots, and of springs that are taken beyond now
    ty, tz = -nz, ny
    rate, speed, way = -(ny * ry + nz * rz), ty * ry + tz * rz, ty * gy + tz * gz
    had = take(nodes.slip, i)
    grip = beta, 0.0 if p.tie[i] else ratio, friction  # of a bond: a tie transmits no shear
    spent = broken = none
    if some(holds):
        breaks = holds & bond_breaks(depth, had + way, (p.pull_m[i], p.hold_m[i]), grip)
        if some(breaks):
            spent = choose(breaks, kn * released(depth, had, grip[1]), 0.0)
            broken = choose(breaks, 1.0, none)
            had, way = choose(breaks, 0.0, had), choose(breaks, 0.0, way)
            holds, was = holds & ~breaks, was | breaks
            put(nodes.slip, i, had)
            put_where(nodes.state, i, breaks, OPEN)
    touching = touching & ~holds
    if past_s == 0.0:  # what touches at first has not just closed
        was = touching
    joint = beta, ratio, friction
    normal, shear, share, after, pressed, drags, stored, taken = node(
        depth, rate, speed, had, way, (touching, holds, was), (joint, grip), dt, p.drag[i]
    )
    put_where(nodes.state, i, touching, CLOSED)
    across = choose(pressed, ahead * kn, none)
    along = choose(drags, ahead * kn * ratio, none)
    acting = touching | holds
    put(nodes.slip, i, choose(acting, after, had))
    weight = share * kn
    fy = choose(acting, weight * (ny * normal - ty * shear), 0.0)
    fz = choose(acting, weight * (nz * normal - tz * shear), 0.0)
    if a >= 0:
        push(parts.force, a, 1.0, (fy, fz), (ay, az))
    else:
        put(parts.supports.fy, j, take(parts.supports.fy, j) + fy)
    if b >= 0:
        push(parts.force, b, -1.0, (fy, fz), (by, bz))
    else:
        put(parts.supports.fy, j, take(parts.supports.fy, j) - fy)
    turn_n, turn_t = (nz * ay - ny * az, nz * by - ny * bz), (tz * ay - ty * az, tz * by - ty * bz)
    resist(p, parts, a, b, (((ny, nz), turn_n, across), ((ty, tz), turn_t, along)))
    acting_j = choose(acting, kn * taken, 0.0), choose(acting, kn * stored, 0.0)
    return acting_j[1], spent, acting_j[0], broken


@inlined
def _links(p, parts, dt, elastic, spent):
    """Springs and dashpots along y between blocks, or to the ground; their energy added."""
    for i in range(p.link_a.size):
        a, b, dashpot = p.link_a[i], p.link_b[i], p.link_ns_m[i]
        stretch, rate = take(parts.place, 3 * a), take(parts.now, 3 * a)
        if b >= 0:
            stretch -= take(parts.place, 3 * b)
            rate -= take(parts.now, 3 * b)
        pull = p.link_n_m[i] * stretch + dashpot * rate
        put(parts.force, 3 * a, take(parts.force, 3 * a) - pull)
        put(parts.own, 6 * a, take(parts.own, 6 * a) + dashpot)
        if b >= 0:
            put(parts.force, 3 * b, take(parts.force, 3 * b) + pull)
            put(parts.own, 6 * b, take(parts.own, 6 * b) + dashpot)
        elastic += 0.5 * p.link_n_m[i] * stretch * stretch
        spent += dt * dashpot * rate * rate
    return elastic, spent


@inlined
def contact(p, whole, parts, turning, time, alive, counts, spent):
    """Forces of all nodes and links, and dashpots; see `march`."""
    _predict(p, parts, time, alive)
    nodes, supports = _nodes(p, parts.nodes), parts.supports
    elastic, taken = lines.press(p, parts, nodes.lines, nodes.held, time, alive, counts)
    stored, lost, broken = pieces.press(p, whole, parts, nodes.groups, time, alive, counts)
    elastic, spent = elastic + stored, spent + taken + lost
    for i in range(p.kn_n_m.size):
        now = take(nodes.state, i)
        live = alive & (now < GONE)
        if not some(live):
            continue
        a, b = p.body_a[i], p.body_b[i]
        j = p.support[i] if p.support[i] >= 0 else len(supports.y) - 1
        su = take(supports.y, j)
        ny, nz = like(p.normal[i, 0], su), like(p.normal[i, 1], su)
        ay, az = like(p.arm_a_m[i, 0], su), like(p.arm_a_m[i, 1], su)
        if a >= 0:
            ay, az = turned(parts.turn, a, (ay, az))
            py, pz = placed(p, parts, a, (ay, az))
        else:
            py, pz = ay + su, az
        by, bz = like(p.arm_b_m[i, 0], su), like(p.arm_b_m[i, 1], su)
        if b >= 0:
            ny, nz = turned(parts.turn, b, (ny, nz))
            cy, cz = turned(parts.turn, b, (by, bz))
            by, bz = beyond(p, parts, b, py, pz)
            depth = -ny * (by - cy) - nz * (bz - cz)
            oy, oz = p.rim[i, 0], p.rim[i, 1]
            if oy != 0.0 or oz != 0.0:
                ey, ez = turned(parts.turn, b, (oy, oz))
                out = live & (ey * by + ez * bz > p.rim_m[i])
                if some(out):
                    if not p.partial[i]:
                        _come_out(p, i, parts, nodes, out)
                    put_where(nodes.state, i, out, GONE)
                    slip, pressed = take(nodes.slip, i), max(depth, 0.0)
                    spent += 0.5 * p.kn_n_m[i] * p.shear_ratio[i] * (slip * slip)
                    spent += 0.5 * p.kn_n_m[i] * (pressed * pressed)
                    live = live & ~out
        else:
            depth = -ny * (py - by - su) - nz * (pz - bz)
        holds, was = live & (now > CLOSED), live & (now > OPEN) & (now < HOLDS)
        touching = live & ~(depth <= 0.0)
        opened = was & ~touching
        if some(opened):
            slip = take(nodes.slip, i)
            spent += 0.5 * p.kn_n_m[i] * p.shear_ratio[i] * (slip * slip)
            put_where(nodes.state, i, opened, OPEN)
            put_where(nodes.slip, i, opened, 0.0)
        acting = touching | holds
        if some(acting):
            if not alone(depth) and some(~(abs(depth) < math.inf)):
                # a block without a place: 0·∞ would be no 0
                ny, nz = choose(acting, ny, 0.0), choose(acting, nz, 0.0)
                ay, az = choose(acting, ay, 0.0), choose(acting, az, 0.0)
                by, bz = choose(acting, by, 0.0), choose(acting, bz, 0.0)
            where, arms = (ny, nz, depth), (ay, az, by, bz)
            acts = touching, holds, was
            stored, lost, taken, gone = _force(p, i, j, parts, nodes, where, arms, time, acts)
            elastic, spent, broken = elastic + stored, spent + lost + taken, broken + gone
    elastic, spent = _links(p, parts, time[2], elastic, spent)
    return elastic, spent, broken


@inlined
def _answer(p, parts, held, share):
    """Let supports feel what accelerations do to the forces on their blocks."""
    lines = p.lines
    for i in range(lines.half_m.size):
        a, b, j = lines.body_a[i], lines.body_b[i], lines.support[i]
        if (a >= 0 and b >= 0) or j < 0:
            continue
        at = 3 * max(a, b)
        back = take(held, 3 * i) * take(parts.rise, at)
        back += take(held, 3 * i + 1) * take(parts.rise, at + 1)
        back += take(held, 3 * i + 2) * take(parts.rise, at + 2)
        put(parts.supports.fy, j, take(parts.supports.fy, j) + share * back)


@inlined
def accelerate(p, parts, half, ag, gravity):
    """Accelerations of all blocks, with a block's own dashpots at the velocity of this step.

    Dashpots of `lines` act at v⁻ + ½h (late·a − (late − 1)·a⁻): in the middle of the step; where
    they would ring, at its end less what the last acceleration says of half of it, which keeps
    the second order. With `p.lead` springs of pieces act as far ahead: with K beside C in the
    matrix, (M + ½h late C + ½·lead·h²K)·a = F(x, v*) + ½h (late − 2 lead) C·a⁻ with
    v* = v⁻ + (½ − lead)h a⁻, at twice the lead Newmark's β. Supports feel what blocks feel.
    """
    damping, rise, force, nodes = parts.own, parts.rise, parts.force, _nodes(p, parts.nodes)
    before = 1.0  # the dashpots' part of what stands in `damping`
    if p.lead > 0.0 and half > 0.0:
        known = p.late - 2.0 * p.lead  # of the last acceleration in the rate at which they act
        before = known * p.beta / (p.late * p.beta + 2.0 * p.lead * half)
    chained = len(parts.ride.u) > 0
    if chained:
        _answer(p, parts, nodes.held, -half * before)
    for i in range(p.mass_kg.size):
        at, to = 3 * i, 6 * i
        mass, inertia = p.mass_kg[i], p.inertia_kg_m2[i]
        y, z = before * take(rise, at), before * take(rise, at + 1)
        turn = before * take(rise, at + 2)
        c00, c01, c02 = (
            half * take(damping, to),
            half * take(damping, to + 1),
            half * take(damping, to + 2),
        )
        c11, c12 = half * take(damping, to + 3), half * take(damping, to + 4)
        c22 = half * take(damping, to + 5)
        dashpots, was = (c00, c01, c02, c11, c12, c22), (y, z, turn)
        bars = take(parts.push, at), take(parts.push, at + 1), take(parts.push, at + 2)
        fy = take(force, at) + (bars[0] + dot((c00, c01, c02), was)) - mass * ag
        fz = take(force, at + 1) + (bars[1] + dot((c01, c11, c12), was)) - mass * gravity
        moment = take(force, at + 2) + (bars[2] + dot((c02, c12, c22), was))
        if not p.in_row:
            goes = take(nodes.goes, i) > 0.0
            free = goes & p.free[i, 0], goes & p.free[i, 1], goes & p.free[i, 2]
            accelerations = solved(dashpots, mass, inertia, free, (fy, fz, moment))
            for m in range(3):
                put(rise, at + m, accelerations[m])
        else:
            for m in range(3):
                put(rise, at + m, was[m])
                put(force, at + m, (fy, fz, moment)[m])
            for m in range(6):
                put(damping, to + m, dashpots[m])
    if p.in_row:
        between = parts.between
        for i in range(p.mass_kg.size - 1):
            low, high, at = 3 * i, 3 * i + 3, 9 * i
            lower, higher = three(rise, low, 1), three(rise, high, 1)
            for m in range(9):
                put(between, at + m, half * take(between, at + m))
            for m in range(3):
                row, column = three(between, at + 3 * m, 1), three(between, at + m, 3)
                put(force, low + m, take(force, low + m) + dot(row, higher))
                put(force, high + m, take(force, high + m) + dot(column, lower))
        solve_row(damping, between, parts.inverse, p.mass_kg, p.inertia_kg_m2, force)
        for row in range(len(force)):
            put(rise, row, take(force, row))
    if chained:
        _answer(p, parts, nodes.held, half)


@inlined
def monitor(p, parts):
    """Place and speed of the watched point that is farthest from where it stood."""
    d = v = like(0.0, take(parts.place, 0))
    for point in range(p.watched.size):
        block = p.watched[point]
        my, mz = p.monitor_m[point, 0], p.monitor_m[point, 1]
        cos, sin = take(parts.turn, 2 * block), take(parts.turn, 2 * block + 1)
        at = take(parts.place, 3 * block) + cos * my - sin * mz - my
        speed = take(parts.now, 3 * block) - take(parts.now, 3 * block + 2) * (sin * my + cos * mz)
        if point == 0:
            d, v = at, speed
        farther = ~(abs(at) <= abs(d))
        d, v = choose(farther, at, d), choose(farther, speed, v)
    return d, v


@inlined
def energies(p, parts, half, ag, gravity):
    """Of one history, see `march`; dashpots of nodes have been counted with their forces.

    A guide moves its block along y against what its nodes push.
    """
    kinetic = raised = power = 0.0
    lift = lone(gravity) - p.gravity_m_s2
    for i in range(p.mass_kg.size):
        mass, at = p.mass_kg[i], 3 * i
        for m in range(3):
            put(parts.now, at + m, take(parts.rate, at + m) + half * take(parts.rise, at + m))
        y, z = lone(take(parts.now, at)), lone(take(parts.now, at + 1))
        turn = lone(take(parts.now, at + 2))
        kinetic += 0.5 * mass * (y * y + z * z) + 0.5 * p.inertia_kg_m2[i] * turn * turn
        raised += mass * p.gravity_m_s2 * lone(take(parts.place, at + 1))
        power -= mass * (lone(ag) * y + lift * z)
    return kinetic, raised, power, lines.taken(p, parts, _nodes(p, parts.nodes).lines)


@looped
def march_stack(given, rows, scratch, every, series, weight):
    """One history of a `Stack`, see `march.advance`; its samples are of the first block."""
    what = contact, accelerate, monitor, energies
    return advance(what, given, rows, scratch, TO_THE_END, 0, every, series, weight)


@looped
def march_stacks(given, memory, scratch, case, motion, outcomes):
    """Histories of a `Stack` side by side, see `march.march_many`."""
    align_stack()
    what = contact, accelerate, monitor, energies
    march_many(what, given, memory, scratch, case, motion, outcomes)


STACK = Loop(march_stack, march_stacks, _start, 1)
