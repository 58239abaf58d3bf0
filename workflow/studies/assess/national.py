"""The seismic hazard of NTC 2018 as it is tabulated: a_g, F0 and T_C* by return period.

The national grid gives them at nine return periods T_R from 30 to 2475 years. Between two of them
every parameter p follows log p = log p1 + log(p2/p1) log(T_R/T_R1)/log(T_R2/T_R1) (NTC 2008, annex
A, formula 2, which NTC 2018 keeps). a_g S_S S_T is the PGA that is exceeded 1/T_R times a year, so
the rows are a hazard curve as well as spectra.
"""

import math

import numpy as np

from studies.assess.code_spectrum import CodeDemand
from studies.shared.hazard import Hazard

PARAMETERS = ("ag_g", "f0", "tc_star_s")
PERIOD = "return_period_years"
# a_g [g] of the national grid at 475 years lies between 0.03 and 0.28, and grows with the return
# period as its power 0.42; half as much again, and a third, is no site of it.
LEAST_G, MOST_G, AT_YEARS, GROWTH = 0.01, 0.42, 475.0, 0.42


def check_rows(rows):
    """Refuse rows (PERIOD, PARAMETERS) that are no hazard, by a ValueError of one line."""
    if len(rows) < 2:
        raise ValueError(
            f"assessment.hazard: {len(rows)} row; expected two or more, by return period"
        )
    for number, row in enumerate(rows, 1):
        _refuse_implausible(number, row)
    for number, (before, after) in enumerate(zip(rows, rows[1:], strict=False), 2):
        for key in (PERIOD, "ag_g"):
            if after[key] <= before[key]:
                raise ValueError(
                    f"assessment.hazard: row {number}: {key} = {after[key]:g} after "
                    f"{before[key]:g}; expected return periods and a_g that rise"
                )


def _refuse_implausible(number, row):
    """Refuse an a_g that the national grid has nowhere: in tenths of g as printed, or in m/s²."""
    ag, grown = row["ag_g"], (row[PERIOD] / AT_YEARS) ** GROWTH
    if LEAST_G * grown <= ag <= MOST_G * grown:
        return
    meant = ""
    if ag > MOST_G * grown:
        meant = f": in tenths of g, as the table is printed, it is {0.1 * ag:.3g} g"
    raise ValueError(
        f"assessment.hazard: row {number}: ag_g = {ag:g} at {row[PERIOD]:g} years; expected g, "
        f"{LEAST_G * grown:.2g} to {MOST_G * grown:.2g} there{meant}"
    )


def row_at(rows, return_period_years):
    """`PARAMETERS` at a return period, by the code's interpolation of ascending rows.

    A ValueError where they do not reach it.
    """
    periods = [row[PERIOD] for row in rows]
    if not periods[0] <= return_period_years <= periods[-1]:
        raise ValueError(
            f"assessment.return_period_years = {return_period_years:g}: assessment.hazard has "
            f"{periods[0]:g} to {periods[-1]:g} years; expected one of them or between"
        )
    at, known = math.log(return_period_years), np.log(periods)
    return {
        key: float(np.exp(np.interp(at, known, np.log([row[key] for row in rows]))))
        for key in PARAMETERS
    }


def spectrum_of(row, soil, topography):
    """Elastic spectrum of NTC 2018 of one row."""
    return CodeDemand(row["ag_g"], row["f0"], row["tc_star_s"], soil, topography)


def stated_row(assessment):
    """Row that section assessment states: of its hazard at the return period, or ag_g; or None."""
    if assessment["hazard"]:
        return row_at(assessment["hazard"], assessment["return_period_years"])
    return None if assessment["ag_g"] is None else assessment


def return_period_of(assessment, pga_g):
    """Return period at which section assessment's hazard has a PGA on the ground: (key, years).

    The key is `at` those years, `below` those of the first row or `above` those of the last.
    Between rows of the hazard by the curve's power law; None where there are no rows.
    """
    if not assessment["hazard"]:
        return None
    curve = curve_of(assessment["hazard"], assessment["soil"], assessment["topography"])
    first, last = (float(f"{1.0 / rate:.6g}") for rate in curve.annual_rate[[0, -1]])
    if pga_g < curve.intensity[0]:
        return "below", first
    if pga_g > curve.intensity[-1]:
        return "above", last
    rate = np.interp(np.log(pga_g), np.log(curve.intensity), np.log(curve.annual_rate))
    return "at", math.exp(-float(rate))


def curve_of(rows, soil, topography):
    """Hazard curve of the PGA on a subsoil: a_g S_S S_T and 1/T_R a year.

    S_S falls as the ground is shaken harder, on subsoil D beyond F0 a_g = 0.8 faster than a_g
    rises. Rows whose PGA is not above all before them are left out there.
    """
    points: list[tuple[float, float]] = []
    for row in rows:
        pga_g = spectrum_of(row, soil, topography).pga_g
        if not points or pga_g > points[-1][0]:
            points.append((pga_g, 1.0 / row[PERIOD]))
    return Hazard("pga_g", *np.array(points).T)
