"""The formula as numbers: reading its file, and what it says of a façade.

    ln IM50 = ln tan α + Σ c_k t_k,      ln IM ~ Normal(ln IM50, δ²) over ground motions

with the groups t_k of `groups.terms`, and IM any of `MEASURES`. A base other than the one of the
atlas has a second sum for the ratio of the two; with a building that yields `yielding` says what
its strength does.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from scipy.special import ndtr

from rocking.formula import groups, yielding
from rocking.formula.groups import OutsideError
from rocking.shipped import shipped
from yade_scripts.lists import listed
from yade_scripts.model.facades import Facade

if TYPE_CHECKING:
    from rocking.collapse.case import Case

FILE = shipped("config/formula.json")
MEASURES = {
    "pga_g": "g",
    "pgv_cm_s": "cm/s",
    "sa_avg_2s_g": "g",
    "sa_t1_g": "g",
    "sa_avg_2s_t1_g": "g",
}
SLACK = 1e-9  # of a limit
NOT_FOR = {  # dimensions that a model does not know
    "W1": ("period_s", "mass_ratio", "storeys"),
    "W2": ("mass_ratio",),
    "W2m": (),
}


@lru_cache(maxsize=4)
def read(path=FILE):
    """Content of a formula's file; a ValueError of one line where the file is not of that kind."""
    keys = ("models", "limits", "bases")
    return yielding.content(path, keys, "the formula's file (target atlas)")


def check_limits(row, model, law):
    """Refuse a façade outside of the atlas: an OutsideError names dimension, value and limits."""
    for name, (low, high) in law["limits"].items():
        value = row[name]
        if name in NOT_FOR[model]:
            continue
        if value is None or not low * (1.0 - SLACK) <= value <= high * (1.0 + SLACK):
            said = "nothing" if value is None else f"{value:.4g}"
            raise OutsideError(
                f"formula: {name} = {said}: the atlas has {low:.4g} to {high:.4g} ({model})"
            )


def total(part, terms):
    """Σ c_k t_k of a part of the file: terms, coefficients."""
    pairs = zip(part["terms"], part["coefficients"], strict=True)
    return math.fsum(c * terms[name] for name, c in pairs)


def said(row, model, measure="pga_g", base=None, law=None):
    """Median over motions of half collapse, dispersion δ by motion, and the formula's own error.

    The row has `groups.DIMENSIONS`, of which those that the model does not know may be None. It may
    have base_shear_ratio, V/W of a building that yields. The median is in the unit of the measure
    (`MEASURES`); without a base it is on the atlas's own, and without a law (`read`) by that of
    `FILE`. The error is the standard one of ln median, by façades and stations left out. An
    OutsideError of one line outside of the atlas, or for a model, measure or base that it has not.
    """
    law = law or read()
    if model not in law["models"]:
        raise OutsideError(f"formula: model {model}: the atlas has {listed(law['models'])}")
    if measure not in MEASURES:
        raise OutsideError(f"formula: measure {measure}: expected one of {', '.join(MEASURES)}")
    check_limits(row, model, law)
    ratio = row.get("base_shear_ratio")
    unknown = {name: ends[0] for name, ends in law["limits"].items() if row[name] is None}
    terms = groups.terms({**row, **unknown})
    value, error = _elastic(row, model, measure, base, terms, law)
    if ratio is not None and "period_s" not in NOT_FOR[model]:
        own_g, ground_g = (
            math.exp(_elastic(row, name, "pga_g", base, terms, law)[0]) for name in (model, "W1")
        )
        more, its_error = yielding.log_ratio(own_g, ground_g, ratio, model)
        value, error = value + more, math.hypot(error, its_error)
    return math.exp(value), law["models"][model][measure]["dispersion"], error


