"""Post-processing of incremental dynamic analyses."""

import numpy as np

from rocking.tables import read_frame
from yade_scripts.lists import listed

COLUMNS = {
    "model",
    "record",
    "direction",
    "pga_g",
    "d_over_b",
    "collapsed",
    "status",
    "dt_s",
    "steps",
    "wall_s",
}


def read_curve(path):
    """Read one IDA table (contract: ida/{model}/{record}_{direction}.csv), by ascending PGA.

    ValueError if a column of the contract is missing.
    """
    table = read_frame(path)
    missing = COLUMNS - set(table.columns)
    if missing:
        raise ValueError(f"{path}: missing column(s) {listed(sorted(missing))}")
    return table.sort_values("pga_g", ignore_index=True)


def curve_key(table):
    """Model, record and direction of an IDA or ensemble table."""
    head = table.iloc[0]
    return head["model"], head["record"], head["direction"]


def by_curve(paths, read=read_frame):
    """Return tables of files, each of one curve, by `curve_key`; empty ones are left out."""
    return {curve_key(table): table for table in map(read, paths) if len(table)}


def branches(curve):
    """Rows of a curve with status "ok", and "overturned"; failed runs are in neither."""
    return curve[curve["status"] == "ok"], curve[curve["status"] == "overturned"]


def highest(row):
    """Largest intensity worth showing for a curve: where all collapse, or what was reached.

    NaN where every run failed.
    """
    known = [row[f"pga_{name}_g"] for name in ("all", "collapse", "max")]
    return next((g for g in known if np.isfinite(g)), np.nan)
