"""What the configuration's façade must satisfy as a whole, beyond the limits of its keys."""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from rocking.configuration.schema import ConfigError, show
from rocking.configuration.static_stability import WEAKEST, check_static_stability
from yade_scripts.lists import listed
from yade_scripts.model import interlocking, registry
from yade_scripts.model.base import course_tops
from yade_scripts.model.facades import ALONG, OWN_KEYS, STUDY, TRIANGLE, Facade, FloorRow, Rods
from yade_scripts.model.shape import Shape, shape_of

MIN_SLENDERNESS = 2.0  # h/b; a stockier block slides or crushes before it rocks


class TooStockyError(ConfigError):
    """A façade that slides or crushes before it rocks."""


def check_facade(resolved: Mapping) -> None:
    """Check section facade with the models and return walls it stands before.

    Of a configuration, or of the sections of a case with its model as `models`. Everything wrong is
    a `ConfigError` of one line with the key, its value and what was expected.
    """
    facade = Facade.of(resolved["facade"])
    _check_geometry(facade, resolved["return_wall"])
    _check_sides(resolved)
    bonded = [name for name in resolved["models"] if registry.model(name).bonded]
    bond_mpa = max(facade.bond_tension_mpa, facade.bond_cohesion_mpa)
    if bond_mpa > 0.0 and facade.tilt_deg > 0.0:
        raise ConfigError(
            f"facade.tilt_deg = {show(facade.tilt_deg)}: expected 0 (°) with a bond of the base"
        )
    for key, unit in (("gap_m", "m"), ("tilt_deg", "°")):  # a bond needs a wall that it touches
        if bonded and getattr(facade, key) > 0.0:
            raise ConfigError(
                f"facade.{key} = {show(getattr(facade, key))}: expected 0 ({unit}) with the bonded "
                f"models {show(bonded)}"
            )
    _check_shape(resolved)
    check_bars(resolved)
    _check_hinges(resolved)
    _check_bricks(resolved)
    check_static_stability(resolved)


def _check_sides(resolved: Mapping) -> None:
    """Refuse models whose walls a free-standing façade has not, and a building lower than it."""
    facade, models = Facade.of(resolved["facade"]), resolved["models"]
    raised, alone = facade.base_height_m, facade.is_free
    allowed = ["W1", "W2", "W2m"] if raised else ["W1"]
    if alone and not set(models) <= set(allowed):
        on = "" if raised else ", and W2 and W2m on a base above the ground alone"
        raise ConfigError(
            f"models = {show(models)}: expected [{listed(allowed)}] with facade.sides = two, "
            f"since a free-standing façade has no return walls{on}"
        )
    least = raised + (0.0 if alone else facade.height_m)
    if facade.building_top_m < least * (1.0 - 1e-9):
        what = "base_height_m" if alone else "base_height_m + facade.height_m"
        raise ConfigError(
            f"facade.building_height_m = {show(facade.building_height_m)}: expected at least "
            f"facade.{what} = {show(least)} (m)"
        )


def _check_bricks(resolved: Mapping) -> None:
    """Refuse return walls of bricks that cannot be laid up to the façade's height."""
    for name in resolved["models"]:
        kind = registry.model(name)
        if kind.walls == "bricks":
            try:
                interlocking.check(resolved, kind.two_way)
            except ValueError as error:
                raise ConfigError(f"{error}, with model {name}") from None


def _check_geometry(facade: Facade, wall: Mapping) -> None:
    h, b = facade.height_m, facade.thickness_m
    if h < MIN_SLENDERNESS * b:
        raise TooStockyError(
            f"facade.height_m = {show(h)}: expected at least {show(MIN_SLENDERNESS)} × "
            f"facade.thickness_m = {show(MIN_SLENDERNESS * b)} (m), for a wall that rocks"
        )
    slenderness_deg = math.degrees(math.atan2(b, h))
    tilt = facade.tilt_deg
    if tilt >= slenderness_deg:
        raise ConfigError(
            f"facade.tilt_deg = {show(tilt)}: expected less than "
            f"atan(thickness/height) = {slenderness_deg:.4g} (°), or the façade has fallen already"
        )
    if facade.is_free:
        return
    total = wall["count"] * wall["thickness_m"]
    if total > facade.width_m * (1.0 + 1e-9):
        raise ConfigError(
            f"return_wall.count = {wall['count']}: expected count × thickness_m = {show(total)} "
            f"within facade.width_m = {show(facade.width_m)} (m)"
        )


