"""Finished runs that are compared with others."""

import csv


def curves_of(path):
    """Rows of a finished run's collapse table, as text."""
    with open(path, encoding="utf-8", newline="") as handle:
        return list(csv.DictReader(handle))
