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
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from rocking.mechanics.closed_forms import GRAVITY_M_S2

TINY = 1e-30  # complex step
COURSES = 400  # points at which a capacity curve is searched for its zero
AT_END = 1e-9  # of a pull's reach: what rounding may add where it is evaluated at its end
BESIDE = 1e-6  # of a rotation: past a drop


class Weight(NamedTuple):
    """Weight P [N] and the path θ → (y, z) [m] of its point."""

    weight_n: float
    path: Callable


class Pull(NamedTuple):
    """Inward horizontal force on a point of the façade, on the path θ → (y, z) [m].

    It pulls from an outward displacement of the point, the slack, up to the reach, itself included;
    one that fades falls linearly to zero there, others hold until there.
    """

    force_n: float
    path: Callable
    reach_m: float = math.inf
    fades: bool = False
    slack_m: float = 0.0


@dataclass(frozen=True)
class Mechanism:
    """Weights, pulls and the point whose outward displacement is d_C."""

    name: str
    weights: tuple[Weight, ...]
    control: Callable  # θ → (y, z) of the control point [m]
    pulls: tuple[Pull, ...] = ()
    largest_rad: float = 0.5 * math.pi  # end of the kinematics
    pieces: tuple = ()  # rigid ones as (low_m, high_m, what makes a point's path), for drawings
    lumped: tuple[Weight, ...] = ()  # `weights` with those of one block at their centroid
    _rotations: dict = field(default_factory=dict, repr=False, compare=False)  # by displacement

    def multiplier(self, theta_rad=0.0):
        """α(θ) of the module's equation [-]; of an array of rotations an array."""
        lifted = pushed = 0.0
        for p, path in self.lumped or self.weights:  # a block's path is linear in its points
            out, up = rate(path, theta_rad)
            pushed, lifted = pushed + p * out, lifted + p * up
        return (lifted + sum(self._pull(pull, theta_rad) for pull in self.pulls)) / pushed

    @staticmethod
    def _pull(pull, theta):
        gone = pull.path(theta)[0].real - pull.path(0.0)[0].real
        acts = (pull.slack_m <= gone) & (gone <= pull.reach_m * (1.0 + AT_END))
        left = np.maximum(1.0 - gone / pull.reach_m, 0.0) if pull.fades else 1.0
        return acts * left * pull.force_n * rate(pull.path, theta)[0]

    def displacement(self, theta_rad):
        """d_C of the control point [m]."""
        return float(self.control(theta_rad)[0].real - self.control(0.0)[0].real)

    def _turned(self, pull, gone_m):
        """Rotation at which a pull's point has moved so far [rad]; None where it never does."""
        start = pull.path(0.0)[0].real

        def left(t):
            return pull.path(t)[0].real - start - gone_m

        return (
            brentq(left, 0.0, self.largest_rad, xtol=1e-14) if left(self.largest_rad) > 0 else None
        )

    @cached_property
    def _course(self):
        """Rotations over the whole kinematics, either side of where a pull begins or ends; α."""
        grid = set(np.linspace(0.0, self.largest_rad, COURSES + 1).tolist())
        for pull in self.pulls:
            for gone in (pull.slack_m, pull.reach_m):
                if 0.0 < gone < math.inf and (turned := self._turned(pull, gone)) is not None:
                    grid |= {turned, turned * (1.0 + BESIDE)}
        rotations = np.array(sorted(grid))
        return rotations, self.multiplier(rotations)

    def falls(self):
        """Whether α vanishes at some rotation; squat blocks between held levels lock instead."""
        return bool((self._course[1] <= 0.0).any())

    def ultimate(self):
        """Rotation [rad] and displacement d0 [m] of the control point at which α first is zero.

        A ValueError where α is not positive at the start, or never vanishes.
        """
        return self._ultimate

    @cached_property
    def _ultimate(self):  # every check asks for it
        grid, alpha = self._course
        below = np.flatnonzero(alpha <= 0.0)
        if not below.size or below[0] == 0:
            when = "at rest" if below.size else "up to its largest rotation"
            raise ValueError(f"mechanism '{self.name}': the multiplier does not vanish {when}")
        k = below[0]
        root = brentq(self.multiplier, grid[k - 1], grid[k], xtol=1e-14)
        return float(root), self.displacement(root)

    def rotation(self, displacement_m):
        """θ at which the control point has moved by d_C [rad]."""
        if displacement_m not in self._rotations:
            self._rotations[displacement_m] = brentq(
                lambda t: self.displacement(t) - displacement_m, 0.0, self.largest_rad, xtol=1e-14
            )
        return self._rotations[displacement_m]

    def limit(self, share):
        """Displacement of the control point at which a limit state is reached [m], and why.

        The least of a share of d0 and of the displacement at which a pull ends and takes more than
        half of the largest multiplier with it (Circolare 7/2019, C8.7.1.2.1.6, for the SLV). What
        ends before d0 has no part in d0, which is of the curve that is left. A pull holds up to its
        end, itself included, so α there is that of the curve before the drop. The second value
        tells whether it is a pull's end.
        """
        limit_m, early = self._limits(share)
        return limit_m, early is not None

    def early(self, share):
        """The pull whose end sets `limit`; None where that is the share of d0."""
        return self._limits(share)[1]

    def without(self, pull):
        """The mechanism without one of its pulls."""
        left = tuple(other for other in self.pulls if other is not pull)
        return replace(self, pulls=left, _rotations={})

    def _limits(self, share):
        """`limit`'s displacement, and the pull that sets it or None."""
        theta0, d0 = self.ultimate()
        limit_m, early = share * d0, None
        grid, alpha = self._course
        largest = max(alpha[grid <= theta0])
        for pull in self.pulls:
            if not math.isfinite(pull.reach_m) or pull.fades:
                continue
            end = self._turned(pull, pull.reach_m)
            if end is None or end >= theta0:
                continue
            drop = self.multiplier(end) - self.multiplier(end * (1.0 + BESIDE))
            if drop > 0.5 * largest and self.displacement(end) < limit_m:
                limit_m, early = self.displacement(end), pull
        return limit_m, early

    def participation(self, letter=False):
        """Participating mass by the virtual displacements δ = y'(0) of the weights.

        M* = (Σ Pδ)²/(g Σ Pδ²), e* = g M*/Σ P; the displacement of the equivalent oscillator is
        d* = d_C Σ Pδ²/(δ_C Σ Pδ), with δ_C that of the control point (Circolare 7/2019, C8.7.1.4
        and C8.7.1.5).

        A load that a floor or a roof holds in place lifts and does not move sideways. The letter
        counts it in Σ P, which lowers e* and raises α0 g/e*, though a mass that does not move takes
        no part in the motion. Here Σ P has the weights that move alone; `letter` counts all.

        Returns
        -------
        mass_kg, ratio, per_control : float
            M*, e*, d*/d_C.
        """
        p, delta = self._moved
        linear, squared = p @ delta, p @ delta**2
        mass = linear**2 / (GRAVITY_M_S2 * squared)
        counted = p.sum() if letter else p[np.abs(delta) > 1e-12 * np.abs(delta).max()].sum()
        return mass, GRAVITY_M_S2 * mass / counted, squared / (rate(self.control, 0.0)[0] * linear)

    @cached_property
    def _moved(self):
        """Weights and their virtual displacements δ at rest."""
        p = np.array([weight for weight, _ in self.weights])
        return p, np.array([rate(path, 0.0)[0] for _, path in self.weights])

    def curve(self, points=101):
        """Capacity curve up to d0: displacement of the control point [m] and multiplier [-]."""
        theta = np.linspace(0.0, self.ultimate()[0], points)
        d = np.array([self.displacement(t) for t in theta])
        return d, np.array([self.multiplier(t) for t in theta])


