"""The study's own configuration, `config/scenarios/study.yaml`: what it was made with.

A rigid block on springs of E/h with its β, with a building that stays elastic. Defaults are not
the study's: what rests on it, as tests and formulas do, names its keys.
"""

import functools
from collections.abc import Mapping
from typing import Any

from rocking.configuration.files import read_yaml
from rocking.configuration.layers import laid_over, nested
from rocking.shipped import shipped

FILE = shipped("config/scenarios/study.yaml")
SECTIONS = ("facade", "return_wall", "damping", "smdof", "ida", "ensemble")  # of a case


@functools.cache
def _keys() -> dict[str, Any]:
    given = read_yaml(FILE)
    return {name: given[name] for name in SECTIONS}


def as_in_the_study(given: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Return a configuration laid over the study's keys of `SECTIONS`.

    Parameters
    ----------
    given : mapping or None
        Values by section or dotted key; what they leave open is as in the study, and what that
        leaves open has its default.

    Returns
    -------
    dict
        By section, for `Case.configured` and `config.resolve`.

    Examples
    --------
    >>> from rocking import Case
    >>> block = Case.configured("W2", as_in_the_study({"facade.height_m": 5.0}))
    >>> block["facade"]["courses"], block["smdof"]["base_shear_ratio"], block["beta_s"]
    (0, None, 0.00276)
    """
    return laid_over(_keys(), nested(given or {}))
