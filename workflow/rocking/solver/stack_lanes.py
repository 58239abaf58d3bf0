"""The compiled loop of several blocks for many amplitudes of one motion, side by side in vectors.

Each history is that of `stack_kernel.march_stack`, digit for digit, whoever stands beside it: node
by node in the same order, by the functions of `law`. It leaves out what a peak does not need,
energy and rows, and takes neither links, ties and floors nor blocks in a row.
"""

import math

import numpy as np

from rocking.runtime.compiled import compiled, inlined

from .chunks import march
from .dashpots import solved
from .law import bond_breaks, bonded, dry
from .vectors import WIDTH, choose, put, put_where, rows_of_lanes, some, take, wide

# Rows of a block: y, z and turn, rates half a step back, accelerations, whether it still moves;
# after all blocks the slip of each node, then its state, one of:
PLACE, RATE, RISE, GOES, BLOCK = 0, 3, 6, 9, 10
OPEN, CLOSED, HOLDS, GONE = 0.0, 1.0, 2.0, 3.0
# of a step: cosine and sine, rates at the whole step, forces, dashpots
TURN, RATES, FORCE, OWN, STEP = 0, 2, 5, 8, 14


@inlined
def _add(rows, row, value):
    put(rows, row, take(rows, row) + value)


@inlined
def _damp(step, at, y, z, arm, dashpot):
    """Add a dashpot along (y, z), as `dashpots.damp`."""
    cy, cz, ct = dashpot * y, dashpot * z, dashpot * arm
    _add(step, at + OWN, cy * y)
    _add(step, at + OWN + 1, cy * z)
    _add(step, at + OWN + 2, cy * arm)
    _add(step, at + OWN + 3, cz * z)
    _add(step, at + OWN + 4, cz * arm)
    _add(step, at + OWN + 5, ct * arm)


@inlined
def _come_out(p, i, state, blocks, out):
    """Take the debris that meets node i out of the scene in some lanes, with all its nodes."""
    for block in (p.body_a[i], p.body_b[i]):
        if block < 0 or not p.debris[block] or not p.free[block].any():
            continue
        at = BLOCK * block
        falls = out & (take(blocks, at + GOES) > 0.0)
        if not some(falls):
            continue
        for row in range(at + RATE, at + BLOCK):
            put_where(blocks, row, falls, 0.0)
        for other in range(p.body_a.size):
            if p.body_a[other] == block or p.body_b[other] == block:
                put_where(state, other, falls, GONE)


@inlined
def _force(p, i, ids, kept, blocks, step, moving, where, arms, past_s, dt, acts):
    """What node i does to its blocks in the lanes where it acts."""
    (a, b), (slip, state), (sv, sdu) = ids, kept, moving
    (ny, nz, depth), (ay, az, by, bz) = where, arms
    touching, holds, was = acts
    none = wide(0.0)
    if a >= 0:
        at, of = BLOCK * a + RATE, STEP * a + RATES
        spin, turn = take(step, of + 2), take(blocks, at + 2)
        ry, rz = take(step, of) - spin * az, take(step, of + 1) + spin * ay
        gy = past_s * (take(blocks, at) - turn * az)
        gz = past_s * (take(blocks, at + 1) + turn * ay)
    else:
        ry, rz, gy, gz = sv, none, sdu, none
    if b >= 0:
        at, of = BLOCK * b + RATE, STEP * b + RATES
        spin, turn = take(step, of + 2), take(blocks, at + 2)
        ry, rz = ry - take(step, of) + spin * bz, rz - take(step, of + 1) - spin * by
        gy -= past_s * (take(blocks, at) - turn * bz)
        gz -= past_s * (take(blocks, at + 1) + turn * by)
    else:
        ry, gy = ry - sv, gy - sdu
    kn, beta, ratio, friction = p.kn_n_m[i], p.beta_s[i], p.shear_ratio[i], p.friction[i]
    ty, tz = -nz, ny
    rate, speed, way = -(ny * ry + nz * rz), ty * ry + tz * rz, ty * gy + tz * gz
    had = take(slip, i)
    grip = beta, 0.0 if p.tie[i] else ratio, friction  # of a bond: a tie transmits no shear
    if some(holds):
        breaks = holds & bond_breaks(depth, had + way, (p.pull_m[i], p.hold_m[i]), grip)
        if some(breaks):
            had, way = choose(breaks, 0.0, had), choose(breaks, 0.0, way)
            holds, was = holds & ~breaks, was | breaks
            put(slip, i, had)
            put_where(state, i, breaks, OPEN)
    touching = touching & ~holds
    if past_s == 0.0:  # what touches at first has not just closed
        was = touching
    own, joint = choose(touching, way, 0.0), (beta, ratio, friction)
    normal, shear, share, after, pressed, sticks, _, _ = dry(
        depth, rate, speed, had, own, touching & ~was, joint, dt
    )
    put_where(state, i, touching, CLOSED)
    across = choose(touching & pressed, beta * kn, 0.0)
    along = choose(touching & sticks, beta * kn * ratio, 0.0)
    if some(holds):
        pull, drag, whole, held, _, _, _, _ = bonded(depth, rate, speed, had + way, grip, dt)
        normal, shear = choose(holds, pull, normal), choose(holds, drag, shear)
        share, after = choose(holds, whole, share), choose(holds, held, after)
        across = choose(holds, beta * kn, across)
        along = choose(holds, beta * kn * grip[1], along)
    acting = touching | holds
    put(slip, i, choose(acting, after, had))
    weight = share * kn
    fy = choose(acting, weight * (ny * normal - ty * shear), 0.0)
    fz = choose(acting, weight * (nz * normal - tz * shear), 0.0)
    if a >= 0:
        at = STEP * a
        _add(step, at + FORCE, fy)
        _add(step, at + FORCE + 1, fz)
        _add(step, at + FORCE + 2, ay * fz - az * fy)
        _damp(step, at, ny, nz, nz * ay - ny * az, across)
        _damp(step, at, ty, tz, tz * ay - ty * az, along)
    if b >= 0:
        at = STEP * b
        _add(step, at + FORCE, -fy)
        _add(step, at + FORCE + 1, -fz)
        _add(step, at + FORCE + 2, -(by * fz - bz * fy))
        _damp(step, at, ny, nz, nz * by - ny * bz, across)
        _damp(step, at, ty, tz, tz * by - ty * bz, along)