def _elastic(row, model, measure, base, terms, law):
    """Logarithm of the median before an elastic building, and its standard error."""
    fit = law["models"][model][measure]
    value, error = math.log(groups.tan_alpha(row)) + total(fit, terms), fit["error"]
    if base not in (None, law["made_of"]["base"]):
        if base not in law["bases"]:
            other = listed([law["made_of"]["base"], *law["bases"]])
            raise OutsideError(f"formula: facade.base = {base}: the atlas has {other}")
        ratio = law["bases"][base][model]
        value, error = value + total(ratio, terms), math.hypot(error, ratio["error"])
    return value, error


@dataclass(frozen=True)
class Estimate:
    """What the formula says of a façade.

    Attributes
    ----------
    model, measure : str
    median : float
        Of half collapse over ground motions [unit of the measure].
    dispersion : float
        Standard deviation of its logarithm over ground motions, δ.
    error : float
        Standard error of ln median, as façades and stations that were left out show it.
    """

    model: str
    measure: str
    median: float
    dispersion: float
    error: float

    @property
    def low(self):
        """Intensity below which 16 % of the motions fell the façade."""
        return self.median * math.exp(-self.dispersion)

    @property
    def high(self):
        """Intensity below which 84 % of the motions fell the façade."""
        return self.median * math.exp(self.dispersion)

    def probability(self, intensity):
        """P(collapse) at intensities, over ground motions."""
        import numpy as np

        given = np.asarray(intensity, float)
        if not np.all(given >= 0.0):
            raise ValueError(f"intensity = {intensity!r}: expected numbers ≥ 0")
        with np.errstate(divide="ignore"):  # nothing falls at zero
            return ndtr(np.log(given / self.median) / self.dispersion)

    def __repr__(self):
        """Return one line: median, its band by motion, the formula's error."""
        unit = MEASURES[self.measure]
        return (
            f"Estimate {self.model}: half collapse {self.median:.3g} {unit}; two thirds of the "
            f"motions {self.low:.3g} to {self.high:.3g} {unit}; formula ± {100 * self.error:.0f} %"
        )


def estimate(case: "Case", measure: str = "pga_g", law: str | Path | None = None) -> "Estimate":
    """Estimate half collapse of a case by the formula, without a history.

    Parameters
    ----------
    case : Case
    measure : str
        pga_g, pgv_cm_s, sa_avg_2s_g (geometric mean of Sa over `measures.AVERAGE_S`), sa_t1_g (at
        the building's T1) or sa_avg_2s_t1_g (Sa_avg^0.7 Sa(T1)^0.3); 5 % damping.
    law : path or None
        A formula's file; None: the one that comes with the project.

    Returns
    -------
    Estimate

    Raises
    ------
    OutsideError
        In one line that names the key, for a façade that the formula does not describe.
    TypeError
        For anything but a case.

    Examples
    --------
    >>> from rocking import Case, estimate
    >>> formula = estimate(Case.configured("W1", {"facade.base": "column"}))
    >>> bool(0.2 < formula.median < 0.6)
    True
    """
    if not hasattr(case, "model"):
        raise TypeError(f"estimate: expected a rocking.Case, got {type(case).__name__}")
    known = read(law or FILE)
    facade = Facade.of(case["facade"])
    base = base_of(facade.base, facade.courses, facade.courses_growth, known)
    row = groups.dimensions(case)
    return Estimate(case.model, measure, *said(row, case.model, measure, base, known))


def base_of(base, courses, courses_growth, law):
    """Name of a façade's base, as a formula's file (`read`) has it.

    An OutsideError of one line for a stack of courses that the atlas has not.
    """
    if not courses:
        return base
    known = law["made_of"].get("others", [])
    for row in known:
        if (row["courses"], row["courses_growth"]) == (courses, courses_growth):
            return row["name"]
    has = [f"{row['courses']} of growth {row['courses_growth']:g}" for row in known]
    stacks = listed(stack for stack in has if not stack.startswith("0 ")) or "none"
    raise OutsideError(
        f"formula: facade.courses = {courses} of growth {courses_growth:g}: "
        f"of stacks the atlas has {stacks}"
    )
