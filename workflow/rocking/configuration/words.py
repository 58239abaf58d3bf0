"""Names of columns and keys, and values beside them, as a reader writes them."""

from collections.abc import Mapping
from typing import Any

# endings of column names in tables, longest first, and how a reader writes the unit
UNITS = {
    "_cm_s": "cm/s",
    "_m_s2": "m/s²",
    "_m_s": "m/s",
    "_kg_m3": "kg/m³",
    "_kn_m": "kN/m",
    "_pa_m": "Pa/m",
    "_mpa": "MPa",
    "_kn": "kN",
    "_kg": "kg",
    "_mm": "mm",
    "_deg": "°",
    "_mb": "MB",
    "_cm": "cm",
    "_hz": "Hz",
    "_m": "m",
    "_t": "t",
    "_s": "s",
    "_g": "g",
}
WORDS = {
    "pga": "PGA",
    "pgv": "PGV",
    "pgd": "PGD",
    "w1": "W1",
    "w2": "W2",
    "t1": "T1",
    "im": "IM",
    "ci": "CI",
    "beta": "β",
    "eq5": "eq. 5",
    "cpu": "CPU",
    "wme": "WME",
    "dof": "DOF",
    "n": "n",
    "e": "E",
    "n_dof": "masses",
    "paper": "study",
    "p10": "10 %",
    "p90": "90 %",
    "yade": "YADE",
}


def _parts(name):
    """Words of a name and its unit: "pga_safe_g" is ("PGA safe", "g")."""
    ending = next((e for e in UNITS if name.endswith(e) and name != e), "")
    bare = name.removesuffix(ending)
    words = WORDS.get(bare) or " ".join(WORDS.get(word, word) for word in bare.split("_"))
    return words, UNITS.get(ending, "")


def heading(column):
    """Column name for reading: "pga_safe_g" becomes "PGA safe [g]"."""
    words, unit = _parts(column.removesuffix("_paper"))
    words += " study" if column.endswith("_paper") else ""
    return words + (f" [{unit}]" if unit else "")


def said(key: str, value: Any) -> str:
    """Return a key with its value: "height_m", 6.48 becomes "height 6.48 m"."""
    words, unit = _parts(key)
    if isinstance(value, list):
        if value and isinstance(value[0], dict):
            return f"{words} ({'; '.join(listed(row.items()) for row in value)})"
        value = ", ".join(f"{v:g}" if isinstance(v, float) else str(v) for v in value)
    number = f"{value:g}" if isinstance(value, float) else str(value)
    return f"{words} {number}" + (unit if unit == "°" else f" {unit}" if unit else "")


def listed(pairs):
    """Keys with their values, those that have one."""
    return ", ".join(said(key, value) for key, value in pairs if value not in (None, []))


def in_a_line(resolved: Mapping) -> str:
    """Façade and building of a run in one line, for a title."""
    facade, chain = resolved["facade"], resolved["smdof"]
    wall = f"in {facade['courses']} courses" if facade["courses"] else "in one piece"
    if facade["hinges_m"]:
        wall = "hinged"
    strength = chain["base_shear_ratio"]
    building = "elastic" if strength is None else f"yields at V/W {strength:g}"
    return (
        f"façade {facade['height_m']:g} m high, {facade['thickness_m']:g} m thick, {wall}; "
        f"building of {chain['period_s']:g} s, {building}"
    )
