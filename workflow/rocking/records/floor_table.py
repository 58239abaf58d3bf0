"""Floor motions of another program at several intensities: a table of files, one an intensity."""

import csv
from pathlib import Path

import numpy as np

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.yielding import TabulatedFloors

from .errors import RecordError
from .floor_file import GROUND, read_floor_file

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
    folder = Path(path).parent
    try:
        with open(path, newline="", encoding="utf-8") as handle:
            lines = (line for line in handle if not line.startswith("#"))
            rows = list(csv.DictReader(lines))
    except (OSError, UnicodeDecodeError) as error:
        raise RecordError(f"{path}: expected a table of floor motions by PGA: {error}") from None
    if not rows or any(rows[0].get(name) is None for name in WANTED):
        raise RecordError(f"{path}: expected columns {', '.join(WANTED)} and a row an intensity")
    levels, first = [], None
    for number, row in enumerate(rows, 1):
        try:
            pga_g = float(row["pga_g"])
        except (TypeError, ValueError):
            raise RecordError(
                f"{path}, row {number}: pga_g = {row['pga_g']!r}: expected a number (g)"
            ) from None
        file = folder / str(row["file"])
        time_s, found = read_floor_file(str(file), units, columns, record)
        peak_g = float(np.abs(found[GROUND]).max()) / STANDARD_GRAVITY_M_S2
        if not abs(peak_g / pga_g - 1.0) <= OFF:
            raise RecordError(
                f"{path}, row {number}: pga_g = {pga_g:g}, but the ground of {row['file']} has a "
                f"peak of {peak_g:.4g} g; expected the same"
            )
        first = time_s if first is None else first
        if len(time_s) != len(first) or np.abs(time_s - first).max() > 1e-6 * first[-1]:
            raise RecordError(f"{file}: expected the times of {rows[0]['file']}")
        levels.append(found)
    try:
        return first, TabulatedFloors(levels)
    except ValueError as error:
        raise RecordError(f"{path}: {error}") from None
