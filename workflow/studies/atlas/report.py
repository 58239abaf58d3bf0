"""Tables of what a formula's file holds."""

import pandas as pd
from rocking.formula.law import MEASURES

COEFFICIENTS = ["model", "base", "measure", "term", "coefficient", "ci_low", "ci_high"]


def coefficients(law):
    """A row a coefficient, with its interval (COEFFICIENTS); a ratio has two bases."""
    rows = []
    own = law["made_of"]["base"]
    for model, parts in law["models"].items():
        for measure in MEASURES:
            rows += _rows((model, own, measure), parts[measure])
    for base, parts in law["bases"].items():
        for model, part in parts.items():
            rows += _rows((model, f"{base} over {own}", "ratio"), part)
    return pd.DataFrame(rows, columns=COEFFICIENTS)


def errors(law):
    """A row a model and measure: dispersion by motion, and errors of left-out façades."""
    rows = []
    for model, parts in law["models"].items():
        for measure in MEASURES:
            part = parts[measure]
            key = {"model": model, "measure": measure, "dispersion": part["dispersion"]}
            rows.append({**key, "error": part["error"], **part["checks"]})
    return pd.DataFrame(rows)


def _rows(key, part):
    columns = ("terms", "coefficients", "low", "high")
    return [(*key, *row) for row in zip(*(part[name] for name in columns), strict=True)]
