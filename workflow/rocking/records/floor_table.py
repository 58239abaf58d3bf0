"""Floor motions of another program at several intensities: a table of files, one an intensity."""

from pathlib import Path

import numpy as np

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.yielding import TabulatedFloors

from .errors import RecordError
from .floor_file import GROUND, read_floor_file
from .table import SEPARATED, split_line
from .text import read_text

WANTED = ("pga_g", "file")
MOST = 1000  # intensities
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
    levels, first, before_g = [], None, 0.0
    rows = _rows(path)
    for number, row in enumerate(rows, 1):
        try:
            pga_g = float(row["pga_g"])
        except ValueError:
            pga_g = float("nan")
        if not before_g < pga_g < float("inf"):
            expected = f"more than {before_g:g}, the row before" if before_g else "a number > 0 (g)"
            raise RecordError(
                f"{path}, row {number}: pga_g = {row['pga_g'][:40]!r}: expected {expected}"
            )
        before_g = pga_g
        file = folder / row["file"]
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


def _rows(path):
    """Rows of the table as dictionaries of text; cells apart as in a records table."""
    text = read_text(path)
    lines = [
        (number, line)
        for number, line in enumerate(text.lines, 1)
        if line.strip() and not line.startswith("#")
    ]
    header = lines[0][1] if lines else ""
    separator = next((mark for mark in SEPARATED if mark in header), ",")
    columns = split_line(text, 1, header, separator)
    if len(lines) < 2 or not set(WANTED) <= {*columns}:
        raise RecordError(f"{path}: expected columns {', '.join(WANTED)} and a row an intensity")
    if len(lines) > MOST:
        raise RecordError(f"{path}: {len(lines) - 1} rows; expected at most {MOST - 1}")
    found = []
    for number, line in lines[1:]:
        cells = split_line(text, number, line, separator, len(columns))
        row = dict(zip(columns, cells, strict=False))
        if len(cells) > len(columns) or not all(row.get(name) for name in WANTED):
            raise text.error(number, f"{len(cells)} cells; expected {', '.join(columns)}")
        if separator == ";":  # where commas are for decimals
            row["pga_g"] = row["pga_g"].replace(",", ".")
        found.append(row)
    return found
