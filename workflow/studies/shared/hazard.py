"""Hazard curves: how often a year each intensity is exceeded at a site.

Two forms are read. The project's own is a table of two columns, separated by commas, tabs or
semicolons, named by the measure and `annual_rate`:

    pga_g,annual_rate
    0.05,2.1e-2
    0.10,7.4e-3

The other is what OpenQuake exports (`hazard_curve-mean-PGA_1.csv`): a first line with
`investigation_time` t and `imt`, columns lon, lat, depth and poe-<intensity>, a row a site. Its
probabilities of exceedance P in t years are rates by the Poisson process, λ = −ln(1 − P)/t.
"""

import csv
import re
from dataclasses import dataclass

import numpy as np
from record_files.text import comma_hint, read_text
from rocking.records.intensity_measures import MEASURES

from yade_scripts.lists import listed

RATE = "annual_rate"
LONGEST = 10_000  # rows of a table, or sites of an export
SAME_PERIOD = 1e-3  # relative; a hazard curve for Sa at another period is another measure
SAME_PLACE = 1e-4  # degrees
STRONG_G = 2.0  # a curve in g that begins above it is in percent of g or in cm/s²
# What the ground of any site does once in 475 years, and how it grows with the root of the return
# period; far beyond what hazard maps of the most and the least active regions have.
LEAST_G, MOST_G, AT_YEARS = 0.002, 1.5, 475.0
SHARES = {"pga_g": 1.0, "sa_t1_g": 3.0, "pgv_cm_s": 200.0}  # of a measure, in the PGA in g
LONG_YEARS = 10_000.0  # beyond it curves are extrapolations


class HazardError(ValueError):
    """A hazard table that cannot be used; its text is one line."""


@dataclass(frozen=True)
class Hazard:
    """A hazard curve, a power law between its points (straight on logarithmic scales).

    `measure` is of `MEASURES`, `intensity` ascends in its unit, shape (n,), and `annual_rate`, of
    exceedance [1/year], descends and is positive.
    """

    measure: str
    intensity: np.ndarray
    annual_rate: np.ndarray

    def rate(self, intensity):
        """Annual rate of exceedance; beyond the ends the outer power laws go on."""
        x, y = np.log(self.intensity), np.log(self.annual_rate)
        at = np.log(np.asarray(intensity, float))
        i = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
        slope = np.diff(y) / np.diff(x)
        return np.exp(y[i] + slope[i] * (at - x[i]))


def read_hazard(path, period_s, site=None):
    """`Hazard` of a file in either form; a curve of Sa at another period [s] is refused.

    `site` is the longitude and latitude [°] to take from an export, which without it may hold one
    site only. A HazardError of one line names file, line and what was expected; a RecordError comes
    where the file is missing, no text, or too large.
    """
    text = read_text(path)
    if text.lines[0].startswith("#") and "investigation_time" in text.lines[0]:
        return _export(path, text.lines, period_s, site)
    return _table(path, text.said())


def _fault(path, line, words):
    return HazardError(f"{path}: line {line}: {words}")


def _number(path, line, word, what):
    try:
        value = float(word)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        hint = comma_hint(word)
        raise _fault(path, line, f"expected {what}, found {word.strip()[:40]!r}{hint}")
    return value


def _curve(path, measure, points):
    """Curve of (line, intensity, rate), checked: ascending, descending, positive, two or more.

    Equal rates at the low end are one point, the last of them: below it the curve says nothing.
    """
    while len(points) > 1 and points[0][2] == points[1][2] and points[0][1] < points[1][1]:
        points = points[1:]
    for (_, x0, y0), (line, x1, y1) in zip(points, points[1:], strict=False):
        if not x1 > x0:
            raise _fault(path, line, f"intensity {x1:g} after {x0:g}; expected ascending ones")
        if not y1 < y0:
            raise _fault(
                path, line, f"rate {y1:g} at {x1:g}, {y0:g} at {x0:g}; expected it to fall"
            )
    for line, x, y in points:
        if not (x > 0.0 and y > 0.0):
            raise _fault(path, line, f"intensity {x:g}, rate {y:g}; expected positive numbers")
    if len(points) < 2:
        raise HazardError(f"{path}: {len(points)} usable points; expected two or more")
    line, lowest, _ = points[0]
    if lowest > STRONG_G and measure.endswith("_g"):
        raise _fault(
            path, line, f"{measure} begins at {lowest:g}; expected g: are the units right?"
        )
    _refuse_implausible(path, measure, points)
    _, x, y = np.array(points, float).T
    return Hazard(measure, x, y)


