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

from ..record import unit_name
from ..text import fixed_block, parse_count, parse_number
from .channel import Channel, channels

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
    label, peak, start = _heading(text, first)
    words, values, line = _block(text, start, "ACCEL")
    raw = words.re is _RAW
    dt_s = parse_number(text, start, words[3], "the time step or rate")
    if raw and dt_s:
        dt_s = 1 / dt_s
    unit = unit_name(words[4])
    if unit is None:
        raise text.error(start, f"unknown units {words[4][:20]!r}")
    for quantity in () if raw else ("VELOC", "DISPL"):
        _, _, line = _block(text, line, quantity)
    if not text.line(line, "the end of the channel, /&").startswith("/&"):
        raise text.error(line, "expected the end of the channel, /&")
    stated = None
    if peak and unit_name(peak[2]) == unit:
        stated = abs(parse_number(text, first, peak[1], "the peak acceleration"))
    found = re.fullmatch(r"(\d{1,3}) DEG", label, re.I)
    azimuth, stated_peak = int(found[1]) if found else None, (stated, 0.001, 0.001)
    return Channel(label, values, start + 1, azimuth, unit, dt_s, peak=stated_peak), line + 1


def _heading(text, first):
    """Read a heading: component, match of the peak or None, and the line that begins the data."""
    label, peak = "", None
    for number in range(first, len(text.lines) + 1):
        line = text.lines[number - 1][:200]
        if _DATA.fullmatch(line) or _RAW.fullmatch(line):
            return label, peak, number
        if line.startswith("/&"):
            raise text.error(number, "channel without 'POINTS OF ACCEL DATA EQUALLY SPACED'")
        named = _CHANNEL.fullmatch(line)
        if named:
            label = named[1]
        peak = _PEAK.match(line) or peak
    raise text.error(len(text.lines), "the file ends in a channel's heading")


def _block(text, start, quantity):
    """Read a quantity from its line of words; return their match, the values and the line after."""
    row = text.line(start, f"POINTS OF {quantity} DATA")[:200]
    match = _DATA.fullmatch(row) or _RAW.fullmatch(row)
    if not match or match[2].upper() != quantity:
        raise text.error(start, f"expected '… POINTS OF {quantity} DATA EQUALLY SPACED …'")
    count = parse_count(text, start, match[1], "the number of points")
    form = _FORMAT.search(row)
    per_line, width = (int(form[1]), int(form[2])) if form else (8, 10)
    if not per_line or not width:
        raise text.error(start, "a Fortran format without columns")
    return match, *fixed_block(text, start + 1, width, per_line, count)
