"""Checks of codes of practice and rigid-block results: capacity, demand, and the PGA between.

Formulas are those of the Circolare 7/2019 (C8.7.1.2.1, C7.2.3) and of NZS 1170.5 (section 8) as
secondary transcriptions report them; neither official text could be read. What follows from
mechanics (virtual work, Housner's energy) is derived where it stands.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from rocking.assessment.demand import displacement
from rocking.mechanics.closed_forms import G_M_S2, block

BEHAVIOUR = 2.0  # q of the linear check
LIMITS = {  # share of d0, factor of the secant period, damping of the demand
    "SLV": (0.4, 1.68, 0.08),
    "SLC": (0.6, 1.56, 0.10),
}
FORCE_LIMIT = 3.6  # of the weight, in F_ph ≤ 3.6 W_p


@dataclass(frozen=True)
class Check:
    """One check with everything between input and result.

    Attributes
    ----------
    name, source : str
    capacity, demand : float
        In `unit`.
    unit : str
    demand_pga_g : float
        PGA of the shaking that the demand is of.
    steps : tuple of (symbol, meaning, value, unit)
        Intermediate numbers in their order.
    """

    name: str
    source: str
    capacity: float
    demand: float
    unit: str
    demand_pga_g: float
    steps: tuple = field(default=(), repr=False)

    @property
    def ratio(self):
        """Capacity over demand; at least 1 passes."""
        return self.capacity / self.demand

    @property
    def failing_pga_g(self):
        """PGA at which the check just fails, its shaking scaled [g]."""
        return self.demand_pga_g * self.ratio


def _circolare(where):
    return f"Circolare 7/2019 C8.7.1.2.1, {where}; as transcribed, official text not checked"


def _shares(mechanism):
    """α0, e* and what turns d_C into d*."""
    return mechanism.multiplier(), *mechanism.participation()[1:]


def linear(mechanism, demand, where, *, confidence_factor=1.0, behaviour=BEHAVIOUR):
    """Linear check: q α0 g/(e* FC) against the peak acceleration of ground or floor.

    Parameters
    ----------
    mechanism : rocking.assessment.mechanism.Mechanism
    demand : RecordDemand, TableDemand or FloorDemand
        Taken at period 0.
    where : str
        "on the ground" or at which height.
    confidence_factor, behaviour : float
        FC, q.
    """
    alpha, ratio, _ = _shares(mechanism)
    onset = alpha / (ratio * confidence_factor)
    peak = demand.acceleration(0.0)
    steps = (
        ("α0", "multiplier that sets the mechanism off", alpha, "-"),
        ("e*", "participating mass ratio", ratio, "-"),
        ("FC", "confidence factor", confidence_factor, "-"),
        ("a_SLD", "α0 g/(e* FC), onset", onset, "g"),
        ("q", "behaviour factor", behaviour, "-"),
        ("q a_SLD", "capacity", behaviour * onset, "g"),
        ("a(T=0)", f"peak acceleration {where}", peak, "g"),
    )
    return Check(
        f"linear, {where}",
        _circolare("linear kinematic"),
        behaviour * onset,
        peak,
        "g",
        demand.pga_g,
        steps,
    )


def nonlinear(mechanism, demand, where, limit="SLV", *, confidence_factor=1.0):
    """Non-linear check: share of d0 against the displacement demand at the secant period.

    The capacity curve is that of the equivalent oscillator, a = α g/(e* FC) and d = d_C Σ Pδ²/
    (δ_C Σ Pδ). With d_SLV = 0.4 d0: T = 1.68π√(d/a(d)), demand S_De(T) at 8 % damping; with d_SLC =
    0.6 d0: T = 1.56π√(d/a(d)), 10 %.

    Parameters
    ----------
    limit : {"SLV", "SLC"}
    """
    share, factor, damping = LIMITS[limit]
    _, ratio, per_control = _shares(mechanism)
    ultimate = mechanism.ultimate()[1]
    d = share * ultimate * per_control
    alpha = mechanism.multiplier(mechanism.rotation(share * ultimate))
    a = alpha * G_M_S2 / (ratio * confidence_factor)
    if a <= 0.0:
        raise ValueError(f"non-linear check: no acceleration left at {share} d0")
    period = factor * math.pi * math.sqrt(d / a)
    needed = displacement(demand, period, damping)
    steps = (
        ("d0", "control point's displacement at which α vanishes", ultimate, "m"),
        ("d*/d_C", "oscillator's displacement over the control point's", per_control, "-"),
        (f"d_{limit}", f"{share} d0, of the oscillator: capacity", d, "m"),
        (f"α(d_{limit})", "multiplier in the turned position", alpha, "-"),
        (f"a(d_{limit})", "α g/(e* FC)", a / G_M_S2, "g"),
        (f"T_{limit}", f"{factor}π√(d/a)", period, "s"),
        ("ξ", "damping of the demand", damping, "-"),
        ("S_e(T)", f"spectral acceleration {where}", demand.acceleration(period, damping), "g"),
        ("S_De(T)", "displacement demand", needed, "m"),
    )
    return Check(
        f"non-linear {limit}, {where}",
        _circolare("non-linear kinematic"),
        d,
        needed,
        "m",
        demand.pga_g,
        steps,
    )


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
    α0 W. How the standard's companion lets a rocking wall use its displacement could not be read
    and is not attempted.

    Parameters
    ----------
    height_m, building_m : float
        h_i of the part's support, h_n of the building.
    period_s : float
        T_p; 0 for a rigid part.
    response_factor : float
        C_ph · R_p.
    """
    alpha = mechanism.multiplier()
    high, shape = height_coefficient(height_m, building_m), part_coefficient(period_s)
    force = min(demand.pga_g * high * shape * response_factor, FORCE_LIMIT)
    steps = (
        ("C(0)", "PGA", demand.pga_g, "g"),
        ("h_i", "height of the part's support", height_m, "m"),
        ("C_Hi", "floor height coefficient", high, "-"),
        ("T_p", "period of the part", period_s, "s"),
        ("C_i", "part spectral shape coefficient", shape, "-"),
        ("C_ph R_p", "response and risk factors", response_factor, "-"),
        ("F_ph/W_p", "demand", force, "-"),
        ("α0", "capacity: multiplier that sets the mechanism off", alpha, "-"),
    )
    name = f"parts, T_p = {period_s:.2g} s, h_i = {height_m:.3g} m"
    source = "NZS 1170.5:2004 section 8; as transcribed, official text not checked"
    return Check(name, source, alpha, force, "-", demand.pga_g, steps)


