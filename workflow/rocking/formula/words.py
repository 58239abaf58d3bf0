"""What a run and a report say of a façade by the formula."""

import math
import warnings
from typing import NamedTuple

from rocking.collapse.case import SECTIONS, Case
from rocking.configuration.config import resolve
from rocking.formula.groups import OutsideError
from rocking.formula.law import estimate

OWN = ("facade", "return_wall", "smdof")  # sections in which an own façade differs from the default
MODELS = ("W1", "W2", "W2m")
MOST = 4  # runs of a study that say something
REACH = 2.0  # standard errors beyond which a computed value is remarked upon


def of_runs(settings):
    """Lines of `of_run` for the first runs of a study, by its resolved configurations."""
    first = list(settings.items())[:MOST]
    return [line for name, resolved in first if (line := of_run(name, resolved))]


def _estimated(resolved, model):
    """`estimate` of a run's façade; None where the formula does not describe it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the run says of β itself what there is to say
        try:
            return estimate(Case.chosen({key: resolved[key] for key in SECTIONS}, model))
        except (OutsideError, ValueError):
            return None


def of_run(name, resolved):
    """One line before a run of an own façade.

    Empty for the default façade and for one that the formula does not describe.
    """
    usual = resolve({})
    if all(resolved[section] == usual[section] for section in OWN):
        return ""
    every = [_estimated(resolved, model) for model in MODELS if model in resolved["models"]]
    estimates = [of_model for of_model in every if of_model]
    if not estimates:
        return ""
    said = ", ".join(f"{of_model.model} {of_model.median:.2g} g" for of_model in estimates)
    factor = math.exp(max(of_model.dispersion for of_model in estimates))
    return (
        f"{name}: by the formula half of the motions fell it at a PGA of {said} "
        f"(two thirds of them within a factor of {factor:.2g}; workflow/studies/atlas/page.md)"
    )


class Outlier(NamedTuple):
    """A computed median of a model and what the formula allows for such façades [g]."""

    model: str
    computed_g: float
    low_g: float
    high_g: float


def outliers(resolved, table):
    """`outlier` of a run's computed medians of the whole façade, where there is any.

    The table has model, median_pga_g and stations.
    """
    judged = []
    for row in table.to_dict("records"):
        expected = _estimated(resolved, row["model"])
        judged += [outlier(expected, row["median_pga_g"], row["stations"])] if expected else []
    return [outside for outside in judged if outside is not None]


def outlier(expected, computed_g, stations):
    """`Outlier` of a computed median that lies outside of the formula's range; else None.

    Its standard error is the formula's own, and that of a median over motions of so few stations.
    """
    if not (math.isfinite(computed_g) and computed_g > 0.0 and stations > 0):
        return None
    error = math.hypot(expected.error, expected.dispersion / math.sqrt(stations))
    if abs(math.log(computed_g / expected.median)) <= REACH * error:
        return None
    low, high = (expected.median * math.exp(sign * REACH * error) for sign in (-1.0, 1.0))
    return Outlier(expected.model, computed_g, low, high)
