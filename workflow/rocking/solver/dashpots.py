"""Blocks of a stack: points that turn with them, forces on them, and their dashpots.

These act at the velocity of the step, by matrices of 3 × 3 a block.
"""

from rocking.runtime.compiled import inlined

from .vectors import choose, put, take


@inlined
def solved(own, mass, inertia, free, force):
    """Accelerations (M + C)⁻¹·f of one block, of those of its freedoms that it has.

    C by its entries 00, 01, 02, 11, 12, 22; for one number and for lanes of them.
    """
    c00, c01, c02, c11, c12, c22 = own
    y, z, turn = free
    f0, f1, f2 = choose(y, force[0], 0.0), choose(z, force[1], 0.0), choose(turn, force[2], 0.0)
    c01, c02, c12 = choose(y & z, c01, 0.0), choose(y & turn, c02, 0.0), choose(z & turn, c12, 0.0)
    upper = 1.0 / (mass + c00)
    l10, l20 = c01 * upper, c02 * upper
    r12 = c12 - l10 * c02
    middle = 1.0 / (mass + c11 - l10 * c01)
    l21 = r12 * middle
    f1 -= l10 * f0
    f2 = (f2 - l20 * f0 - l21 * f1) / (inertia + c22 - l20 * c02 - l21 * r12)
    f1 = (f1 - r12 * f2) * middle
    return (f0 - c01 * f1 - c02 * f2) * upper, f1, f2


@inlined
def damp(own, block, y, z, arm, dashpot):
    """Add a dashpot along (y, z); `arm` is its place times that direction."""
    cy, cz, ct, at = dashpot * y, dashpot * z, dashpot * arm, 6 * block
    put(own, at, take(own, at) + cy * y)
    put(own, at + 1, take(own, at + 1) + cy * z)
    put(own, at + 2, take(own, at + 2) + cy * arm)
    put(own, at + 3, take(own, at + 3) + cz * z)
    put(own, at + 4, take(own, at + 4) + cz * arm)
    put(own, at + 5, take(own, at + 5) + ct * arm)


@inlined
def couple(between, low, y, z, arm_low, arm_high, dashpot):
    """Add what a dashpot along (y, z) does between block `low` and the next, C of the two."""
    for m, one in enumerate((y, z, arm_low)):
        for n, other in enumerate((y, z, arm_high)):
            at = 9 * low + 3 * m + n
            put(between, at, take(between, at) - dashpot * one * other)


@inlined
def resist(p, parts, a, b, dashpots):
    """Add dashpots between two blocks, −1: none, each by direction, arms along it, and size."""
    if a >= 0:
        for (y, z), (arm_a, _), dashpot in dashpots:
            damp(parts.own, a, y, z, arm_a, dashpot)
    if b >= 0:
        for (y, z), (_, arm_b), dashpot in dashpots:
            damp(parts.own, b, y, z, arm_b, dashpot)
    if p.in_row and a >= 0 and b >= 0:
        for (y, z), (arm_a, arm_b), dashpot in dashpots:
            if a < b:
                couple(parts.between, a, y, z, arm_a, arm_b, dashpot)
            else:
                couple(parts.between, b, y, z, arm_b, arm_a, dashpot)


@inlined
def turned(turn, block, arm):
    """A direction or arm that turns with a block."""
    cos, sin = take(turn, 2 * block), take(turn, 2 * block + 1)
    return cos * arm[0] - sin * arm[1], sin * arm[0] + cos * arm[1]


@inlined
def placed(p, parts, block, arm):
    """Where a point of a block is."""
    y, z = take(parts.place, 3 * block), take(parts.place, 3 * block + 1)
    return p.centre_m[block, 0] + y + arm[0], p.centre_m[block, 1] + z + arm[1]


@inlined
def beyond(p, parts, block, y, z):
    """A place from the centroid of a block."""
    y = y - p.centre_m[block, 0] - take(parts.place, 3 * block)
    return y, z - p.centre_m[block, 1] - take(parts.place, 3 * block + 1)


@inlined
def rates(parts, block, arm, past_s):
    """Velocity of a point of a block now, and its way since the last step."""
    (ay, az), at = arm, 3 * block
    spin, turn = take(parts.now, at + 2), take(parts.rate, at + 2)
    return (
        take(parts.now, at) - spin * az,
        take(parts.now, at + 1) + spin * ay,
        past_s * (take(parts.rate, at) - turn * az),
        past_s * (take(parts.rate, at + 1) + turn * ay),
    )


