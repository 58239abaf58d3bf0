"""CSMIP (CDMG) Volume 2: many channels a file, acceleration, velocity and displacement.

Each channel: a text heading with "CHAN n: …" and "PEAK ACCELERATION = …", integer and
real headings, then for each quantity a line "… POINTS OF ACCEL DATA EQUALLY SPACED AT
… SEC.  (UNITS: …)" and its values, 8F10.3; a line "/&" ends the channel.
(Shakal & Huang 1985, OSMS 85-03.) Velocities and displacements are checked for their
number and left aside.
"""

import re

import numpy as np

from ..record import unit_name
from ..text import fixed_block, parse_count, parse_number
from .channel import Channel

DESCRIPTION = "CSMIP Volume 2"
MAX_CHANNELS = 200
_DATA = re.compile(
    r"\s*(\d+)\s+POINTS OF (ACCEL|VELOC|DISPL) DATA EQUALLY SPACED AT\s+([\d.]+)\s+SEC\."
    r"\s*\(UNITS:\s*(\S+?)\s*\)",
    re.I,
)
_CHANNEL = re.compile(r"CHAN\s+\d+:\s*(.*?)\s*", re.I)
_PEAK = re.compile(r"PEAK ACCELERATION =\s*([-+.\d]+)\s*(\S+)\s+AT", re.I)


def sniff(text):
    """Tell whether the first line is CORRECTED ACCELEROGRAM in capitals."""
    return text.lines[0].startswith("CORRECTED ACCELEROGRAM")


def read(text):
    """Read all channels."""
    channels: list[Channel] = []
    line = 1
    while line <= len(text.lines):
        if not text.lines[line - 1].strip():
            line += 1
            continue
        if len(channels) == MAX_CHANNELS:
            raise text.error(line, f"more than {MAX_CHANNELS} channels")
        channel, line = _channel(text, line)
        channels.append(channel)
    return channels


def _channel(text, first):
    """Read the channel whose heading starts at line `first`; return it and the line after."""
    label, peak, start = "", None, None
    for number in range(first, len(text.lines) + 1):
        line = text.lines[number - 1][:200]
        match = _DATA.match(line)
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
    for quantity in ("ACCEL", "VELOC", "DISPL"):
        match = _DATA.match(text.line(start, f"POINTS OF {quantity} DATA")[:200])
        if not match or match[2].upper() != quantity:
            raise text.error(start, f"expected '… POINTS OF {quantity} DATA EQUALLY SPACED …'")
        count = parse_count(text, start, match[1], "the number of points")
        block, end = fixed_block(text, start + 1, 10, 8, count)
        if quantity == "ACCEL":
            values, data, unit = block, start + 1, unit_name(match[4]) or ""
            dt_s = parse_number(text, start, match[3], "the time step")
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
