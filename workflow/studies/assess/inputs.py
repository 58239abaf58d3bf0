"""What an assessment needs to be told, checked before anything is planned."""

import json
from collections.abc import Mapping
from importlib.util import find_spec

from rocking.configuration.config import Settings
from rocking.configuration.differences import flat

from studies.assess import national
from studies.assess.site import pga_at, read_spectrum
from studies.shared.hazard import read_hazard
from yade_scripts.lists import listed
from yade_scripts.model.registry import MODELS

STATED = {  # keys that an assessment does not take from the case study
    "facade": ("height_m", "thickness_m", "width_m", "density_kg_m3"),
    "smdof": ("n_dof", "period_s"),
    "assessment": ("confidence_factor",),
}

# of section assessment: what the report shows and nothing is computed from
WORDS = ("language", "title", "client", "place", "engineer", "registration", "date")
RODS = ("diameter_mm", "length_m")  # of a row of ties that is there


def check_stated(given, models=()):
    """Refuse a façade whose numbers would be the case study's, in one line with every missing key.

    `given` is the configuration as the user gave it, which tells what is stated from what is a
    default. Where walls carry the building under one of `models`, its mass or section `building` is
    asked for too; of a row of ties what its rods are.
    """
    missing, wanted = [], dict(STATED)
    if "building" not in given and any(MODELS[name].two_way for name in models):
        wanted["return_wall"] = ("building_mass_kg",)
    for section, keys in wanted.items():
        part = given.get(section)
        known = part if isinstance(part, Mapping) else {}
        missing += [f"{section}.{key}" for key in keys if key not in known]
    facade = given.get("facade")
    ties = facade.get("ties") if isinstance(facade, Mapping) else None
    for number, row in enumerate(ties if isinstance(ties, list) else (), 1):
        missing += [
            f"facade.ties.{number}.{key}"
            for key in RODS
            if isinstance(row, Mapping) and key not in row
        ]
    if missing:
        raise ValueError(
            f"assess: {listed(missing)} not stated; expected in the façade's file, not the case "
            "study's default"
        )


def check_printer(package="weasyprint"):
    """Refuse, with a ValueError, a report whose PDF nothing here can write."""
    if find_spec(package) is None:
        raise ValueError(
            f"assess: the report's PDF needs the package {package}, which is not installed; "
            "expected `make setup`, or `pip install weasyprint`, first"
        )


def spectrum_file(resolved, find):
    """File of the site's spectrum, checked; None where the hazard curve stands for it.

    `find` returns where a file of the configuration is. Raises a ValueError of one line with the
    key.
    """
    if (path := resolved["assessment"]["spectrum"]) is not None:
        path = find(path)
        _checked("assessment.spectrum", read_spectrum, path)
    return path


def hazard_file(resolved, find):
    """File of the site's hazard curve, as `spectrum_file`; None where a spectrum is given alone."""
    path, settings = resolved["risk"]["hazard"], resolved["assessment"]
    if path is not None:
        path, period_s = find(path), resolved["smdof"]["period_s"]
        curve = _checked("risk.hazard", read_hazard, path, period_s, resolved["risk"]["site"])
        if not any(settings[key] for key in ("spectrum", "ag_g", "hazard")):
            _checked("risk.hazard", pga_at, curve, settings["return_period_years"])
    return path


def check_demand(resolved, *files):
    """Refuse an assessment that has no demand, or two."""
    assessment = resolved["assessment"]
    if assessment["hazard"]:
        national.check_rows(assessment["hazard"])
        national.row_at(assessment["hazard"], assessment["return_period_years"])
        if assessment["ag_g"] is not None:
            raise ValueError(
                "assess: assessment.ag_g: stated beside assessment.hazard; expected one of the two"
            )
    if assessment["en_spectrum"]:
        _, tb, tc, td = assessment["en_spectrum"]
        if assessment["ag_g"] is None or assessment["spectrum"] or not tb < tc < td:
            raise ValueError(
                f"assess: assessment.en_spectrum = {assessment['en_spectrum']}: expected S, T_B < "
                "T_C < T_D (s), with assessment.ag_g and without assessment.spectrum"
            )
    if not any(files) and assessment["ag_g"] is None and not assessment["hazard"]:
        raise ValueError(
            "assess: no demand; expected assessment.hazard (rows of NTC 2018), assessment.ag_g, "
            "assessment.spectrum (columns period_s,sa_g) or risk.hazard (columns pga_g,annual_rate)"
        )


def check_mechanisms(resolved):
    """Refuse a façade that has hinges stated, or a part that falls by its own weight."""
    if resolved["facade"]["hinges_m"]:
        raise ValueError(
            "assess: facade.hinges_m: expected none; the checks find the weakest mechanism, "
            "vertical bending among them"
        )
    if resolved["facade"]["wedge_deg"]:
        raise ValueError(
            f"assess: facade.wedge_deg = {resolved['facade']['wedge_deg']:g}: expected 0 (°); the "
            "checks find the weakest wedge, or take that of assessment.crack_deg"
        )
    for key, expected in (("sides", "one"), ("outline", "box")):
        if resolved["facade"][key] != expected:
            raise ValueError(
                f"assess: facade.{key} = {resolved['facade'][key]}: expected {expected}; state the "
                "wall below, with facade.gable_height_m or facade.parapet_height_m"
            )
    if any(resolved["part"].values()):
        raise ValueError(
            "assess: part: expected none; every part that fails first is shaken, beside the whole"
        )
    from studies.assess.family import Family  # slow to load
    from studies.assess.ties import check_levels

    check_levels(resolved)
    try:
        Family(resolved).all()
    except ValueError as error:
        raise ValueError(f"assess: {error}") from None


def without_words(text):
    """`Settings` with section assessment, without its keys in `WORDS`."""
    parts = json.loads(text)
    assessment = {key: value for key, value in parts["assessment"].items() if key not in WORDS}
    kept = parts | {"assessment": assessment}
    return Settings(json.dumps(kept, sort_keys=True, separators=(",", ":"), ensure_ascii=False))


def every_value(settings):
    """Values by dotted key, rows of lists by their number: `facade.floors.1.load_kn`."""
    values: dict = {}
    for key, value in flat(settings).items():
        if isinstance(value, list) and value and all(isinstance(row, Mapping) for row in value):
            for number, row in enumerate(value, 1):
                values |= flat(row, f"{key}.{number}.")
        else:
            values[key] = value
    return values


def _checked(key, read, *arguments):
    try:
        return read(*arguments)
    except ValueError as error:
        raise ValueError(f"{key}: {error}") from None
