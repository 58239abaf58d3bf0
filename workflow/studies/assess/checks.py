"""Kinematic checks of codes of practice to their letter, and rigid-block results.

Each check has its capacity, its demand, what stands between, and the PGA at which it just fails
when its shaking is scaled. The formulas, with number, document and how each was read, are those of
`sources`; what follows from mechanics (virtual work, Housner's energy) is derived where it stands.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from rocking.mechanics.closed_forms import GRAVITY_M_S2, block
from rocking.records import G_M_S2
from rocking.records.intensity_measures import HOUSNER_S

from studies.assess.catalogue import SAY
from studies.assess.demand import displacement, largest_displacement
from studies.assess.sources import cited

BEHAVIOUR = 2.0  # q of the linear check
LEAST_KNOWN = 1.35  # FC of knowledge level 1
LIMITS = {  # share of d0, factor of the secant period, damping of the demand
    "SLV": (0.4, 1.68, 0.08),
    "SLC": (0.6, 1.56, 0.10),
}
EUROCODE = {"SD": (0.4, 0.08), "NC": (0.6, 0.10)}  # share of d0, damping (that of the Circolare)
EUROCODE_PERIOD = 1.6  # of π√(d/a)
MODEL_FACTOR = {1: 1.55, 2: 1.40, 3: 1.30}  # γ_Rd by knowledge level
INFINITE_STRENGTH = 1.2  # on γ_Rd, where blocks do not crush
FORCE_LIMIT = 3.6  # of the weight, in F_ph ≤ 3.6 W_p
CANTILEVER = 6.2  # κ of T0
ACTION_FACTOR = 1.0  # γ_Sd, which was not read


@dataclass(frozen=True)
class Check:
    """One check with everything between input and result."""

    name: str
    source: str
    capacity: float
    demand: float
    unit: str  # of both
    demand_pga_g: float  # of the shaking that the demand is of
    failing_pga_g: float  # at which it just fails, its shaking scaled; ∞ where it never does
    steps: tuple = field(repr=False)  # (symbol, meaning, value, unit) between, in their order

    @property
    def ratio(self):
        """PGA at which it just fails over that of the demand; at least 1 passes."""
        return self.failing_pga_g / self.demand_pga_g


def confidence(stated, hinge_inset_m):
    """FC to use: that of knowledge level 1 where the hinge does not crush (C8.7.1.2.1.3)."""
    return stated if hinge_inset_m > 0.0 else LEAST_KNOWN


def initial_period(length_m, thickness_m, unit_weight_n_m3, e_pa):
    """T0 = κ λ L √(W/(E g)), λ = L/t, κ = 6.2: a cantilever free to vibrate [s] (C8.7.1.7)."""
    slender = length_m / thickness_m
    return CANTILEVER * slender * length_m * math.sqrt(unit_weight_n_m3 / (e_pa * GRAVITY_M_S2))


def _shares(mechanism):
    """α0, e* and what turns d_C into d*."""
    return mechanism.multiplier(), *mechanism.participation()[1:]


def onset(mechanism, demand, confidence_factor, t0_s=0.0):
    """a_Z,SLD = α0 g/(e* FC) [g], and the PGA at which floor or ground reach it [g].

    With T0 the element is free to vibrate and feels S_eZ(T0) at 5 % (C8.7.1.8, C8.7.1.9).
    """
    alpha, ratio, _ = _shares(mechanism)
    start = alpha / (ratio * confidence_factor)
    return start, demand.pga_g * start / demand.acceleration(t0_s)


def linear(mechanism, demand, where, *, confidence_factor=1.0, behaviour=BEHAVIOUR, t0_s=0.0):
    """Linear check: q α0 g/(e* FC) against the peak acceleration of ground or floor.

    The demand, any of `demand` or a `CodeDemand`, is taken at T0: that of an element free to
    vibrate, 0 for one held by the walls behind it. `where` says "on the ground" or at which height.
    """
    alpha, ratio, _ = _shares(mechanism)
    start, damage = onset(mechanism, demand, confidence_factor, t0_s)
    peak = demand.acceleration(t0_s)
    capacity, fails = behaviour * start, behaviour * damage
    steps = (
        ("α0", SAY("step.multiplier"), alpha, "-"),
        ("e*", SAY("step.mass_ratio"), ratio, "-"),
        ("FC", SAY("step.confidence"), confidence_factor, "-"),
        ("a_SLD", SAY("step.onset"), start, "g"),
        ("T0", SAY("step.period_before"), t0_s, "s"),
        ("a_g,SLD", SAY("step.pga_onset"), damage, "g"),
        ("q", SAY("step.behaviour"), behaviour, "-"),
        ("q a_SLD", SAY("step.capacity"), capacity, "g"),
        ("a(T0)", SAY("step.acceleration", where=where), peak, "g"),
    )
    first = "onset_free" if t0_s else "onset"
    source = cited("multiplier", "mass", first, "confidence", "behaviour", "floor_peak")
    return Check(
        SAY("step.name_linear", where=where),
        source,
        capacity,
        peak,
        "g",
        demand.pga_g,
        fails,
        steps,
    )


def capacity_at(mechanism, displacement_m, confidence_factor, t0_s=0.0):
    """Spectral acceleration a [m/s²] at a displacement of the control point.

    a = α(d_C) g/(e* FC); for an element free to vibrate no more than the elastic 4π²d/T0² before
    that line meets the curve (C8.7.1.3, C8.7.1.6).
    """
    _, ratio, per_control = _shares(mechanism)
    alpha = mechanism.multiplier(mechanism.rotation(displacement_m))
    a = alpha * G_M_S2 / (ratio * confidence_factor)
    if t0_s:
        a = min(a, (2.0 * math.pi / t0_s) ** 2 * displacement_m * per_control)
    return a


def nonlinear(mechanism, demand, where, limit="SLV", *, confidence_factor=1.0, t0_s=0.0):
    """Non-linear check: what is left of d0 against the displacement demand up to the secant period.

    The capacity curve is that of the equivalent oscillator, a = α g/(e* FC) and d = d_C Σ Pδ²/
    (δ_C Σ Pδ). With d_SLV the least of 0.4 d0 and of a link's failure: T = 1.68π√(d/a(d)), demand
    the largest S_De over [T0, T] at 8 % damping; with d_SLC = 0.6 d0: 1.56π, 10 %. The PGA at which
    it fails is not taken below that of the onset.
    """
    share, factor, damping = LIMITS[limit]
    _, ratio, per_control = _shares(mechanism)
    ultimate = mechanism.ultimate()[1]
    control, broken = mechanism.limit(share) if limit == "SLV" else (share * ultimate, False)
    why = SAY("step.gives_way") if broken else SAY("step.share_d0", share=share)
    d = control * per_control
    a = capacity_at(mechanism, control, confidence_factor, t0_s)
    if a <= 0.0:
        raise ValueError(f"non-linear check: no acceleration left at {share} d0")
    period = factor * math.pi * math.sqrt(d / a)
    needed, at = largest_displacement(demand, t0_s, period, damping)
    damage = onset(mechanism, demand, confidence_factor, t0_s)[1]
    fails = max(demand.pga_g * d / needed, damage)
    steps = (
        ("d0", SAY("step.ultimate"), ultimate, "m"),
        ("d*/d_C", SAY("step.per_control"), per_control, "-"),
        (f"d_{limit}", SAY("step.of_oscillator", why=why), d, "m"),
        (f"a(d_{limit})", SAY("step.capacity_acceleration"), a / G_M_S2, "g"),
        (f"T_{limit}", SAY("step.secant", factor=factor), period, "s"),
        ("ξ", SAY("step.damping"), damping, "-"),
        ("T_max", SAY("step.period_largest"), at, "s"),
        ("S_De", SAY("step.needed", where=where), needed, "m"),
        ("a_g,SLD", SAY("step.pga_onset_least"), damage, "g"),
        (f"a_g,{limit}", SAY("step.pga_fails"), fails, "g"),
    )
    secant = f"secant_{limit.lower()}"
    keys = ("acceleration", "displacement", "limits", secant, "largest", "at_height", "floor")
    name = SAY("step.name_nonlinear", limit=limit, where=where)
    return Check(name, cited(*keys), d, needed, "m", demand.pga_g, fails, steps)


def eurocode(mechanism, demand, where, limit="SD", *, knowledge=1, crushes=False):
    """Rocking check of EN 1998-3:2025, known at second hand.

    With λ falling in a line from λ0 to zero at d0, a* = λ g/e* and T = 1.6π√(d/a*) at d = 0.4 d0
    (SD) or 0.6 d0 (NC): γ_Sd S_De(T) η(ξ) ≤ d/γ_Rd. Where ties or anchors pull, α(d) of the real
    curve is taken if less: they may have given way before. γ_Rd = 1.55, 1.40, 1.30 by knowledge
    level, times 1.2 where blocks do not crush. On a floor η is left out. The damping is the
    Circolare's, the floor spectrum too; γ_Sd was not read and is taken as 1. `crushes`: whether
    the hinge lies inside the outer face.
    """
    share, damping = EUROCODE[limit]
    alpha, ratio, per_control = _shares(mechanism)
    ultimate = mechanism.ultimate()[1]
    d = share * ultimate * per_control
    left = alpha * (1.0 - share)
    if mechanism.pulls:
        left = min(left, mechanism.multiplier(mechanism.rotation(share * ultimate)))
    a = left * G_M_S2 / ratio
    period = EUROCODE_PERIOD * math.pi * math.sqrt(d / a)
    ground = not hasattr(demand, "ground")
    needed = ACTION_FACTOR * displacement(demand, period, damping if ground else 0.05)
    gamma = MODEL_FACTOR[knowledge] * (1.0 if crushes else INFINITE_STRENGTH)
    capacity, fails = d / gamma, demand.pga_g * d / (gamma * needed)
    steps = (
        ("λ0", SAY("step.multiplier"), alpha, "-"),
        ("d0*", SAY("step.ultimate_oscillator"), ultimate * per_control, "m"),
        (f"d_{limit}", SAY("step.share", share=share), d, "m"),
        ("a*", SAY("step.eurocode_acceleration"), a / G_M_S2, "g"),
        (f"T_{limit}", SAY("step.eurocode_secant"), period, "s"),
        ("γ_Rd", SAY("step.model_factor"), gamma, "-"),
        ("γ_Sd", SAY("step.action_factor"), ACTION_FACTOR, "-"),
        (f"d_{limit}/γ_Rd", SAY("step.capacity"), capacity, "m"),
        ("γ_Sd S_De", SAY("step.demand", where=where), needed, "m"),
    )
    name = SAY("step.name_eurocode", limit=limit, where=where)
    return Check(name, cited("rocking"), capacity, needed, "m", demand.pga_g, fails, steps)


def height_coefficient(height_m, building_m):
    """C_Hi of NZS 1170.5, 8.3: the smallest that applies of 1 + h_i/6, 1 + 10 h_i/h_n and 3.

    1 + h_i/6 for h_i < 12 m, 1 + 10 h_i/h_n for h_i < 0.2 h_n, 3 above both.
    """
    choices = [3.0]
    if height_m < 12.0:
        choices.append(1.0 + height_m / 6.0)
    if height_m < 0.2 * building_m:
        choices.append(1.0 + 10.0 * height_m / building_m)
    return min(choices)


def part_coefficient(period_s):
    """C_i(T_p) of NZS 1170.5, 8.4: 2 to 0.75 s, 2(1.75 − T_p) to 1.5 s, 0.5 beyond."""
    return float(np.clip(2.0 * (1.75 - period_s), 0.5, 2.0))


def parts(mechanism, demand, height_m, building_m, period_s, *, response_factor=1.0):
    """Parts demand of NZS 1170.5 against the force that sets the mechanism off.

    F_ph = C(0) C_Hi C_i(T_p) C_ph R_p W_p ≤ 3.6 W_p, with C(0) the PGA of the demand; capacity
    α0 W. It just fails at a PGA of α0/(C_Hi C_i C_ph R_p), and never where α0 is at least 3.6:
    where the limit binds the demand does not grow with the PGA. How the standard's companion lets a
    rocking wall use its displacement could not be read and is not attempted.

    Heights are h_i of the part's support and h_n of the building; the period is T_p, 0 for a rigid
    part, the response factor C_ph R_p.
    """
    alpha = mechanism.multiplier()
    high, shape = height_coefficient(height_m, building_m), part_coefficient(period_s)
    per_pga = high * shape * response_factor
    force = min(demand.pga_g * per_pga, FORCE_LIMIT)
    steps = (
        ("C(0)", SAY("step.pga"), demand.pga_g, "g"),
        ("h_i", SAY("step.support"), height_m, "m"),
        ("C_Hi", SAY("step.height_coefficient"), high, "-"),
        ("T_p", SAY("step.part_period"), period_s, "s"),
        ("C_i", SAY("step.shape_coefficient"), shape, "-"),
        ("C_ph R_p", SAY("step.response_factor"), response_factor, "-"),
        ("F_ph/W_p", SAY("step.force"), force, "-"),
        ("α0", SAY("step.capacity_multiplier"), alpha, "-"),
    )
    name = SAY("step.name_parts", period_s=period_s, height_m=height_m)
    fails = math.inf if alpha >= FORCE_LIMIT else alpha / per_pga
    return Check(name, cited("parts"), alpha, force, "-", demand.pga_g, fails, steps)


def mean_pseudo_velocity(demand):
    """Mean 5 % pseudo-velocity from 0.1 to 2.5 s, Housner's intensity over 2.4 s [m/s]."""
    t = HOUSNER_S
    v = [demand.acceleration(p) * G_M_S2 * p / (2.0 * np.pi) for p in t]
    return float(np.trapezoid(v, t) / (t[-1] - t[0]))


