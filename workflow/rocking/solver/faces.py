"""The two faces of a straight joint between blocks: how deep they are, and how they move.

The line turns with block a, the plane that it meets with block b; −1 for either is a support, which
moves along y alone. What one is to the other is linear along the line, a0 + a1·s.
"""

from rocking.runtime.compiled import inlined

from .dashpots import apart, beyond, placed, push, rates, turned
from .joints import added
from .vectors import alone, choose, like, put, take


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
    d0, d1 = joints.level_m[i] - ny * by - nz * bz, -(ny * ey + nz * ez)
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
    across, within = nz * ey - ny * ez, tz * ey - ty * ez
    q0, q1 = -(ny * vy + nz * vz), -spin * across
    s0, s1 = ty * vy + tz * vz, spin * within
    g0, g1 = ty * uy + tz * uz, turn * within
    return (across, within), (q0, q1, s0, s1, g0, g1)


@inlined
def act(parts, ends, arms, normal, force, couple_n_m):
    """Push the blocks apart by the resultants across and along the joint, at the line's origin.

    A support takes what is along y; `couple_n_m` is about that origin.
    """
    (a, b, j), (ny, nz), (across, along), supports = ends, normal, force, parts.supports
    fy, fz = ny * across + nz * along, nz * across - ny * along
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
        (y, z), (one, other, more) = directions[which]
        k0, k1, k2 = sums[which]
        dashpot = size[which]
        of_low, of_high = one * k0 + more * k1, other * k0 + more * k1
        both = one * of_high + more * (other * k1 + more * k2)
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
def withstand(parts, ends, arms, direction, more, sums, back, row, also=False):
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
    back, row, also
        Of a joint with a support three rows from that one on get, or are added, what rates of its
        block do to the force along y.
    """
    (a, b, _), (y, z), (k0, k1, k2) = ends, direction, sums
    lever_a, lever_b = z * arms[0][0] - y * arms[0][1], z * arms[1][0] - y * arms[1][1]
    of_a, of_b = lever_a * k0 + more * k1, lever_b * k0 + more * k1
    spread = more * (k1 * lever_a + more * k2), more * (k1 * lever_b + more * k2)
    yy, yz, zz = y * y * k0, y * z * k0, z * z * k0
    for end in range(2):
        block, mine = (a, b)[end], (of_a, of_b)[end]
        if block >= 0:
            turning = (lever_a, lever_b)[end] * mine + spread[end]
            entries = yy, yz, y * mine, zz, z * mine, turning
            for m, value in enumerate(entries):
                put(parts.own, 6 * block + m, take(parts.own, 6 * block + m) + value)
    if a >= 0 and b >= 0:
        low, of_low, of_high = (a, of_a, of_b) if a < b else (b, of_b, of_a)
        both = lever_b * of_a + spread[0]
        couplings = yy, yz, y * of_high, yz, zz, z * of_high, of_low * y, of_low * z, both
        for m, value in enumerate(couplings):
            put(parts.between, 9 * low + m, take(parts.between, 9 * low + m) - value)
    else:
        mine = of_a if a >= 0 else of_b
        for m, value in enumerate((yy, yz, y * mine)):
            put(back, row + m, take(back, row + m) + value if also else value)


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
            own, at = parts.own, 6 * block
            yy, yz, yt = take(own, at), take(own, at + 1), take(own, at + 2)
            had = yy, yz, yt, take(own, at + 3), take(own, at + 4), take(own, at + 5)
            where = *arms[end], *along
            for m, value in enumerate(added(had, where, (ny, nz, ty, tz), sums, dashpots)):
                put(own, at + m, value)
    if a >= 0 and b >= 0:
        (ry, rz), (by, bz) = arms
        of_a, of_b = (
            (nz * ry - ny * rz, tz * ry - ty * rz),
            (nz * by - ny * bz, tz * by - ty * bz),
        )
        low, one, other = (a, of_a, of_b) if a < b else (b, of_b, of_a)
        both = ((ny, nz), (one[0], other[0], turns[0])), ((ty, tz), (one[1], other[1], turns[1]))
        _coupled(parts.between, low, both, sums, (beta, beta * ratio))
