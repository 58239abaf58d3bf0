"""The shaking to assess a façade for: a spectrum from a file, or a shape at a hazard's PGA."""

import math
from pathlib import Path

import numpy as np
from record_files.text import read_text

from studies.assess import national
from studies.assess.code_spectrum import EurocodeDemand
from studies.assess.demand import RecordDemand, TableDemand
from studies.shared.hazard import read_hazard

COLUMNS = ("period_s", "sa_g")
LONGEST = 10_000
PERIODS_S = np.concatenate(([0.0], np.geomspace(0.05, 4.0, 31)))


class SpectrumError(ValueError):
    """A spectrum that cannot be used; its text is one line."""


def demand_said(assessment, sites, say):
    """Where the demand is from, in words: of section assessment and the site's files."""
    years = {"years": assessment["return_period_years"]}
    if assessment["spectrum"]:
        return say("page.demand.file", file=assessment["spectrum"])
    if assessment["en_spectrum"]:
        keys = ("soil_factor", "tb_s", "tc_s", "td_s")
        about = dict(zip(keys, assessment["en_spectrum"], strict=True))
        return say("page.demand.eurocode", ag_g=assessment["ag_g"], **about)
    if (row := national.stated_row(assessment)) is not None:
        about = {"ag_g": row["ag_g"], "f0": row["f0"], "tc_s": row["tc_star_s"]}
        about |= {key: assessment[key] for key in ("soil", "topography")}
        if assessment["hazard"]:
            return say("page.demand.national_years", **about, **years)
        return say("page.demand.national", **about)
    files = ", ".join(Path(str(s)).name for s in sites)
    return say("page.demand.curve", file=files, **years)


def read_spectrum(path):
    """Read an elastic spectrum of 5 % damping, columns period_s and sa_g, separated by commas.

    Lines that begin with # are remarks. Periods ascend from 0, where the value is the PGA, to 1 s
    or beyond. A SpectrumError names file and line and what was expected.
    """
    lines = read_text(path).said()
    if not lines or tuple(w.strip() for w in lines[0][1].split(",")) != COLUMNS:
        header = lines[0][1][:60] if lines else "nothing"
        raise SpectrumError(f"{path}: columns '{header}'; expected {','.join(COLUMNS)}")
    if len(lines) > LONGEST:
        raise SpectrumError(f"{path}: more than {LONGEST} rows")
    points: list[tuple[float, float]] = []
    for n, text in lines[1:]:
        words = text.split(",")
        try:
            values = [float(word) for word in words]
        except ValueError:
            values = []
        if len(values) != 2 or not all(map(math.isfinite, values)) or values[1] <= 0.0:
            raise SpectrumError(
                f"{path}: line {n}: {text.strip()[:40]!r}; expected a period and a positive sa_g"
            )
        if points and values[0] <= points[-1][0]:
            raise SpectrumError(f"{path}: line {n}: period {values[0]:g} s does not ascend")
        points.append((values[0], values[1]))
    if len(points) < 3 or points[0][0] != 0.0 or points[-1][0] < 1.0:
        raise SpectrumError(
            f"{path}: expected three or more rows, from period 0 (the PGA) to 1 s or beyond"
        )
    return TableDemand(*np.array(points).T)


def pga_at(hazard, return_period_years):
    """PGA with a rate of exceedance of one in the return period [g], on the hazard's power laws.

    A SpectrumError where the curve is of another measure, or does not reach that rate.
    """
    rate = 1.0 / return_period_years
    if hazard.measure != "pga_g":
        raise SpectrumError(f"hazard of {hazard.measure}; expected pga_g, or a spectrum")
    low, high = hazard.annual_rate[-1], hazard.annual_rate[0]
    if not low <= rate <= high:
        raise SpectrumError(
            f"hazard from {low:.3g} to {high:.3g} a year; expected it to reach {rate:.3g} "
            f"(return_period_years = {return_period_years:g})"
        )
    x, y = np.log(hazard.intensity)[::-1], np.log(hazard.annual_rate)[::-1]
    return float(np.exp(np.interp(math.log(rate), y, x)))


def shapes(records):
    """Spectra of 5 % damping over the PGA, a row a record, at `PERIODS_S`."""
    rows = []
    for record in records:
        demand = RecordDemand(record.acceleration_m_s2, record.dt_s)
        rows.append([demand.acceleration(t) / demand.pga_g for t in PERIODS_S])
    return np.array(rows)


def at_pga(shape, pga_g):
    """The median shape of the records at a PGA."""
    return TableDemand(PERIODS_S, pga_g * np.median(shape, axis=0))


def demand_from(settings, records, spectrum, hazard):
    """The ground's demand: of a table, of a code, or the median shape at the hazard's PGA.

    The first that is stated of the file of a spectrum, and in section assessment of
    `en_spectrum`, `hazard` (rows of NTC 2018) and `ag_g`; else that of the file of a hazard curve,
    where the shapes of `records` stand for the site's. Files are empty where there is none;
    `settings` are sections smdof and assessment, and risk.site.
    """
    assessment = settings["assessment"]
    if spectrum:
        return read_spectrum(str(spectrum))
    if assessment["en_spectrum"]:
        return EurocodeDemand(assessment["ag_g"], *assessment["en_spectrum"])
    if (row := national.stated_row(assessment)) is not None:
        return national.spectrum_of(row, assessment["soil"], assessment["topography"])
    curve = read_hazard(str(hazard), settings["smdof"]["period_s"], settings["risk.site"])
    return at_pga(shapes(records), pga_at(curve, assessment["return_period_years"]))


def hazards_of(assessment, curve=None, name=""):
    """Hazard curves of the PGA that a site has, by what they are called; the code's own first.

    `curve` is that of risk.hazard, `name` that of its file; of another measure it gives no rate
    here.
    """
    curves = {}
    if assessment["hazard"]:
        curves["NTC 2018"] = national.curve_of(
            assessment["hazard"], assessment["soil"], assessment["topography"]
        )
    if curve is not None and curve.measure == "pga_g":
        curves[name] = curve
    return curves
