"""Blocks of a stack: points that turn with them, forces on them, and their dashpots.

These act at the velocity of the step, by matrices of 3 × 3 a block.
"""

from rocking.runtime.compiled import inlined

from .vectors import choose, dot, less_dot, like, minus, plus, put, take


@inlined
def solved(damping, mass, inertia, free, force):
    """Accelerations (M + C)⁻¹·f of one block, of those of its freedoms that it has.

    C by its entries 00, 01, 02, 11, 12, 22; for one number and for lanes of them.
    """
    c00, c01, c02, c11, c12, c22 = damping
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
def damp(damping, block, y, z, arm, dashpot):
    """Add a dashpot along (y, z); `arm` is its place times that direction."""
    cy, cz, ct, at = dashpot * y, dashpot * z, dashpot * arm, 6 * block
    put(damping, at, take(damping, at) + cy * y)
    put(damping, at + 1, take(damping, at + 1) + cy * z)
    put(damping, at + 2, take(damping, at + 2) + cy * arm)
    put(damping, at + 3, take(damping, at + 3) + cz * z)
    put(damping, at + 4, take(damping, at + 4) + cz * arm)
    put(damping, at + 5, take(damping, at + 5) + ct * arm)


@inlined
def couple(between, low, y, z, arm_low, arm_high, dashpot):
    """Add what a dashpot along (y, z) does between block `low` and the next, C of the two."""
    for m, of_low in enumerate((y, z, arm_low)):
        for n, of_high in enumerate((y, z, arm_high)):
            at = 9 * low + 3 * m + n
            put(between, at, take(between, at) - dashpot * of_low * of_high)


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
    return minus(cos * arm[0], sin, arm[1]), plus(sin * arm[0], cos, arm[1])


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
        minus(take(parts.now, at), spin, az),
        plus(take(parts.now, at + 1), spin, ay),
        past_s * minus(take(parts.rate, at), turn, az),
        past_s * plus(take(parts.rate, at + 1), turn, ay),
    )


@inlined
def apart(parts, block, arm, past_s, point):
    """Such rates of another point, less those of the block's."""
    (by, bz), at, (ry, rz, gy, gz) = arm, 3 * block, point
    spin, turn = take(parts.now, at + 2), take(parts.rate, at + 2)
    ry, rz = ry - take(parts.now, at), rz - take(parts.now, at + 1)
    gy = minus(gy, past_s, minus(take(parts.rate, at), turn, bz))
    gz = minus(gz, past_s, plus(take(parts.rate, at + 1), turn, by))
    return plus(ry, spin, bz), minus(rz, spin, by), gy, gz


@inlined
def push(rows, block, sign, force, arm, couple_n_m=-0.0):
    """Add a force and a couple, or what reacts to them, to those of a block."""
    (fy, fz), (ay, az), at = force, arm, 3 * block
    put(rows, at, take(rows, at) + sign * fy)
    put(rows, at + 1, take(rows, at + 1) + sign * fz)
    put(rows, at + 2, take(rows, at + 2) + sign * plus(minus(couple_n_m, az, fy), ay, fz))


@inlined
def three(rows, first, stride):
    """Three rows, so far from each other."""
    return take(rows, first), take(rows, first + stride), take(rows, first + 2 * stride)


@inlined
def _applied(matrix, vector):
    """A symmetric matrix, by its entries 00, 01, 02, 11, 12, 22, times a vector."""
    a, b, c, d, e, f = matrix
    return dot((a, b, c), vector), dot((b, d, e), vector), dot((c, e, f), vector)


@inlined
def _inverse(matrix):
    """Inverse of such a matrix."""
    a, b, c, d, e, f = matrix
    aa, bb, cc = minus(d * f, e, e), minus(c * e, b, f), minus(b * e, c, d)
    over = 1.0 / dot((a, b, c), (aa, bb, cc))
    dd, ee, ff = minus(a * f, c, c), minus(b * c, a, e), minus(a * d, b, b)
    return over * aa, over * bb, over * cc, over * dd, over * ee, over * ff


@inlined
def _without(block, other, columns):
    """Matrix and force of a block once the one before it, by inverse and force, is eliminated.

    `columns`: of what joins that one to this.
    """
    (a, b, c, d, e, f), (f0, f1, f2) = block
    (inverse, under), (first, second, third) = other, columns
    y, z, turn = _applied(inverse, first), _applied(inverse, second), _applied(inverse, third)
    force = less_dot(f0, y, under), less_dot(f1, z, under), less_dot(f2, turn, under)
    a, b, c = less_dot(a, y, first), less_dot(b, y, second), less_dot(c, y, third)
    matrix = a, b, c, less_dot(d, z, second), less_dot(e, z, third), less_dot(f, turn, third)
    return matrix, force


@inlined
def _keep(rows, first, values):
    """Write some values into rows from one on."""
    for m in range(len(values)):
        put(rows, first + m, values[m])


@inlined
def solve_row(damping, between, inverse, mass, inertia, force):
    """Solve (M + C)·a = f of blocks in a row in place, by blocks of 3 from the first to the last.

    C by `damping`, six rows a block, and `between`, nine that join each block to the next;
    `inverse`: room for six rows a block.
    """
    last = mass.size - 1
    none = like(0.0, take(force, 0))
    solved_to = (none, none, none, none, none, none), (none, none, none)
    for i in range(last + 1):
        to, low = 6 * i, 9 * (i - 1)
        (c00, c01, c02), (c11, c12, c22) = three(damping, to, 1), three(damping, to + 3, 1)
        matrix = mass[i] + c00, c01, c02, mass[i] + c11, c12, inertia[i] + c22
        block = matrix, three(force, 3 * i, 1)
        if i > 0:
            columns = three(between, low, 3), three(between, low + 1, 3), three(between, low + 2, 3)
            block = _without(block, solved_to, columns)
        solved_to = _inverse(block[0]), block[1]
        _keep(inverse, to, solved_to[0])
        _keep(force, 3 * i, solved_to[1])
    beside = _applied(*solved_to)
    _keep(force, 3 * last, beside)
    for i in range(last - 1, -1, -1):
        at = 9 * i
        f0, f1, f2 = three(force, 3 * i, 1)
        f0 = less_dot(f0, three(between, at, 1), beside)
        f1 = less_dot(f1, three(between, at + 3, 1), beside)
        f2 = less_dot(f2, three(between, at + 6, 1), beside)
        own_inverse = *three(inverse, 6 * i, 1), *three(inverse, 6 * i + 3, 1)
        beside = _applied(own_inverse, (f0, f1, f2))
        _keep(force, 3 * i, beside)
