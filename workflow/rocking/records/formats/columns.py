"""Plain numbers: one column, time and accelerations, or several a line without a time.

Lines before the first one of numbers alone are headings, and so is a first line "64 0.02"
of the number of samples and the step. The nearest heading that splits into as many cells as
there are columns names them; a unit in it ("Acceleration (g's)", "acceleration_m_s2"), alone in
a row below the names, or in another heading is read as stated by the file, a time step
likewise. Cells are apart by blanks, tabs, commas or semicolons; numbers may have decimal commas
where those are not separators too.
"""

import re
from dataclasses import dataclass, field, replace

import numpy as np

from ..text import MAX_SAMPLES, check_last, free_block, parse_number
from .channel import Channel
from .header import (
    NUMBER,
    heading_component,
    heading_unit,
    is_numbers,
    stated_count,
    stated_step,
    stated_unit,
)

MAX_COLUMNS = 64
MAX_HEADING = 200
LOOK = 200  # lines that decide on separators and on what the first column is
_COMMA = re.compile(r"[-+]?(?:\d*,)?\d+(?:[eE][-+]?\d+)?")
_START = re.compile(r"\s*[-+]?\.?\d")
_TIME = re.compile(r"\W*(t|time|zeit|temps|tempo|s|sec)\b", re.I)
_COMPONENT = re.compile(
    r"(?i)(n-?s|e-?w|u-?d|w-?e|[nsewuzxyltv]|up|vert\w*|long\w*|trans\w*|h[12nle]\w*|ch(an)?\w*"
    r"|[ns]\d+[ew]|acc\w*|a[xyz_]\w*)\W*(?:[ (\[_,].*)?"
)


@dataclass(frozen=True)
class _Layout:
    first: int  # line of the first numbers, 0 for none
    separator: str | None = None  # None: blanks
    decimal_comma: bool = False
    columns: int = 0
    kind: str = ""
    labels: list = field(default_factory=list)  # with an empty one first: no time column

    def cells(self, line):
        cells = line.split(self.separator)
        if self.separator:
            cells = [cell.strip() for cell in cells]
            while len(cells) > 1 and not cells[-1]:  # a separator at the end of the line
                cells.pop()
        return [cell.replace(",", ".") for cell in cells] if self.decimal_comma else cells


def _worded(text):
    """Return the file with "NPTS= 64, DT= 0.02" for a first line "64 0.02" before one a line."""
    rows = [row for row in text.lines[: LOOK + 1] if row.strip()]
    words = text.lines[0].split()
    if len(words) != 2 or len(rows) < 3 or not is_numbers(text.lines[0]):
        return text
    alone = all(len(row.split()) == 1 and is_numbers(row) for row in rows[1:])
    if not (alone and words[0].isdigit() and "." in words[1]):
        return text
    return replace(text, lines=[f"NPTS= {words[0]}, DT= {words[1]}", *text.lines[1:]])


def _layout(text):
    """Look at the start of the file; `kind` is the name of a format."""
    text = _worded(text)
    head = enumerate(text.lines[:MAX_HEADING], 1)
    first, line = next(((n, row) for n, row in head if is_numbers(row)), (0, ""))
    if not first:
        return _Layout(0)
    rows = [row for row in text.lines[first - 1 : first - 1 + LOOK] if row.strip()]
    words = [word for row in rows for word in row.replace(";", " ").split()]
    comma = any("," in word for word in words) and all(map(_COMMA.fullmatch, words))
    separator = ";" if ";" in line else "," if "," in line and not comma else None
    layout = _Layout(first, separator, comma)
    columns = len(layout.cells(line))
    before = next((row for row in reversed(text.lines[: first - 1]) if row.strip()), "")
    if _START.match(before) and len(layout.cells(before)) == columns:
        raise text.error(first - 1, f"expected numbers as in the next line, found {before[:40]!r}")
    labels = _labels(before, layout, columns)
    kind = "single-column"
    if columns > 1:
        timed = _is_time(text, layout) or bool(_TIME.match(labels[0]))
        named = all(map(_COMPONENT.fullmatch, labels))
        kind = "csv" if separator else "columns" if columns > 2 or not timed else "two-column"
        if not timed and not separator and not named:
            kind = "wrapped"
        if not timed and named:
            labels = ["", *labels]
    return replace(layout, columns=columns, kind=kind, labels=labels)


