"""The normalised record between rules: a CSV of the motion, a JSON of its provenance.

`{name}.csv` has the columns time_s and acceleration_m_s2, vertical_m_s2 where the record is used
with its vertical motion, and nothing else, so that any tool reads it; `{name}.json` beside it has
name, dt_s, source, units_read, baseline and details.
"""

import json
import os

import numpy as np
from record_files.columns import read_columns
from record_files.errors import RecordError
from record_files.record import SOURCES, Record
from record_files.text import read_text

from yade_scripts.files import write_atomic, write_json

_KEYS = {"name": str, "dt_s": float, "source": str, "units_read": str, "baseline": str}


def side_path(path):
    """Return the provenance file's path for a record's CSV path."""
    return os.path.splitext(os.fspath(path))[0] + ".json"


def write_csv(record, path):
    """Write a record as `path` (CSV) and its provenance beside it (JSON)."""
    columns = {"time_s": record.time_s, "acceleration_m_s2": record.acceleration_m_s2}
    if record.vertical_m_s2 is not None:
        columns["vertical_m_s2"] = record.vertical_m_s2
    rows = zip(*(values.tolist() for values in columns.values()), strict=True)
    body = "".join(",".join(f"{value:.9g}" for value in row) + "\n" for row in rows)
    provenance = {key: getattr(record, key) for key in _KEYS} | {"details": record.details}
    # Provenance first: a CSV that exists always has its side file.
    write_json(side_path(path), provenance, sort_keys=True)
    write_atomic(path, ",".join(columns) + "\n" + body)


def read_csv(path):
    """Read a record written by `write_csv`.

    A RecordError where either file is missing or damaged, or the two do not belong together.
    """
    channel, *other = read_columns(read_text(path))
    side = side_path(path)
    text = read_text(side)
    try:
        data = json.loads("\n".join(text.lines))
        values = {key: kind(data[key]) for key, kind in _KEYS.items()}
        details = dict(data["details"])
    except (ValueError, KeyError, TypeError, RecursionError) as problem:
        raise RecordError(f"{side}: not a record's provenance ({str(problem)[:80]})") from None
    if channel.units != "m/s2" or abs(channel.dt_s - values["dt_s"]) > 1e-6 * channel.dt_s:
        raise RecordError(f"{side}: does not belong to {path} (units or time step differ)")
    if values["source"] not in SOURCES:
        raise RecordError(f"{side}: source {values['source']!r}; expected {' or '.join(SOURCES)}")
    vertical = np.array(other[0].values) if other else None
    return Record(
        acceleration_m_s2=np.array(channel.values),
        details=details,
        vertical_m_s2=vertical,
        **values,
    )
