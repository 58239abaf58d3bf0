"""Finished runs that are compared with others, perhaps by an earlier version."""

import csv

from yade_scripts.model.registry import MODELS, WITH_WALLS


def curves_of(path):
    """Rows of a finished run's collapse table, as text."""
    with open(path, encoding="utf-8", newline="") as handle:
        return list(csv.DictReader(handle))


def models_gone(path):
    """Say which models of a finished run's collapse table are no longer known; empty: none."""
    names = {row.get("model") or "" for row in curves_of(path)}
    if not (gone := sorted(names - set(MODELS))):
        return ""
    known = ", ".join(WITH_WALLS)
    return f"{path}: no model {', '.join(gone)} any more; expected {known}: run it again"
