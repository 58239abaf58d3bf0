"""CSMIP (CDMG) Volumes 1 and 2: many channels a file; 2 with velocity and displacement too.

Each channel: a text heading with "CHAN n: …" and "PEAK ACCELERATION = …", integer and
real headings, then for each quantity a line "… POINTS OF ACCEL DATA EQUALLY SPACED AT
… SEC.  (UNITS: …)" or "… sec, in cm/sec2. (8f10.6)" and its values, eight a line; Volume 1
has "… Accelerogram points at 200 pts/sec in units of g . Format: (8f9.6)" alone. A line
"/&" ends the channel.
(Shakal & Huang 1985, OSMS 85-03.) Velocities and displacements are checked for their
number and left aside.
"""

import re

import numpy as np

from ..record import unit_name
from ..text import fixed_block, parse_count, parse_number
from .channel import Channel, channels

NAME, DESCRIPTION = "csmip", "CSMIP Volumes 1 and 2"
_DATA = re.compile(
    r"\s*(\d+) POINTS OF (ACCEL|VELOC|DISPL) DATA EQUALLY SPACED AT\s+([\d.]+)\s+SEC[.,]"
    r"\s*(?:\(UNITS:|IN)\s*(\S+?)[.)]?(?:\s.*)?",
    re.I,
)
_RAW = re.compile(
    r"\s*(\d+) (ACCEL)EROGRAM POINTS AT\s+([\d.]+)\s+PTS/SEC IN UNITS OF (\S+?)[ .].*", re.I
)
_FORMAT = re.compile(r"\((\d{1,2})F(\d{1,2})\.\d", re.I)
_CHANNEL = re.compile(r"CHAN\s+\d+:\s*(.*?)\s*", re.I)
_PEAK = re.compile(r"PEAK ACCELERATION =\s*([-+.\d]+)\s*(\S+)\s+AT", re.I)


def sniff(text):
    """Tell whether the first line is a CSMIP heading (GeoNet's names no channel)."""
    first = text.lines[0][:200]
    return bool(re.match(r"CORRECTED ACCELEROGRAM|(?i:UNCORRECTED ACCELEROGRAM DATA)", first)) or (
        bool(re.match(r"Corrected accelerogram .*\bChan\b", first))
    )


def read(text):
    """Read all channels."""
    return channels(text, _channel)


def _channel(text, first):
    """Read the channel whose heading starts at line `first`; return it and the line after."""
    label, peak, start = "", None, None
    for number in range(first, len(text.lines) + 1):
        line = text.lines[number - 1][:200]
        match = _DATA.fullmatch(line) or _RAW.fullmatch(line)
        if match:
            start = number
            break
        if line.startswith("/&"):
            raise text.error(number, "channel without 'POINTS OF ACCEL DATA EQUALLY SPACED'")
        named = _CHANNEL.fullmatch(line)
        if named:
            label = named[1]
        peak = _PEAK.match(line) or peak
    if start is None:
        raise text.error(len(text.lines), "the file ends in a channel's heading")
    values, dt_s, unit, data = np.empty(0), 0.0, "", 0
    raw = _RAW.fullmatch(text.lines[start - 1][:200])
    for quantity in ("ACCEL",) if raw else ("ACCEL", "VELOC", "DISPL"):
        row = text.line(start, f"POINTS OF {quantity} DATA")[:200]
        match = raw or _DATA.fullmatch(row)
        if not match or match[2].upper() != quantity:
            raise text.error(start, f"expected '… POINTS OF {quantity} DATA EQUALLY SPACED …'")
        count = parse_count(text, start, match[1], "the number of points")
        form = _FORMAT.search(row)
        per_line, width = (int(form[1]), int(form[2])) if form else (8, 10)
        if not per_line or not width:
            raise text.error(start, "a Fortran format without columns")
        block, end = fixed_block(text, start + 1, width, per_line, count)
        if quantity == "ACCEL":
            values, data, unit = block, start + 1, unit_name(match[4]) or ""
            dt_s = parse_number(text, start, match[3], "the time step or rate")
            if raw and dt_s:
                dt_s = 1 / dt_s
            if not unit:
                raise text.error(start, f"unknown units {match[4][:20]!r}")
        start = end
    if not text.line(start, "the end of the channel, /&").startswith("/&"):
        raise text.error(start, "expected the end of the channel, /&")
    stated = None
    if peak and unit_name(peak[2]) == unit:
        stated = abs(parse_number(text, first, peak[1], "the peak acceleration"))
    azimuth = re.fullmatch(r"(\d{1,3}) DEG", label, re.I)
    channel = Channel(
        label,
        values,
        data,
        azimuth_deg=int(azimuth[1]) if azimuth else None,
        units=unit,
        dt_s=dt_s,
        peak_stated=stated,
        peak_tolerance=(0.001, 0.001),
    )
    return channel, start + 1
