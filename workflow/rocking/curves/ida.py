"""Post-processing of incremental dynamic analyses."""

import pandas as pd

from yade_scripts.studies.intensities import collapse_bounds

COLLAPSE_COLUMNS = [
    "model",
    "record",
    "direction",
    "pga_safe_g",
    "pga_collapse_g",
    "pga_median_g",
    "pga_p10_g",
    "pga_p90_g",
]
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

    Raises
    ------
    ValueError
        If a column of the contract is missing.
    """
    table = pd.read_csv(path)
    missing = COLUMNS - set(table.columns)
    if missing:
        raise ValueError(f"{path}: missing column(s) {', '.join(sorted(missing))}")
    return table.sort_values("pga_g", ignore_index=True)


def curve_key(table):
    """Model, record and direction of an IDA or ensemble table."""
    head = table.iloc[0]
    return head["model"], head["record"], head["direction"]


def collapse_row(curve):
    """Collapse intensities of one curve: highest safe PGA below the first collapse, and that.

    A curve without collapse leaves pga_collapse_g blank (censored at its highest
    intensity); failed runs count as neither.
    """
    done = dict(zip(curve["pga_g"], curve["status"], strict=True))
    safe, collapse = collapse_bounds(done)
    model, record, direction = curve_key(curve)
    return {
        "model": model,
        "record": record,
        "direction": direction,
        "pga_safe_g": safe,
        "pga_collapse_g": collapse,
    }


def branches(curve):
    """Split a curve into runs that stood and runs that overturned.

    Returns
    -------
    stood, fell : DataFrame
        Rows with status "ok" and "overturned"; failed runs are in neither.
    """
    return curve[curve["status"] == "ok"], curve[curve["status"] == "overturned"]
