"""Floor motions of another program at several intensities: a table of files, one an intensity.

A table (CSV) has pga_g, ascending by at most a quarter, and file, from the table's folder. Files
without units or captions have them in units, and in columns as "ground floor1 floor2".
"""

import csv
import math
from pathlib import Path

import numpy as np

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.yielding import TabulatedFloors

from .errors import RecordError
from .floor_file import GROUND, named, read_floor_file
from .table import ELASTIC

WANTED = ("pga_g", "file")
OFF = 0.02  # of the stated PGA, by which that of a file's ground may differ


def read_floor_table(path, units=None, columns=None, record=None):
    """Read floor motions by PGA, one file an intensity.

    Parameters
    ----------
    path : path
        A table (CSV) with pga_g, ascending, and file, named from the table's folder.
    units, columns, record
        Of every file, see `floor_file.read_floor_file`.

    Returns
    -------
    time_s : ndarray, shape (nt,)
    floors : yade_scripts.model.yielding.TabulatedFloors

    Raises
    ------
    RecordError
        In one line that names the table or the file.
    """
    levels, first = [], None
    for number, (pga_g, file, row) in enumerate(intensities(path), 1):
        names = (row.get("columns") or "").split() or columns
        time_s, found = read_floor_file(str(file), row.get("units") or units, names, record)
        peak_g = float(np.abs(found[GROUND]).max()) / STANDARD_GRAVITY_M_S2
        if not abs(peak_g / pga_g - 1.0) <= OFF:
            raise RecordError(
                f"{path}, row {number}: pga_g = {pga_g:g}, but the ground of {row['file']} has a "
                f"peak of {peak_g:.4g} g; expected the same"
            )
        first = time_s if first is None else first
        if len(time_s) != len(first) or np.abs(time_s - first).max() > 1e-6 * first[-1]:
            raise RecordError(f"{file}: expected the times of the table's first file")
        levels.append(found)
    try:
        return first, TabulatedFloors(levels)
    except ValueError as error:
        raise RecordError(f"{path}: {error}") from None


def intensities(path):
    """PGA [g], file and cells of every row of a table; RecordError of one line."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as handle:
            rows = list(csv.DictReader(line for line in handle if not line.startswith("#")))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise RecordError(f"{path}: expected a table of floor motions by PGA: {error}") from None
    if not rows or any(rows[0].get(name) is None for name in WANTED):
        raise RecordError(f"{path}: expected columns {', '.join(WANTED)} and a row an intensity")
    found = []
    for number, row in enumerate(rows, 1):
        try:
            pga_g = float(row["pga_g"])
        except (TypeError, ValueError):
            pga_g = math.nan
        if not 0.0 < pga_g < math.inf:
            raise RecordError(
                f"{path}, row {number}: pga_g = {row['pga_g']!r}: expected a number above 0 (g)"
            )
        found.append((pga_g, Path(path).parent / str(row["file"]), row))
    return found


def is_table(path):
    """Whether a file begins as a table of floor motions by PGA does, not as floor motions do."""
    try:
        with open(path, encoding="utf-8-sig") as handle:
            head = next((line for line in handle if not line.startswith("#")), "")
    except (OSError, UnicodeDecodeError):
        return False
    return "pga_g" in [cell.strip() for cell in head.split(",")]


def floors_named(path):
    """Number of floors of a file, or of the first one of a table; 0 without captions."""
    file, names = path, ""
    if is_table(path):
        _, file, row = intensities(path)[0]
        names = row.get("columns") or ""
    return sum(name.startswith("floor") for name in names.split() or named(file))


def files_of(row):
    """Files of the floor motions of a row of the records table, the table by PGA first."""
    if row.floors_path is None:
        return []
    if not is_table(row.floors_path):
        return [row.floors_path]
    return [row.floors_path, *(str(file) for _, file, _ in intensities(row.floors_path))]


def floors_of(row, record):
    """Times and columns of the floor motions of a row of the records table.

    Parameters
    ----------
    row : table.Row
        With floors.
    record : Record
        The row's own motion, which the building was given.

    Returns
    -------
    time_s : ndarray, shape (nt,)
    columns : dict of str to ndarray, or TabulatedFloors

    Raises
    ------
    RecordError
        In one line; also for floors of one intensity of a building that is not said to be elastic.
    """
    path = row.floors_path
    if is_table(path):
        return read_floor_table(path, record=record)
    if row.floors_building != ELASTIC:
        raise RecordError(
            f"{path}: floors of one intensity hold at that alone, but for an elastic building: "
            f"state floors_building = {ELASTIC} in the records table, or a table of {WANTED[0]} "
            f"and {WANTED[1]}, one file an intensity"
        )
    return read_floor_file(path, record=record)
