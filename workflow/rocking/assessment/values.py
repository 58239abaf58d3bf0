"""Every value behind a report: whether it was stated, follows from others, or is a default."""

import json

from rocking.assessment.checks import LEAST_KNOWN, confidence
from rocking.calibration.beta import beta_and_range
from rocking.configuration.differences import flat

SECTIONS = (
    "facade",
    "return_wall",
    "smdof",
    "damping",
    "assessment",
    "numerics",
    "ensemble",
    "ida",
)
ALONE = ("models", "records_table", "directions", "vertical_motion", "seed")
OVERRULED = ("damping.beta_s", "assessment.confidence_factor")  # a rule may stand for these
STATED, DERIVED, DEFAULT = "stated", "derived", "default"


def _words(value):
    if value is None:
        return "none"
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, str):
        return value or "–"
    return json.dumps(value, ensure_ascii=False)


def _derived(config):
    """What stands for keys that are null, or is not used as stated: text by key."""
    f, own, chain = config["facade"], config["assessment"], config["smdof"]
    loads = sum(row["load_kn"] for row in f["floors"])
    beta, outside = beta_and_range(config)
    law = config["damping"]["law"]
    words = {
        "facade.base_stiffness_pa_m": f"{1e6 * f['e_mpa'] / f['height_m']:.4g} (E/h)",
        "return_wall.length_m": f"{0.5 * f['height_m']:.4g} (h/2)",
        "return_wall.building_mass_kg": "of the brick model",
        "assessment.roof_load_kn": f"{loads:g} (of facade.floors)",
        "assessment.roof_arm_m": "middle of the thickness",
        "assessment.height_ratio": "middle of the line that holds the façade",
        "assessment.building_damping": f"{chain['damping_ratio']:g} (smdof.damping_ratio)",
        "assessment.match_high_s": "T_SLC of the whole façade, from 2 to 4 s",
    }
    if law != "value":
        words["damping.beta_s"] = f"{beta:.4g} (law {law}" + (f"; {outside})" if outside else ")")
    used = confidence(own["confidence_factor"], own["hinge_inset_m"])
    if used != own["confidence_factor"]:
        words["assessment.confidence_factor"] = (
            f"{LEAST_KNOWN} (knowledge level 1: the hinge does not crush; stated "
            f"{own['confidence_factor']:g})"
        )
    return words


def values(config, given):
    """Rows (key, value, standing) of every key that the assessment rests on.

    Parameters
    ----------
    config : dict
        Resolved configuration of the run.
    given : collection of str
        Dotted keys that the user's configuration states.
    """
    parts = {key: config[key] for key in (*ALONE, *SECTIONS)}
    known, given = _derived(config), set(given)
    rows = []
    for key, value in flat(parts).items():
        stated = key in given or any(key.startswith(f"{g}.") for g in given)
        if key in known and (value is None or key in OVERRULED):
            rows.append((key, known[key], DERIVED))
        else:
            rows.append((key, _words(value), STATED if stated else DEFAULT))
    return rows
