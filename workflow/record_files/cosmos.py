"""COSMOS strong-motion format V1.20: channels one after another, acceleration first.

Text heading (its number of lines is in the first one), integer and real headings, each
announced with its Fortran format, comments, then "n acceleration pts, …,
units=cm/sec2(04),Format=(8F10.5)" and the values; "/&" ends a channel. The 62nd real is
the sampling interval of these data in ms, the 64th their largest value (the 34th, in s,
is that of the recorder before processing). Unknown values are -999. Velocity and
displacement blocks or channels are skipped.
"""

import re

from .channel import Channel, channels
from .text import fixed_block, parse_count, parse_number
from .units import unit_name

MAX_HEADING = 200
_FIRST = re.compile(r"\(Format v[\d.]+ with\s+(\d{1,3}) text lines\)", re.I)
_HEADING = re.compile(
    r"\s*(\d{1,4}) (Integer|Real)-header values follow on\s+(\d{1,3}) lines?,"
    r"\s*Format\s*=\s*\((\d{1,2})[IFEG](\d{1,2})",
    re.I,
)
_COMMENTS = re.compile(r"\s*(\d{1,4}) Comment line", re.I)
_DATA = re.compile(
    r"\s*(\d+)\s+(\w+)\s+pts,.*units=\s*([^\s,(]+)\s*\(\d+\),\s*"
    r"Format=\s*\((\d{1,2})[FEG](\d{1,2})",
    re.I,
)
_STATION = re.compile(r"Sta Cha\w*:\s*\d+:\s*(.*?)\s*\(", re.I)
UNKNOWN = -999.0


def sniff(text):
    """Tell whether the first line states the COSMOS format."""
    return bool(_FIRST.search(text.lines[0]))


def read(text):
    """Read the acceleration of all channels."""
    accelerations = channels(text, _channel)
    if not accelerations:
        raise text.error(len(text.lines), "no channel of acceleration in the file")
    return accelerations


def _heading(text, line, kind):
    """Read a block of header numbers as text; return the fields and the line after."""
    match = _HEADING.match(text.line(line, f"{kind}-header values"))
    if not match or match[2].lower() != kind.lower():
        raise text.error(line, f"expected '… {kind}-header values follow on … lines, Format=(…)'")
    count, lines, per_line, width = (int(match[i]) for i in (1, 3, 4, 5))
    if not per_line or not width:
        raise text.error(line, "a Fortran format without columns")
    fields = []
    for number in range(line + 1, line + 1 + lines):
        row = text.line(number, f"{kind}-header values").rstrip()
        fields += [(number, row[i : i + width]) for i in range(0, len(row), width)]
    if len(fields) != count:
        raise text.error(line, f"{len(fields)} values follow; expected {count}")
    return fields, line + 1 + lines


def _channel(text, first):
    """Read a channel from line `first`; return it (None: no acceleration) and the line after."""
    match = _FIRST.search(text.line(first, "a COSMOS heading"))
    if not match:
        raise text.error(first, "expected a COSMOS heading '… (Format v… with … text lines)'")
    if not 1 <= int(match[1]) <= MAX_HEADING:
        raise text.error(first, f"{match[1]} text lines; expected 1 … {MAX_HEADING}")
    line = first + int(match[1])
    text.line(line, "the end of the text heading")
    stations = (_STATION.match(row[:200]) for row in text.lines[first - 1 : line - 1])
    label = next((station[1] for station in stations if station), "")
    _, line = _heading(text, line, "Integer")
    reals, line = _heading(text, line, "Real")
    comments = _COMMENTS.match(text.line(line, "comments or data"))
    if comments:
        line += 1 + int(comments[1])
    channel = None
    while True:
        row = text.line(line, "data or the end of the channel, /&")
        if row.startswith(("/&", "End-of-data for")):  # the second as PRISM writes it
            return channel, line + 1
        match = _DATA.match(row[:200])
        if not match and " raw " in row[:40]:
            raise text.error(line, "raw counts; expected a file of acceleration (V1, V2)")
        if not match:
            raise text.error(line, f"expected '… pts, …, units=…,Format=(…)', found {row[:40]!r}")
        count = parse_count(text, line, match[1], "the number of points")
        per_line, width = int(match[4]), int(match[5])
        if not per_line or not width:
            raise text.error(line, "a Fortran format without columns")
        values, end = fixed_block(text, line + 1, width, per_line, count)
        if match[2].lower().startswith("accel"):
            if channel:
                raise text.error(line, "a second block of acceleration in one channel")
            channel = _acceleration(text, line, reals, label, values, match[3])
        line = end


def _acceleration(text, line, reals, label, values, units):
    unit = unit_name(units)
    if unit is None:
        raise text.error(line, f"unknown units {units[:20]!r}; expected g, cm/sec2, …")
    if len(reals) < 64:
        raise text.error(line, f"{len(reals)} real headers; expected at least 64")
    interval_ms = parse_number(text, reals[61][0], reals[61][1], "the sampling interval (real 62)")
    peak = parse_number(text, reals[63][0], reals[63][1], "the largest value (real 64)")
    match = re.match(r"(\d{1,3})\s*deg", label, re.I)
    azimuth = int(match[1]) if match else None
    dt_s = interval_ms / 1000 if interval_ms > 0 else None
    stated_peak = (abs(peak) if peak != UNKNOWN else None, 0.001, 0.0)
    return Channel(label, values, line + 1, azimuth, unit, dt_s, peak=stated_peak)
