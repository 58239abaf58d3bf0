"""How tables are written: one form for every CSV file of the results."""

import pandas as pd


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
