"""The compiled loop of one block for many amplitudes of one motion, side by side in vectors.

Each history is that of `kernel.march_block`, digit for digit, whoever stands beside it: the law,
the lines, dashpots and the solve are the same functions, and sums run in the same order. It leaves
out what a peak does not need, energy and rows, and takes joints on driven supports alone.

Joints that are open in all histories of a chunk (`chunks`) are passed over, closed forms are summed
where one needs them, nodes visited where one touches.
"""

import math

import numpy as np

from rocking.runtime.compiled import compiled, inlined

from .chunks import march
from .joints import _added, _line, untouched
from .kernel import _solve
from .law import bond_breaks, bonded, dry
from .vectors import WIDTH, choose, put, put_where, rows_of_lanes, some, take, wide

# Rows of the block: pose, rates half a step back, accelerations; then of each group, as `Touch`:
BLOCK = 9
MOST, MORE, SUMS, DEPTH, SUMMED, BONDS, GROUP = 0, 1, 3, 5, 7, 8, 9  # DEPTH: line a step ago
# and last the slip of each node, and of scenes with bonds whether it is intact


@inlined
def _spread(p, groups, slip, g, mask):
    """Give the nodes of a summed group their slips back."""
    at = GROUP * g
    put_where(groups, at + SUMMED, mask, 0.0)
    more0, more1 = take(groups, at + MORE), take(groups, at + MORE + 1)
    for i in range(p.first[g], p.first[g + 1]):
        own = take(slip, i)
        put(slip, i, choose(mask, own + (more0 + more1 * p.place_m[i]), own))


@inlined
def _sum(p, groups, slip, g, mask, most):
    """Bring a group into closed form where all its slips are less than `most`."""
    low, high, top = p.first[g], p.first[g + 1], wide(0.0)
    for i in range(low, high):
        top = max(top, abs(take(slip, i)))
    mask = mask & (top < most)
    if not some(mask):
        return
    sum0, sum1 = wide(0.0), wide(0.0)
    for i in range(low, high):
        stored = p.kn_n_m[i] * take(slip, i)
        sum0 += stored
        sum1 += stored * p.place_m[i]
    at = GROUP * g
    put_where(groups, at + SUMMED, mask, 1.0)
    put_where(groups, at + MOST, mask, top)
    put_where(groups, at + MORE, mask, 0.0)
    put_where(groups, at + MORE + 1, mask, 0.0)
    put_where(groups, at + SUMS, mask, sum0)
    put_where(groups, at + SUMS + 1, mask, sum1)


@inlined
def _whole(groups, g, mask, inertia, lines, law):
    """Resultants of summed groups, as `joints._whole` has them; nothing in the other lanes."""
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    beta, ratio = law
    k0, k1, k2, at = inertia[g, 0], inertia[g, 1], inertia[g, 2], GROUP * g
    sum0 = take(groups, at + SUMS) + (g0 * k0 + g1 * k1)
    sum1 = take(groups, at + SUMS + 1) + (g0 * k1 + g1 * k2)
    put_where(groups, at + SUMS, mask, sum0)
    put_where(groups, at + SUMS + 1, mask, sum1)
    put_where(groups, at + MORE, mask, take(groups, at + MORE) + g0)
    put_where(groups, at + MORE + 1, mask, take(groups, at + MORE + 1) + g1)
    h0, h1 = d0 + beta * q0, d1 + beta * q1
    normal = choose(mask, h0 * k0 + h1 * k1, 0.0), choose(mask, h0 * k1 + h1 * k2, 0.0)
    shear = (
        choose(mask, ratio * (sum0 + beta * (s0 * k0 + s1 * k1)), 0.0),
        choose(mask, ratio * (sum1 + beta * (s0 * k1 + s1 * k2)), 0.0),
    )
    acts = choose(mask, k0, 0.0), choose(mask, k1, 0.0), choose(mask, k2, 0.0)
    return normal, shear, acts, acts


@inlined
def _break(p, i, g, groups, slip, intact, holds, depth, step, joint):
    """Break a node's bonds in the lanes where they reach their strength; where it holds, breaks."""
    strength = p.pull_m[i], p.hold_m[i]
    breaks = holds & bond_breaks(depth, take(slip, i) + step, strength, joint)
    if some(breaks):
        put_where(intact, i, breaks, 0.0)
        put_where(slip, i, breaks, 0.0)
        left = GROUP * g + BONDS
        put_where(groups, left, breaks, take(groups, left) - 1.0)
    return holds & ~breaks, breaks


