"""Plain columns: two-column text, CSV and a single column.

Lines before the first number may be headings or comments. A heading that splits
into as many cells as there are columns names them; a unit in it ("Acceleration
(g's)", "acceleration_m_s2") is read as stated by the file. Without one the units
must be stated in the records table. The first of two or more columns is time in
seconds, uniform within the rounding of its printed digits.
"""

import re

import numpy as np

from ..record import unit_name
from ..text import MAX_SAMPLES, check_last, parse_number
from .channel import Channel

DESCRIPTION = "columns of numbers"
MAX_COLUMNS = 64
_START = re.compile(r"\s*[-+.]?\d")
_BRACKETED = re.compile(r"[(\[]([^()\[\]]+)[)\]]")


def _cells(line, separator):
    return [cell.strip() for cell in (line.split(separator) if separator else line.split())]


def _layout(text):
    """Return (first data line, separator or None for blanks, number of columns)."""
    for number, line in enumerate(text.lines, 1):
        if _START.match(line):
            separator = next((mark for mark in ",;" if mark in line), None)
            return number, separator, len(_cells(line, separator))
        if number == 100:
            break
    return 0, None, 0


def sniff_csv(text):
    """Tell whether the first data line has commas or semicolons."""
    _, separator, columns = _layout(text)
    return separator is not None and columns >= 2


def sniff_two_column(text):
    """Tell whether the first data line is two numbers apart by blanks."""
    _, separator, columns = _layout(text)
    return separator is None and columns == 2


def sniff_single_column(text):
    """Tell whether the first data line is one number."""
    _, separator, columns = _layout(text)
    return separator is None and columns == 1


def read_csv(text):
    """Read a comma- or semicolon-separated file: time, then one or more channels."""
    first, separator, columns = _layout(text)
    if not first or separator is None or columns < 2:
        raise text.error(first or 1, "expected time and acceleration separated by commas")
    return _with_time(text, first, separator, columns)


def read_two_column(text):
    """Read two columns apart by blanks: time, acceleration."""
    first, separator, columns = _layout(text)
    if not first or separator is not None or columns != 2:
        raise text.error(first or 1, "expected two numbers a line, time and acceleration")
    return _with_time(text, first, separator, columns)


def read_single_column(text):
    """Read one acceleration a line; the step must be stated in the table."""
    first, separator, columns = _layout(text)
    if not first or separator is not None or columns != 1:
        raise text.error(first or 1, "expected one number a line, the acceleration")
    values = _table(text, first, None, 1)[:, 0]
    heading = _heading(text, first, None, 1)
    return [Channel(heading[0] or "1", values, first, units=_unit(heading[0]))]


def _table(text, first, separator, columns):
    """Read all data lines, shape (n, columns)."""
    if columns > MAX_COLUMNS:
        raise text.error(first, f"{columns} columns; expected at most {MAX_COLUMNS}")
    rows = len(text.lines) - first + 1
    if rows * columns > 4 * MAX_SAMPLES:
        raise text.error(first, f"more than {4 * MAX_SAMPLES} numbers")
    table = np.empty((rows, columns))
    used, last = 0, first
    for number in range(first, len(text.lines) + 1):
        line = text.lines[number - 1]
        if not line.strip():
            if any(rest.strip() for rest in text.lines[number:]):
                raise text.error(number, "blank line between the samples")
            break
        cells = _cells(line, separator)
        if len(cells) != columns:
            hint = "" if separator else " (decimal commas are not read)" if "," in line else ""
            raise text.error(
                number, f"{len(cells)} values, but {columns} in the lines before{hint}"
            )
        for column, cell in enumerate(cells):
            table[used, column] = parse_number(text, number, cell, "a number")
        last = number
        used += 1
    lines = text.lines[first - 1 : min(last - 1, first + 999)]
    earlier = [_cells(line, separator)[-1] for line in lines]
    check_last(text, last, _cells(text.lines[last - 1], separator)[-1], earlier)
    if used < 2:
        raise text.error(first, "expected at least 2 samples")
    return table[:used]


def _heading(text, first, separator, columns):
    """Return the column headings, empty strings when the file has none."""
    for line in reversed(text.lines[: first - 1]):
        words = line.lstrip("#%! \t")
        if words.strip():
            cells = _cells(words, separator or "\t")
            if len(cells) != columns:
                cells = _cells(words, None)
            if len(cells) == columns:
                return [cell.strip("\"' ") for cell in cells]
            break
    return [""] * columns


def _unit(heading):
    """Return the canonical unit named in a heading, or None."""
    bracketed = _BRACKETED.search(heading)
    if bracketed:
        return unit_name(bracketed[1])
    suffix = re.search(r"_(g|(?:m|cm|mm)_s2)$", heading)
    return unit_name(suffix[1]) if suffix else None


def _with_time(text, first, separator, columns):
    table = _table(text, first, separator, columns)
    heading = _heading(text, first, separator, columns)
    stated = _BRACKETED.search(heading[0])
    if stated and stated[1].strip().lower() not in {"s", "sec", "secs", "second", "seconds"}:
        raise text.error(first, f"time is in {stated[1][:20]!r}; expected seconds")
    dt_s = uniform_step(text, first, table[:, 0], separator)
    return [
        Channel(heading[c] or f"column {c + 1}", table[:, c], first, None, _unit(heading[c]), dt_s)
        for c in range(1, columns)
    ]


def uniform_step(text, first, time_s, separator=None):
    """Step of a printed time column [s].

    Steps and times must agree with a uniform grid from the first to the last time
    within the rounding of the printed digits, at most two fifths of a step.
    """
    steps = np.diff(time_s)
    down = np.flatnonzero(steps <= 0)
    if down.size:
        raise text.error(
            first + int(down[0]) + 1,
            f"time goes from {time_s[down[0]]:g} to {time_s[down[0] + 1]:g} s; "
            "expected it to increase (is the first column time?)",
        )
    dt_s = float(time_s[-1] - time_s[0]) / (len(time_s) - 1)
    # Half a unit of the last digit at either end, but never so much that a sample could
    # be missing; plus the rounding of double precision itself.
    tolerance = min(0.5001 * _resolution(text, first, len(time_s), separator), 0.2 * dt_s)
    tolerance += 1e-3 * dt_s + 4e-16 * float(np.max(np.abs(time_s)))
    off = np.abs(time_s - (time_s[0] + dt_s * np.arange(len(time_s)))) > 2 * tolerance
    if off.any() or np.any(np.abs(steps - dt_s) > 2 * tolerance):
        usual = float(np.median(steps))
        place = int(np.argmax(np.abs(steps - usual)))
        raise text.error(
            first + place + 1,
            f"time step {steps[place]:g} s, but {usual:g} s elsewhere: the step must be uniform",
        )
    return float(f"{dt_s:.9g}")


def _resolution(text, first, rows, separator):
    """Unit of the last printed digit of the time column (finest over the first samples)."""
    finest = 1.0
    for line in text.lines[first - 1 : first - 1 + min(rows, 1000)]:
        mantissa, _, exponent = _cells(line, separator)[0].lower().partition("e")
        decimals = len(mantissa.partition(".")[2]) - int(exponent or 0)
        finest = min(finest, 10.0**-decimals)
    return finest
