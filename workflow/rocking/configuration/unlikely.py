"""What a configuration may say, but hardly means: in another unit, or without an effect."""

import math
from collections.abc import Iterator, Mapping

from rocking.configuration import together, units
from rocking.configuration.schema import leaves, show, whole
from yade_scripts.lists import listed
from yade_scripts.model import registry
from yade_scripts.model.shape import shape_of

COEFFICIENT = 2.0  # an angle of friction [°] below it is rather a coefficient
MOST = 40  # lines: what no line says is silent
OWN_SCAN = {"level_ratio": "ida", "power": "ida", "realisations": "ensemble"}  # of w3.scan, else of


def lines(
    settings: Mapping[str, Mapping], stated: Mapping[str, Mapping] | None = None
) -> list[str]:
    """Doubts about the resolved configurations of a study, by run; each line once.

    `stated` is what the user's configuration says of every run. A key that it says without what the
    key acts with is doubted.
    """
    doubts = [line for resolved in settings.values() for line in _unlikely(resolved)]
    runs: dict[str, list[str]] = {}
    for run, given in (stated or {}).items():
        for line in together.without_effect(settings[run], given):
            runs.setdefault(line, []).append(run)
    for line, those in runs.items():
        doubts.append(line if len(those) == len(settings) else f"{listed(those, 3)}: {line}")
    return list(dict.fromkeys(doubts))


def _unlikely(resolved: Mapping) -> Iterator[str]:
    for section in ("facade", "return_wall"):
        angle = resolved[section]["friction_deg"]
        if 0.0 < angle < COEFFICIENT:
            meant = math.degrees(math.atan(angle))
            yield (
                f"{section}.friction_deg = {show(angle)}: an angle in degrees; "
                f"a coefficient of {show(angle)} would be {meant:.0f}"
            )
    mass = resolved["return_wall"]["building_mass_kg"]
    pushed = [name for name in resolved["models"] if registry.model(name).two_way]
    facade_kg = shape_of(resolved["facade"]).mass_kg if mass and pushed else 0.0
    if mass and mass < facade_kg:
        yield (
            f"return_wall.building_mass_kg = {show(mass)}: less than the façade's own "
            f"{facade_kg:.0f} kg, behind {', '.join(pushed)}; is it in kg?"
        )
    yield from units.unusual(resolved)
    yield from _not_for_bricks(resolved)


def _not_for_bricks(resolved: Mapping) -> Iterator[str]:
    """Settings of the dense scan that were changed, and in whose place W3 has defaults of its own.

    What W3 takes is in `collapse.scan.scan_settings`.
    """
    kinds = map(registry.model, resolved["models"])
    bricks = " and ".join(kind.name for kind in kinds if kind.scanned and not kind.single_block)
    if not bricks or resolved["ida"]["mode"] == "grid":
        return
    defaults = {path: schema.get("default") for path, schema in leaves(whole())}
    for key, section in OWN_SCAN.items():
        stated, taken = resolved[section][key], resolved["w3"]["scan"][key]
        untouched = taken == defaults[f"w3.scan.{key}"]
        if untouched and stated not in (taken, defaults[f"{section}.{key}"]):
            yield (
                f"{section}.{key} = {show(stated)} is not for the dense scan of {bricks}, "
                f"which takes w3.scan.{key} = {show(taken)}"
            )
