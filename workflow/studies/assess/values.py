"""Every value behind a report: whether it was stated, follows from others, or is a default."""

import json

from rocking.fidelity import CHOSEN
from rocking.mechanics.beta import CalibrationError, beta_and_range

from studies.assess.checks import LEAST_KNOWN, confidence
from studies.assess.inputs import every_value

SECTIONS = (
    "facade",
    "return_wall",
    "smdof",
    "damping",
    "assessment",
    "numerics",
    "ensemble",
    "baseline",
)
HAZARD = ("hazard", "site")  # of section risk
ALONE = ("models", "records_table", "directions", "vertical_motion", "seed")
OVERRULED = ("damping.beta_s", "assessment.confidence_factor")  # a rule may stand for these
IN_ROWS = {"arm_m": "half the thickness", "anchor_kn": "more than the steel"}  # where null
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
        "facade.base_stiffness_pa_m": f"{1e6 * f['e_mpa'] / f['height_m']:.4g} (E/h; facade.base "
        "says where it sits)",
        "facade.parapet_thickness_m": "that of the highest storey",
        "return_wall.length_m": f"{0.5 * f['height_m']:.4g} (h/2)",
        "return_wall.building_mass_kg": "of the brick model",
        **{f"numerics.{key}": "from measured convergence" for key in CHOSEN},
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


def _beside_eq5(config):
    """A β that is given as a value, beside what eq. 5 says of this façade."""
    own = f"{config['damping']['beta_s']:g}"
    try:
        beta, outside = beta_and_range(config | {"damping": {"law": "eq5"}})
    except CalibrationError:
        return f"{own} (eq. 5 has no value for this façade)"
    words = f"{own} (not of this façade; eq. 5 gives {beta:.4g}"
    return words + (f"; {outside})" if outside else ")")


def values(config, given):
    """Rows (key, value, standing) of every key of a configuration that the assessment rests on.

    `given` are the dotted keys that the user states.
    """
    parts = {key: config[key] for key in (*ALONE, *SECTIONS)}
    parts["ida"] = {"max_pga_g": config["ida"]["max_pga_g"]}
    parts["risk"] = {key: config["risk"][key] for key in HAZARD}
    known, given = _derived(config), set(given)
    rows = []
    for key, value in every_value(parts).items():
        stated = key in given or any(key.startswith(f"{g}.") for g in given)
        if key in known and (value is None or key in OVERRULED):
            rows.append((key, known[key], DERIVED))
            continue
        place, _, last = key.rpartition(".")
        if value is None and last in IN_ROWS and place[-1:].isdigit():
            rows.append((key, IN_ROWS[last], DERIVED))
            continue
        words = _words(value)
        if key == "damping.beta_s" and config["facade"]["sides"] == "one":
            words = _beside_eq5(config)
        rows.append((key, words, STATED if stated else DEFAULT))
    return rows