def _is_time(text, layout):
    """Tell whether the first column rises or falls through the file, as no acceleration does.

    Spread over the whole file; nine of ten steps, so that a damaged time is refused by
    its line instead of taken for an acceleration. Also when there are too few to tell.
    """
    rows = text.lines[layout.first - 1 :]
    values = []
    for row in rows[:: max(1, len(rows) // LOOK)]:
        cells = layout.cells(row)
        if cells and re.fullmatch(NUMBER, cells[0]):
            values.append(float(cells[0]))
    steps = np.diff(values)
    return len(steps) < 5 or max(np.mean(steps > 0), np.mean(steps < 0)) >= 0.9


def _labels(line, layout, columns):
    """Return the column headings, empty strings when the line names none."""
    words = line.lstrip("#%! \t")
    split = [layout.cells(words), *(words.split(mark) for mark in (layout.separator, "\t", None))]
    for cells in split if words.strip() else ():
        if len(cells) == columns:
            return [cell.strip("\"' ")[:80] for cell in cells]
    return [""] * columns


def kind_of(text):
    """Name of the format here that a file looks like; empty where it has no line of numbers."""
    return _layout(text).kind


def read_columns(text):
    """Read time, then one or more channels; or named channels without a time."""
    layout = _layout(text)
    if layout.columns < 2 or layout.kind == "single-column":
        raise text.error(layout.first or 1, "expected time and acceleration, two numbers a line")
    table = _table(text, layout)
    heading = text.lines[: layout.first - 1]
    dt_s, rounding = stated_step(heading)
    labels, at = layout.labels, 1
    if len(labels) > layout.columns:  # no time column
        labels, at = labels[1:], 0
    else:
        unit = re.search(r"[(\[]([^()\[\]]+)[)\]]", labels[0])
        if unit and unit[1].strip().lower() not in {"s", "sec", "secs", "second", "seconds"}:
            raise text.error(layout.first, f"time is in {unit[1][:20]!r}; expected seconds")
        _check_commas(text, layout)
        dt_s, rounding = uniform_step(text, layout.first, table[:, 0], layout.cells), 0.0
    unit = stated_unit(heading[:-1] if any(labels) else heading)
    return [
        Channel(
            labels[c] or (f"column {c + 1}" if not any(labels) else ""),
            table[:, c],
            layout.first,
            None,
            heading_unit(labels[c]) or unit,
            dt_s,
            rounding,
            component=heading_component(labels[c]) if labels[c] else None,
        )
        for c in range(at, layout.columns)
    ]


def _numbers_only(text, layout, values):
    text = _worded(text)
    heading = text.lines[: layout.first - 1]
    label = layout.labels[0] if layout.columns == 1 and layout.labels else ""
    unit = heading_unit(label) or stated_unit(heading)
    named = heading_component(label)
    dt_s, rounding = stated_step(heading)
    label = label or "1"
    return [Channel(label, values, layout.first, None, unit, dt_s, rounding, component=named)]


def read_single(text):
    """Read one acceleration a line."""
    layout = _layout(text)
    if layout.columns != 1 and layout.kind != "single-column":
        raise text.error(layout.first or 1, "expected one number a line, the acceleration")
    return _numbers_only(text, layout, _table(text, layout)[:, 0])


def read_wrapped(text):
    """Read accelerations several to a line, in the order of reading."""
    layout = _layout(text)
    if not layout.first or layout.separator:
        raise text.error(layout.first or 1, "expected accelerations apart by blanks")
    heading, rows = text.lines[: layout.first - 1], text.lines[layout.first - 1 :]
    if layout.decimal_comma:
        text = replace(text, lines=heading + [row.replace(",", ".") for row in rows])
    values = free_block(text, layout.first, stated_count(heading))
    return _numbers_only(text, layout, values)


def _table(text, layout):
    """Read all data lines, shape (n, columns)."""
    first, columns = layout.first, max(layout.columns, 1)
    if columns > MAX_COLUMNS:
        raise text.error(first, f"{columns} columns; expected at most {MAX_COLUMNS}")
    rows = len(text.lines) - first + 1
    if rows * columns > 4 * MAX_SAMPLES:
        raise text.error(first, f"more than {4 * MAX_SAMPLES} numbers")
    last = len(text.lines)
    while not text.lines[last - 1].strip():
        last -= 1
    table = np.empty((last - first + 1, columns))
    for number, line in enumerate(text.lines[first - 1 : last], first):
        if not line.strip():
            raise text.error(number, "blank line between the samples")
        cells = layout.cells(line)
        if len(cells) != columns:
            raise text.error(number, f"{len(cells)} values, but {columns} in the lines before")
        table[number - first] = [parse_number(text, number, cell, "a number") for cell in cells]
    lines = text.lines[first - 1 : min(last - 1, first + 999)]
    earlier = [layout.cells(line)[-1] for line in lines]
    check_last(text, last, layout.cells(text.lines[last - 1])[-1], earlier)
    if len(table) < 2:
        raise text.error(first, "expected at least 2 samples")
    count = stated_count(_worded(text).lines[: first - 1])
    if count not in (None, len(table)):
        raise text.error(last, f"{len(table)} samples, but the heading declares {count}")
    return table


def _check_commas(text, layout):
    """Refuse "0,01,0,0012" and "0.01,0,0012", where commas seem to be decimal marks too."""
    if layout.separator != "," or layout.columns < 3:
        return
    for line in text.lines[layout.first - 1 : layout.first - 1 + LOOK]:
        rest = "".join(layout.cells(line)[1:] if layout.columns % 2 else layout.cells(line))
        if "." in rest or "e" in rest.lower():
            return
    raise text.error(
        layout.first,
        "commas seem to separate the columns and to mark decimals as well; separate them by "
        "semicolons or tabs, or write decimal points",
    )


def uniform_step(text, first, time_s, cells=str.split):
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
    tolerance = min(0.5001 * _resolution(text, first, len(time_s), cells), 0.2 * dt_s)
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


def _resolution(text, first, rows, cells):
    """Unit of the last printed digit of the time column (finest over the first samples)."""
    finest = 1.0
    for line in text.lines[first - 1 : first - 1 + min(rows, 1000)]:
        mantissa, _, exponent = cells(line)[0].lower().partition("e")
        decimals = len(mantissa.partition(".")[2]) - int(exponent or 0)
        finest = min(finest, 10.0**-decimals)
    return finest
