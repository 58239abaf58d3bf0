"""A plain façade and its mechanisms, for tests that know their multipliers by hand."""

from typing import NamedTuple

from rocking.mechanics.blocks import Edges, Held, bending, toppling
from rocking.mechanics.mechanism import spread_weight


class PlainFacade(NamedTuple):
    """A plain façade as its mechanisms see it; lengths in m, forces in N, on the whole width."""

    height_m: float
    thickness_m: float
    weight_n: float
    hinge_inset_m: float = 0.0  # of the hinge from the outer face, for crushing
    roof_n: float = 0.0  # vertical load at the top, which moves with the façade
    roof_arm_m: float = 0.0  # its distance from the inner face
    pushing_n: float = 0.0  # weight that does not bear on it but pushes its top, Q of C8.7.1.1


def overturning(facade, pulls=()):
    """Simple overturning of the whole façade about its outer edge, less the hinge's inset.

    Free: α0 = (b − 2t)/h. With a roof load N at the inner distance s, and Q that pushes at the top:
    α0 = [W(b/2 − t) + N(b − s − t)]/(W h/2 + (N + Q) h). Ties T at z_t add T z_t to the numerator.
    Pulls are `Held`: ties, and courses of interlocked return walls (`courses`).
    """
    f = facade
    h, middle = f.height_m, 0.5 * f.thickness_m
    masses = [(part, middle, z) for part, z in spread_weight(f.weight_n, 0.0, h)]
    hinge = (f.thickness_m - f.hinge_inset_m, 0.0)
    return toppling(
        "overturning about the base",
        masses,
        hinge,
        (hinge[0], h),
        [(f.roof_n, f.roof_arm_m, h)],
        pulls,
        [(f.pushing_n, h)],
    )


def courses(height_m, bricks, unit_weight_n_m3):
    """Friction of `Interlocked` walls as `Held`, from the top: F_i = μ γ t_s v h_b i a wall.

    Joint i lies at h − i·h_b above the hinge and is gone when it has slipped by the overlap v
    (upper bound of Casapulla et al., 2019). Their sum is μ γ t_s v h_b n(n − 1)/2 a wall, for n
    courses, at (n + 1)h_b/3 above the hinge: for many courses 1.25 times `blocks.interlocking`.
    """
    force = bricks.return_walls * bricks.rubbing_n(unit_weight_n_m3)
    course, overlap = bricks.course_height_m, bricks.overlap_m
    joints = range(1, round(height_m / course))
    return [Held(force * i, height_m - i * course, overlap) for i in joints]


def two_blocks(facade, hinge_height_m):
    """Vertical bending: the top is held, the façade opens at a hinge at an intermediate height.

    Small rotations, b₁ = b, roof load N at s from the inner face, W₁ = W h₁/h, W₂ = W h₂/h, r =
    h₁/h₂ (rotation of the upper block per lower one):

        α0 = [W₁ b/2 + (W₂ + N) b + r (W₂ b/2 + N s)]/[(W₁ + W₂) h₁/2]

    See `blocks.bending`; the hinge inset applies at the base and at the joint. The held roof load
    has no horizontal displacement and does no work against the shaking.
    """
    f, h1, h = facade, hinge_height_m, facade.height_m
    b, w = f.thickness_m, f.weight_n / h
    return bending(
        "vertical bending",
        [(p, 0.5 * b, z) for p, z in spread_weight(w * h1, 0.0, h1)],
        [(p, 0.5 * b, z) for p, z in spread_weight(w * (h - h1), h1, h)],
        Edges((b - f.hinge_inset_m, 0.0), (f.hinge_inset_m, h1), (b, h)),
        held=[(f.roof_n, f.roof_arm_m, h)],
    )
