"""What a building that yields does to the formula's answer: V/W as a group.

Walls that move with an elastic building cost a façade L = ln(C_W1/C), with C the PGA of half
collapse before it and C_W1 that with walls that move with the ground. A building that yields passes
less on, and gives a part of L back. At C an elastic chain would carry e^a C/g of its weight; where
that exceeds V/W its storeys yield before the façade falls, and half collapse comes later by

    ln r = s max(0, L) max(0, x),   x = ln[(C/g)/(V/W)] + a.

s and a are fitted by model, of bilinear storeys with 2 % hardening (`tests/trials/yielding`); r is
one number for every measure.
"""

import json
import math
from functools import lru_cache
from pathlib import Path

from rocking.formula.groups import OutsideError
from rocking.shipped import shipped

FILE = shipped("config/formula_yielding.json")


def content(path, keys, what):
    """Content of a formula's file; a ValueError of one line where it has not all of some keys."""
    try:
        law = json.loads(Path(path).read_text("utf-8"))
        [law[key] for key in keys]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{path}: expected {what}: {error}") from None
    return law


@lru_cache(maxsize=4)
def read(path=FILE):
    """Content of the file on yielding; a ValueError of one line for a file of another kind."""
    return content(path, ("models", "lowest"), "the formula of yielding buildings")


def excess(pga_g, ratio, part):
    """x, see above; PGA before an elastic building [g], V/W, and a model's part."""
    return math.log(pga_g / ratio) + part["a"]


def log_ratio(pga_g, ground_g, ratio, model):
    """ln r, and its standard error.

    Parameters
    ----------
    pga_g, ground_g : float
        Half collapse before an elastic building, and with walls that move with the ground (W1) [g].
    ratio : float
        V/W.
    model : str
        One of the file's.

    An OutsideError of one line for a strength that was not tried.
    """
    law = read()
    if ratio < law["lowest"]:
        raise OutsideError(
            f"formula: base_shear_ratio = {ratio:.4g}: the formula has {law['lowest']:g} and more"
        )
    part, lost = law["models"][model], math.log(ground_g / pga_g)
    beyond = excess(pga_g, ratio, part)
    if beyond <= 0.0 or lost <= 0.0:
        return 0.0, 0.0
    return part["s"] * lost * beyond, part["error"]
