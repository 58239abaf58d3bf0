"""The two faces of a straight joint between blocks: how deep they are, and how they move.

The line turns with block a, the plane that it meets with block b; −1 for either is a support, which
moves along y alone. What one is to the other is linear along the line, a0 + a1·s.
"""

from rocking.runtime.compiled import inlined

from .dashpots import apart, beyond, placed, push, rates, turned
from .joints import added
from .vectors import alone, choose, like, minus, plus, put, take


@inlined
def met(p, joints, i, parts, alive):
    """Where joint i of `pieces.Groups` or `lines.Lines` is.

    Blocks a and b and the support; arms of the line's origin from the centroids of a and b; the
    plane's normal and the line's direction; d0, d1, less than nothing in histories that have ended.
    """
    supports = parts.supports
    a, b = joints.body_a[i], joints.body_b[i]
    j = joints.support[i] if joints.support[i] >= 0 else len(supports.y) - 1
    su = take(supports.y, j)
    ry, rz = like(joints.origin_m[i, 0], su), like(joints.origin_m[i, 1], su)
    ey, ez = like(joints.along[i, 0], su), like(joints.along[i, 1], su)
    ny, nz = like(joints.normal[i, 0], su), like(joints.normal[i, 1], su)
    py, pz = ry + su, rz
    if a >= 0:
        ry, rz = turned(parts.turn, a, (ry, rz))
        ey, ez = turned(parts.turn, a, (ey, ez))
        py, pz = placed(p, parts, a, (ry, rz))
    by, bz = py - su, pz
    if b >= 0:
        ny, nz = turned(parts.turn, b, (ny, nz))
        by, bz = beyond(p, parts, b, py, pz)
    d0, d1 = minus(minus(joints.level_m[i], ny, by), nz, bz), -plus(ny * ey, nz, ez)
    if not alone(d0):
        d0, d1 = choose(alive, d0, -1.0), choose(alive, d1, 0.0)
    return (a, b, j), ((ry, rz), (by, bz)), (ny, nz), (ey, ez), (d0, d1)


@inlined
def moving(parts, ends, arms, normal, along, past_s):
    """How the faces move.

    What an arm along the line has across it and along it; rate of penetration, rate of slip and
    slip of this step, each as a0, a1.
    """
    (a, b, j), (near, far), (ny, nz), (ey, ez) = ends, arms, normal, along
    supports, (ty, tz) = parts.supports, (-nz, ny)
    spin = turn = like(0.0, ny)
    vy, vz, uy, uz = take(supports.vy, j), spin, take(supports.dy, j), spin
    if a >= 0:
        vy, vz, uy, uz = rates(parts, a, near, past_s)
        spin, turn = take(parts.now, 3 * a + 2), past_s * take(parts.rate, 3 * a + 2)
    if b >= 0:
        vy, vz, uy, uz = apart(parts, b, far, past_s, (vy, vz, uy, uz))
        spin = spin - take(parts.now, 3 * b + 2)
        turn = turn - past_s * take(parts.rate, 3 * b + 2)
    else:
        vy, uy = vy - take(supports.vy, j), uy - take(supports.dy, j)
    across, within = minus(nz * ey, ny, ez), minus(tz * ey, ty, ez)
    q0, q1 = -plus(ny * vy, nz, vz), -spin * across
    s0, s1 = plus(ty * vy, tz, vz), spin * within
    g0, g1 = plus(ty * uy, tz, uz), turn * within
    return (across, within), (q0, q1, s0, s1, g0, g1)


@inlined
def act(parts, ends, arms, normal, force, couple_n_m):
    """Push the blocks apart by the resultants across and along the joint, at the line's origin.

    A support takes what is along y; `couple_n_m` is about that origin.
    """
    (a, b, j), (ny, nz), (across, along), supports = ends, normal, force, parts.supports
    fy, fz = plus(ny * across, nz, along), minus(nz * across, ny, along)
    if a >= 0:
        push(parts.force, a, 1.0, (fy, fz), arms[0], couple_n_m)
    else:
        put(supports.fy, j, take(supports.fy, j) + fy)
    if b >= 0:
        push(parts.force, b, -1.0, (fy, fz), arms[1], couple_n_m)
    else:
        put(supports.fy, j, take(supports.fy, j) - fy)


@inlined
def _coupled(between, low, directions, sums, size):
    """Add what the dashpots of a joint do between block `low` and the next, C of the two.

    `directions`: of each (y, z), what arms of the lower and the higher block have along it at the
    line's origin, and how both grow along the line; `sums`: of each Σ k·(1, s, s²).
    """
    for which in range(2):
        (y, z), (arm_low, arm_high, more) = directions[which]
        k0, k1, k2 = sums[which]
        dashpot = size[which]
        of_low, of_high = arm_low * k0 + more * k1, arm_high * k0 + more * k1
        both = arm_low * of_high + more * (arm_high * k1 + more * k2)
        entries = (
            (y * y * k0, y * z * k0, y * of_high),
            (z * y * k0, z * z * k0, z * of_high),
            (of_low * y, of_low * z, both),
        )
        for m, row in enumerate(entries):
            for n, entry in enumerate(row):
                at = 9 * low + 3 * m + n
                put(between, at, take(between, at) - dashpot * entry)