@inlined
def _each(p, groups, nodes, g, touches, before, bound, lines, dt, sums):
    """Resultants of the nodes that touch or hold, one by one, added to `sums`; as `joints._each`.

    `touches` and `before` are penetrations along the line, now, less than zero where a lane is to
    be left alone, and at the last step; `bound`: lanes in which the group has bonds left.
    """
    (slip, intact), none = nodes, wide(0.0)
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    (n0, n1), (t0, t1), (u0, u1, u2), (w0, w1, w2) = sums
    ratio = p.shear_ratio[g]
    joint = p.beta_s[g], ratio, p.friction[g]
    low, high = p.first[g], p.first[g + 1]
    tied = some(bound)
    upper = low if tied else high  # from here on up to the end nodes touch somewhere
    while upper > low and some(touches[0] + touches[1] * p.place_m[upper - 1] > 0.0):
        upper -= 1
    i = low
    while i < high:
        s, kn = p.place_m[i], p.kn_n_m[i]
        touching = touches[0] + touches[1] * s > 0.0
        holds = breaks = touching & ~touching
        if tied:
            holds = bound & (take(intact, i) > 0.0)
        acts = touching | holds
        if not some(acts):
            i = max(upper, i + 1)
            continue
        depth, rate, speed, step = d0 + d1 * s, q0 + q1 * s, s0 + s1 * s, g0 + g1 * s
        grip = joint  # of a bond: a tie transmits no shear
        if tied and some(holds):
            if p.tie[i]:
                grip = joint[0], 0.0, joint[2]
            holds, breaks = _break(p, i, g, groups, slip, intact, holds, depth, step, grip)
            acts = touching | holds
            step = choose(breaks, 0.0, step)
            touching = touching & ~holds
        had = kept = take(slip, i)
        normal = shear = share = across = along = none
        if some(touching):
            was = before[0] + before[1] * s > 0.0
            normal, shear, share, kept, pressed, sticks, _, _ = dry(
                depth,
                rate,
                speed,
                choose(touching & was, had, 0.0),
                choose(touching, step, 0.0),
                touching & ~was,
                joint,
                dt,
            )
            along = choose(touching & sticks, kn if ratio > 0.0 else 0.0, 0.0)
            across = choose(touching & pressed, kn, 0.0)
        if tied and some(holds):
            pull, drag, whole, held, _, _, _, _ = bonded(depth, rate, speed, had + step, grip, dt)
            normal, shear = choose(holds, pull, normal), choose(holds, drag, shear)
            share, kept = choose(holds, whole, share), choose(holds, held, kept)
            along = choose(holds, kn if grip[1] > 0.0 else 0.0, along)
            across = choose(holds, kn, across)
        put(slip, i, choose(acts, kept, had))
        u0, u1, u2 = u0 + across, u1 + across * s, u2 + across * s * s
        w0, w1, w2 = w0 + along, w1 + along * s, w2 + along * s * s
        weight = choose(acts, share * kn, 0.0)
        normal, shear = normal * weight, shear * weight
        n0, n1 = n0 + normal, n1 + normal * s
        t0, t1 = t0 + shear, t1 + shear * s
        i += 1
    return (n0, n1), (t0, t1), (u0, u1, u2), (w0, w1, w2)


