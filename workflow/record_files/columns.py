"""Plain numbers: one column, time and accelerations, or several a line without a time.

Lines before the first one of numbers alone are headings, and so is a first line "64 0.02"
of the number of samples and the step. What the block of numbers is, `layout` decides. The nearest
heading that splits into as many cells as there are columns names them; a unit in it ("Acceleration
(g's)", "acceleration_m_s2"), alone in a row below the names, or in another heading is read as
stated by the file, a time step likewise.
"""

import re

import numpy as np

from .block import once
from .captions import TIME_UNITS
from .channel import Channel
from .header import Said, heading_component, heading_unit, stated_steps, stated_unit
from .layout import kind_of, layout
from .units import unit_name

__all__ = ["kind_of", "read_columns", "read_single", "read_wrapped", "uniform_step"]

SIDE_BY_SIDE = ("csv", "two-column", "columns")


def read_columns(text):
    """Read time, then one or more channels; or channels without a time."""
    file_layout = _found(text, SIDE_BY_SIDE, as_columns=True)
    if file_layout is None or file_layout.kind not in SIDE_BY_SIDE:
        line = file_layout.block.first if file_layout else 1
        raise text.error(line, "expected time and acceleration, two numbers a line")
    return _channels(text, file_layout)


def read_single(text):
    """Read one acceleration a line."""
    file_layout = _found(text, ("single-column",), as_columns=None)
    if file_layout is None or file_layout.kind != "single-column":
        line = file_layout.block.first if file_layout else 1
        raise text.error(line, "expected one number a line, the acceleration")
    return _channels(text, file_layout)


def read_wrapped(text):
    """Read accelerations several to a line, in the order of reading."""
    file_layout = _found(text, ("wrapped", "single-column"), as_columns=False)
    if file_layout is None or file_layout.kind not in ("wrapped", "single-column"):
        line = file_layout.block.first if file_layout else 1
        raise text.error(line, "expected accelerations in a row, without a time")
    return _channels(text, file_layout)


def _found(text, kinds, as_columns):
    """`Layout` of a file as it looks; where that is another kind or open, as it is stated."""
    try:
        file_layout = once(text, layout)
    except ValueError:
        return layout(text, as_columns)
    return file_layout if file_layout and file_layout.kind in kinds else layout(text, as_columns)


def _channels(text, file_layout):
    heading = file_layout.block.heading
    captions = [label for label, _, _ in file_layout.channels]
    named = any(captions)
    said = stated_unit(heading[:-1] if named and len(captions) > 1 else heading)
    if not (said.unit or said.against):
        said = Said(stated_unit(heading).unit)
    dt_s, rounding, choices = _step(text, file_layout, heading)
    single = len(file_layout.channels) == 1
    return [
        Channel(
            label or ("1" if single else ""),
            np.ascontiguousarray(values),
            line,
            None,
            stated.unit,
            dt_s,
            rounding,
            component=heading_component(label) if label else None,
            against=stated.against,
            steps=choices,
        )
        for label, values, line in file_layout.channels
        for stated in [_unit_of(label, said)]
    ]


def _unit_of(label, said):
    of_label = heading_unit(label) if label else Said()
    return of_label if of_label.unit or of_label.against else said


def _step(text, file_layout, heading):
    """Step [s], half a unit of its last digit, and steps that the heading states and differ."""
    block, (_, declared) = file_layout.block, file_layout.declared
    if file_layout.time_s is None:
        steps = [(declared, 0.0)] if declared else stated_steps(heading)
        if declared:
            _agree(text, block, declared, stated_steps(heading, sure=True))
        return (*steps[0], ()) if len(steps) == 1 else (None, 0.0, tuple(v for v, _ in steps))
    label, cells = file_layout.time
    first = block.lines.index(file_layout.channels[0][2])
    per_line = max(round(len(file_layout.time_s) / (len(block.lines) - first)), 1)

    def line_of(place):
        return block.lines[min(first + place // per_line, len(block.lines) - 1)]

    unit = re.search(r"[(\[]([^()\[\]]+)[)\]]", label)
    factor = TIME_UNITS.get(unit[1].strip().lower()) if unit else 1.0
    if factor is None and unit and unit_name(unit[1]) is None:
        raise text.error(block.first, f"time is in {unit[1][:20]!r}; expected seconds")
    dt_s = uniform_step(text, file_layout.time_s, cells, line_of) * (factor or 1.0)
    known = stated_steps(heading, sure=True) + ([(declared, 0.0)] if declared else [])
    _agree(text, block, dt_s, known)
    return float(f"{dt_s:.9g}"), 0.0, ()


def _agree(text, block, dt_s, steps):
    """Refuse a step that no statement of the heading agrees with."""
    if steps and all(abs(v - dt_s) > max(0.01 * dt_s, r) for v, r in steps):
        raise text.error(
            block.first,
            f"the time step is {dt_s:g} s, but the heading states {steps[0][0]:g} s",
        )


def uniform_step(text, time_s, cells, line_of):
    """Step of printed times [s].

    Steps and times must agree with a uniform grid from the first to the last time
    within the rounding of the printed digits, at most two fifths of a step. `line_of` is the line
    of a time by its place.
    """
    steps = np.diff(time_s)
    down = np.flatnonzero(steps <= 0)
    if down.size:
        raise text.error(
            line_of(int(down[0]) + 1),
            f"time goes from {time_s[down[0]]:g} to {time_s[down[0] + 1]:g} s; "
            "expected it to increase (is the first column time?)",
        )
    dt_s = float(time_s[-1] - time_s[0]) / (len(time_s) - 1)
    # Half a unit of the last digit at either end, but never so much that a sample could
    # be missing; plus the rounding of double precision itself.
    tolerance = min(0.5001 * _resolution(cells), 0.2 * dt_s)
    tolerance += 1e-3 * dt_s + 4e-16 * float(np.max(np.abs(time_s)))
    off = np.abs(time_s - (time_s[0] + dt_s * np.arange(len(time_s)))) > 2 * tolerance
    if off.any() or np.any(np.abs(steps - dt_s) > 2 * tolerance):
        usual = float(np.median(steps))
        place = int(np.argmax(np.abs(steps - usual)))
        raise text.error(
            line_of(place + 1),
            f"time step {steps[place]:g} s, but {usual:g} s elsewhere: the step must be uniform",
        )
    return float(f"{dt_s:.9g}")


def _resolution(cells):
    """Unit of the last printed digit of times (finest over the first samples)."""
    finest = 1.0
    for cell in cells[:1000]:
        mantissa, _, exponent = cell.lower().partition("e")
        decimals = len(mantissa.partition(".")[2]) - int(exponent or 0)
        finest = min(finest, 10.0**-decimals)
    return finest