@inlined
def apart(parts, block, arm, past_s, own):
    """Such rates of another point, less those of the block's."""
    (by, bz), at, (ry, rz, gy, gz) = arm, 3 * block, own
    spin, turn = take(parts.now, at + 2), take(parts.rate, at + 2)
    ry, rz = ry - take(parts.now, at) + spin * bz, rz - take(parts.now, at + 1) - spin * by
    gy -= past_s * (take(parts.rate, at) - turn * bz)
    return ry, rz, gy, gz - past_s * (take(parts.rate, at + 1) + turn * by)


@inlined
def push(rows, block, sign, force, arm, couple_n_m=-0.0):
    """Add a force and a couple, or what reacts to them, to those of a block."""
    (fy, fz), (ay, az), at = force, arm, 3 * block
    put(rows, at, take(rows, at) + sign * fy)
    put(rows, at + 1, take(rows, at + 1) + sign * fz)
    put(rows, at + 2, take(rows, at + 2) + sign * (ay * fz - az * fy + couple_n_m))


@inlined
def _three(rows, first, stride):
    """Three rows, so far from each other."""
    return take(rows, first), take(rows, first + stride), take(rows, first + 2 * stride)


@inlined
def _times(row, inverse, low):
    """A row times the inverse of a block's matrix, in nine rows from `low` on."""
    y, z, turn = row
    (a, b, c), (d, e, f) = _three(inverse, low, 1), _three(inverse, low + 3, 1)
    g, h, i = _three(inverse, low + 6, 1)
    return y * a + z * d + turn * g, y * b + z * e + turn * h, y * c + z * f + turn * i


@inlined
def solve_row(own, between, inverse, mass, inertia, force):
    """Solve (M + C)·a = f of blocks in a row in place, by blocks of 3 from the first to the last.

    C by `own`, six rows a block, and `between`, nine that join each block to the next; `inverse`:
    room for nine rows a block.
    """
    blocks = mass.size
    for i in range(blocks):
        at, to, low = 3 * i, 6 * i, 9 * (i - 1)
        a, b, c = mass[i] + take(own, to), take(own, to + 1), take(own, to + 2)
        d, e = mass[i] + take(own, to + 3), take(own, to + 4)
        f = inertia[i] + take(own, to + 5)
        if i > 0:
            y = _times(_three(between, low, 3), inverse, low)
            z = _times(_three(between, low + 1, 3), inverse, low)
            turn = _times(_three(between, low + 2, 3), inverse, low)
            f0, f1, f2 = _three(force, at - 3, 1)
            for m, back in enumerate((y, z, turn)):
                less = take(force, at + m) - back[0] * f0 - back[1] * f1 - back[2] * f2
                put(force, at + m, less)
            for r in range(3):
                b0, b1, b2 = _three(between, low + 3 * r, 1)
                a, b, c = a - y[r] * b0, b - y[r] * b1, c - y[r] * b2
                d, e, f = d - z[r] * b1, e - z[r] * b2, f - turn[r] * b2
        over = 1.0 / (a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d))
        put(inverse, 9 * i, over * (d * f - e * e))
        put(inverse, 9 * i + 4, over * (a * f - c * c))
        put(inverse, 9 * i + 8, over * (a * d - b * b))
        one, other, last = over * (c * e - b * f), over * (b * e - c * d), over * (b * c - a * e)
        for m, n, value in ((0, 1, one), (0, 2, other), (1, 2, last)):
            put(inverse, 9 * i + 3 * m + n, value)
            put(inverse, 9 * i + 3 * n + m, value)
    for i in range(blocks - 1, -1, -1):
        at = 3 * i
        if i < blocks - 1:
            for m in range(3):
                for n in range(3):
                    less = take(between, 9 * i + 3 * m + n) * take(force, at + 3 + n)
                    put(force, at + m, take(force, at + m) - less)
        f0, f1, f2 = _three(force, at, 1)
        for m in range(3):
            i0, i1, i2 = _three(inverse, 9 * i + 3 * m, 1)
            put(force, at + m, i0 * f0 + i1 * f1 + i2 * f2)
