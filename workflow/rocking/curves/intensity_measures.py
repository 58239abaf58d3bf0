"""Intensity measures of a record, per unit of its PGA.

An incremental dynamic analysis scales a record, and all measures here scale with it, so an
intensity in PGA becomes one in any other measure by a factor of the record alone: nothing is
run again. p·PGV/g and PGV differ by a constant of the façade; they order the records of one
façade alike, and p·PGV/g serves to compare façades of different size.
"""

from dataclasses import dataclass

from rocking.records import G_M_S2, measures
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
    )
}


def record_measures(record, period_s, damping_ratio, p_rad_s):
    """Every measure of a record as it is, unscaled.

    Parameters
    ----------
    record : rocking.records.Record
    period_s, damping_ratio : float
        Of the oscillator behind Sa(T1), the pseudo-acceleration ω²·Sd.
    p_rad_s : float
        Rocking frequency √(3g/4R) of the façade.

    Returns
    -------
    dict of str to float
        By the names of `MEASURES`.
    """
    peaks = measures(record)
    spectrum = response_spectrum(record.acceleration_m_s2, record.dt_s, [period_s], damping_ratio)
    return {
        "pga_g": peaks["pga_g"],
        "pgv_cm_s": peaks["pgv_cm_s"],
        "sa_t1_g": float(spectrum.psa_m_s2[0]) / G_M_S2,
        "p_pgv_over_g": p_rad_s * peaks["pgv_cm_s"] / 100.0 / G_M_S2,
    }


def per_pga(values):
    """Measures at a PGA of 1 g, the factors from PGA in g to each measure."""
    return {name: value / values["pga_g"] for name, value in values.items()}