@inlined
def _contact(p, inertia, supports, groups, nodes, pose, rates, last, past_s, dt, alive):
    """Forces of all nodes on the blocks, and the dashpots that act; as `joints.block_contact`."""
    (py, pz, pt), (my, mz, mt) = rates, last
    none, slip = wide(0.0), nodes[0]
    fy, fz, moment = none, none, none
    own = none, none, none, none, none, none
    for g in range(p.level_m.size):
        j = p.support[g] if p.support[g] >= 0 else len(supports) // 3 - 1
        at, place = GROUP * g, take(supports, 3 * j)
        sign, ny, nz, ry, rz, ey, ez, d0, d1 = _line(p, g, pose, place, none, 0.0)
        d0, d1 = choose(alive, d0, -1.0), choose(alive, d1, 0.0)
        s_low, s_high = p.place_m[p.first[g]], p.place_m[p.first[g + 1] - 1]
        below, above = d0 + d1 * s_low > 0.0, d0 + d1 * s_high > 0.0
        touch, whole = below | above, below & above
        bound = alive & (take(groups, at + BONDS) > 0.0)  # bonds act wherever they are
        summed = take(groups, at + SUMMED) > 0.0
        before = take(groups, at + DEPTH), take(groups, at + DEPTH + 1)
        put(groups, at + DEPTH, d0)
        put(groups, at + DEPTH + 1, d1)
        if some(summed & ~whole):
            _spread(p, groups, slip, g, summed & ~whole)
            summed = summed & whole
        if not some(touch | bound):
            continue
        ty, tz = -nz, ny
        vy, vz = py - pt * rz - take(supports, 3 * j + 1), pz + pt * ry
        uy, uz = past_s * (my - mt * rz) - take(supports, 3 * j + 2), past_s * (mz + mt * ry)
        turn_n, turn_t = nz * ey - ny * ez, tz * ey - ty * ez
        q0, q1 = -sign * (ny * vy + nz * vz), -sign * pt * turn_n
        s0, s1 = sign * (ty * vy + tz * vz), sign * pt * turn_t
        g0, g1 = sign * (ty * uy + tz * uz), sign * past_s * mt * turn_t
        lines = d0, d1, q0, q1, s0, s1, g0, g1
        beta, ratio, friction = p.beta_s[g], p.shear_ratio[g], p.friction[g]
        h0, h1 = d0 + beta * q0, d1 + beta * q1
        least = min(h0 + h1 * s_low, h0 + h1 * s_high)
        if some(summed):
            most = take(groups, at + MOST) + abs(take(groups, at + MORE) + g0)
            most += abs(take(groups, at + MORE + 1) + g1) * inertia[g, 3]
            slides = summed & (ratio * most > friction * least)
            if some(slides):
                _spread(p, groups, slip, g, slides)
                summed = summed & ~slides
        sums = (none, none), (none, none), (none, none, none), (none, none, none)
        if some(summed):
            sums = _whole(groups, g, summed, inertia, lines, (beta, ratio))
        each = (touch | bound) & ~summed
        if some(each):
            touches = choose(each, d0, -1.0), choose(each, d1, 0.0)
            if past_s == 0.0:  # what touches at first has not just closed
                before = d0, d1
            sums = _each(p, groups, nodes, g, touches, before, bound, lines, dt, sums)
            ready = each & (whole | bound) & (take(groups, at + BONDS) <= 0.0)
            if some(ready):
                _sum(p, groups, slip, g, ready, 0.5 * friction * least / ratio)
        (n0, n1), (t0, t1), across, along = sums
        gy, gz = sign * (ny * n0 - ty * t0), sign * (nz * n0 - tz * t0)
        fy += gy
        fz += gz
        moment += ry * gz - rz * gy
        moment += sign * (ey * (nz * n1 - tz * t1) - ez * (ny * n1 - ty * t1))
        own = _added(own, (ry, rz, ey, ez), (ny, nz, ty, tz), (across, along), (beta, ratio))
    return (fy, fz, moment), own


@inlined
def _step(p, room, supports, state, alive, goes_on, field, time):
    """Move the block on by a step; place and speed of its monitored point before."""
    (inertia, trig), (half, past, ahead, dt) = room, time
    my, mz = p.monitor_m[0], p.monitor_m[1]
    rest = BLOCK + GROUP * p.level_m.size
    slips = rest + p.place_m.size
    groups, nodes = state[BLOCK:rest], (state[rest:slips], state[slips:])
    y, z, turn = take(state, 0), take(state, 1), take(state, 2)
    vy, vz, spin = take(state, 3), take(state, 4), take(state, 5)
    ay, az, at = take(state, 6), take(state, 7), take(state, 8)
    rates = vy + half * ay, vz + half * az, spin + half * at
    put(trig, 0, turn)
    for lane in range(WIDTH):
        trig[1, lane], trig[2, lane] = math.cos(trig[0, lane]), math.sin(trig[0, lane])
    cos, sin = take(trig, 1), take(trig, 2)
    pose, behind = (y, z, cos, sin), (vy, vz, spin)
    force, dashpots = _contact(
        p, inertia, supports, groups, nodes, pose, rates, behind, past, dt, alive
    )
    d = y + cos * my - sin * mz - my
    v = rates[0] - rates[2] * (sin * my + cos * mz)
    ay, az, at = _solve(p.mass_kg, p.inertia_kg_m2, half, dashpots, (ay, az, at), force, field)
    vy, vz, spin = vy + ahead * ay, vz + ahead * az, spin + ahead * at
    y, z, turn = y + dt * vy, z + dt * vz, turn + dt * spin
    for row, value in enumerate((y, z, turn, vy, vz, spin, ay, az, at)):
        put(state, row, value)
    return d, v


@compiled
def march_lanes(p, table, factors, rules, motion_s, max_speed_m_s):
    """Advance the histories of all factors until a rule ends each, as `chunks.march`.

    `p` is a `Planar` without ties and floors.
    """
    fresh, nodes = untouched(p), p.place_m.size
    rest = BLOCK + GROUP * p.level_m.size
    state = np.zeros(rest + (2 * nodes if p.bonded.any() else nodes))
    state[:6] = p.start
    for g in range(p.level_m.size):
        state[BLOCK + GROUP * g + BONDS] = fresh.bonds[g]
    for i in range(state.size - rest - nodes):
        state[rest + nodes + i] = p.bonded[i]
    room = fresh.inertia, rows_of_lanes(3)
    return march(_step, p, room, state, table, factors, rules, motion_s, max_speed_m_s)
