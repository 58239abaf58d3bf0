"""Closed forms of rocking mechanics, against which every solver of the project is checked.

A rigid rectangular block of height h and thickness b rocks about its toes:
slenderness α = atan(b/h), half diagonal R, frequency p = √(3g/4R). Angles in
radian, rotation positive outward, SI units throughout.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy

from yade_scripts.model.gravity import GRAVITY_M_S2


def _positive(**values):
    """Raise a ValueError that names the first value that is not positive and finite."""
    for name, value in values.items():
        if not np.all(np.isfinite(value)) or not np.all(np.asarray(value) > 0.0):
            raise ValueError(f"{name}: expected a positive value, got {value}")


# Geometry and free rocking -----------------------------------------------------------------------


class BlockShape(NamedTuple):
    """Slenderness α [rad], half diagonal R [m] and rocking frequency p [rad/s] of a block."""

    alpha_rad: float
    half_diagonal_m: float
    p_rad_s: float


def block(h_m, b_m, gravity_m_s2=GRAVITY_M_S2):
    """α = atan(b/h), R = √(h² + b²)/2 and p = √(3g/4R) of a homogeneous block (Housner, 1963)."""
    _positive(h_m=h_m, b_m=b_m, gravity_m_s2=gravity_m_s2)
    radius = 0.5 * math.hypot(h_m, b_m)
    return BlockShape(math.atan2(b_m, h_m), radius, math.sqrt(0.75 * gravity_m_s2 / radius))


def _release(ratio):
    """Check a release angle θ0/α."""
    if not 0.0 < ratio < 1.0:
        raise ValueError(f"theta0_over_alpha: expected a value between 0 and 1, got {ratio}")


def quarter_period(theta0_over_alpha, p_rad_s):
    """Time from release at θ0 to the impact, acosh(1/(1 − θ0/α))/p [s].

    Linearised for slender blocks (Housner, 1963); a quarter of the period of
    free two-sided rocking without loss, half the first bounce of one-sided rocking.
    """
    _release(theta0_over_alpha)
    _positive(p_rad_s=p_rad_s)
    return math.acosh(1.0 / (1.0 - theta0_over_alpha)) / p_rad_s


def quarter_period_finite(theta0_over_alpha, h_m, b_m, gravity_m_s2=GRAVITY_M_S2):
    """Same time for finite angles [s]: ∫ dθ/θ̇ with θ̇² = 2p²(cos(α − θ0) − cos(α − θ)).

    With θ = θ0 − s² the integrand is regular at the release.
    """
    _release(theta0_over_alpha)
    alpha, _, p = block(h_m, b_m, gravity_m_s2)
    theta0 = theta0_over_alpha * alpha

    def integrand(s):
        # cos A − cos B = 2 sin((A + B)/2) sin((B − A)/2), without cancellation
        half = 0.5 * s * s
        drop = 2.0 * math.sin(alpha - theta0 + half) * (math.sin(half) / (s * s) if s else 0.5)
        return 2.0 / (p * math.sqrt(2.0 * drop))

    return scipy.integrate.quad(integrand, 0.0, math.sqrt(theta0), epsabs=0.0, epsrel=1e-10)[0]


def energy_ratio(theta_over_alpha):
    """Energy of a block at rest at θ over that at θ = α, 1 − (1 − θ/α)² (linearised)."""
    ratio = np.asarray(theta_over_alpha, float)
    return ratio * (2.0 - ratio)  # the same, without cancellation


def amplitude_after_impacts(theta0_over_alpha, restitution, n):
    """θn/α after n impacts: 1 − (1 − θn/α)² = e^{2n}[1 − (1 − θ0/α)²] (Housner, 1963).

    `restitution` e is the ratio of angular velocities after and before an impact.
    """
    left = np.asarray(restitution, float) ** (2 * np.asarray(n)) * energy_ratio(theta0_over_alpha)
    return left / (1.0 + np.sqrt(1.0 - left))  # 1 − √(1 − left), without cancellation


def restitution_observed(theta_n_over_alpha, theta0_over_alpha, n):
    """Experimental restitution e_exp from the n-th rebound (eq. 4 of the study)."""
    ratio = energy_ratio(np.abs(theta_n_over_alpha)) / energy_ratio(np.abs(theta0_over_alpha))
    return ratio ** (1.0 / (2.0 * np.asarray(n)))


def restitution_housner(alpha_rad):
    """Restitution of two-sided rocking, 1 − (3/2) sin²α (conservation of angular momentum)."""
    return 1.0 - 1.5 * np.sin(alpha_rad) ** 2


def restitution_one_sided(alpha_rad):
    """e_1SR of one-sided rocking (eq. 3 of the study), with its sign.

    Two impacts at the base and one against the return wall, (1 − (3/2)sin²α)² ·
    (1 − (3/2)cos²α). Negative for slender blocks, as the velocity reverses;
    e_exp of eq. 4 is to be compared with its magnitude.
    """
    return restitution_housner(alpha_rad) ** 2 * (1.0 - 1.5 * np.cos(alpha_rad) ** 2)


# Damping -----------------------------------------------------------------------------------------


def beta_one_sided(b_m, h_m, e_mpa):
    """Stiffness-proportional damping β_1SR [s] of one-sided rocking (eq. 5 of the study).

    A dimensional regression: b in m, E in **MPa**; fitted for b = 0.11 to 0.3 m and
    E = 1800 to 4050 MPa.
    """
    _positive(b_m=b_m, h_m=h_m, e_mpa=e_mpa)
    factor = b_m / 384.0 - e_mpa / 5.6e6 + 0.00074
    return factor * math.exp(h_m / b_m * (6572.0 - e_mpa) / 1.2e5)


def rayleigh_ratio(omega_rad_s, alpha_1_s, beta_s):
    """Damping ratio ζ = α/(2ω) + βω/2 of C = αM + βK (eq. 2 of the study)."""
    omega = np.asarray(omega_rad_s, float)
    return alpha_1_s / (2.0 * omega) + beta_s * omega / 2.0


def base_rocking_frequency(h_m, b_m, density_kg_m3, e_pa):
    """Circular frequency of a block's rotation on its linear base jkn = E/h [rad/s].

    ω² = (jkn b³w/12)/(m(h² + b²)/12) = (E/ρ)/(h²(1 + (h/b)²)). The largest β of the
    study's parameter range is β = 1/ω, that is ζ = 0.5.
    """
    _positive(h_m=h_m, b_m=b_m, density_kg_m3=density_kg_m3, e_pa=e_pa)
    return math.sqrt(e_pa / density_kg_m3 / (1.0 + (h_m / b_m) ** 2)) / h_m


# Overturning by pulses ---------------------------------------------------------------------------


def overturning_rectangular(x, p_rad_s):
    """Shortest rectangular pulse a = xαg that overturns, t1 = ln(x/(x − 1))/p [s]; ∞ for x ≤ 1.

    Linearised and without impact, from p∫(a/αg)e^{−pτ}dτ = 1.
    """
    _positive(x=x, p_rad_s=p_rad_s)
    return math.log(x / (x - 1.0)) / p_rad_s if x > 1.0 else math.inf


def overturning_half_sine(omega_over_p):
    """Smallest x at which a half sine xαg·sin ωt overturns without impact (linearised).

    Uplift at sin φ = 1/x; then x·p∫ sin(ωτ)e^{−pτ}dτ from uplift to the pulse's end
    equals 1, with τ counted from uplift.
    """
    _positive(omega_over_p=omega_over_p)
    r = omega_over_p

    def excess(x):
        phi = math.asin(1.0 / x)
        tail = r * math.exp(-(math.pi - phi) / r)
        return x * (tail + math.sin(phi) + r * math.cos(phi)) / (1.0 + r * r) - 1.0

    high = 2.0
    while excess(high) < 0.0:
        high *= 2.0
    return scipy.optimize.brentq(excess, 1.0, high, xtol=1e-13)


# Static capacity curves --------------------------------------------------------------------------


def capacity_rigid(theta_rad, h_m, b_m):
    """Static multiplier λ(θ) = tan(α − θ) of a rigid block on a rigid base."""
    return np.tan(math.atan2(b_m, h_m) - np.asarray(theta_rad, float))


@dataclass(frozen=True)
class Interlocked:
    """Return walls of courses that interlock with the façade.

    Attributes
    ----------
    course_height_m, overlap_m, return_thickness_m : float
        h_b, v and t_s.
    friction : float
        μ = tan φ of the courses on each other.
    return_walls : int
    """

    course_height_m: float
    overlap_m: float
    return_thickness_m: float
    friction: float
    return_walls: int = 2

    def __post_init__(self):
        """Check the sizes."""
        _positive(**{k: v for k, v in vars(self).items() if k.endswith("_m")})

    def rubbing_n(self, unit_weight_n_m3):
        """F_1 = μ γ t_s v h_b in one wall [N]: what rubs in joint i is i times that."""
        force = self.friction * unit_weight_n_m3 * self.return_thickness_m
        return force * self.overlap_m * self.course_height_m


def capacity_interlocking(
    theta_rad, h_m, b_m, w_m, density_kg_m3, bricks, bound="upper", gravity_m_s2=GRAVITY_M_S2
):
    """Kinematic capacity curve of a façade that rocks away from interlocked return walls.

    Joint i = 1…n − 1 from the top lies at y_i = h − i·h_b above the hinge and
    rubs with F_i = μγ t_s v h_b i in each return wall; it slips s_i = y_i sin θ.

    λ(θ) = [W(b/2·cosθ − h/2·sinθ) + N_rw ΣF_i k_i y_i cosθ] / [W(h/2·cosθ + b/2·sinθ)]

    Parameters
    ----------
    theta_rad : array_like
        Rotation; the top displacement is d = h sin θ.
    h_m, b_m, w_m, density_kg_m3 : float
        Height, thickness and width of the façade; density of it and of the return walls.
    bricks : Interlocked
        The height must be a whole number of courses.
    bound : {"upper", "lower"}
        Upper: k_i = 1 while s_i < v, else 0. Lower: k_i = max(0, 1 − s_i/v).

    Returns
    -------
    ndarray
        λ, shape of `theta_rad`.

    References
    ----------
    Casapulla et al. (2019b), as used for the capacity curves of the study.
    """
    _positive(h_m=h_m, b_m=b_m, w_m=w_m, density_kg_m3=density_kg_m3)
    unit_weight = density_kg_m3 * gravity_m_s2
    course, overlap_m = bricks.course_height_m, bricks.overlap_m
    courses = round(h_m / course)
    if courses < 1 or abs(courses * course - h_m) > 1e-6 * h_m:
        raise ValueError(f"course_height_m: {course} m does not divide h_m = {h_m} m")
    if bound not in ("upper", "lower"):
        raise ValueError(f"bound: expected 'upper' or 'lower', got '{bound}'")
    theta = np.asarray(theta_rad, float)[..., None]
    i = np.arange(1, courses)
    y = h_m - i * course
    slip = y * np.sin(theta)
    if bound == "upper":
        engaged = (slip < overlap_m).astype(float)
    else:
        engaged = np.maximum(0.0, 1.0 - slip / overlap_m)
    force = bricks.rubbing_n(unit_weight) * i
    friction_moment = bricks.return_walls * np.sum(force * engaged * y, axis=-1)
    weight = unit_weight * h_m * b_m * w_m
    cos, sin = np.cos(theta[..., 0]), np.sin(theta[..., 0])
    arm = 0.5 * (b_m * cos - h_m * sin)
    return (weight * arm + friction_moment * cos) / (weight * 0.5 * (h_m * cos + b_m * sin))


def capacity_compliant_base(
    theta_rad, h_m, b_m, density_kg_m3, jkn_pa_m, gravity_m_s2=GRAVITY_M_S2, *, edge_pa=0.0
):
    """Static multiplier λ(θ) of a rigid block on a no-tension elastic base.

    Penetration falls linearly from the toe, by sin θ per unit of width. With k = jkn evenly and a
    spring k_e along either edge (`edge_pa`, per width), and W = ρghb:

    - full contact while (k b²/2 + k_e b) sin θ ≤ W; the reaction is eccentric by
      e = (k b³/12 + k_e b²/2) sin θ/W;
    - beyond, the toe sinks by p with k_e p + k p²/(2 sin θ) = W, and the resultant lies
      k p³/(6 W sin² θ) inside the toe: the pivot is inset and the capacity below tan(α − θ).
      Without k_e that is a third of the width in contact, c = √(2W/(k sin θ)).

    λ = (e·cosθ − h/2·sinθ)/(h/2·cosθ + b/2·sinθ)

    The lever arm leaves out the penetration itself, of order ρgh/jkn ≪ h.
    """
    _positive(h_m=h_m, b_m=b_m, density_kg_m3=density_kg_m3, jkn_pa_m=jkn_pa_m)
    theta = np.asarray(theta_rad, float)
    sin, cos = np.sin(theta), np.cos(theta)
    q = density_kg_m3 * gravity_m_s2 * h_m * b_m / jkn_pa_m
    edge = edge_pa / jkn_pa_m
    full = (b_m**3 / 12.0 + 0.5 * edge * b_m**2) * sin / q
    with np.errstate(divide="ignore", invalid="ignore"):
        width = np.sqrt(edge**2 + 2.0 * q / sin) - edge  # in contact
        partial = 0.5 * b_m - width**3 * sin / (6.0 * q)
    eccentricity = np.where(sin * (0.5 * b_m**2 + edge * b_m) <= q, full, partial)
    return (eccentricity * cos - 0.5 * h_m * sin) / (0.5 * (h_m * cos + b_m * sin))


def tip_over_compliant_base(h_m, b_m, density_kg_m3, jkn_pa_m, gravity_m_s2=GRAVITY_M_S2):
    """Rotation [rad] and value of the largest λ of `capacity_compliant_base`: static tip-over.

    Small-angle check: θ* = (√(2q)/(3h))^{2/3}. Returns (nan, 0) if the base is so
    soft that the upright block is unstable, jkn·b³w/12 ≤ W·h/2.
    """
    q = density_kg_m3 * gravity_m_s2 * h_m * b_m / jkn_pa_m
    if b_m**3 / 12.0 <= q * h_m / 2.0:
        return math.nan, 0.0
    alpha = math.atan2(b_m, h_m)
    minimum = scipy.optimize.minimize_scalar(
        lambda t: -capacity_compliant_base(t, h_m, b_m, density_kg_m3, jkn_pa_m, gravity_m_s2),
        bounds=(0.0, alpha),
        method="bounded",
        options={"xatol": 1e-10 * alpha},
    )
    return float(minimum.x), float(-minimum.fun)
