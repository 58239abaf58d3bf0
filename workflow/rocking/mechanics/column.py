"""A wall that is elastic along its height: its static curve λ(d), and that of a stack of courses.

The wall is a column of height h and thickness b under its own weight and a uniform horizontal
acceleration λ·g, fixed at its foot. It carries no tension and feels P-Δ. Per width, a section at s
below the top bears W s/h, W = ρ g h b, with the inclination θ (outward positive)

    N = (W s/h)(cos θ − λ sin θ),      dM/ds = (W s/h)(sin θ + λ cos θ)(1 + ε)

and its curvature follows from its eccentricity e = M/(N b): linear strain, no tension,

    κ = 12 e N/(E b²)                 uncracked, e ≤ 1/6
    κ = 2 N/(9 E b² (1/2 − e)²)       cracked; the width in contact is 3 b (1/2 − e)

while ε lengthens the axis where the section opens. Then dθ/ds = −κ, θ = 0 at the foot, M = 0 at
the top and d = ∫ sin θ ds. Lengths over h and b, forces over W: what is left are the group

    Γ = ρ g h³/(E b²)

and, through sines and cosines alone, b/h. The integration cuts the wall into rigid pieces with
elastic joints between them, each standing for half a piece on either side: of many pieces, finer
towards the foot, that is the column; of a few equal ones the stack of courses that distinct
elements run. It starts from an inclination of the top and goes down, which leaves λ as the one
unknown: the foot's inclination must vanish. The error falls with the square of the pieces.
"""

import math

import numpy as np
from scipy.optimize import brentq

from rocking.mechanics.closed_forms import GRAVITY_M_S2, _positive
from rocking.runtime.compiled import compiled

PIECES = 400  # of the column: λ within 1e-4
FINEST = 1e-3  # of the pieces at the foot over those at the top
STEP = 0.02  # of b/h, by which λ is bracketed
WIDER = 1.1  # by which the top's inclination is
BUCKLES = 7.837 / 12.0  # Γ at which an uncracked column falls by its own weight (Greenhill)


def compliance(h_m, b_m, density_kg_m3, e_pa, gravity_m_s2=GRAVITY_M_S2):
    """Γ = ρ g h³/(E b²), how compliant a wall is under its own weight [-]."""
    _positive(h_m=h_m, b_m=b_m, density_kg_m3=density_kg_m3, e_pa=e_pa)
    return density_kg_m3 * gravity_m_s2 * h_m**3 / (e_pa * b_m**2)


def courses(count, growth=1.0):
    """Heights of the joints of so many courses below the top, over h, both ends included.

    Each course is `growth` times as high as the one below it.
    """
    heights = float(growth) ** np.arange(count)[::-1]
    return np.concatenate(([0.0], np.cumsum(heights) / heights.sum()))


def graded(count=PIECES, finest=FINEST):
    """The same for the column: pieces that grow in geometric progression from the foot up."""
    above = finest * np.expm1(np.linspace(1.0, 0.0, count + 1) * np.log1p(1.0 / finest))
    edges = 1.0 - above
    edges[[0, -1]] = 0.0, 1.0
    return edges


@compiled
def _down(multiplier, top_rad, gamma, ratio, edges):
    """Inclination of what is below the foot [rad], and d/b; λ and that of the top given."""
    theta, moment, d = top_rad, 0.0, 0.0
    last = edges.size - 1
    for i in range(1, last + 1):
        low, high = edges[i], edges[i - 1]
        length = 0.5 * ((edges[i + 1] if i < last else low) - high)
        push = math.sin(theta) + multiplier * math.cos(theta)
        moment += push * (low**2 - high**2) / (2.0 * ratio)
        d += math.sin(theta) * (low - high) / ratio
        normal = low * (math.cos(theta) - multiplier * math.sin(theta))
        off = abs(moment) / normal
        if normal <= 0.0 or off >= 0.5:
            return (-1.0 if moment > 0.0 else 1.0), d
        if off <= 1.0 / 6.0:
            bent, opened = 12.0 * off, -1.0
        else:
            width = 3.0 * (0.5 - off)
            bent = 2.0 / width**2
            opened = bent * (0.5 - width)
        turn = math.copysign(gamma * ratio * normal * length * bent, moment)
        lift = gamma * ratio * normal * length * opened  # of the axis at the joint, over b
        moment += lift * low * (math.sin(theta - turn) + multiplier * math.cos(theta - turn))
        d += lift * math.sin(theta - 0.5 * turn)
        theta -= turn
        if theta < 0.0 < moment:
            return theta, d
    return theta, d


def capacity(d_over_b, gamma, ratio, edges=None):
    """Static curve λ(d) of the column, or of a stack of courses with these `edges` (`courses`).

    Of top displacements d/b, shape (n,), above 0 and at most 1.2, Γ (`compliance`) and b/h the
    multipliers, shape (n,), negative past the point of no return. A ValueError for a d/b out of
    range or without an equilibrium, or a wall that falls by its own weight, Γ ≥ 0.653.
    """
    wanted = np.atleast_1d(np.asarray(d_over_b, float))
    edges = graded() if edges is None else np.asarray(edges, float)
    _positive(gamma=gamma, ratio=ratio)
    if not np.all((wanted > 0.0) & (wanted <= 1.2)):
        raise ValueError("d_over_b: expected values above 0, at most 1.2")
    if gamma >= BUCKLES:
        raise ValueError(f"gamma = {gamma:.4g}: expected below {BUCKLES:.3f}: it falls by itself")

    def multiplier(top):
        # the lowest of the equilibria: those above it turn about a higher joint
        low = -math.tan(top)
        while _down(low + STEP * ratio, top, gamma, ratio, edges)[0] > 0.0:
            low += STEP * ratio
        return brentq(
            lambda x: _down(x, top, gamma, ratio, edges)[0], low, low + STEP * ratio, xtol=1e-15
        )

    def multiplier_at(d):
        def excess(top):
            return _down(multiplier(top), top, gamma, ratio, edges)[1] - d

        low = 0.9 * d * ratio
        while excess(WIDER * low) < 0.0:
            low *= WIDER
            if low > 0.5 * math.pi:
                raise ValueError(f"d_over_b = {d:.4g}: no equilibrium was found")
        return multiplier(brentq(excess, low, WIDER * low, xtol=1e-13))

    return np.array([multiplier_at(d) for d in wanted])