def housner(height_m, thickness_m, demand):
    """Housner's energy: the base velocity that just turns a free block over, against S_v.

    A base velocity V gives the block, by angular momentum about its toe, ω = mVR cos α/I; it falls
    where ½Iω² ≥ mgR(1 − cos α). With I = 4mR²/3: V = √(8gR(1 − cos α)/3)/cos α, about αg/p.
    Housner (1963) compares it with the velocity spectrum, taken as flat: here the mean of the 5 %
    pseudo-velocity over 0.1 to 2.5 s.
    """
    alpha, radius, p = block(height_m, thickness_m)
    lift = radius * (1.0 - math.cos(alpha))
    needed = math.sqrt(8.0 * GRAVITY_M_S2 * lift / 3.0) / math.cos(alpha)
    given = mean_pseudo_velocity(demand)
    steps = (
        ("α", SAY("step.slenderness"), alpha, "rad"),
        ("R", SAY("step.half_diagonal"), radius, "m"),
        ("p", SAY("step.block_frequency"), p, "rad/s"),
        ("V", SAY("step.velocity"), needed, "m/s"),
        ("S_v", SAY("step.pseudo_velocity"), given, "m/s"),
    )
    name, fails = SAY("step.name_housner"), demand.pga_g * needed / given
    return Check(name, cited("energy"), needed, given, "m/s", demand.pga_g, fails, steps)
