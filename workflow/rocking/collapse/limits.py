"""Numbers that a history or a search may be given."""

import math
import warnings
from numbers import Real

from rocking.configuration import schema

UNUSUAL_G = 3.0  # no ground motion recorded so far has a component of more
MOST_G = schema.whole()["properties"]["ida"]["properties"]["grid_g"]["items"]["maximum"]


def positive(name, value, most=math.inf):
    """Refuse what is no finite number above 0."""
    good = isinstance(value, Real) and not isinstance(value, bool) and 0.0 < float(value) < math.inf
    if not good or value > most:
        limit = "" if most == math.inf else f" and ≤ {most:g}"
        raise ValueError(f"{name} = {value!r}: expected a number > 0{limit}")


def intensity(name, value):
    """Refuse what is no peak acceleration [g], and say what no ground has had."""
    positive(name, value, MOST_G)
    if value > UNUSUAL_G:
        warnings.warn(
            f"{name} = {value:g} g: beyond {UNUSUAL_G:g} g, more than any recorded ground motion; "
            "is it in g?",
            UserWarning,
            stacklevel=4,
        )
