"""Ground motions: the records table, file readers, baseline treatment and surrogates.

row  = read_table("config/records.tsv")["RRS228"]
rec  = load("RRS228", "config/records.tsv")      # m/s², from its file or a surrogate
peak = measures(rec)                             # pga_g, pgv_cm_s, pgd_cm, duration_s
"""

import os
from dataclasses import replace

import numpy as np
from record_files import FORMATS
from record_files.errors import RecordError
from record_files.reader import detect, nearest, read_record
from record_files.record import G_M_S2, Record, integrate, measures

from rocking.shipped import shipped

from .baseline import treat
from .store import read_csv, write_csv
from .surrogate import DEFAULT_SEED, generate
from .surrogate_data import read_specs
from .table import Row, read_table

__all__ = [
    "DEFAULT_SEED",
    "FORMATS",
    "G_M_S2",
    "Record",
    "RecordError",
    "Row",
    "detect",
    "generate",
    "integrate",
    "load",
    "load_as",
    "measures",
    "read_csv",
    "read_record",
    "read_specs",
    "read_table",
    "records_row",
    "surrogates_for",
    "treat",
    "write_csv",
]

TREATMENT = ("baseline", "seed", "vertical_motion")  # what is done to a row of the records table
RECORDS_COLUMNS = ("record", "source", "dt_s", "duration_s", "pga_g", "pgv_cm_s", "pgd_cm")
EXPECTED_VERTICAL = "expected it in the column vertical or vertical_file"


def surrogates_for(table_path):
    """Return the surrogate parameters a table uses: `surrogates.yaml` beside it or the project's.

    The project's too, so that a record keeps its motion in a user's table elsewhere. None
    where there is neither.
    """
    beside = os.path.join(os.path.dirname(os.fspath(table_path)), "surrogates.yaml")
    ours = str(shipped("config/surrogates.yaml"))
    return next((p for p in (beside, ours) if os.path.isfile(p)), None)


def load(
    name,
    table_path,
    *,
    baseline="none",
    seed=DEFAULT_SEED,
    surrogates_path=None,
    vertical=False,
    vertical_motion="off",
):
    """Load the motion of one table row, from its file or as a surrogate.

    Parameters
    ----------
    name : str
        Record in the table.
    table_path : str
        The records table.
    baseline : str or mapping
        Treatment of a file's record: a method of `baseline.treat`, or a mapping of its keywords
        (the configuration's section `baseline`). Surrogates rest at both ends and need none.
    seed : int
        Of the surrogates' noise.
    surrogates_path : str or None
        Surrogate parameters; None: those of `surrogates_for`. A record without an entry gets
        parameters derived from its peaks.
    vertical : bool
        The row's vertical motion (columns vertical, vertical_file), upward positive as the file
        gives it, instead of the horizontal one.
    vertical_motion : str
        "on" adds the vertical motion to the horizontal one. Both begin at the same instant; where
        the vertical one ends earlier the ground rests, later it is cut.

    Returns
    -------
    Record

    Raises
    ------
    RecordError
        Naming the table, file, row or line.
    """
    if vertical_motion == "on":
        options = {"baseline": baseline, "seed": seed}
        up = load(name, table_path, vertical=True, **options)
        return _beside(load(name, table_path, **options), up, table_path)
    table = read_table(table_path)
    if name not in table:
        raise RecordError(f"{table_path}: no record {name!r}{nearest(str(name), table)}")
    row = table[name]
    if vertical and row.vertical_path is None:
        place = f"{table_path}, line {row.line}: record {name}"
        raise RecordError(f"{place} has no vertical motion; {EXPECTED_VERTICAL}")
    if vertical or row.path is not None:
        record = _of_file(row, vertical, baseline)
    else:
        surrogates_path = surrogates_path or surrogates_for(table_path)
        spec = read_specs(surrogates_path).get(name) if surrogates_path else None
        record = generate(name, **row.targets, spec=spec, seed=seed)
    return replace(record, details=record.details | {"about": row.about}) if row.about else record


def _of_file(row, vertical, baseline):
    """Motion of a table row's file, its baseline treated."""
    path = row.vertical_path if vertical else row.path
    record = read_record(path, format=row.format, **row.stated(vertical))
    options = {"method": baseline} if isinstance(baseline, str) else dict(baseline)
    return treat(record, **options)


def load_as(settings, name, table_path):
    """Load a motion as a run treats it, by the keys of `TREATMENT` that its settings have."""
    return load(name, table_path, **{k: settings[k] for k in TREATMENT if k in settings})


def _beside(record, up, table_path):
    """A record with its vertical motion beside it."""
    if abs(up.dt_s - record.dt_s) > 1e-3 * record.dt_s:
        raise RecordError(
            f"{table_path}: record {record.name}: vertical motion at steps of {up.dt_s:g} s, "
            f"expected {record.dt_s:g} s as the horizontal one"
        )
    both, count = np.zeros(len(record)), min(len(record), len(up))
    both[:count] = up.acceleration_m_s2[:count]
    details = {**record.details, "vertical": up.details}
    return replace(record, vertical_m_s2=both, details=details)


def records_row(record):
    """Return the record's row of tables/records.csv, keys RECORDS_COLUMNS."""
    peaks = measures(record)
    values = {"record": record.name, "source": record.source, "dt_s": record.dt_s} | peaks
    return {column: values[column] for column in RECORDS_COLUMNS}
