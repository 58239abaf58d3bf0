"""Elastic spectra of codes by their parameters: NTC 2018, EN 1998-1:2004."""

from dataclasses import dataclass

from studies.assess.demand import REFERENCE, eta

SOILS = {  # subsoil: S_S = between bounds, p − q F0 a_g/g; C_C = r T_C*^s (table 3.2.IV)
    "A": ((1.0, 0.0, 1.0, 1.0), (1.0, 0.0)),
    "B": ((1.40, 0.40, 1.00, 1.20), (1.10, -0.20)),
    "C": ((1.70, 0.60, 1.00, 1.50), (1.05, -0.33)),
    "D": ((2.40, 1.50, 0.90, 1.80), (1.25, -0.50)),
    "E": ((2.00, 1.10, 1.00, 1.60), (1.15, -0.40)),
}
TOPOGRAPHY = {"T1": 1.0, "T2": 1.2, "T3": 1.2, "T4": 1.4}  # S_T at the top (table 3.2.V)


def soil_factors(soil, ag_g, f0, tc_star_s):
    """S_S and C_C of a subsoil (NTC 2018, table 3.2.IV)."""
    (p, q, low, high), (r, s) = SOILS[soil]
    return min(max(p - q * f0 * ag_g, low), high), r * tc_star_s**s


class Elastic:
    """Elastic spectrum of four branches, of a_g, F0 and S_S, S_T, T_B, T_C, T_D (`factors`)."""

    ag_g: float
    f0: float

    @property
    def factors(self) -> tuple:
        """S_S, S_T, T_B, T_C, T_D."""
        raise NotImplementedError

    @property
    def pga_g(self):
        """S_e(0) = a_g S [g]."""
        ss, st, *_ = self.factors
        return self.ag_g * ss * st

    @property
    def edges_s(self):
        """T_D, from which on the displacement is the same [s]."""
        return (self.factors[-1],)

    def acceleration(self, period_s, damping_ratio=REFERENCE):
        """S_e(T) [g]."""
        *_, tb, tc, td = self.factors
        high = eta(damping_ratio) * self.f0
        if period_s < tb:
            share = period_s / tb
            return self.pga_g * (high * share + 1.0 - share)
        shape = 1.0 if period_s < tc else tc / period_s
        if period_s >= td:
            shape = tc * td / period_s**2
        return float(self.pga_g * high * shape)


@dataclass(frozen=True)
class CodeDemand(Elastic):
    """Horizontal elastic spectrum of NTC 2018, 3.2.2 to 3.2.7.

    With S = S_S S_T, T_C = C_C T_C*, T_B = T_C/3 and T_D = 4 a_g/g + 1.6 s, S_e(T) is

        a_g S η F0 [T/T_B + (1 − T/T_B)/(η F0)]    for T < T_B,
        a_g S η F0, a_g S η F0 T_C/T, a_g S η F0 T_C T_D/T²   to T_C, to T_D, beyond.
    """

    ag_g: float  # of the limit state, on rock, and so are the next two
    f0: float
    tc_star_s: float
    soil: str = "A"  # of `SOILS`
    topography: str = "T1"  # of `TOPOGRAPHY`

    @property
    def factors(self):
        """S_S, S_T, T_B, T_C, T_D."""
        ss, cc = soil_factors(self.soil, self.ag_g, self.f0, self.tc_star_s)
        tc = cc * self.tc_star_s
        return ss, TOPOGRAPHY[self.topography], tc / 3.0, tc, 4.0 * self.ag_g + 1.6


@dataclass(frozen=True)
class EurocodeDemand(Elastic):
    """Horizontal elastic spectrum of EN 1998-1:2004, equations 3.2 to 3.5, at second hand.

    With a_g on ground A (times γ_I), S of the ground and T_B, T_C, T_D of its table or of a
    national annex, η = √(10/(5 + ξ)) ≥ 0.55, S_e(T) is

        a_g S [1 + (2.5 η − 1) T/T_B]   for T ≤ T_B,
        2.5 a_g S η, 2.5 a_g S η T_C/T, 2.5 a_g S η T_C T_D/T²   to T_C, to T_D, beyond.
    """

    ag_g: float
    soil_factor: float
    tb_s: float
    tc_s: float
    td_s: float
    f0: float = 2.5

    @property
    def factors(self):
        """S, 1, T_B, T_C, T_D."""
        return self.soil_factor, 1.0, self.tb_s, self.tc_s, self.td_s