@inlined
def _contact(p, supports, blocks, kept, step, past_s, dt, alive):
    """Forces of all nodes on the blocks, and the dashpots that act."""
    slip, state = kept
    still = len(supports) // 3 - 1
    for i in range(p.kn_n_m.size):
        now = take(state, i)
        live = alive & (now < GONE)
        if not some(live):
            continue
        a, b = p.body_a[i], p.body_b[i]
        j = 3 * (p.support[i] if p.support[i] >= 0 else still)
        su, moving = take(supports, j), (take(supports, j + 1), take(supports, j + 2))
        ny, nz = wide(p.normal[i, 0]), wide(p.normal[i, 1])
        ay, az = wide(p.arm_a_m[i, 0]), wide(p.arm_a_m[i, 1])
        if a >= 0:
            cos, sin = take(step, STEP * a), take(step, STEP * a + 1)
            ay, az = cos * ay - sin * az, sin * ay + cos * az
            py = p.centre_m[a, 0] + take(blocks, BLOCK * a) + ay
            pz = p.centre_m[a, 1] + take(blocks, BLOCK * a + 1) + az
        else:
            py, pz = ay + su, az
        by, bz = wide(p.arm_b_m[i, 0]), wide(p.arm_b_m[i, 1])
        if b >= 0:
            cos, sin = take(step, STEP * b), take(step, STEP * b + 1)
            ny, nz = cos * ny - sin * nz, sin * ny + cos * nz
            cy, cz = cos * by - sin * bz, sin * by + cos * bz
            by = py - p.centre_m[b, 0] - take(blocks, BLOCK * b)
            bz = pz - p.centre_m[b, 1] - take(blocks, BLOCK * b + 1)
            depth = -ny * (by - cy) - nz * (bz - cz)
            oy, oz = p.rim[i, 0], p.rim[i, 1]
            if oy != 0.0 or oz != 0.0:
                far = (cos * oy - sin * oz) * by + (sin * oy + cos * oz) * bz
                out = live & (far > p.rim_m[i])
                if some(out):
                    if not p.partial[i]:
                        _come_out(p, i, state, blocks, out)
                    put_where(state, i, out, GONE)
                    live = live & ~out
        else:
            depth = -ny * (py - by - su) - nz * (pz - bz)
        holds, was = live & (now > CLOSED), live & (now > OPEN) & (now < HOLDS)
        touching = live & ~(depth <= 0.0)
        opened = was & ~touching
        if some(opened):
            put_where(state, i, opened, OPEN)
            put_where(slip, i, opened, 0.0)
        acting = touching | holds
        if some(acting):
            if some(~(abs(depth) < math.inf)):  # a block without a place: 0·∞ would be no 0
                ny, nz = choose(acting, ny, 0.0), choose(acting, nz, 0.0)
                ay, az = choose(acting, ay, 0.0), choose(acting, az, 0.0)
                by, bz = choose(acting, by, 0.0), choose(acting, bz, 0.0)
            where, arms = (ny, nz, depth), (ay, az, by, bz)
            acts = touching, holds, was
            _force(p, i, (a, b), kept, blocks, step, moving, where, arms, past_s, dt, acts)


