"""Rocking masonry façades: records, cases, searches for collapse, and what is made of them.

The way in, without Snakemake::

    from rocking import Case, Motion, collapse_curve

    case = Case.configured("W2m", {"facade.height_m": 6.0})
    print(collapse_curve(case, Motion.named("GMN_NS"), "neg").summary())

A name is loaded when it is first used, so that `import rocking` stays quick.
"""

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # for type checkers: what is loaded when it is asked for
    from rocking.collapse.case import Case, Variant
    from rocking.collapse.curve import Curve, collapse_curve, collapse_curves, history
    from rocking.collapse.history import History
    from rocking.collapse.motion import Motion
    from rocking.formula.law import Estimate, estimate

_PUBLIC = {
    "Case": "collapse.case",
    "Curve": "collapse.curve",
    "Estimate": "formula.law",
    "History": "collapse.history",
    "Motion": "collapse.motion",
    "Variant": "collapse.case",
    "collapse_curve": "collapse.curve",
    "collapse_curves": "collapse.curve",
    "estimate": "formula.law",
    "history": "collapse.curve",
}
__all__ = [
    "Case",
    "Curve",
    "Estimate",
    "History",
    "Motion",
    "Variant",
    "collapse_curve",
    "collapse_curves",
    "estimate",
    "history",
]


def __getattr__(name):
    """Return a public name, loading the module that has it; `__version__` too."""
    if name == "__version__":
        return importlib.import_module("rocking.version").version()
    if name not in _PUBLIC:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"rocking.{_PUBLIC[name]}"), name)


def __dir__():
    """Return the names that are there or can be loaded, for completion at a prompt."""
    return sorted({*globals(), *__all__})
