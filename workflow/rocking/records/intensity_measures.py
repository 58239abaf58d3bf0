"""Intensity measures of a record, per unit of its PGA.

An incremental dynamic analysis scales a record, and all measures here scale with it, so an
intensity in PGA becomes one in any other measure by a factor of the record alone: nothing is
run again. p·PGV/g and PGV differ by a constant of the façade; they order the records of one
façade alike, and p·PGV/g serves to compare façades of different size.
"""

from dataclasses import dataclass

import numpy as np

from rocking.records import G_M_S2, integrate, measures
from smdof.spectra import response_spectrum


@dataclass(frozen=True)
class Measure:
    """Name of a measure in tables, its symbol and its unit ("-" for none)."""

    name: str
    symbol: str
    unit: str

    @property
    def label(self):
        """Label of an axis."""
        return f"{self.symbol} [{self.unit}]"


MEASURES = {
    m.name: m
    for m in (
        Measure("pga_g", "PGA", "g"),
        Measure("pgv_cm_s", "PGV", "cm/s"),
        Measure("sa_t1_g", "Sa(T1)", "g"),
        Measure("p_pgv_over_g", "p·PGV/g", "-"),
        Measure("sa_avg_g", "AvgSa", "g"),
        Measure("housner_cm", "SI", "cm"),
        Measure("miv_cm_s", "MIV", "cm/s"),
    )
}
AVERAGED = np.linspace(0.2, 3.0, 10)  # periods of AvgSa over T1 (Eads et al., 2015)
HOUSNER_S = np.linspace(0.1, 2.5, 49)  # periods of Housner's spectrum intensity


def record_measures(record, period_s, damping_ratio, p_rad_s):
    """Every measure of a record as it is, unscaled.

    Parameters
    ----------
    record : rocking.records.Record
    period_s, damping_ratio : float
        T1 and ζ of the oscillator behind Sa(T1), the pseudo-acceleration ω²·Sd, and of AvgSa, the
        geometric mean of Sa at ten periods from 0.2 T1 to 3 T1 (Eads, Miranda & Lignos, 2015,
        Earthq. Eng. Struct. Dyn. 44, 2057).
    p_rad_s : float
        Rocking frequency √(3g/4R) of the façade.

    Returns
    -------
    dict of str to float
        By the names of `MEASURES`. SI = ∫ PSV dT from 0.1 to 2.5 s at 5 % damping (Housner, 1952);
        MIV, the maximum incremental velocity, the largest |∫a dt| between two zero crossings of the
        acceleration (Anderson & Bertero, 1987, J. Struct. Eng. 113, 1739).
    """
    peaks = measures(record)
    a, dt = record.acceleration_m_s2, record.dt_s
    periods = np.concatenate([[period_s], period_s * AVERAGED])
    psa = response_spectrum(a, dt, periods, damping_ratio).psa_m_s2
    psv = response_spectrum(a, dt, HOUSNER_S, 0.05).psa_m_s2 * HOUSNER_S / (2.0 * np.pi)
    return {
        "pga_g": peaks["pga_g"],
        "pgv_cm_s": peaks["pgv_cm_s"],
        "sa_t1_g": float(psa[0]) / G_M_S2,
        "p_pgv_over_g": p_rad_s * peaks["pgv_cm_s"] / 100.0 / G_M_S2,
        "sa_avg_g": float(np.exp(np.mean(np.log(psa[1:])))) / G_M_S2,
        "housner_cm": 100.0 * float(np.trapezoid(psv, HOUSNER_S)),
        "miv_cm_s": 100.0 * incremental_velocity(a, dt),
    }


def incremental_velocity(acceleration_m_s2, dt_s):
    """Largest change of velocity while the acceleration keeps its sign [m/s].

    Exact for piecewise-linear acceleration: its crossings of zero are extremes of the velocity.
    """
    a = np.asarray(acceleration_m_s2, float)
    velocity, _ = integrate(a, dt_s)
    left, right = a[:-1], a[1:]
    cross = np.flatnonzero(left * right < 0.0)
    part = left[cross] / (left[cross] - right[cross])
    at = velocity[cross] + 0.5 * dt_s * part * left[cross]
    zeros = np.flatnonzero(a == 0.0)
    places = np.concatenate([[0.0], cross + part, zeros, [len(a) - 1.0]])
    values = np.concatenate([velocity[:1], at, velocity[zeros], velocity[-1:]])
    return float(np.abs(np.diff(values[np.argsort(places, kind="stable")])).max())


def per_pga(values):
    """Measures at a PGA of 1 g, the factors from PGA in g to each measure."""
    return {name: value / values["pga_g"] for name, value in values.items()}
