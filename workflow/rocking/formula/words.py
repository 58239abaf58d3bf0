"""What a run and a report say of a façade by the formula."""

import math
import warnings

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


def remarks(resolved, table):
    """`remark` of a run's computed medians of the whole façade, where there is any to make.

    The table has model, median_pga_g and stations.
    """
    said = []
    for row in table.to_dict("records"):
        found = _estimated(resolved, row["model"])
        said += [remark(found, row["median_pga_g"], row["stations"])] if found else []
    return [line for line in said if line]


def remark(found, computed_g, stations):
    """What to say of a computed median that lies outside of the formula's range; else nothing.

    Its standard error is the formula's own, and that of a median over motions of so few stations.
    """
    if not (math.isfinite(computed_g) and computed_g > 0.0 and stations > 0):
        return ""
    error = math.hypot(found.error, found.dispersion / math.sqrt(stations))
    if abs(math.log(computed_g / found.median)) <= REACH * error:
        return ""
    side = "more" if computed_g > found.median else "less"
    return (
        f"{found.model}: the computed median of {computed_g:.3g} g is {side} than the formula for "
        f"such façades allows ({found.median * math.exp(-REACH * error):.3g} to "
        f"{found.median * math.exp(REACH * error):.3g} g). Look at what this façade or its "
        "motions have that others have not, or for a mistake in the input."
    )
