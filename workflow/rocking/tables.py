"""How results are read and written: one form for every table (CSV), and for all else JSON."""

import csv

import pandas as pd
from pandas._libs.parsers import STR_NA_VALUES

from yade_scripts.files import read_json, write_json

__all__ = ["headed", "read_frame", "read_json", "read_tables", "write_json", "write_table"]

# Columns of names, which users choose: 1063, 0012, 1E03, NA and True are names as any other.
NAMES = ("record", "station", "event", "run", "part", "name", "variant", "case", "file", "first")


def read_frame(path, **options):
    """Read a table of results: columns of names as text, as they stand, all others by themselves.

    `options` are of `pandas.read_csv`. An empty cell is missing in any column.
    """
    with open(path, encoding="utf-8", newline="") as stream:
        mark = options.get("comment") or "\0"
        lines = (line for line in stream if not line.startswith(mark))
        header = next(csv.reader(lines, delimiter=options.get("sep", ",")), [])
    named = [column for column in header if column in NAMES]
    missing = {column: [""] if column in named else sorted(STR_NA_VALUES) for column in header}
    return pd.read_csv(
        path, dtype=dict.fromkeys(named, str), keep_default_na=False, na_values=missing, **options
    )


def read_tables(paths):
    """Tables of several files, one below the other; those without rows have no part in it."""
    found = [read_frame(path) for path in paths]
    return pd.concat([table for table in found if len(table)] or found[:1], ignore_index=True)


def headed(table, **values):
    """Return a table with columns of one value each before its own."""
    frame = table.copy()
    for place, (name, value) in enumerate(values.items()):
        frame.insert(place, name, value)
    return frame


def write_table(table, path, columns=None, digits="%.6g"):
    """Write a table, or its rows, as CSV: a header, no index, line feeds on any system.

    `columns` say which and in which order, and make the header where there are no rows. `digits` is
    the form of floating-point numbers; None writes as many digits as tell them apart.
    """
    frame = pd.DataFrame(table, columns=columns)
    frame.to_csv(path, index=False, float_format=digits, lineterminator="\n")
