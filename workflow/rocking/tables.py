"""How results are read and written: one form for every table (CSV), and for all else JSON."""

import csv
import re
import unicodedata

import pandas as pd
from pandas._libs.parsers import STR_NA_VALUES

from yade_scripts.files import read_json, write_json

# what a spreadsheet takes for a formula: text that begins so, and is more than a name or a number
_FORMULA = re.compile(r"\s*([=@].*|[+-](?![\w.+-]*\Z).*)", re.DOTALL)

__all__ = [
    "headed",
    "read_frame",
    "read_json",
    "read_tables",
    "together",
    "write_json",
    "write_table",
]

# Columns of names, which users choose: 1063, 0012, 1E03, NA and True are names as any other.
NAMES = ("record", "station", "event", "run", "part", "name", "variant", "case", "file", "first")


def read_frame(path, numbers=(), **options):
    """Read a table of results: columns of names as text, as they stand, all others by themselves.

    `numbers` are columns that hold numbers here and names elsewhere, such as the runs of a test;
    `options` are of `pandas.read_csv`. An empty cell is missing in any column. The apostrophe that
    `write_table` puts before text is taken off.
    """
    with open(path, encoding="utf-8", newline="") as stream:
        mark = options.get("comment") or "\0"
        lines = (line for line in stream if not line.startswith(mark))
        header = next(csv.reader(lines, delimiter=options.get("sep", ",")), [])
    named = [column for column in header if column in NAMES and column not in numbers]
    missing = {column: [""] if column in named else sorted(STR_NA_VALUES) for column in header}
    frame = pd.read_csv(
        path, dtype=dict.fromkeys(named, str), keep_default_na=False, na_values=missing, **options
    )
    for name in frame.select_dtypes(include="object"):
        frame[name] = frame[name].map(_as_given, na_action="ignore")
    return frame


def read_tables(paths):
    """Tables of several files, one below the other; those without rows have no part in it."""
    return together(read_frame(path) for path in paths)


def together(tables):
    """Tables one below the other, with the columns of all; those without rows have no part in it.

    A column that is blank throughout one of them takes its type from the others: pandas does so
    too, and warns with each that it will not for ever.
    """
    parts = list(tables)
    columns = dict.fromkeys(name for table in parts for name in table.columns)
    filled = [table.dropna(axis="columns", how="all") for table in parts if len(table)]
    if not filled:
        return parts[0].reindex(columns=list(columns))
    return pd.concat(filled, ignore_index=True).reindex(columns=list(columns))


def headed(table, **values):
    """Return a table with columns of one value each before its own."""
    frame = table.copy()
    for place, (name, value) in enumerate(values.items()):
        frame.insert(place, name, value)
    return frame


def as_text(value):
    """A cell that no spreadsheet takes for a formula, nor its lines for rows."""
    if not isinstance(value, str):
        return value
    text = value.replace("\r\n", "\n").replace("\r", "\n")  # only these are quoted in a CSV file
    plain = unicodedata.normalize("NFKC", text).lstrip("\ufeff")  # ＝ counts as = in places
    return f"'{text}" if _FORMULA.fullmatch(plain) else text


def _as_given(cell):
    """A cell before `as_text`."""
    guarded = isinstance(cell, str) and cell[:1] == "'" and as_text(cell[1:]) == cell
    return cell[1:] if guarded else cell


def write_table(table, path, columns=None, digits="%.6g"):
    """Write a table, or its rows, as CSV: a header, no index, line feeds on any system.

    `columns` say which and in which order, and make the header where there are no rows. `digits` is
    the form of floating-point numbers; None writes as many digits as tell them apart. Text that a
    spreadsheet would run as a formula gets an apostrophe before it, by which these know text.
    """
    frame = pd.DataFrame(table, columns=columns).copy(deep=False)
    for name in frame.select_dtypes(exclude=["number", "bool"]):
        frame[name] = frame[name].map(as_text, na_action="ignore")
    frame.columns = frame.columns.map(as_text)
    frame.to_csv(path, index=False, float_format=digits, lineterminator="\n")
