"""The page on which a reader moves a façade's numbers: HTML with the formula's file inside."""

import json
from pathlib import Path

from rocking.formula import yielding
from rocking.formula.law import NOT_FOR

from yade_scripts.model.gravity import GRAVITY_M_S2

TEMPLATE = Path(__file__).with_name("page.html")
PLACES = ("/*LAW*/null", "/*G*/9.81")
BLOCKS = {"column": "block, elastic base", "study": "block on E/h"}


def walls(law):
    """What a reader calls each base of a formula's file, the atlas's own first."""
    others = {row["name"]: row for row in law["made_of"].get("others", [])}
    words = {law["made_of"]["base"]: BLOCKS[law["made_of"]["base"]]}
    for name in law["bases"]:
        row = others[name]
        words[name] = f"{row['courses']} courses" if row["courses"] else BLOCKS[row["base"]]
    return words


def content(law):
    """What the page needs of a formula's file, as `law.read` gives it."""
    made = law["made_of"]
    parts = {
        model: {
            measure: {key: part[key] for key in ("terms", "coefficients", "dispersion", "error")}
            for measure, part in by_measure.items()
        }
        for model, by_measure in law["models"].items()
    }
    return {
        "base": made["base"],
        "walls": walls(law),
        "limits": law["limits"],
        "not_for": {model: list(NOT_FOR[model]) for model in parts},
        "models": parts,
        "bases": law["bases"],
        "yielding": {key: yielding.read()[key] for key in ("lowest", "models")},
        "about": (
            f"Fitted to {made['facades']} façades under {len(made['records'])} recorded motions in "
            f"{len(made['directions'])} directions. It stands for a computed answer, not for a "
            "test: no experiment says when such a façade falls."
        ),
    }


def page(law):
    """Text of the page for what `law.read` gives; it loads nothing from anywhere."""
    text = TEMPLATE.read_text("utf-8")
    values = json.dumps(content(law), ensure_ascii=False, sort_keys=True).replace("</", "<\\/")
    for place, value in zip(PLACES, (values, repr(GRAVITY_M_S2)), strict=True):
        if text.count(place) != 1:
            raise ValueError(f"{TEMPLATE.name}: expected one {place}")
        text = text.replace(place, value)
    return text
