"""The compiled loop of one block for many amplitudes of one motion, side by side in vectors.

Each history is that of `kernel.march_block`, digit for digit, whoever stands beside it: the law,
the lines, dashpots and the solve are the same functions, and sums run in the same order. It leaves
out what a peak does not need, energy and rows, and takes dry joints on driven supports alone.

A chunk of `WIDTH` histories marches as one. Joints that are open in all of them are passed over,
closed forms are summed where one needs them, nodes visited where one touches. Histories that ended
leave their lanes idle until those that last fit into fewer chunks.
"""

import math

import numpy as np

from rocking.runtime.compiled import compiled, inlined

from .inputs import FAILED, OK, OVERTURNED
from .joints import _added, _line, untouched
from .kernel import _solve
from .law import dry
from .vectors import WIDTH, choose, put, some, take, wide

STRIDE = 256  # steps between two looks at which histories have ended
# Rows of a chunk's memory: pose, rates half a step back, accelerations; largest |d|, when it last
# moved, factor, end of the motion, failing speed; whether it goes on, its outcome and end
PEAK, MOVED, FACTOR, MOTION, FASTEST, ALIVE, STATUS, END, BLOCK = 9, 10, 11, 12, 13, 14, 15, 16, 17
# then three a support: place, velocity, way since the last step; then of each group, as `Touch`:
MOST, MORE, SUMS, DEPTH, SUMMED, GROUP = 0, 1, 3, 5, 7, 8  # DEPTH: its line at the last step
# and last the slip of each node


@inlined
def _set(groups, row, mask, value):
    put(groups, row, choose(mask, value, take(groups, row)))


@inlined
def _spread(p, groups, slip, g, mask):
    """Give the nodes of a summed group their slips back."""
    at = GROUP * g
    _set(groups, at + SUMMED, mask, 0.0)
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
    _set(groups, at + SUMMED, mask, 1.0)
    _set(groups, at + MOST, mask, top)
    _set(groups, at + MORE, mask, 0.0)
    _set(groups, at + MORE + 1, mask, 0.0)
    _set(groups, at + SUMS, mask, sum0)
    _set(groups, at + SUMS + 1, mask, sum1)


@inlined
def _whole(groups, g, mask, inertia, lines, law):
    """Resultants of summed groups, as `joints._whole` has them; nothing in the other lanes."""
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    beta, ratio = law
    k0, k1, k2, at = inertia[g, 0], inertia[g, 1], inertia[g, 2], GROUP * g
    sum0 = take(groups, at + SUMS) + (g0 * k0 + g1 * k1)
    sum1 = take(groups, at + SUMS + 1) + (g0 * k1 + g1 * k2)
    _set(groups, at + SUMS, mask, sum0)
    _set(groups, at + SUMS + 1, mask, sum1)
    _set(groups, at + MORE, mask, take(groups, at + MORE) + g0)
    _set(groups, at + MORE + 1, mask, take(groups, at + MORE + 1) + g1)
    h0, h1 = d0 + beta * q0, d1 + beta * q1
    normal = choose(mask, h0 * k0 + h1 * k1, 0.0), choose(mask, h0 * k1 + h1 * k2, 0.0)
    shear = (
        choose(mask, ratio * (sum0 + beta * (s0 * k0 + s1 * k1)), 0.0),
        choose(mask, ratio * (sum1 + beta * (s0 * k1 + s1 * k2)), 0.0),
    )
    acts = choose(mask, k0, 0.0), choose(mask, k1, 0.0), choose(mask, k2, 0.0)
    return normal, shear, acts, acts


@inlined
def _each(p, slip, g, touches, before, lines, dt, sums):
    """Resultants of the nodes that touch, one by one, added to `sums`; as `joints._each`.

    `touches` and `before` are penetrations along the line, now, less than zero where a lane is to
    be left alone, and at the last step.
    """
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    (n0, n1), (t0, t1), (u0, u1, u2), (w0, w1, w2) = sums
    ratio = p.shear_ratio[g]
    joint = p.beta_s[g], ratio, p.friction[g]
    low, high = p.first[g], p.first[g + 1]
    upper = high  # from here on up to the end nodes touch somewhere
    while upper > low and some(touches[0] + touches[1] * p.place_m[upper - 1] > 0.0):
        upper -= 1
    i = low
    while i < high:
        s, kn = p.place_m[i], p.kn_n_m[i]
        touching = touches[0] + touches[1] * s > 0.0
        if not some(touching):
            i = max(upper, i + 1)
            continue
        had, was = take(slip, i), before[0] + before[1] * s > 0.0
        normal, shear, share, kept, pressed, sticks, _, _ = dry(
            d0 + d1 * s,
            q0 + q1 * s,
            s0 + s1 * s,
            choose(touching & was, had, 0.0),
            choose(touching, g0 + g1 * s, 0.0),
            touching & ~was,
            joint,
            dt,
        )
        put(slip, i, choose(touching, kept, had))
        across = choose(touching & pressed, kn, 0.0)
        along = choose(touching & sticks, kn if ratio > 0.0 else 0.0, 0.0)
        u0, u1, u2 = u0 + across, u1 + across * s, u2 + across * s * s
        w0, w1, w2 = w0 + along, w1 + along * s, w2 + along * s * s
        weight = choose(touching, share * kn, 0.0)
        normal, shear = normal * weight, shear * weight
        n0, n1 = n0 + normal, n1 + normal * s
        t0, t1 = t0 + shear, t1 + shear * s
        i += 1
    return (n0, n1), (t0, t1), (u0, u1, u2), (w0, w1, w2)


