"""Values in another unit: a range that is usual, and which unit would bring a value into it.

A key states as `usual: [low, high]` what is common, much narrower than what may be computed. Zero
stands for "none" in most keys and is never doubted.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from rocking.configuration.schema import leaves, show, value_at, whole

# What one of another unit is in the key's own.
OTHERS: dict[str, dict[str, float]] = {
    "g": {"m/s²": 1 / 9.80665, "cm/s²": 0.01 / 9.80665, "%": 0.01},
    "m": {"cm": 0.01, "mm": 0.001},
    "mm": {"cm": 10.0, "m": 1000.0},
    "kN": {"N": 0.001, "kg": 0.00980665, "t": 9.80665, "MN": 1000.0},
    "kg": {"t": 1000.0},
    "t": {"kg": 0.001},
    "MPa": {"GPa": 1000.0, "kPa": 0.001, "Pa": 1e-6},
    "kg/m³": {"kN/m³": 1000 / 9.80665, "t/m³": 1000.0},
    "kN/m": {"N/m": 0.001, "MN/m": 1000.0},
    "Pa/m": {"MPa/m": 1e6, "N/mm³": 1e9, "kPa/m": 1000.0},
    "s": {"ms": 0.001},
    "°": {"rad": 180 / math.pi},
    "-": {"%": 0.01},
}


def meant(value: float, unit: str, usual: list[float] | None) -> str:
    """What a value would be in the unit that makes it usual: "20 mm"; empty where none does."""
    if not usual:
        return ""
    suffix = "" if unit == "-" else f" {unit}"
    for other, factor in OTHERS.get(unit, {}).items():
        if usual[0] <= value * factor <= usual[1]:
            return f"{show(value)} {other} would be {float(f'{value * factor:.3g}'):g}{suffix}"
    if unit == "s" and value > 0.0 and usual[0] <= 1.0 / value <= usual[1]:
        return f"{show(value)} Hz would be {float(f'{1.0 / value:.3g}'):g} s"
    return ""


def unusual(resolved: Mapping) -> Iterator[str]:
    """Doubts about numbers of a resolved configuration that lie outside what is usual."""
    for path, schema in leaves(whole()):
        value = value_at(resolved, path)
        yield from _unlikely(path, value, schema, schema.get("unit", "-"))


def _unlikely(path: str, value: Any, schema: Mapping, unit: str) -> Iterator[str]:
    if isinstance(value, list):
        items = schema.get("items", {})
        for number, entry in enumerate(value, 1):
            yield from _unlikely(f"{path}[{number}]", entry, items, items.get("unit", unit))
    elif isinstance(value, Mapping):
        for key, part in schema.get("properties", {}).items():
            yield from _unlikely(f"{path}.{key}", value.get(key), part, part.get("unit", "-"))
    elif "usual" in schema and isinstance(value, int | float) and value:
        low, high = schema["usual"]
        if not low <= value <= high:
            suffix = "" if unit == "-" else f" {unit}"
            said = f"{path} = {show(value)}{suffix}: usual are {show(low)} to {show(high)}"
            yield "; ".join(filter(None, [said, meant(value, unit, schema["usual"])]))
