"""Tables of runs: numbers until they are written, formatted here alone."""

import csv
import io
import json
from typing import Any

import numpy as np

from yade_scripts.engine import simulate

KEY = {"model": "", "record": "", "direction": "", "pga_g": ".4f"}  # what names a run
REALISATION = {"realisation": "d", "amplitude_factor": ".9f"}  # and one of an ensemble
HEAD = {**KEY, "status": "", "dt_s": ".6e"}  # what does not change along one history
TWO_COMPONENTS = {"twist_rad": ".6g", "slid_m": ".6g"}  # what a run under both has beside
# of the columns that every table of earthquake runs ends with
RUN_COLUMNS = {
    "d_over_b": ".6f",
    "collapsed": "d",
    "status": "",
    "dt_s": ".6e",
    "steps": "d",
    "wall_s": ".3f",
}


def run_row(model, record, direction, pga_g, history):
    """Row of one run; d/b and collapse are None where it failed.

    d/b is that of an overturned façade at most, and rounded as in the table: a run reads the same
    from the table and from a journal.
    """
    failed = history.status == simulate.FAILED
    return {
        "model": model,
        "record": record,
        "direction": direction,
        "pga_g": pga_g,
        "d_over_b": None if failed else round(float(min(history.peak_d_over_b, 1.0)), 6),
        "collapsed": None if failed else int(history.status == simulate.OVERTURNED),
        "status": history.status,
        "dt_s": history.dt_s,
        "steps": history.steps,
        "wall_s": history.wall_s,
        **history.beside,
    }


def to_csv(rows, columns):
    """Rows as CSV text, with the format of each column, in order; None is left blank."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in rows:
        values = ((row[name], how) for name, how in columns.items())
        writer.writerow("" if value is None else format(value, how) for value, how in values)
    return text.getvalue()


def history_facts(case, args, pga_g, history):
    """What does not change along one history: its HEAD, from a command line and its outcome."""
    given = case["model"], args.record, args.direction, pga_g, history.status, history.dt_s
    return dict(zip(HEAD, given, strict=True))


def history_csv(facts, names, rows, formats):
    """One history as CSV text; what does not change, the facts, stands in the first columns.

    Columns without a format get six digits.
    """
    lines = (dict(zip(names, row, strict=True)) | facts for row in rows)
    return to_csv(lines, {name: formats.get(name, ".6g") for name in (*facts, *names)})


def archive(runs, **series):
    """Bytes of a NumPy archive of histories: `runs` (JSON), `length` of each, and series by name.

    A series has an array a run; they are kept end to end.
    """
    text = io.BytesIO()
    lengths = np.array([len(values) for values in next(iter(series.values()))])
    arrays: dict[str, Any] = {"runs": np.array(json.dumps(runs)), "length": lengths}
    arrays |= {name: np.concatenate(values) for name, values in series.items()}
    np.savez_compressed(text, **arrays)
    return text.getvalue()