@inlined
def _contact(p, inertia, supports, groups, slip, pose, rates, last, past_s, dt, alive):
    """Forces of all nodes on the blocks, and the dashpots that act; as `joints.block_contact`."""
    (py, pz, pt), (my, mz, mt) = rates, last
    none = wide(0.0)
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
        summed = take(groups, at + SUMMED) > 0.0
        before = take(groups, at + DEPTH), take(groups, at + DEPTH + 1)
        put(groups, at + DEPTH, d0)
        put(groups, at + DEPTH + 1, d1)
        if some(summed & ~whole):
            _spread(p, groups, slip, g, summed & ~whole)
            summed = summed & whole
        if not some(touch):
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
        each = touch & ~summed
        if some(each):
            touches = choose(each, d0, -1.0), choose(each, d1, 0.0)
            if past_s == 0.0:  # what touches at first has not just closed
                before = d0, d1
            sums = _each(p, slip, g, touches, before, lines, dt, sums)
            if some(each & whole):
                _sum(p, groups, slip, g, each & whole, 0.5 * friction * least / ratio)
        (n0, n1), (t0, t1), across, along = sums
        gy, gz = sign * (ny * n0 - ty * t0), sign * (nz * n0 - tz * t0)
        fy += gy
        fz += gz
        moment += ry * gz - rz * gy
        moment += sign * (ey * (nz * n1 - tz * t1) - ez * (ny * n1 - ty * t1))
        own = _added(own, (ry, rz, ey, ez), (ny, nz, ty, tz), (across, along), (beta, ratio))
    return (fy, fz, moment), own


@inlined
def _drive(table, factor, k, past_s, supports):
    """Move the supports to step k, as `inputs.drive`."""
    last = table.ground_m_s2.size - 1
    row = min(k, last)
    for j in range(table.place_m.shape[1]):
        speed, old = factor * table.speed_m_s[row, j], take(supports, 3 * j)
        place = factor * table.place_m[row, j]
        if k > last:
            place = old + past_s * speed
        put(supports, 3 * j, place)
        put(supports, 3 * j + 1, speed)
        put(supports, 3 * j + 2, place - old if k > 0 else 0.0 * place)


@inlined
def _judge(rules, chunk, k, dt, d, v, moved, alive):
    """Lanes that go on after step k, and when each last moved; as `inputs.verdict`.

    Outcome and end of those that do not go on are noted.
    """
    now = wide(k * dt)
    sound = (abs(v) <= take(chunk, FASTEST)) & (abs(d) < math.inf)
    fell = sound & (abs(d) >= rules.overturn_m)
    moves = (abs(v) > rules.rest_velocity_m_s) | (abs(d) > rules.rest_m)
    moved = choose(moves, now, moved)
    rests = ~moves & (now > take(chunk, MOTION)) & (now - moved > rules.rest_time_s)
    over = alive & (~sound | fell | rests)
    if k >= math.ceil(rules.limit_s / dt):
        over = alive
    if some(over):
        _set(chunk, END, over, now)
        status = choose(sound, choose(fell, wide(OVERTURNED), OK * 1.0), FAILED * 1.0)
        _set(chunk, STATUS, over, status)
        alive = alive & ~over
        put(chunk, ALIVE, choose(alive, wide(1.0), 0.0))
    return alive, moved