def check_bars(resolved: Mapping) -> None:
    """Refuse ties and floors that nothing carries, that snap early or that hold nothing."""
    facade = Facade.of(resolved["facade"])
    several = [name for name in resolved["models"] if not registry.model(name).single_block]
    keys = ("ties", "floors", "thrusts")
    rows = [(key, *row) for key in keys for row in enumerate(getattr(facade, key), 1)]
    for key, number, row in rows:
        where = f"facade.{key}[{number}]"
        if row.height_m > facade.height_m:
            raise ConfigError(
                f"{where}.height_m = {show(row.height_m)}: expected at most facade.height_m = "
                f"{show(facade.height_m)} (m)"
            )
        if several:
            raise ConfigError(
                f"models = {show(several)}: expected no facade.{key}, or a façade of one block"
            )
        if facade.is_free and key == "ties":
            raise ConfigError(
                "facade.sides = two: expected no facade.ties, which need return walls; a floor's "
                "anchor_kn holds to the ground"
            )
        if key == "ties" and row.elongation * row.e_mpa < row.yield_mpa:
            raise ConfigError(
                f"{where}.elongation = {show(row.elongation)}: expected at least the strain at "
                f"yield, yield_mpa/e_mpa = {show(row.yield_mpa / row.e_mpa)}"
            )
        if key == "ties":
            _check_pretension(where, row)
            _check_places(where, row, facade)
        if key == "floors":
            _check_floor(where, row, shape_of(replace(facade, hinges_m=())))
            _check_bearing(where, row, resolved)


def _check_pretension(where: str, row: Rods) -> None:
    """Refuse a rod that is slack and pulls, or that pulls more than it holds."""
    if row.pretension_kn and row.slack_mm:
        raise ConfigError(
            f"{where}.slack_mm = {show(row.slack_mm)}: expected 0 (mm) with pretension_kn = "
            f"{show(row.pretension_kn)}"
        )
    if (most := 1e-3 * row.rod[1] / row.count) < row.pretension_kn:
        raise ConfigError(
            f"{where}.pretension_kn = {show(row.pretension_kn)}: expected at most what rod and "
            f"anchor hold, {most:.4g} (kN)"
        )


def _check_places(where: str, row: Rods, facade: Facade) -> None:
    """Refuse places of rods that are not as many as the rods, or not on the façade."""
    if row.x_m is None:
        return
    if len(row.x_m) != row.count:
        raise ConfigError(
            f"{where}.x_m: found {len(row.x_m)} places; expected as many as count = {row.count}"
        )
    half = 0.5 * facade.width_m
    for x in row.x_m:
        if abs(x) > half:
            raise ConfigError(
                f"{where}.x_m = {show(x)}: expected within half of facade.width_m on either side "
                f"of the middle, {show(half)} (m)"
            )


def _check_floor(where: str, row: FloorRow, shape: Shape) -> None:
    back, front = shape.faces_at(row.height_m)
    if (row.arm_m or 0.0) > front - back + 1e-9:
        raise ConfigError(
            f"{where}.arm_m = {show(row.arm_m)}: expected at most the thickness at that height, "
            f"{show(front - back)} (m)"
        )
    if row.joists == ALONG and row.load_kn:
        raise ConfigError(
            f"{where}.load_kn = {show(row.load_kn)}: expected 0 (kN) with joists = along, which "
            "bear on the return walls"
        )
    if row.load_kn == row.anchor_kn == 0.0 and row.joists != ALONG:
        raise ConfigError(f"{where}.load_kn = 0: expected a load, or an anchor_kn (kN) above 0")
    least = row.anchor_kn / row.stiffness_kn_m
    if row.anchor_reach_m < least and not row.mass_t:
        raise ConfigError(
            f"{where}.anchor_reach_m = {show(row.anchor_reach_m)}: expected at least "
            f"anchor_kn/stiffness_kn_m = {least:.3g} (m), at which the anchors pull anchor_kn"
        )
    if row.mass_t > 0.0 and row.friction * row.load_kn + row.anchor_kn == 0.0:
        raise ConfigError(
            f"{where}.mass_t = {show(row.mass_t)}: expected friction or anchor_kn (kN) that "
            "joins it to the façade"
        )


def _check_bearing(where: str, row: FloorRow, resolved: Mapping) -> None:
    """Refuse a level load that does not lie on a plain top, or rests where nothing holds it."""
    facade = Facade.of(resolved["facade"])
    if row.bearing != "flat" and not row.load_inertia:
        return
    given = "bearing = flat" if row.bearing == "flat" else "load_inertia = true"
    if row.height_m != facade.height_m or row.arm_m is not None or row.mass_t:
        raise ConfigError(
            f"{where}.{given}: expected height_m = facade.height_m = "
            f"{show(facade.height_m)} (m), arm_m = null and mass_t = 0"
        )
    pushed = [name for name in resolved["models"] if registry.model(name).two_way]
    if pushed or facade.tilt_deg or not facade.is_plain:
        raise ConfigError(
            f"{where}.{given}: expected a plain upright façade before driven walls or none"
        )


