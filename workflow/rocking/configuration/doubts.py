"""What a configuration may say, but hardly means: numbers in another unit than the key's."""

import math
from collections.abc import Iterator, Mapping

from rocking.configuration.schema import show
from yade_scripts.model import registry
from yade_scripts.model.shape import shape_of

COEFFICIENT = 2.0  # an angle of friction [°] below it is rather a coefficient


def lines(settings: Mapping[str, Mapping]) -> list[str]:
    """Doubts about the resolved configurations of a study, by run; each line once."""
    return list(dict.fromkeys(line for one in settings.values() for line in _doubts(one)))


def _doubts(resolved: Mapping) -> Iterator[str]:
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
    own = shape_of(resolved["facade"]).mass_kg if mass and pushed else 0.0
    if mass and mass < own:
        yield (
            f"return_wall.building_mass_kg = {show(mass)}: less than the façade's own "
            f"{own:.0f} kg, behind {', '.join(pushed)}; is it in kg?"
        )
