"""GeoNet V1A (uncorrected) and V2A (corrected): three components a file, in mm/s².

Each component has 16 lines of text, 4 lines of integers (10I8), 6 of reals (10F8) and
its accelerations (10F8 as well); V2A adds velocities and displacements, which are
checked for their number and left aside. (GeoNet, "Strong motion file formats".)
"""

import re

from .channel import Channel
from .text import fixed_block, parse_count, parse_number
from .units import unit_name

TEXT_LINES, INTEGER_LINES, REAL_LINES = 16, 4, 6
MAX_CHANNELS = 30
_RAW = re.compile(r"intervals\s+of\s+([\d.]+)\s*s", re.I)
_CORRECTED = re.compile(r"\bat\s+([\d.]+)\s*s(?:ec)?\s+intervals", re.I)
_PEAK = re.compile(r"Acceleration:\s+Peak\s+([-+.\d]+)\s*(\S+)\s+at", re.I)
_QUADRANT = re.compile(r"([NS])(\d{1,2})([EW])", re.I)
_POINTS = {"N": 0, "E": 90, "S": 180, "W": 270}


def sniff(text):
    """Tell whether the first line is a GeoNet heading."""
    return bool(re.match(r"(Unc|C)orrected accelerogram (?!.*\bChan\b)", text.lines[0][:200]))


def read(text):
    """Read all components."""
    channels: list[Channel] = []
    line = 1
    while line <= len(text.lines) and text.lines[line - 1].strip():
        if len(channels) == MAX_CHANNELS:
            raise text.error(line, f"more than {MAX_CHANNELS} components")
        channel, line = _component(text, line)
        channels.append(channel)
    return channels


def _component(text, first):
    """Read the component whose heading starts at line `first`; return it and the line after."""
    heading = text.line(first, "a heading")
    match = re.match(r"(Unc|C)orrected accelerogram ", heading)
    if not match:
        raise text.error(
            first, f"expected '(Un)corrected accelerogram …', found {heading.strip()[:40]!r}"
        )
    step = text.line(first + 10, "the time step")[:200]
    interval = (_RAW if match[1] == "Unc" else _CORRECTED).search(step)
    dt_s = None  # what the heading fails to say is asked for, or stated in the table
    if interval:
        dt_s = parse_number(text, first + 10, interval[1], "the sampling interval")
    words = text.line(first + 12, "the component").split()
    label = words[1] if len(words) > 1 and words[0] == "Component" else ""
    peak = _PEAK.match(text.line(first + 13, "the peak acceleration")[:200])
    unit = unit_name(peak[2]) if peak else None
    stated = None
    if peak and unit:
        stated = abs(parse_number(text, first + 13, peak[1], "the peak acceleration"))
    counts = _counts(text, first + TEXT_LINES + INTEGER_LINES - 1)
    data = first + TEXT_LINES + INTEGER_LINES + REAL_LINES
    values, line = fixed_block(text, data, 8, 10, counts[0])
    for count in counts[1:]:
        if count:
            _, line = fixed_block(text, line, 8, 10, count)
    stated_peak = (stated, 0.002, 0.06)
    return Channel(label, values, data, _azimuth(label), unit, dt_s, peak=stated_peak), line


def _counts(text, number):
    """Numbers of acceleration, velocity and displacement samples, items 34–36 of the integers."""
    fields = text.line(number, "the numbers of samples").split()
    if len(fields) != 10:
        raise text.error(number, f"expected 10 integers, found {len(fields)}")
    counts = [parse_count(text, number, fields[3], "the number of acceleration samples")]
    for field in fields[4:6]:
        if field != "0":
            counts.append(parse_count(text, number, field, "a number of samples"))
    return counts


def _azimuth(label):
    """Degrees clockwise from north of "S26W", "N" and the like, None for the vertical."""
    quadrant = _QUADRANT.fullmatch(label)
    if quadrant:
        north, angle, side = quadrant[1].upper(), int(quadrant[2]), quadrant[3].upper()
        turned = angle if side == "E" else -angle
        return (turned if north == "N" else 180 - turned) % 360
    return _POINTS.get(label.upper())