def _check_shape(resolved: Mapping) -> None:
    facade = Facade.of(resolved["facade"])
    if facade.is_plain:
        return
    for name in resolved["models"]:
        if not registry.model(name).single_block:
            raise ConfigError(f"models = {name}: expected a façade of one block with a shape")
    _check_outline(resolved["facade"])
    _check_wedge(resolved["facade"])
    if facade.courses:
        _shape(facade, course_tops(facade)[:-1], "courses")
    _shape(facade, ())


def _shape(facade: Facade, hinges: Sequence, key: str = "hinges_m") -> None:
    """Refuse a shape that cannot be, cut at these heights."""
    try:
        shape = shape_of(replace(facade, hinges_m=tuple(hinges)))
        for z in hinges:
            shape.joint_at(z, key)
    except ValueError as error:
        raise ConfigError(str(error)) from None


def _check_wedge(section: Mapping) -> None:
    """Refuse a wedge on a façade without return walls, or on one in pieces."""
    facade = Facade.of(section)
    if not facade.wedge_deg:
        return
    given = [key for key in ("hinges_m", "courses") if getattr(facade, key)]
    given += ["sides"] if facade.is_free else []
    if given:
        raise ConfigError(
            f"facade.wedge_deg = {show(facade.wedge_deg)}: expected 0 (°) with facade."
            f"{given[0]} = {show(section[given[0]])}: the wedge goes along with one block that "
            "leans on return walls"
        )


def _check_outline(section: Mapping) -> None:
    facade = Facade.of(section)
    if facade.outline != TRIANGLE:
        return
    given = [key for key in (*OWN_KEYS, "hinges_m", "courses") if getattr(facade, key)]
    if given:
        raise ConfigError(
            f"facade.{given[0]} = {show(section[given[0]])}: expected none with facade.outline = "
            f"{TRIANGLE}"
        )
    if not facade.is_free:
        raise ConfigError(
            f"facade.outline = {TRIANGLE}: expected facade.sides = two, since no return wall "
            "stands behind a gable"
        )


def _check_hinges(resolved: Mapping) -> None:
    facade = Facade.of(resolved["facade"])
    heights, courses = facade.hinges_m, facade.courses
    stated = [key for key in ("base_stiffness_pa_m", "courses", "hinges_m") if getattr(facade, key)]
    bases = [("facade.base", facade.base)]
    forms = resolved.get("uncertainty", {}).get("bases", ())
    bases += [("uncertainty.bases", base) for base in forms]
    for key, base in bases:
        if base != STUDY and stated:
            raise ConfigError(
                f"{key} = {base}: expected {STUDY} with facade.{stated[0]}, which states its own "
                "stiffness"
            )
    if not heights and not courses:
        return
    given = "hinges_m" if heights else "courses"
    if heights and courses:
        raise ConfigError(f"facade.courses = {courses}: expected 0 with facade.hinges_m")
    for name in resolved["models"]:
        kind = registry.model(name)
        if not kind.compiled or kind.bonded:
            expected = (
                f"{given} = {courses}, or facade.courses = 0, one block" if courses else given
            )
            raise ConfigError(
                f"models = {name}: expected W1, W2 or W2m, dry, with facade.{expected}"
            )
    if facade.tilt_deg and heights:
        raise ConfigError(
            "facade.hinges_m: expected none with facade.tilt_deg, of a wall that leans"
        )
    if not facade.is_plain and heights == WEAKEST:
        raise ConfigError(f"facade.{given} = {WEAKEST}: expected a plain façade on the ground")
    if courses:
        return
    if heights != WEAKEST:
        if any(a >= b for a, b in itertools.pairwise(heights)):
            raise ConfigError(f"facade.hinges_m = {show(list(heights))}: expected ascending values")
        if heights[-1] >= facade.height_m:
            raise ConfigError(
                f"facade.hinges_m = {show(list(heights))}: expected heights below "
                f"facade.height_m = {show(facade.height_m)} (m)"
            )
        _shape(facade, heights)
        return
    levels = {row.height_m for row in facade.floors}
    if levels != {facade.height_m}:
        raise ConfigError(
            f"facade.hinges_m = {WEAKEST}: expected facade.floors at the top alone, that hold it, "
            f"at facade.height_m = {show(facade.height_m)} (m)"
        )