def rate(path, theta):
    """Derivative of a path by θ, one or an array of them."""
    y, z = path(theta + 1j * TINY)
    return y.imag / TINY, z.imag / TINY


def cos_sin(angle):
    """Cosine and sine of a complex angle, or of an array of them."""
    if isinstance(angle, np.ndarray):
        return np.cos(angle.astype(complex)), np.sin(angle.astype(complex))
    return cmath.cos(angle), cmath.sin(angle)


def turning(point, hinge):
    """Path of a point of a block that turns outward about a hinge, both (y, z) [m]."""
    dy, dz = point[0] - hinge[0], point[1] - hinge[1]

    def path(theta):
        cos, sin = cos_sin(theta)
        return hinge[0] + dy * cos + dz * sin, hinge[1] - dy * sin + dz * cos

    return path


def spread_weight(weight_n, low_m, high_m):
    """Uniform weight between two heights as two halves at its Gauss points, (weight, z) each.

    They have its centroid and, exactly, its second moment along the height, which the
    participating mass takes: e* = 3/4 for a wall that turns about its base.
    """
    return [(0.5 * weight_n, z) for z in gauss(low_m, high_m)]


def gauss(low, high):
    """The two Gauss points of an interval."""
    middle, arm = 0.5 * (low + high), 0.5 * (high - low) / math.sqrt(3.0)
    return middle - arm, middle + arm
