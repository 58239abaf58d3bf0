"""Demand of shaking on an oscillator: spectra of a record, of a table, of a code, and of floors.

A demand knows its peak ground acceleration and its pseudo-acceleration at any period and damping,
in g. It is scaled with its PGA, so a check whose demand is proportional to it just fails at PGA ×
capacity/demand.
"""

import math
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from rocking.records import G_M_S2

from smdof.chain import shear_chain
from smdof.spectra import response_spectrum

REFERENCE = 0.05  # damping ratio of a spectrum given as a table
LOWER, UPPER = 0.8, 1.1  # a and b of C7.2.6
PERIOD_STEP = 1.08  # between the periods over which the largest displacement is sought
SAME = 1e-9  # relative, of displacements
SHORTEST = 12.0  # of the longest: no spectrum has its largest displacement below


def eta(damping_ratio):
    """Factor η = √(10/(5 + ξ)) ≥ 0.55 on a spectrum of 5 %, ξ in per cent (NTC 2018, 3.2.4)."""
    return max(np.sqrt(10.0 / (5.0 + 100.0 * damping_ratio)), 0.55)


@dataclass(frozen=True)
class RecordDemand:
    """Elastic spectrum of one accelerogram as it is, exact for its straight lines."""

    acceleration_m_s2: np.ndarray
    dt_s: float
    _known: dict = field(default_factory=dict, repr=False, compare=False)
    edges_s = ()  # periods between which its displacement is smooth, beside any grid's

    @property
    def pga_g(self):
        """Largest absolute ground acceleration [g]."""
        return float(np.abs(self.acceleration_m_s2).max()) / G_M_S2

    def acceleration(self, period_s, damping_ratio=REFERENCE):
        """Pseudo-acceleration ω²Sd [g]; the PGA at period 0."""
        if period_s <= 0.0:
            return self.pga_g
        key = (round(period_s, 12), round(damping_ratio, 12))
        if key not in self._known:
            self.compute([period_s], damping_ratio)
        return self._known[key]

    def compute(self, periods_s, damping_ratio):
        """Compute the spectrum at several periods at once, to be kept."""
        wanted = {float(t) for t in periods_s if t > 0.0}
        known = {t for t in wanted if (round(t, 12), round(damping_ratio, 12)) in self._known}
        periods = sorted(wanted - known)
        if not periods:
            return
        spectrum = response_spectrum(self.acceleration_m_s2, self.dt_s, periods, damping_ratio)
        for period, value in zip(periods, spectrum.psa_m_s2 / G_M_S2, strict=True):
            self._known[round(period, 12), round(damping_ratio, 12)] = float(value)


@dataclass(frozen=True)
class TableDemand:
    """Spectrum of 5 % damping given by points, straight between them, ∝ 1/T² beyond the last.

    Periods ascend from 0, where the value is the PGA.
    """

    period_s: np.ndarray
    acceleration_g: np.ndarray

    @property
    def pga_g(self):
        """Value at period 0 [g]."""
        return float(self.acceleration_g[0])

    @property
    def edges_s(self):
        """Periods at which it bends [s]; from the last on the displacement is the same."""
        return tuple(float(t) for t in self.period_s if t > 0.0)

    def acceleration(self, period_s, damping_ratio=REFERENCE):
        """Pseudo-acceleration [g]; away from 5 % by η, except at period 0."""
        if period_s <= 0.0:
            return self.pga_g
        last = self.period_s[-1]
        value = np.interp(period_s, self.period_s, self.acceleration_g)
        value *= min(1.0, last / period_s) ** 2
        return float(value * eta(damping_ratio))


def displacement(demand, period_s, damping_ratio):
    """S_De(T) = S_e(T) T²/4π² [m] (NTC 2018, 3.2.10).

    On a floor not less than S_eZ(T1) b²T1²/4π² where T > b T1, with T1 the building's longest
    period (Circolare 7/2019, C8.7.1.12): the displacement spectrum does not fall with the period.
    """
    value = demand.acceleration(period_s, damping_ratio) * G_M_S2 * (period_s / (2 * np.pi)) ** 2
    if isinstance(demand, FloorDemand):
        first = demand.period_s
        if period_s > UPPER * first:
            peak = demand.acceleration(first, damping_ratio) * G_M_S2
            value = max(value, peak * (UPPER * first / (2.0 * np.pi)) ** 2)
    return value


