"""Local mechanisms by virtual work: multiplier, capacity curve, participating mass.

A mechanism is a one-parameter motion of rigid blocks. Every weight and every pull (tie, friction of
interlocked courses) has a path (y(θ), z(θ)), y outward and z upward, θ the rotation of the lowest
block [rad]. With the multiplier α of horizontal forces α·P the virtual work of a further dθ is

    α Σ P y' − Σ P z' − Σ F y' = 0,   ' = d/dθ,

so α(θ) = (Σ P z' + Σ F y')/Σ P y' in the turned position, α0 = α(0). Paths are analytic, and their
derivatives are taken by a complex step, exact to rounding. SI units throughout.
"""

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from rocking.mechanics.closed_forms import G_M_S2, _positive

TINY = 1e-30  # complex step
COURSES = 400  # points at which a capacity curve is searched for its zero


class Weight(NamedTuple):
    """Weight P [N] and the path θ → (y, z) [m] of its point."""

    weight_n: float
    path: Callable


class Pull(NamedTuple):
    """Inward horizontal force on a point of the façade.

    Attributes
    ----------
    force_n : float
    path : callable
        θ → (y, z) of its point [m].
    reach_m : float
        Outward displacement of the point at which it is gone.
    fades : bool
        It falls linearly to zero there; otherwise it holds until there.
    """

    force_n: float
    path: Callable
    reach_m: float = math.inf
    fades: bool = False


@dataclass(frozen=True)
class Mechanism:
    """Weights, pulls and the point whose outward displacement is d_C.

    Attributes
    ----------
    name : str
    weights, pulls : tuple of Weight, of Pull
    control : callable
        θ → (y, z) of the control point [m].
    largest_rad : float
        End of the kinematics.
    """

    name: str
    weights: tuple
    control: Callable
    pulls: tuple = ()
    largest_rad: float = 0.5 * math.pi

    def multiplier(self, theta_rad=0.0):
        """α(θ) of the module's equation [-]."""
        lifted = sum(p * _rate(path, theta_rad)[1] for p, path in self.weights)
        pushed = sum(p * _rate(path, theta_rad)[0] for p, path in self.weights)
        return (lifted + sum(self._pull(pull, theta_rad) for pull in self.pulls)) / pushed

    @staticmethod
    def _pull(pull, theta):
        gone = pull.path(theta)[0].real - pull.path(0.0)[0].real
        if gone >= pull.reach_m:
            return 0.0
        left = 1.0 - gone / pull.reach_m if pull.fades else 1.0
        return left * pull.force_n * _rate(pull.path, theta)[0]

    def displacement(self, theta_rad):
        """d_C of the control point [m]."""
        return float(self.control(theta_rad)[0].real - self.control(0.0)[0].real)

    def ultimate(self):
        """Rotation [rad] and displacement d0 [m] of the control point at which α first is zero.

        Raises
        ------
        ValueError
            If α is not positive at the start, or never vanishes.
        """
        grid = np.linspace(0.0, self.largest_rad, COURSES + 1)
        alpha = np.array([self.multiplier(t) for t in grid])
        below = np.flatnonzero(alpha <= 0.0)
        if not below.size or below[0] == 0:
            when = "at rest" if below.size else "up to its largest rotation"
            raise ValueError(f"mechanism '{self.name}': the multiplier does not vanish {when}")
        k = below[0]
        root = brentq(self.multiplier, grid[k - 1], grid[k], xtol=1e-14)
        return float(root), self.displacement(root)

    def rotation(self, displacement_m):
        """θ at which the control point has moved by d_C [rad]."""
        return brentq(
            lambda t: self.displacement(t) - displacement_m, 0.0, self.largest_rad, xtol=1e-14
        )

    def participation(self):
        """Participating mass by the virtual displacements δ = y'(0) of the weights.

        M* = (Σ Pδ)²/(g Σ Pδ²), e* = g M*/Σ P; the displacement of the equivalent oscillator is
        d* = d_C Σ Pδ²/(δ_C Σ Pδ), with δ_C that of the control point (Circolare 7/2019,
        C8.7.1.2.1, as transcribed in the literature).

        Returns
        -------
        mass_kg, ratio, per_control : float
            M*, e*, d*/d_C.
        """
        p = np.array([weight for weight, _ in self.weights])
        delta = np.array([_rate(path, 0.0)[0] for _, path in self.weights])
        one, two = p @ delta, p @ delta**2
        mass = one**2 / (G_M_S2 * two)
        return mass, G_M_S2 * mass / p.sum(), two / (_rate(self.control, 0.0)[0] * one)

    def curve(self, points=101):
        """Capacity curve up to d0: displacement of the control point [m] and multiplier [-]."""
        theta = np.linspace(0.0, self.ultimate()[0], points)
        d = np.array([self.displacement(t) for t in theta])
        return d, np.array([self.multiplier(t) for t in theta])