@inlined
def withstand(parts, ends, arms, direction, more, sums, back, row):
    """Add what resists rates of the faces along one direction to blocks and between them.

    Parameters
    ----------
    ends, arms
        Of `met`.
    direction : tuple of 2 numbers
        (y, z).
    more : number
        What an arm along the line has along it, of `moving`.
    sums : tuple of 3 numbers
        Σ dashpot·(1, s, s²) along the line.
    back, row
        Of a joint with a support three rows from that one on get what rates of its block do to the
        force along y.
    """
    (y, z), (k0, k1, k2) = direction, sums
    lever_a, lever_b = _levers(arms, direction)
    turned, twice = more * k1, more * (more * k2)
    of_a, of_b = plus(turned, lever_a, k0), plus(turned, lever_b, k0)
    spread = plus(twice, turned, lever_a), plus(twice, turned, lever_b)
    _add_dashpots(parts, ends, (y, z), k0, (lever_a, lever_b), (of_a, of_b), spread)
    a, b, _ = ends
    if a < 0 or b < 0:
        mine = of_a if a >= 0 else of_b
        for m, value in enumerate((y * (y * k0), y * (z * k0), y * mine)):
            put(back, row + m, value)


@inlined
def withstand_slip(parts, ends, arms, direction, k0, back, row):
    """The same, added to `back`, of what resists the slip of a line all along in one way."""
    (y, z), (a, b, _), none = direction, ends, like(0.0, k0)
    lever_a, lever_b = _levers(arms, direction)
    of_a, of_b = lever_a * k0, lever_b * k0
    _add_dashpots(parts, ends, (y, z), k0, (lever_a, lever_b), (of_a, of_b), (none, none))
    if a < 0 or b < 0:
        mine = of_a if a >= 0 else of_b
        for m, value in enumerate((y * k0, z * k0, mine)):
            put(back, row + m, plus(take(back, row + m), y, value))


@inlined
def _levers(arms, direction):
    """What the arms of a joint's origin from the centroids of a and b have across a direction."""
    (y, z), ((ay, az), (by, bz)) = direction, arms
    return minus(z * ay, y, az), minus(z * by, y, bz)


@inlined
def _add_dashpots(parts, ends, direction, k0, levers, moments, spread):
    """Add a joint's dashpots along a direction to those of its blocks and between them."""
    (a, b, _), (y, z) = ends, direction
    yk, zk = y * k0, z * k0
    for end in range(2):
        block, mine = (a, b)[end], moments[end]
        if block >= 0:
            damping, at = parts.own, 6 * block
            put(damping, at, plus(take(damping, at), y, yk))
            put(damping, at + 1, plus(take(damping, at + 1), y, zk))
            put(damping, at + 2, plus(take(damping, at + 2), y, mine))
            put(damping, at + 3, plus(take(damping, at + 3), z, zk))
            put(damping, at + 4, plus(take(damping, at + 4), z, mine))
            put(damping, at + 5, plus(take(damping, at + 5) + spread[end], levers[end], mine))
    if a >= 0 and b >= 0:
        low, of_low, of_high = (a, *moments) if a < b else (b, moments[1], moments[0])
        between, at = parts.between, 9 * low
        of_y, of_z = ((y, yk), (y, zk), (y, of_high)), ((z, yk), (z, zk), (z, of_high))
        for m, (one, other) in enumerate((*of_y, *of_z, (of_low, y), (of_low, z))):
            put(between, at + m, minus(take(between, at + m), one, other))
        rest = take(between, at + 8) - spread[0]
        put(between, at + 8, minus(rest, levers[1], moments[0]))


@inlined
def resist(parts, joint, turns, sums, dashpots):
    """Add the dashpots of a joint to those of its blocks and between them.

    `joint`: ends, arms, normal, along of `met`; `turns`: of `moving`; `sums`: of each
    direction Σ k·(1, s, s²); `dashpots`: over k across, and that along over it.
    """
    (a, b, _), arms, (ny, nz), along = joint
    (ty, tz), (beta, ratio) = (-nz, ny), dashpots
    for end in range(2):
        block = (a, b)[end]
        if block >= 0:
            damping, at = parts.own, 6 * block
            yy, yz, yt = take(damping, at), take(damping, at + 1), take(damping, at + 2)
            had = yy, yz, yt, take(damping, at + 3), take(damping, at + 4), take(damping, at + 5)
            where = *arms[end], *along
            for m, value in enumerate(added(had, where, (ny, nz, ty, tz), sums, dashpots)):
                put(damping, at + m, value)
    if a >= 0 and b >= 0:
        (ry, rz), (by, bz) = arms
        of_a, of_b = (
            (nz * ry - ny * rz, tz * ry - ty * rz),
            (nz * by - ny * bz, tz * by - ty * bz),
        )
        low, of_low, of_high = (a, of_a, of_b) if a < b else (b, of_b, of_a)
        both = (
            ((ny, nz), (of_low[0], of_high[0], turns[0])),
            ((ty, tz), (of_low[1], of_high[1], turns[1])),
        )
        _coupled(parts.between, low, both, sums, (beta, beta * ratio))