@inlined
def _advance(p, inertia, table, rules, chunk, begin, trig):
    """March a chunk over `STRIDE` steps from `begin`, or until all its histories have ended."""
    dt, last = table.step_s, table.ground_m_s2.size - 1
    first = BLOCK + 3 * (table.place_m.shape[1] + 1)
    supports = chunk[BLOCK:first]
    groups = chunk[first : first + GROUP * p.level_m.size]
    slip = chunk[first + GROUP * p.level_m.size :]
    y, z, turn = take(chunk, 0), take(chunk, 1), take(chunk, 2)
    vy, vz, spin = take(chunk, 3), take(chunk, 4), take(chunk, 5)
    ay, az, at = take(chunk, 6), take(chunk, 7), take(chunk, 8)
    peak, moved = take(chunk, PEAK), take(chunk, MOVED)
    factor, alive = take(chunk, FACTOR), take(chunk, ALIVE) > 0.0
    size, (my, mz) = abs(factor), (p.monitor_m[0], p.monitor_m[1])
    for k in range(begin, begin + STRIDE):
        half, past = (0.5 * dt, dt) if k > 0 else (0.0, 0.0)
        row = min(k, last)
        ag = factor * table.ground_m_s2[row]
        gravity = p.gravity_m_s2 + size * table.vertical_m_s2[row]
        _drive(table, factor, k, past, supports)
        rates = vy + half * ay, vz + half * az, spin + half * at
        put(trig, 0, turn)
        for lane in range(WIDTH):
            trig[1, lane], trig[2, lane] = math.cos(trig[0, lane]), math.sin(trig[0, lane])
        cos, sin = take(trig, 1), take(trig, 2)
        pose, behind = (y, z, cos, sin), (vy, vz, spin)
        force, own = _contact(
            p, inertia, supports, groups, slip, pose, rates, behind, past, dt, alive
        )
        d = y + cos * my - sin * mz - my
        v = rates[0] - rates[2] * (sin * my + cos * mz)
        ay, az, at = _solve(
            p.mass_kg, p.inertia_kg_m2, half, own, (ay, az, at), force, (ag, gravity)
        )
        peak = choose(alive & (abs(d) > peak), abs(d), peak)
        alive, moved = _judge(rules, chunk, k, dt, d, v, moved, alive)
        if not some(alive):
            break
        ahead = dt if k > 0 else 0.5 * dt
        vy, vz, spin = vy + ahead * ay, vz + ahead * az, spin + ahead * at
        y, z, turn = y + dt * vy, z + dt * vz, turn + dt * spin
    for row, value in enumerate((y, z, turn, vy, vz, spin, ay, az, at, peak, moved)):
        put(chunk, row, value)


@compiled
def march_lanes(p, table, factors, rules, motion_s, max_speed_m_s):
    """Advance the histories of all factors until a rule ends each: as `kernel.march_block`.

    Parameters
    ----------
    p : Planar
        Without bonds, ties and floors.
    table, rules
        As there.
    factors, motion_s, max_speed_m_s : ndarray, shape (cases,)

    Returns
    -------
    ndarray, shape (cases, 3)
        Peak [m], status, end [s].
    """
    chunks = (factors.size + WIDTH - 1) // WIDTH
    inertia, trig = untouched(p).inertia, np.zeros((3, WIDTH))
    first = BLOCK + 3 * (table.place_m.shape[1] + 1)
    rows = first + GROUP * p.level_m.size + p.place_m.size
    memory, case = np.zeros((chunks, rows, WIDTH)), np.full((chunks, WIDTH), -1)
    found = np.zeros((factors.size, 3))
    for i in range(factors.size):
        c, lane = divmod(i, WIDTH)
        case[c, lane] = i
        memory[c, :6, lane] = p.start
        memory[c, FACTOR, lane], memory[c, ALIVE, lane] = factors[i], 1.0
        memory[c, MOTION, lane], memory[c, FASTEST, lane] = motion_s[i], max_speed_m_s[i]
    k = 0
    while chunks > 0:
        left = 0
        for c in range(chunks):
            _advance(p, inertia, table, rules, memory[c], k, trig)
            for lane in range(WIDTH):
                i = case[c, lane]
                if i >= 0 and memory[c, ALIVE, lane] == 0.0:
                    found[i, 0], found[i, 1] = memory[c, PEAK, lane], memory[c, STATUS, lane]
                    found[i, 2] = memory[c, END, lane]
                    case[c, lane] = -1
                left += case[c, lane] >= 0
        k += STRIDE
        fewer = (left + WIDTH - 1) // WIDTH
        free = 0  # lanes before this one are taken
        for at in range(fewer * WIDTH, chunks * WIDTH):
            c, lane = divmod(at, WIDTH)
            if case[c, lane] < 0:
                continue
            while case[free // WIDTH, free % WIDTH] >= 0:
                free += 1
            to, there = divmod(free, WIDTH)
            case[to, there] = case[c, lane]
            memory[to, :, there] = memory[c, :, lane]
        chunks = fewer
    return found