def _rate(path, theta):
    """Derivative of a path by θ."""
    y, z = path(complex(theta, TINY))
    return y.imag / TINY, z.imag / TINY


def turning(point, hinge):
    """Path of a point of a block that turns outward about a hinge, both (y, z) [m]."""
    dy, dz = point[0] - hinge[0], point[1] - hinge[1]

    def path(theta):
        theta = complex(theta)
        cos, sin = cmath.cos(theta), cmath.sin(theta)
        return hinge[0] + dy * cos + dz * sin, hinge[1] - dy * sin + dz * cos

    return path


def spread_weight(weight_n, low_m, high_m):
    """Uniform weight between two heights as two halves at its Gauss points, (weight, z) each.

    They have its centroid and, exactly, its second moment along the height, which the
    participating mass takes: e* = 3/4 for a wall that turns about its base.
    """
    middle, arm = 0.5 * (low_m + high_m), 0.5 * (high_m - low_m) / math.sqrt(3.0)
    return [(0.5 * weight_n, middle - arm), (0.5 * weight_n, middle + arm)]


class Facade(NamedTuple):
    """A façade as its mechanisms see it; lengths in m, forces in N, on the whole width.

    Attributes
    ----------
    height_m, thickness_m, weight_n : float
    hinge_inset_m : float
        Distance of the hinge from the outer face, for crushing.
    roof_n, roof_arm_m : float
        Vertical load at the top, and its distance from the inner face; it moves with the façade.
    """

    height_m: float
    thickness_m: float
    weight_n: float
    hinge_inset_m: float = 0.0
    roof_n: float = 0.0
    roof_arm_m: float = 0.0


def _checked(facade):
    f = facade
    _positive(height_m=f.height_m, thickness_m=f.thickness_m, weight_n=f.weight_n)
    for name, value, limit in (
        ("hinge_inset_m", f.hinge_inset_m, 0.5 * f.thickness_m),
        ("roof_arm_m", f.roof_arm_m, f.thickness_m),
        ("roof_n", f.roof_n, math.inf),
    ):
        if not 0.0 <= value <= limit:
            raise ValueError(f"{name}: expected a value from 0 to {limit:g}, got {value}")
    return f


def overturning(facade, pulls=(), name="overturning about the base"):
    """Simple overturning of the whole façade about its outer edge, less the hinge's inset.

    Free: α0 = (b − 2t)/h. With a roof load N at the inner distance s:
    α0 = [W(b/2 − t) + N(b − s − t)]/(W h/2 + N h). Ties T at z_t add T z_t to the numerator.

    Parameters
    ----------
    facade : Facade
    pulls : sequence of (force_n, height_m, reach_m, fades)
        Ties, and courses of interlocked return walls (`courses`).
    """
    f = _checked(facade)
    hinge = (f.thickness_m - f.hinge_inset_m, 0.0)
    middle = 0.5 * f.thickness_m
    weights = [
        Weight(part, turning((middle, z), hinge))
        for part, z in spread_weight(f.weight_n, 0.0, f.height_m)
    ]
    if f.roof_n > 0.0:
        weights.append(Weight(f.roof_n, turning((f.roof_arm_m, f.height_m), hinge)))
    found = []
    for force, height, reach, fades in pulls:
        if not (force >= 0.0 and 0.0 < height <= f.height_m and reach > 0.0):
            raise ValueError(
                f"tie: expected a force of at least 0, a height within {f.height_m:g} m and a "
                f"positive reach, got {force:g} N, {height:g} m, {reach:g} m"
            )
        found.append(Pull(force, turning((hinge[0], height), hinge), reach, fades))
    top = turning((hinge[0], f.height_m), hinge)
    return Mechanism(name, tuple(weights), top, tuple(found))


