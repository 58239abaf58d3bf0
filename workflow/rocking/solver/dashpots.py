"""Dashpots of blocks in the plane at the velocity of the step: matrices of 3 × 3 a block."""

import numpy as np

from rocking.runtime.compiled import compiled, inlined

from .vectors import choose


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
def solve(own, block, mass, inertia, free, force):
    """Solve as `solved` in place, by arrays."""
    force[block, 0], force[block, 1], force[block, 2] = solved(
        (
            own[block, 0],
            own[block, 1],
            own[block, 2],
            own[block, 3],
            own[block, 4],
            own[block, 5],
        ),
        mass,
        inertia,
        (free[block, 0], free[block, 1], free[block, 2]),
        (force[block, 0], force[block, 1], force[block, 2]),
    )


@inlined
def damp(own, block, y, z, arm, dashpot):
    """Add a dashpot along (y, z); `arm` is its place times that direction."""
    cy, cz, ct = dashpot * y, dashpot * z, dashpot * arm
    own[block, 0] += cy * y
    own[block, 1] += cy * z
    own[block, 2] += cy * arm
    own[block, 3] += cz * z
    own[block, 4] += cz * arm
    own[block, 5] += ct * arm


@inlined
def couple(between, low, y, z, arm_low, arm_high, dashpot):
    """Add what a dashpot along (y, z) does between block `low` and the next, C of the two."""
    one, other = (y, z, arm_low), (y, z, arm_high)
    for m in range(3):
        for n in range(3):
            between[low, m, n] -= dashpot * one[m] * other[n]


@compiled
def solve_row(own, between, mass, inertia, force):
    """Solve (M + C)·a = f of blocks in a row in place, by blocks of 3 from the first to the last.

    C by `own`, as in `solve`, and `between`, the part that joins each block to the next.
    """
    blocks = mass.size
    inverse, back = np.zeros((blocks, 3, 3)), np.zeros((3, 3))
    for i in range(blocks):
        a = mass[i] + own[i, 0]
        b, c, d = own[i, 1], own[i, 2], mass[i] + own[i, 3]
        e, f = own[i, 4], inertia[i] + own[i, 5]
        if i > 0:
            for m in range(3):
                for n in range(3):
                    back[m, n] = 0.0
                    for r in range(3):
                        back[m, n] += between[i - 1, r, m] * inverse[i - 1, r, n]
            for m in range(3):
                for n in range(3):
                    force[i, m] -= back[m, n] * force[i - 1, n]
            for r in range(3):
                low = between[i - 1, r]
                a, b, c = a - back[0, r] * low[0], b - back[0, r] * low[1], c - back[0, r] * low[2]
                d, e, f = d - back[1, r] * low[1], e - back[1, r] * low[2], f - back[2, r] * low[2]
        over = 1.0 / (a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d))
        inverse[i, 0, 0], inverse[i, 1, 1] = over * (d * f - e * e), over * (a * f - c * c)
        inverse[i, 2, 2] = over * (a * d - b * b)
        inverse[i, 0, 1] = inverse[i, 1, 0] = over * (c * e - b * f)
        inverse[i, 0, 2] = inverse[i, 2, 0] = over * (b * e - c * d)
        inverse[i, 1, 2] = inverse[i, 2, 1] = over * (b * c - a * e)
    for i in range(blocks - 1, -1, -1):
        for m in range(3):
            if i < blocks - 1:
                for n in range(3):
                    force[i, m] -= between[i, m, n] * force[i + 1, n]
        y, z, turn = force[i, 0], force[i, 1], force[i, 2]
        for m in range(3):
            force[i, m] = inverse[i, m, 0] * y + inverse[i, m, 1] * z + inverse[i, m, 2] * turn
