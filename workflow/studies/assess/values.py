"""Every value behind a report: whether it was stated, follows from others, or is a default."""

import json

from rocking.fidelity import CHOSEN
from rocking.mechanics.beta import CalibrationError, beta_and_range

from studies.assess.catalogue import NOTHING, SAY
from studies.assess.checks import LEAST_KNOWN, confidence
from studies.assess.inputs import every_value
from yade_scripts.model.facades import Facade

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
IN_ROWS = {"arm_m": "half", "anchor_kn": "steel"}  # keys of what stands for null
STATED, DERIVED, DEFAULT = "stated", "derived", "default"


def _told(value, say):
    """A value as it stands in a table."""
    if value is None:
        return say("hand.value.none")
    if isinstance(value, float):
        return say.number(value, "g")
    if isinstance(value, str):
        return value or NOTHING
    return json.dumps(value, ensure_ascii=False)


def _derived(config, say):
    """What stands for keys that are null, or is not used as stated: text by key."""
    facade, assessment = Facade.of(config["facade"]), config["assessment"]
    loads_kn = float(sum(floor.load_kn for floor in facade.floors))

    def told(key, **about):
        return say(f"hand.value.{key}", **about)

    known = {
        "facade.base_stiffness_pa_m": told("base", value=1e6 * facade.e_mpa / facade.height_m),
        "facade.parapet_thickness_m": told("parapet"),
        "return_wall.length_m": told("wall", value=0.5 * facade.height_m),
        "return_wall.building_mass_kg": told("mass"),
        **{f"numerics.{key}": told("convergence") for key in CHOSEN},
        "assessment.roof_load_kn": told("roof", value=loads_kn),
        "assessment.roof_arm_m": told("arm"),
        "assessment.height_ratio": told("ratio"),
        "assessment.building_damping": told("damping", value=config["smdof"]["damping_ratio"]),
        "assessment.match_high_s": told("match"),
    }
    law = config["damping"]["law"]
    if law != "value":
        beta, outside = beta_and_range(config)
        known["damping.beta_s"] = told("beta_outside" if outside else "beta", value=beta, law=law)
    stated = assessment["confidence_factor"]
    if confidence(stated, assessment["hinge_inset_m"]) != stated:
        known["assessment.confidence_factor"] = told("confidence", used=LEAST_KNOWN, stated=stated)
    return known


def _beside_eq5(config, say):
    """A β that is given as a value, beside what eq. 5 says of this façade."""
    given = config["damping"]["beta_s"]
    try:
        beta, outside = beta_and_range(config | {"damping": {"law": "eq5"}})
    except CalibrationError:
        return say("hand.value.beta_alone", own=given)
    key = "hand.value.beta_given_outside" if outside else "hand.value.beta_given"
    return say(key, own=given, value=beta)


def values(config, given, say=SAY):
    """Rows (key, value, standing) of every key of a configuration that the assessment rests on.

    `given` are the dotted keys that the user states.
    """
    parts = {key: config[key] for key in (*ALONE, *SECTIONS)}
    parts["ida"] = {"max_pga_g": config["ida"]["max_pga_g"]}
    parts["risk"] = {key: config["risk"][key] for key in HAZARD}
    known, given = _derived(config, say), set(given)
    rows = []
    for key, value in every_value(parts).items():
        stated = key in given or any(key.startswith(f"{g}.") for g in given)
        if key in known and (value is None or key in OVERRULED):
            rows.append((key, known[key], DERIVED))
            continue
        place, _, last = key.rpartition(".")
        if value is None and last in IN_ROWS and place[-1:].isdigit():
            rows.append((key, say(f"hand.value.{IN_ROWS[last]}"), DERIVED))
            continue
        told = _told(value, say)
        if key == "damping.beta_s" and not Facade.of(config["facade"]).is_free:
            told = _beside_eq5(config, say)
        rows.append((key, told, STATED if stated else DEFAULT))
    return rows
