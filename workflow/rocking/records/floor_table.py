"""Floor motions of another program at several intensities: a table of files, one an intensity.

A table (CSV) has pga_g, ascending by at most a quarter, and file, from the table's folder. Files
without units or captions have them in units, and in columns as "ground floor1 floor2".
"""

import math
import re
from pathlib import Path

import numpy as np
from record_files.errors import RecordError
from record_files.text import read_text

from yade_scripts.lists import listed
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.yielding import TabulatedFloors

from .floor_file import GROUND, named, read_floor_file
from .table import ELASTIC, SEPARATED, split_line

WANTED = ("pga_g", "file")
MOST = 1000  # intensities
HEAD = 10_000  # characters in which a table says its columns
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
        time_s, floors = read_floor_file(str(file), row.get("units") or units, names, record)
        peak_g = float(np.abs(floors[GROUND]).max()) / STANDARD_GRAVITY_M_S2
        if not abs(peak_g / pga_g - 1.0) <= OFF:
            raise RecordError(
                f"{path}, row {number}: pga_g = {pga_g:g}, but the ground of {row['file']} has a "
                f"peak of {peak_g:.4g} g; expected the same"
            )
        first = time_s if first is None else first
        if len(time_s) != len(first) or np.abs(time_s - first).max() > 1e-6 * first[-1]:
            raise RecordError(f"{file}: expected the times of the table's first file")
        levels.append(floors)
    try:
        return first, TabulatedFloors(levels)
    except ValueError as error:
        raise RecordError(f"{path}: {error}") from None


def intensities(path):
    """PGA [g], file and cells of every row of a table; RecordError of one line."""
    levels, before_g = [], 0.0
    for number, row in enumerate(_rows(path), 1):
        try:
            pga_g = float(row["pga_g"])
        except ValueError:
            pga_g = math.nan
        if not before_g < pga_g < math.inf:
            expected = f"more than {before_g:g}, the row before" if before_g else "a number > 0 (g)"
            raise RecordError(
                f"{path}, row {number}: pga_g = {row['pga_g'][:40]!r}: expected {expected}"
            )
        before_g = pga_g
        levels.append((pga_g, Path(path).parent / row["file"], row))
    return levels


def is_table(path):
    """Whether a file begins as a table of floor motions by PGA does, not as floor motions do."""
    try:
        with open(path, encoding="utf-8-sig") as handle:
            lines = handle.read(HEAD).splitlines()
    except (OSError, UnicodeDecodeError):
        return False
    head = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    return "pga_g" in [cell.strip() for cell in re.split(r"[,;\t]", head)]


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


def _rows(path):
    """Rows of the table as dictionaries of text; cells apart as in a records table."""
    text = read_text(path)
    lines = text.said()
    header = lines[0][1] if lines else ""
    separator = next((mark for mark in SEPARATED if mark in header), ",")
    columns = split_line(text, 1, header, separator)
    if len(lines) < 2 or not set(WANTED) <= {*columns}:
        raise RecordError(f"{path}: expected columns {', '.join(WANTED)} and a row an intensity")
    if len(lines) > MOST:
        raise RecordError(f"{path}: {len(lines) - 1} rows; expected at most {MOST - 1}")
    rows = []
    for number, line in lines[1:]:
        cells = split_line(text, number, line, separator, len(columns))
        row = dict(zip(columns, cells, strict=False))
        if len(cells) > len(columns) or not all(row.get(name) for name in WANTED):
            raise text.error(number, f"{len(cells)} cells; expected {listed(columns)}")
        if separator == ";":  # where commas are for decimals
            row["pga_g"] = row["pga_g"].replace(",", ".")
        rows.append(row)
    return rows
