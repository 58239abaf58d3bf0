"""From a file to metres per second squared: format, component, units and step.

What the file states and what the table states must agree; what neither states is
asked for.
"""

import difflib
import os
import re
from numbers import Real

import numpy as np

from .errors import RecordError
from .formats import FORMATS, WANTS, format_of
from .header import COARSEST
from .record import MAX_DT_S, MIN_DT_S, UNITS_M_S2, Record, check_plausible, unit_name
from .text import read_text

SHOWN, LONGEST = 8, 50  # components in a message, characters of a label there


def detect(path):
    """Return the name of the format a file looks like.

    Raises RecordError when none fits.
    """
    return _detect(read_text(path))


def _detect(text):
    form = format_of(text)
    if not form:
        raise text.error(
            1, f"format not recognised; state it in the column format, one of {', '.join(FORMATS)}"
        )
    return form


def nearest(word, words):
    """Return "; did you mean 'x'?" for the nearest word, in any case, or the whole list."""
    folded = {name.casefold(): name for name in words}
    close = difflib.get_close_matches(word.casefold(), list(folded), n=1, cutoff=0.5)
    if close:
        return f"; did you mean {folded[close[0]]!r}?"
    return f"; expected one of {', '.join(words)}"


def choose_component(channels, component, path):
    """Pick one channel by its label, its azimuth in degrees or its place, "2" or "#2" (from 1).

    A number is a label or an azimuth first, then a place. With a single channel
    `component` may be empty. A component that fits none, or more than one, is refused
    with the list of what there is.
    """
    names = [f"#{i} {c.label[:LONGEST] or '(no name)'!r}" for i, c in enumerate(channels, 1)]
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    have = ", ".join(names[:SHOWN]) + more
    if component in (None, ""):
        if len(channels) == 1:
            return channels[0]
        raise RecordError.at(
            path,
            channels[0].line,
            f"the first of {len(channels)} components, {have}; say which in component",
        )
    word = " ".join(str(component).split()).lower()
    number = re.fullmatch(r"#?([0-9]{1,3})", word)
    candidates = [c for c in channels if c.label and " ".join(c.label.split()).lower() == word]
    if number and not candidates and not word.startswith("#"):
        known = [c for c in channels if c.azimuth_deg is not None]
        candidates = [c for c in known if c.azimuth_deg % 360 == int(number[1]) % 360]
    if number and not candidates and 1 <= int(number[1]) <= len(channels):
        candidates = [channels[int(number[1]) - 1]]
    if len(candidates) != 1:
        problem = "fits more than one of" if candidates else "is none of"
        raise RecordError.at(
            path, channels[0].line, f"component {str(component)[:40]!r} {problem} {have}"
        )
    return candidates[0]


def read_record(path, *, name=None, format=None, component=None, dt_s=None, units=None):
    """Read one component of a record file.

    Parameters
    ----------
    path : str
        The file.
    name : str or None
        Name of the record; the file's stem when None.
    format : str or None
        One of `FORMATS`; detected when None or empty.
    component : str or None
        Label, azimuth in degrees, or place; see `choose_component`.
    dt_s : float or None
        Time step; needed when the file has none. When it has, the two must agree within
        0.1 % or the rounding of the file's, and this one is used.
    units : str or None
        Units of the file's accelerations; needed or checked likewise.

    Returns
    -------
    Record
        In m/s², baseline "none", source "file" or "recorded, shipped".

    Raises
    ------
    RecordError
        Anything wrong with the file or a contradiction with what is stated.
    """
    for what, value, kind in (("dt_s", dt_s, Real), ("units", units, str)):
        if value is not None and not isinstance(value, kind):
            expected = "text" if kind is str else "a number (s)"
            raise RecordError(f"{path}: {what} = {value!r}: expected {expected}")
    text, form, channels = open_file(path, format)
    return pick(text, form, channels, name, component, dt_s, units)


_LAST: dict = {}  # channels of the file that was read last: a suite has all its motions in one


