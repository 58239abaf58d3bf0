"""Defaults that hang on other keys: what nobody stated, once the rest of a run is known.

A schema's default is a number. These are the same defaults where another key decides: a hinge makes
the façade two blocks, so it is not cut into courses; a façade twice as heavy stands on a building
twice as heavy. What is stated stays as it is.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from rocking.configuration import schema
from yade_scripts.model.facades import Facade
from yade_scripts.model.registry import MODELS
from yade_scripts.model.shape import shape_of

# keys of section facade that say themselves which blocks the façade is, and on what it stands
OF_A_BLOCK = ("hinges_m", "wedge_deg", "outline", "base")
OF_THE_BUILDING = 0.3  # mass of the study's façade over that of its building
DIGITS = 4  # of a mass that follows from it


def settle(resolved: dict[str, Any], stated: set[str]) -> None:
    """Set keys that `stated`, dotted ones, leaves open and others decide; in place.

    Parameters
    ----------
    resolved : dict
        Complete, of valid values.
    stated : set of str
    """
    facade, kinds = resolved["facade"], [MODELS[name] for name in resolved["models"]]
    if "facade.courses" not in stated and _is_block(facade, kinds):
        facade["courses"] = 0
    cut_by_default = facade["courses"] and "facade.courses" not in stated
    if "facade.courses_growth" not in stated and not cut_by_default:
        facade["courses_growth"] = 1.0
    alone = facade["sides"] == "two"  # no law is of it
    if "damping.law" not in stated and (alone or "damping.beta_s" in stated):
        resolved["damping"]["law"] = "value"
    elastic = all(kind.two_way and not kind.single_block for kind in kinds)  # bricks carry it
    if "smdof.base_shear_ratio" not in stated and elastic:
        resolved["smdof"]["base_shear_ratio"] = None


def _is_block(facade, kinds):
    """Whether a key, or every model, says that the façade is not cut into courses."""
    usual = schema.complete({}, schema.sections()["facade"])
    given = any(facade[key] != usual[key] for key in OF_A_BLOCK)
    return given or not any(kind.compiled and not kind.bonded for kind in kinds)


def settle_mass(resolved: Mapping[str, Any], stated: set[str]) -> None:
    """Set the building's mass, unless it is stated: ten thirds of a façade as high as it; in place.

    Parameters
    ----------
    resolved : mapping
        Whose façade can be.
    stated : set of str
        Dotted keys.
    """
    if "return_wall.building_mass_kg" in stated:
        return
    facade = replace(Facade.of(resolved["facade"]), hinges_m=(), courses=0)
    facade_kg = shape_of(facade).mass_kg * facade.building_top_m / facade.height_m
    resolved["return_wall"]["building_mass_kg"] = float(f"{facade_kg / OF_THE_BUILDING:.{DIGITS}g}")
