"""An acceleration record, its peaks and its units.

Sign: as the file or surrogate gives it; which way is outward is decided by the
direction (pos or neg) of the analysis, not here.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from .errors import RecordError
from .packed import SHIPPED
from .text import MAX_DT_S, MIN_DT_S
from .units import G_M_S2, UNITS_M_S2, unit_name

__all__ = [
    "G_M_S2",
    "UNITS_M_S2",
    "Record",
    "RecordError",
    "begun",
    "check_plausible",
    "integrate",
    "measures",
    "significant_duration",
    "unit_name",
]

MIN_PGA_G, MAX_PGA_G = 1e-5, 5.0  # the strongest motions recorded reach about 4 g in vector sum
BEGINS = 0.005  # of its largest acceleration; what larger shares cost: docs/record.md#assessment

SOURCES = ("file", SHIPPED, "surrogate")


@dataclass(frozen=True)
class Record:
    """One ground acceleration history.

    Parameters
    ----------
    name : str
        Name in the records table; safe as part of a file name.
    acceleration_m_s2 : ndarray, shape (n,)
        Finite, uniformly sampled; linear between samples.
    dt_s : float
        Time step.
    source : str
        One of SOURCES: where the motion comes from; printed wherever it is shown.
    units_read : str
        Units in the file before conversion ("m/s2" for a surrogate).
    baseline : str
        Baseline treatment in words; "none" is the record as given.
    details : dict
        Provenance as plain values: file, format, component, SHA-256, or the
        surrogate's solved parameters.
    vertical_m_s2 : ndarray, shape (n,), or None
        The vertical motion recorded with it, upward positive; None where it is left out.
    """

    name: str
    acceleration_m_s2: np.ndarray
    dt_s: float
    source: str
    units_read: str = "m/s2"
    baseline: str = "none"
    details: dict = field(default_factory=dict)
    vertical_m_s2: np.ndarray | None = None

    def __post_init__(self):
        """Check shape, step, finiteness and a plausible peak."""
        a = self.acceleration_m_s2
        if a.ndim != 1 or len(a) < 2:
            raise RecordError(f"record {self.name}: expected at least 2 samples")
        if not MIN_DT_S <= self.dt_s <= MAX_DT_S:
            raise RecordError(
                f"record {self.name}: time step {self.dt_s:g} s; "
                f"expected {MIN_DT_S:g} … {MAX_DT_S:g} s"
            )
        if not np.all(np.isfinite(a)):
            raise RecordError(f"record {self.name}: not all samples are finite")

    def __len__(self):
        """Return the number of samples."""
        return len(self.acceleration_m_s2)

    @property
    def time_s(self):
        """Return the sample times from 0, shape (n,)."""
        return self.dt_s * np.arange(len(self))

    @property
    def duration_s(self):
        """Return the time from the first to the last sample."""
        return self.dt_s * (len(self) - 1)


def check_plausible(acceleration_m_s2, units, where):
    """Refuse a peak that no ground motion has; `where` names the file or record."""
    pga_g = float(np.max(np.abs(acceleration_m_s2))) / G_M_S2
    if not MIN_PGA_G <= pga_g <= MAX_PGA_G:
        raise RecordError(
            f"{where}: peak of {pga_g:.3g} g with units {units}; expected {MIN_PGA_G:g} … "
            f"{MAX_PGA_G:g} g: are the units right?"
        )


def begun(record, share=BEGINS):
    """A record from its last sample before it first exceeds a share of its largest acceleration.

    The vertical motion counts as the horizontal one does.
    """
    rows = [record.acceleration_m_s2]
    if record.vertical_m_s2 is not None:
        rows.append(record.vertical_m_s2)
    size = np.abs(rows).max(axis=0)
    later = [row[max(int((size > share * size.max()).argmax()) - 1, 0) :] for row in rows]
    return replace(record, **dict(zip(("acceleration_m_s2", "vertical_m_s2"), later, strict=False)))


def integrate(acceleration_m_s2, dt_s):
    """Velocity and displacement of piecewise-linear acceleration, exact, from rest.

    v_{i+1} = v_i + dt (a_i + a_{i+1})/2,
    d_{i+1} = d_i + dt v_i + dt² (2 a_i + a_{i+1})/6.

    Returns
    -------
    velocity_m_s, displacement_m : ndarray, shape (n,)
    """
    a = np.asarray(acceleration_m_s2, dtype=float)
    v = np.zeros_like(a)
    v[1:] = np.cumsum(dt_s * (a[:-1] + a[1:]) / 2.0)
    d = np.zeros_like(a)
    d[1:] = np.cumsum(dt_s * v[:-1] + dt_s**2 * (2.0 * a[:-1] + a[1:]) / 6.0)
    return v, d


def significant_duration(acceleration_m_s2, dt_s, low=0.05, high=0.95):
    """Time between two fractions of the Arias intensity ∫a² dt (Trifunac & Brady 1975) [s]."""
    a2 = np.asarray(acceleration_m_s2, dtype=float) ** 2
    arias = np.concatenate([[0.0], np.cumsum((a2[:-1] + a2[1:]) / 2.0)])
    times = np.interp([low * arias[-1], high * arias[-1]], arias, dt_s * np.arange(len(a2)))
    return float(times[1] - times[0])


def measures(record):
    """Peak values and durations of a record.

    Returns
    -------
    dict
        pga_g (standard gravity), pgv_cm_s and pgd_cm (from `integrate`, starting at
        rest; a record with an untreated baseline drifts and its pgd_cm with it),
        duration_s (first to last sample), significant_duration_s (5–95 % of Arias).
    """
    v, d = integrate(record.acceleration_m_s2, record.dt_s)
    return {
        "pga_g": float(np.max(np.abs(record.acceleration_m_s2))) / G_M_S2,
        "pgv_cm_s": float(np.max(np.abs(v))) * 100.0,
        "pgd_cm": float(np.max(np.abs(d))) * 100.0,
        "duration_s": record.duration_s,
        "significant_duration_s": significant_duration(record.acceleration_m_s2, record.dt_s),
    }