@inlined
def _predict(p, supports, blocks, step, goes_on, half, dt):
    """Rates at the whole step, cosines and sines of all blocks; forces and dashpots at nothing."""
    for block in range(p.mass_kg.size):
        at, to = BLOCK * block, STEP * block
        for m in range(3):
            rate = take(blocks, at + RATE + m) + half * take(blocks, at + RISE + m)
            put(step, to + RATES + m, rate)
        if p.guide[block] >= 0:
            j = 3 * p.guide[block]
            put(blocks, at, take(supports, j))
            put(step, to + RATES, take(supports, j + 1))
            put(blocks, at + RATE, take(supports, j + 2) / dt)
        for lane in range(WIDTH):
            if goes_on[lane] > 0.0:
                turn = blocks[at + 2, lane]
                step[to, lane], step[to + 1, lane] = math.cos(turn), math.sin(turn)
        for row in range(to + FORCE, to + STEP):
            put(step, row, wide(0.0))


@inlined
def _accelerate(p, blocks, step, half, ag, gravity):
    """Accelerations of all blocks, with a block's own dashpots at the velocity of this step."""
    for block in range(p.mass_kg.size):
        at, to = BLOCK * block, STEP * block
        y, z, turn = (
            take(blocks, at + RISE),
            take(blocks, at + RISE + 1),
            take(blocks, at + RISE + 2),
        )
        c00, c01 = take(step, to + OWN) * half, take(step, to + OWN + 1) * half
        c02, c11 = take(step, to + OWN + 2) * half, take(step, to + OWN + 3) * half
        c12, c22 = take(step, to + OWN + 4) * half, take(step, to + OWN + 5) * half
        fy = take(step, to + FORCE) + (c00 * y + c01 * z + c02 * turn)
        fz = take(step, to + FORCE + 1) + (c01 * y + c11 * z + c12 * turn)
        moment = take(step, to + FORCE + 2) + (c02 * y + c12 * z + c22 * turn)
        force = fy - p.mass_kg[block] * ag, fz - p.mass_kg[block] * gravity, moment
        goes = take(blocks, at + GOES) > 0.0
        stays = goes & ~goes
        free = (
            goes if p.free[block, 0] else stays,
            goes if p.free[block, 1] else stays,
            goes if p.free[block, 2] else stays,
        )
        y, z, turn = solved(
            (c00, c01, c02, c11, c12, c22), p.mass_kg[block], p.inertia_kg_m2[block], free, force
        )
        put(blocks, at + RISE, y)
        put(blocks, at + RISE + 1, z)
        put(blocks, at + RISE + 2, turn)


@inlined
def _monitor(p, blocks, step):
    """Place and speed of the watched point that is farthest from where it stood."""
    d, v = wide(0.0), wide(0.0)
    for point in range(p.watched.size):
        block = p.watched[point]
        my, mz = p.monitor_m[point, 0], p.monitor_m[point, 1]
        to = STEP * block
        cos, sin = take(step, to), take(step, to + 1)
        at = take(blocks, BLOCK * block) + cos * my - sin * mz - my
        speed = take(step, to + RATES) - take(step, to + RATES + 2) * (sin * my + cos * mz)
        if point == 0:
            d, v = at, speed
        farther = ~(abs(at) <= abs(d))
        d, v = choose(farther, at, d), choose(farther, speed, v)
    return d, v


@inlined
def _step(p, step, supports, state, alive, goes_on, field, time):
    """Move all blocks on by a step; place and speed of the watched point before."""
    (half, past, ahead, dt), count = time, p.kn_n_m.size
    rest = BLOCK * p.mass_kg.size
    blocks, kept = state[:rest], (state[rest : rest + count], state[rest + count :])
    _predict(p, supports, blocks, step, goes_on, half, dt)
    _contact(p, supports, blocks, kept, step, past, dt, alive)
    _accelerate(p, blocks, step, half, *field)
    d, v = _monitor(p, blocks, step)
    for at in range(0, rest, BLOCK):
        for m in range(at, at + 3):
            rate = take(blocks, m + RATE) + ahead * take(blocks, m + RISE)
            put(blocks, m + RATE, rate)
            put(blocks, m, take(blocks, m) + dt * rate)
    return d, v


@compiled
def march_stack_lanes(p, table, factors, rules, motion_s, max_speed_m_s):
    """Advance the histories of all factors until a rule ends each, as `chunks.march`.

    `p` is a `Stack` without links, ties and floors, its blocks not in a row.
    """
    size, count = p.mass_kg.size, p.kn_n_m.size
    state = np.zeros(BLOCK * size + 2 * count)
    for block in range(size):
        at = BLOCK * block
        state[at + PLACE : at + RISE] = p.start[block]
        state[at + GOES] = 1.0
    for i in range(count):
        state[BLOCK * size + count + i] = HOLDS if p.bonded[i] else OPEN
    step = rows_of_lanes(STEP * size)
    return march(_step, p, step, state, table, factors, rules, motion_s, max_speed_m_s)