def open_file(path, format=None):
    """Read a file's channels, for `pick`: (Text, name of the format, channels)."""
    text = read_text(path)
    form = format.lower() if format else _detect(text)
    if form not in FORMATS:
        raise RecordError(f"unknown format {format!r}{nearest(form, FORMATS)}")
    key = text.path, form, text.sha256
    if key not in _LAST:
        try:
            channels = FORMATS[form](text)
        except RecordError as error:
            if not format:
                raise
            raise RecordError(f"{error} (read as {form}, as stated: {WANTS[form]})") from None
        _LAST.clear()
        _LAST[key] = channels
    return text, form, _LAST[key]


def pick(text, form, channels, name=None, component=None, dt_s=None, units=None):
    """Make a Record of one channel of an opened file; see `read_record`."""
    path = text.path
    channel = choose_component(channels, component, path)
    unit = _units(channel, units, text)
    step = _step(channel, dt_s, text)
    _check_peak(channel, text)
    with np.errstate(over="ignore"):  # infinite is not plausible either
        acceleration = np.array(channel.values, dtype=float) * UNITS_M_S2[unit]
    check_plausible(acceleration, unit, f"{path}, line {channel.line}")
    component = channel.label if channel.component is None else channel.component
    facts = {"file": os.path.basename(path), "format": form, "component": component}
    return Record(
        name or os.path.splitext(os.path.basename(path))[0],
        acceleration,
        step,
        channel.provenance,
        unit,
        details=facts | channel.about | {"sha256": text.sha256},
    )


def _units(channel, stated, text):
    if channel.against:
        raise text.error(channel.line, f"{channel.against}; expected an acceleration")
    unit, known = unit_name(stated) if stated else channel.units, ", ".join(UNITS_M_S2)
    if stated and unit is None:
        raise text.error(channel.line, f"unknown units {stated!r}; expected one of {known}")
    if unit is None:
        raise text.error(channel.line, f"the file states no units; state one of {known}")
    if channel.units and unit != channel.units:
        raise text.error(
            channel.line, f"the file is in {channel.units}, but units {stated!r} are stated"
        )
    return unit


def _step(channel, stated, text):
    # Where the header rounds coarsely, the stated step is the better one.
    file_dt_s, step = channel.dt_s, channel.dt_s if stated is None else stated
    if channel.steps and (stated is None or not _is_one_of(stated, channel.steps)):
        said = " and ".join(f"{dt_s:g} s" for dt_s in channel.steps)
        asked = "state dt_s" if stated is None else f"dt_s {stated:g} is stated"
        raise text.error(channel.line, f"the heading states time steps of {said}; {asked}")
    if step is None:
        raise text.error(channel.line, "the file states no time step; state dt_s")
    if file_dt_s is None:
        if channel.values[0] == stated:
            raise text.error(
                channel.line,
                f"the first number is {stated:g}, the stated step, and would be read as an "
                f"acceleration; write 'DT= {stated:g}' there, or delete it",
            )
    elif stated is not None and not abs(stated - file_dt_s) <= max(
        1e-3 * file_dt_s, min(channel.dt_rounding_s, COARSEST * file_dt_s)
    ):
        raise text.error(
            channel.line, f"the file's time step is {file_dt_s:g} s, but dt_s {stated:g} is stated"
        )
    if not MIN_DT_S <= step <= MAX_DT_S:
        raise text.error(
            channel.line, f"time step {step:g} s; expected {MIN_DT_S:g} … {MAX_DT_S:g} s"
        )
    return float(step)


def _is_one_of(stated, steps):
    return any(abs(stated - dt_s) <= 0.01 * dt_s for dt_s in steps)


def _check_peak(channel, text):
    stated, relative, absolute = channel.peak
    if stated is None:
        return
    peak = float(np.max(np.abs(channel.values)))
    if abs(peak - stated) > max(relative * stated, absolute):
        raise text.error(
            channel.line,
            f"largest value {peak:g} {channel.units}, but the header states {stated:g}: "
            "the data or the header is damaged",
        )
