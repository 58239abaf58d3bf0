"""Values by dotted key, and configurations laid over each other."""

from collections.abc import Mapping
from typing import Any

from rocking.configuration import schema
from rocking.configuration.schema import ConfigError


def nested(given: Mapping) -> dict[str, Any]:
    """Return values by section from values by section or dotted key."""
    return nest(schema.plain(given), "configuration")


def nest(given: dict, where: str) -> dict:
    """Turn dotted keys into sections."""
    out: dict[str, Any] = {}
    for key, value in given.items():
        head, *rest = key.split(".")
        for part in reversed(rest):
            value = {part: value}
        if head in out and _both(out[head], value):
            raise ConfigError(f"{where}.{key}: given twice")
        out[head] = laid_over(out[head], value) if head in out else value
    return out


def _both(one: Any, two: Any) -> bool:
    """Whether some value stands in both of two sections, or what is no section in either."""
    if not (isinstance(one, dict) and isinstance(two, dict)):
        return True
    return any(_both(one[key], two[key]) for key in one.keys() & two.keys())


def laid_over(given: dict, overrides: dict) -> dict:
    """Lay overrides over what is given by section; lists and single values are replaced."""
    out = dict(given)
    for key, value in overrides.items():
        old = out.get(key)
        both = isinstance(old, dict) and isinstance(value, dict)
        out[key] = laid_over(old, value) if both else value  # type: ignore[arg-type]
    return out
