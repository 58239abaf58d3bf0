"""Demand of shaking on an oscillator: spectra of a record or of a table, and of floors.

A demand knows its peak ground acceleration and its pseudo-acceleration at any period and damping,
in g. All of them are proportional to the intensity, so a check that compares a demand with a
capacity just fails at PGA × capacity/demand.
"""

from dataclasses import dataclass, field

import numpy as np

from rocking.mechanics.closed_forms import G_M_S2
from smdof.chain import shear_chain
from smdof.spectra import response_spectrum

REFERENCE = 0.05  # damping ratio of a spectrum given as a table


def eta(damping_ratio):
    """Factor η = √(10/(5 + ξ)) ≥ 0.55 on a spectrum of 5 %, ξ in per cent (NTC 2018, 3.2.3.2.1)."""
    return max(np.sqrt(10.0 / (5.0 + 100.0 * damping_ratio)), 0.55)


@dataclass(frozen=True)
class RecordDemand:
    """Elastic spectrum of one accelerogram as it is, exact for its straight lines.

    Parameters
    ----------
    acceleration_m_s2 : ndarray
    dt_s : float
    """

    acceleration_m_s2: np.ndarray
    dt_s: float
    _known: dict = field(default_factory=dict, repr=False, compare=False)

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
            found = response_spectrum(self.acceleration_m_s2, self.dt_s, [period_s], damping_ratio)
            self._known[key] = float(found.psa_m_s2[0]) / G_M_S2
        return self._known[key]


@dataclass(frozen=True)
class TableDemand:
    """Spectrum of 5 % damping given by points, straight between them, ∝ 1/T² beyond the last.

    Parameters
    ----------
    period_s, acceleration_g : ndarray
        Periods ascend from 0, where the value is the PGA.
    """

    period_s: np.ndarray
    acceleration_g: np.ndarray

    @property
    def pga_g(self):
        """Value at period 0 [g]."""
        return float(self.acceleration_g[0])

    def acceleration(self, period_s, damping_ratio=REFERENCE):
        """Pseudo-acceleration [g]; away from 5 % by η, except at period 0."""
        if period_s <= 0.0:
            return self.pga_g
        last = self.period_s[-1]
        value = np.interp(period_s, self.period_s, self.acceleration_g)
        value *= min(1.0, last / period_s) ** 2
        return float(value * eta(damping_ratio))


def displacement(demand, period_s, damping_ratio):
    """S_De(T) = S_e(T) T²/4π² [m]."""
    value = demand.acceleration(period_s, damping_ratio) * G_M_S2
    return value * (period_s / (2.0 * np.pi)) ** 2


@dataclass(frozen=True)
class FloorDemand:
    """Floor spectrum at height z by the formula of the Circolare 7/2019, C7.2.3.

    Of every mode k the floor feels a_k = S_e(T_k, ξ_k)|γ_k ψ_k(z)|√(1 + 0.0004 ξ_k²), ξ in per
    cent. An oscillator of period T and damping ξ on the floor feels, with R = 1.1 ξ_k^−0.5 η(ξ) and
    ξ_k as a ratio,

        R a_k/[1 + (R − 1)(1 − T/0.8T_k)^1.6]   for T < 0.8 T_k,
        R a_k                                   for 0.8 T_k ≤ T < 1.1 T_k,
        R a_k/[1 + (R − 1)(T/1.1T_k − 1)^1.2]   above,

    and the modes are combined by the root of the sum of squares. At T = 0 that is the peak floor
    acceleration. Not checked against the official text; measured against the exact chain in
    `floor_spectra`.

    Parameters
    ----------
    ground : RecordDemand or TableDemand
    period_s, share : tuple of float
        Of the modes that count: T_k, γ_k ψ_k(z).
    damping_ratio : float
        ξ_k of the building's modes.
    grounded : bool
        Beyond the longest period never below the ground's own spectrum, which a soft oscillator
        feels whatever the building does. Not in the transcription; see `floor_spectra` for what
        its absence means.
    """

    ground: RecordDemand | TableDemand
    period_s: tuple
    share: tuple
    damping_ratio: float = REFERENCE
    grounded: bool = False

    @property
    def pga_g(self):
        """PGA of the ground's demand [g], to which the floor's is proportional."""
        return self.ground.pga_g

    def peaks(self):
        """a_k of every mode [g]."""
        root = np.sqrt(1.0 + 0.0004 * (100.0 * self.damping_ratio) ** 2)
        return tuple(
            self.ground.acceleration(t, self.damping_ratio) * abs(s) * root
            for t, s in zip(self.period_s, self.share, strict=True)
        )

    def acceleration(self, period_s, damping_ratio=REFERENCE):
        """Pseudo-acceleration of an oscillator on the floor [g]."""
        r = 1.1 * self.damping_ratio**-0.5 * eta(damping_ratio)
        square = 0.0
        for own, peak in zip(self.period_s, self.peaks(), strict=True):
            below, above = 1.0 - period_s / (0.8 * own), period_s / (1.1 * own) - 1.0
            divisor = 1.0
            if below > 0.0:
                divisor += (r - 1.0) * below**1.6
            elif above > 0.0:
                divisor += (r - 1.0) * above**1.2
            square += (r * peak / divisor) ** 2
        found = float(np.sqrt(square))
        if self.grounded and period_s > max(self.period_s):
            found = max(found, self.ground.acceleration(period_s, damping_ratio))
        return found


def floor_demand(ground, height_ratio, chain, simplified=False, grounded=False):
    """Floor spectrum at a share of the building's height.

    Parameters
    ----------
    ground : RecordDemand or TableDemand
    height_ratio : float
        z over the height of the building; shapes are straight between floors.
    chain : dict
        Section smdof: n_dof, period_s, damping_ratio.
    simplified : bool
        First mode alone, γ1 = 3n/(2n + 1) and ψ1 = z/H, as the code offers where no modal analysis
        is at hand; else every mode of the equal chain, exact.
    grounded : bool
        See `FloorDemand`.
    """
    n = chain["n_dof"]
    if not 0.0 <= height_ratio <= 1.0:
        raise ValueError(f"height_ratio: expected 0 to 1, got {height_ratio}")
    if simplified:
        gamma = 3.0 * n / (2.0 * n + 1.0)
        periods, shares = [chain["period_s"]], [gamma * height_ratio]
    else:
        modes = shear_chain(n, chain["period_s"])
        rows = np.vstack([np.zeros(n), modes.modes()[1]])
        levels = np.arange(n + 1) / n
        periods = modes.periods_s()
        shares = [np.interp(height_ratio, levels, rows[:, k]) for k in range(n)]
    return FloorDemand(
        ground,
        tuple(float(t) for t in periods),
        tuple(float(s) for s in shares),
        chain["damping_ratio"],
        grounded,
    )
