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
    return [line for one in list(settings.items())[:MOST] if (line := of_run(*one))]


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
    found = [one for one in every if one]
    if not found:
        return ""
    said = ", ".join(f"{one.model} {one.median:.2g} g" for one in found)
    factor = math.exp(max(one.dispersion for one in found))
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
    found = []
    for row in table.to_dict("records"):
        own = _estimated(resolved, row["model"])
        found += [outlier(own, row["median_pga_g"], row["stations"])] if own else []
    return [one for one in found if one is not None]


def outlier(found, computed_g, stations):
    """`Outlier` of a computed median that lies outside of the formula's range; else None.

    Its standard error is the formula's own, and that of a median over motions of so few stations.
    """
    if not (math.isfinite(computed_g) and computed_g > 0.0 and stations > 0):
        return None
    error = math.hypot(found.error, found.dispersion / math.sqrt(stations))
    if abs(math.log(computed_g / found.median)) <= REACH * error:
        return None
    low, high = (found.median * math.exp(sign * REACH * error) for sign in (-1.0, 1.0))
    return Outlier(found.model, computed_g, low, high)
