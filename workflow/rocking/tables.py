"""How results are read and written: one form for every table (CSV), and for all else JSON."""

import pandas as pd

from yade_scripts.files import read_json, write_json

__all__ = ["headed", "read_json", "read_tables", "write_json", "write_table"]


def read_tables(paths):
    """Tables of several files, one below the other; those without rows have no part in it."""
    found = [pd.read_csv(path) for path in paths]
    return pd.concat([table for table in found if len(table)] or found[:1], ignore_index=True)


def headed(table, **values):
    """Return a table with columns of one value each before its own."""
    frame = table.copy()
    for place, (name, value) in enumerate(values.items()):
        frame.insert(place, name, value)
    return frame


def write_table(table, path, columns=None, digits="%.6g"):
    """Write a table as CSV: a header, no index, lines that end in a line feed on any system.

    Parameters
    ----------
    table : DataFrame, or rows as `DataFrame` takes them
    path : path
    columns : list of str, optional
        Which columns, and in which order; of no rows at all, the header.
    digits : str or None
        Form of floating-point numbers; None writes as many digits as tell them apart.
    """
    frame = pd.DataFrame(table, columns=columns)
    frame.to_csv(path, index=False, float_format=digits, lineterminator="\n")