def _refuse_implausible(path, measure, points):
    """Refuse a curve in another unit: what no ground does in a return period, at either end."""
    share = SHARES.get(measure)
    for line, x, rate in points if share else ():
        years = 1.0 / rate
        scale = share * np.sqrt(min(years, LONG_YEARS) / AT_YEARS)
        far = x > MOST_G * scale if years <= LONG_YEARS else x > 10.0 * MOST_G * scale
        if far or (AT_YEARS <= years <= LONG_YEARS and x < LEAST_G * scale):
            most = "at most" if far else "at least"
            limit = (MOST_G if far else LEAST_G) * scale
            unit = measure.removeprefix("pga_").removeprefix("sa_t1_").removeprefix("pgv_")
            raise _fault(
                path,
                line,
                f"{measure} {x:g} once in {years:.3g} years; expected {unit.replace('_', '/')}, "
                f"{most} {limit:.2g} there: are the units right?",
            )


def _table(path, kept):
    """Two columns, the first named by its measure, of lines with their numbers."""
    if not kept:
        raise HazardError(f"{path}: no table; expected columns such as pga_g,{RATE}")
    first, heading = kept[0]
    separator = next((s for s in ",\t;" if s in heading), ",")
    names = [word.strip().strip('"') for word in heading.split(separator)]
    if len(names) != 2 or names[0] not in MEASURES or names[1] != RATE:
        raise _fault(
            path,
            first,
            f"columns {listed(names)}; expected one of {listed(MEASURES)} and {RATE}",
        )
    if len(kept) > LONGEST:
        raise HazardError(f"{path}: more than {LONGEST} rows")
    points = []
    for line, text in kept[1:]:
        words = text.split(separator)
        if len(words) != 2:
            raise _fault(path, line, f"{len(words)} values; expected 2")
        numbers = [_number(path, line, word, "a number") for word in words]
        points.append((line, *numbers))
    return _curve(path, names[0], points)


def _export(path, lines, period_s, site):
    """Export of OpenQuake: one curve a site."""
    time = re.search(r"investigation_time=([0-9.eE+-]+)", lines[0])
    imt = re.search(r"imt=[\"']?([A-Za-z0-9_().]+)", lines[0])
    if not time or not imt:
        raise _fault(path, 1, "expected investigation_time=… and imt=… of OpenQuake")
    years = _number(path, 1, time[1].rstrip("."), "investigation_time in years")
    if years <= 0.0:
        raise _fault(path, 1, f"investigation_time {years:g}; expected it positive")
    if len(lines) > LONGEST:
        raise HazardError(f"{path}: more than {LONGEST} sites")
    measure = measure_of(imt[1], period_s, path)
    rows = list(csv.reader(lines[1:]))
    heading = rows[0] if rows else []
    levels = [(i, name[4:]) for i, name in enumerate(heading) if name.startswith("poe-")]
    if not {"lon", "lat"} <= set(heading) or not levels:
        raise _fault(path, 2, "expected the columns lon, lat and poe-<intensity>")
    sites = []
    for line, row in enumerate(rows[1:], 3):
        if not row:
            continue
        if len(row) != len(heading):
            raise _fault(path, line, f"{len(row)} values; expected {len(heading)}")
        place = [_number(path, line, row[heading.index(k)], k) for k in ("lon", "lat")]
        sites.append((line, place, row))
    if site is not None:
        sites = [s for s in sites if np.abs(np.subtract(s[1], site)).max() < SAME_PLACE]
    if len(sites) != 1:
        found = f"{len(sites)} sites" + ("" if site is None else f" at {site[0]:g}, {site[1]:g}")
        raise HazardError(f"{path}: {found}; expected one (risk.site: [longitude, latitude])")
    line, _, row = sites[0]
    # the unit of a velocity is cm/s there as here, that of an acceleration g
    points = []
    for i, name in levels:
        probability = _number(path, line, row[i], f"poe-{name}")
        if not 0.0 <= probability <= 1.0:
            raise _fault(path, line, f"poe-{name} is {probability:g}; expected 0 to 1")
        if 0.0 < probability < 1.0:  # else its rate is 0 or unbounded
            level = _number(path, 2, name, "poe-<intensity>")
            points.append((line, level, -np.log1p(-probability) / years))
    return _curve(path, measure, points)


def measure_of(imt, period_s, path):
    """Name of the measure that OpenQuake calls `imt`; refuse others, and another period."""
    if imt in ("PGA", "PGV"):
        return {"PGA": "pga_g", "PGV": "pgv_cm_s"}[imt]
    spectral = re.fullmatch(r"SA\(([0-9.]+)\)", imt)
    if not spectral:
        raise HazardError(f"{path}: intensity measure {imt}; expected PGA, PGV or SA(T)")
    if abs(float(spectral[1]) / period_s - 1.0) > SAME_PERIOD:
        raise HazardError(
            f"{path}: {imt}; Sa(T1) of this run is at {period_s:g} s (smdof.period_s)"
        )
    return "sa_t1_g"


def imt_of(measure, period_s):
    """OpenQuake's name of a measure; None where it has none."""
    names = {"pga_g": "PGA", "pgv_cm_s": "PGV", "sa_t1_g": f"SA({period_s:g})"}
    return names.get(measure)