def largest_displacement(demand, low_s, high_s, damping_ratio):
    """Largest spectral displacement between two periods [m], and the period it is at [s].

    Circolare 7/2019, C8.7.1.2.1.8: so wherever accelerograms or a site response analysis give the
    spectrum. For a spectrum whose displacement grows with the period it is that at `high_s`; where
    it is the same from a period on, the first of these.
    """
    low = max(low_s, high_s / SHORTEST)
    first, last = (math.log(t) / math.log(PERIOD_STEP) for t in (low, high_s))
    periods = [*PERIOD_STEP ** np.arange(math.ceil(first), math.ceil(last)), high_s]
    ground = demand.ground if isinstance(demand, FloorDemand) else demand
    periods = sorted({*periods, *(t for t in ground.edges_s if low < t < high_s)})
    if isinstance(ground, RecordDemand):
        ground.compute(periods, damping_ratio)
    displacements_m = [displacement(demand, float(t), damping_ratio) for t in periods]
    most = max(displacements_m)
    k = next(k for k, value in enumerate(displacements_m) if value >= (1.0 - SAME) * most)
    return most, float(periods[k])


@dataclass(frozen=True)
class FloorDemand:
    """Floor spectrum at height z by the Circolare 7/2019, C7.2.5 to C7.2.8, of the first mode.

    The code says that the first mode is enough for ultimate states. Of it the floor feels
    a_1 = S_e(T1, ξ_1)|γ_1 ψ_1(z)|√(1 + 0.0004 ξ_1²), ξ_1 in per cent. An oscillator of period T and
    damping ξ on the floor feels, with R = 1.1 ξ_1^−0.5 η(ξ), ξ_1 as a ratio, a = 0.8 and b = 1.1,

        R a_1/[1 + (R − 1)(1 − T/aT1)^1.6]   for T < a T1,
        R a_1                                for a T1 ≤ T < b T1,
        R a_1/[1 + (R − 1)(T/bT1 − 1)^1.2]   above,

    and not less than S_e(T, ξ) of the ground where T > T1. At T = 0 it is the floor's peak
    acceleration, which is not taken below the ground's PGA: low down, the code's first mode alone
    would be.
    """

    ground: Any  # RecordDemand, TableDemand or CodeDemand
    period_s: float  # T1
    share: float  # γ_1 ψ_1(z)
    damping_ratio: float = REFERENCE  # ξ_1
    _known: dict = field(default_factory=dict, repr=False, compare=False)

    @property
    def pga_g(self):
        """PGA of the ground's demand [g], to which the floor's is proportional."""
        return self.ground.pga_g

    @cached_property
    def peak_g(self):
        """a_1 [g]."""
        root = np.sqrt(1.0 + 0.0004 * (100.0 * self.damping_ratio) ** 2)
        return self.ground.acceleration(self.period_s, self.damping_ratio) * abs(self.share) * root

    def acceleration(self, period_s, damping_ratio=REFERENCE):
        """Pseudo-acceleration of an oscillator on the floor [g]."""
        key = period_s, damping_ratio
        if key not in self._known:  # hundreds of mechanisms ask for the same periods
            self._known[key] = self._acceleration(period_s, damping_ratio)
        return self._known[key]

    def _acceleration(self, period_s, damping_ratio):
        r = 1.1 * self.damping_ratio**-0.5 * eta(damping_ratio)
        below = 1.0 - period_s / (LOWER * self.period_s)
        above = period_s / (UPPER * self.period_s) - 1.0
        divisor = 1.0
        if below > 0.0:
            divisor += (r - 1.0) * below**1.6
        elif above > 0.0:
            divisor += (r - 1.0) * above**1.2
        acceleration_g = float(r * self.peak_g / divisor)
        if period_s <= 0.0 or period_s > self.period_s:
            acceleration_g = max(acceleration_g, self.ground.acceleration(period_s, damping_ratio))
        return acceleration_g


def floor_demand(ground, height_ratio, chain, damaged=None):
    """Floor spectrum at a share z/H of the building's height; the shape is straight between floors.

    `chain` is section smdof. `damaged` are period factor and damping ratio of the building at
    ultimate states (C8.7.1.2.1.4); None leaves it as it is.
    """
    n = chain["n_dof"]
    period_s, shares = _first_mode(n, chain["period_s"])
    share = float(np.interp(height_ratio, np.arange(n + 1) / n, shares))
    factor, damping = damaged or (1.0, chain["damping_ratio"])
    return FloorDemand(ground, float(factor * period_s), share, damping)


@lru_cache(maxsize=64)
def _first_mode(n, period_s):
    """Period of a chain's first mode [s], and its γψ by level, the base's 0."""
    shear = shear_chain(n, period_s)
    return shear.periods_s()[0], np.append(0.0, shear.modes()[1][:, 0])