def mean_pseudo_velocity(demand, damping_ratio=0.05, low_s=0.1, high_s=2.5, points=49):
    """Mean pseudo-velocity from 0.1 to 2.5 s, Housner's spectrum intensity over 2.4 s [m/s]."""
    t = np.linspace(low_s, high_s, points)
    v = [demand.acceleration(p, damping_ratio) * G_M_S2 * p / (2.0 * np.pi) for p in t]
    return float(np.trapezoid(v, t) / (high_s - low_s))


def housner(height_m, thickness_m, demand):
    """Housner's energy: the base velocity that just turns a free block over, against S_v.

    A base velocity V gives the block, by angular momentum about its toe, ω = mVR cos α/I; it falls
    where ½Iω² ≥ mgR(1 − cos α). With I = 4mR²/3: V = √(8gR(1 − cos α)/3)/cos α, about αg/p.
    Housner (1963) compares it with the velocity spectrum, taken as flat: here the mean of the 5 %
    pseudo-velocity over 0.1 to 2.5 s.
    """
    alpha, radius, p = block(height_m, thickness_m)
    needed = math.sqrt(8.0 * G_M_S2 * radius * (1.0 - math.cos(alpha)) / 3.0) / math.cos(alpha)
    given = mean_pseudo_velocity(demand)
    steps = (
        ("α", "slenderness atan(b/h)", alpha, "rad"),
        ("R", "half diagonal", radius, "m"),
        ("p", "√(3g/4R)", p, "rad/s"),
        ("V", "velocity that turns the block over", needed, "m/s"),
        ("S_v", "mean pseudo-velocity, 0.1 to 2.5 s", given, "m/s"),
    )
    source = "Housner (1963); derived here from angular momentum and energy"
    return Check("Housner's energy", source, needed, given, "m/s", demand.pga_g, steps)