def courses(height_m, course_m, return_thickness_m, overlap_m, friction, unit_weight_n_m3, walls=2):
    """Friction of interlocked courses as pulls, from the top: F_i = μ γ t_s v h_b i a wall.

    Joint i lies at h − i·h_b above the hinge and is gone when it has slipped by the overlap v
    (upper bound of Casapulla et al., 2019). Their sum is μ γ t_s v h_b n(n − 1)/2 a wall, for n
    courses; the Circolare's formula for interlocking could not be read well enough to compare.

    Returns
    -------
    list of (force_n, height_m, reach_m, fades)
    """
    _positive(course_m=course_m, overlap_m=overlap_m, return_thickness_m=return_thickness_m)
    count = round(height_m / course_m)
    force = walls * friction * unit_weight_n_m3 * return_thickness_m * overlap_m * course_m
    return [(force * i, height_m - i * course_m, overlap_m, False) for i in range(1, count)]


def two_blocks(facade, hinge_height_m):
    """Vertical bending: the top is held, the façade opens at a hinge at an intermediate height.

    The lower block turns outward about the outer edge of the base, the upper one back about the
    inner edge of the joint between them; its outer top edge, where it is held, moves vertically
    only. Small rotations, b₁ = b, roof load N at s from the inner face, W₁ = W h₁/h, W₂ = W h₂/h,
    r = h₁/h₂ (rotation of the upper block per lower one):

        α0 = [W₁ b/2 + (W₂ + N) b + r (W₂ b/2 + N s)]/[(W₁ + W₂) h₁/2]

    The held roof load has no horizontal displacement and does no work against the shaking.

    Parameters
    ----------
    facade : Facade
        Its hinge inset applies at the base and at the joint.
    hinge_height_m : float
    """
    f = _checked(facade)
    h1, h2 = hinge_height_m, f.height_m - hinge_height_m
    if not (0.0 < h1 < f.height_m):
        raise ValueError(f"hinge_height_m: expected 0 to {f.height_m:g} m, got {h1:g}")
    base = (f.thickness_m - f.hinge_inset_m, 0.0)
    joint = (f.hinge_inset_m, h1)
    lower = turning(joint, base)
    arm = f.thickness_m - f.hinge_inset_m  # from the joint's hinge to the outer face
    length, angle = math.hypot(arm, h2), math.atan2(h2, arm)

    def back(theta):
        """Rotation of the upper block that leaves its outer top edge where it is in y."""
        y, _ = lower(theta)
        return cmath.acos((f.thickness_m - y) / length) - angle

    def upper(point):
        dy, dz = point[0] - joint[0], point[1] - joint[1]

        def path(theta):
            (y, z), psi = lower(theta), back(theta)
            cos, sin = cmath.cos(psi), cmath.sin(psi)
            return y + dy * cos - dz * sin, z + dy * sin + dz * cos

        return path

    b, w = f.thickness_m, f.weight_n / f.height_m
    weights = [Weight(p, turning((0.5 * b, z), base)) for p, z in spread_weight(w * h1, 0.0, h1)]
    weights += [Weight(p, upper((0.5 * b, z))) for p, z in spread_weight(w * h2, h1, f.height_m)]
    if f.roof_n > 0.0:
        weights.append(Weight(f.roof_n, _vertical(upper((f.roof_arm_m, f.height_m)))))
    largest = math.asin(min(0.95 * length / h1, 0.95))  # the joint stays within its reach
    return Mechanism("vertical bending", tuple(weights), lower, (), largest)


def _vertical(path):
    """Vertical part of a path: a load whose bearing slides on what holds it."""

    def only(theta):
        return complex(0.0), path(theta)[1]

    return only


def lowest_two_blocks(facade, shares=19):
    """Hinge height with the smallest α0 [m], and its mechanism, of multiples of h/(shares + 1)."""
    heights = facade.height_m * np.arange(1, shares + 1) / (shares + 1)
    found = [(two_blocks(facade, float(z)), float(z)) for z in heights]
    mechanism, height = min(found, key=lambda item: item[0].multiplier())
    return height, mechanism
