"""CSMIP (CDMG) Volumes 1 and 2, and the prints of their kin: many channels a file.

Each channel is a text heading, 100 integers, 50 or more reals and its data. Volume 2 has for each
of acceleration, velocity and displacement a line "… POINTS OF ACCEL DATA EQUALLY SPACED AT … SEC.
(UNITS: …)", "… sec, in cm/sec2. (8f10.6)" or "IN UNITS CM/SEC/SEC" and its values. Volume 1 has
"… Accelerogram points at 200 pts/sec in units of g . Format: (8f9.6)" alone. A line "/&" ends a
channel, or the file. (Shakal & Huang 1985, OSMS 85-03; Trifunac & Lee 1973 for Volume 1.)

Older prints of Volume 1 (CSMIP, USC, BHRC, RENADIC) have no such line: "NO. OF POINTS = …", "UNITS
ARE SEC AND G/10", both headings of numbers, and then pairs of time and acceleration, or
accelerations with the number of them a second among the reals. Velocities and displacements
are checked for their number and left aside.
"""

import re

import numpy as np

from .at2 import azimuth
from .channel import Channel, channels
from .columns import uniform_step
from .header import stated_unit
from .text import fixed_block, parse_count, parse_number
from .units import unit_name

_DATA = re.compile(
    r"\s*(\d+) POINTS OF (ACC|VEL|DIS)[A-Z]* DATA EQUALLY SPACED AT\s+([\d.]+)\s+SEC[.,]"
    r"\s*(?:(?:\(UNITS:|IN(?: UNITS)?)\s*(\S+?)[.)]?(?:\s.*)?)?",
    re.I,
)
_RAW = re.compile(
    r"\s*(\d+) (ACC)ELEROGRAM POINTS AT\s+([\d.]+)\s+PTS/SEC IN UNITS OF (\S+?)[ .].*", re.I
)
_FORMAT = re.compile(r"\((\d{1,2})F(\d{1,2})\.\d", re.I)
_CHANNEL = re.compile(
    r"(?:CHAN\s+\d+:|COMP\b)\s*(.*?)\s*(?:\(STA CHN:.*|\s{2,}\d+\s*(?:VOL\d)?\s*)?", re.I
)
_PEAK = re.compile(r"PEAK ACCELERATION =\s*([-+.\d]+)\s*(\S+)\s+AT", re.I)
_FIRST = re.compile(
    r"CORRECTED ACCELEROGRAM\b|UNCORRECTED ACCELEROGRAM DATA\b|\* VOL1\w* FILE"
    r"|FILE\s+\d+ OF UNCORRECTED ACCELEROGRAM"
)
_POINTS = re.compile(r"NO\. OF POINTS\s*=\s*(\d+)", re.I)
_UNITS = re.compile(r"UNITS\b.*", re.I)
_LENGTH = re.compile(r"(?:DURATION|RECORD LENGTH)\s*=\s*(\d*\.?\d+)", re.I)
_MAX = re.compile(r"\bMAX\s*=\s*([-+]?[\d.]+)\s*(G)\b", re.I)
INTEGERS, INTEGER_WIDTH = 100, 5
REALS = 50
HEADING = 40  # lines within which a heading ends


def sniff(text):
    """Tell whether the first line is a CSMIP heading (GeoNet's names no channel)."""
    first = text.lines[0][:200]
    return (
        bool(_FIRST.match(first))
        or bool(re.match(r"(?i:UNCORRECTED ACCELEROGRAM DATA)", first))
        or bool(re.match(r"Corrected accelerogram .*\bChan\b", first))
    )


def read(text):
    """Read all channels."""
    return channels(text, _channel)


def _channel(text, first):
    """Read the channel whose heading starts at line `first`; return it and the line after."""
    label, peak, start = _heading(text, first)
    if not start:
        return _older(text, first, label)
    words, values, line = _block(text, start, "ACC")
    raw = words.re is _RAW
    dt_s = parse_number(text, start, words[3], "the time step or rate")
    if raw and dt_s:
        dt_s = 1 / dt_s
    unit = unit_name(words[4]) if words[4] else None
    if words[4] and unit is None:
        raise text.error(start, f"unknown units {words[4][:20]!r}")
    ahead = text.lines[line - 1] if line <= len(text.lines) else ""
    for quantity in ("VEL", "DIS") if not raw and _DATA.fullmatch(ahead[:200]) else ():
        _, _, line = _block(text, line, quantity)
    stated = None
    if peak and unit_name(peak[2]) == unit:
        stated = abs(parse_number(text, first, peak[1], "the peak acceleration"))
    at, stated_peak = azimuth(label), (stated, 0.001, 0.001)
    return Channel(label, values, start + 1, at, unit, dt_s, peak=stated_peak), _end(text, line)


def _end(text, line):
    """Line after the end of a channel, a line "/&" or the end of the file."""
    while line <= len(text.lines) and not text.lines[line - 1].strip():
        line += 1
    if line > len(text.lines):
        return line
    if not text.lines[line - 1].startswith("/&"):
        raise text.error(line, "expected the end of the channel, /&")
    return line + 1


def _heading(text, first):
    """Read a heading: component, match of the peak or None, and the line that begins the data.

    The line is 0 where integers follow the heading and no line of words says what the data are.
    """
    label, peak = "", None
    for number in range(first, len(text.lines) + 1):
        line = text.lines[number - 1][:200]
        if _DATA.fullmatch(line) or _RAW.fullmatch(line):
            return label, peak, number
        if line.startswith("/&"):
            break
        named = _CHANNEL.fullmatch(line)
        label = named[1] if named else label
        peak = _PEAK.match(line) or peak
    return label, peak, 0


def _block(text, start, quantity):
    """Read a quantity from its line of words; return their match, the values and the line after."""
    row = text.line(start, f"POINTS OF {quantity}… DATA")[:200]
    match = _DATA.fullmatch(row) or _RAW.fullmatch(row)
    if not match or match[2].upper() != quantity:
        raise text.error(start, f"expected '… POINTS OF {quantity}… DATA EQUALLY SPACED …'")
    count = parse_count(text, start, match[1], "the number of points")
    form = _FORMAT.search(row)
    if form:
        per_line, width = int(form[1]), int(form[2])
    else:  # ten characters, in older prints of volume 1 nine
        per_line, width = 8, len(text.line(start + 1, f"{count} values").rstrip()) // 8
        width = width if width in (9, 10) and count >= 8 else 10
    if not per_line or not width:
        raise text.error(start, "a Fortran format without columns")
    return match, *fixed_block(text, start + 1, width, per_line, count)


def _older(text, first, label):
    """Read a channel of an older print of volume 1; return it and the line after."""
    count, length_s, said, start = _older_heading(text, first)
    start = _after_integers(text, start)
    reals, start = _reals(text, start)
    row = text.line(start, "the data").rstrip()
    pairs = re.match(r"\s*[-+]?0?\.0*\s", row) and not re.search(r"[eE]", row)
    if pairs:
        return _pairs(text, start, count, said, label)
    width = len(row) // 10 if len(row) % 10 == 0 else len(row) // 8
    per_line = len(row) // max(width, 1)
    values, line = fixed_block(text, start, width, per_line, count)
    rates = {r for r in reals if 10.0 <= r <= 1e4 and abs(length_s * r - count) <= 1.5}
    dt_s = 1.0 / rates.pop() if len(rates) == 1 else None
    return Channel(label, values, start, azimuth(label), said[0], dt_s, peak=said[1]), _end(
        text, line
    )


def _older_heading(text, first):
    """Number of points, length [s], (unit, peak) and the line of the integers."""
    count, length_s, unit = 0, 0.0, None
    peak: tuple[float | None, float, float] = (None, 0.0, 0.0)
    for number in range(first, min(first + HEADING, len(text.lines)) + 1):
        line = text.lines[number - 1][:200]
        points, units = _POINTS.search(line), _UNITS.match(line.strip())
        if points:
            count = parse_count(text, number, points[1], "the number of points")
        lasts = _LENGTH.search(line)
        length_s = float(lasts[1]) if lasts else length_s
        if units:
            said = stated_unit([re.sub(r"\bMAX\b.*", "", units[0], flags=re.I)])
            if said.against:
                raise text.error(number, f"{said.against}; expected an acceleration")
            unit = said.unit
        largest = _MAX.search(line)
        if largest and unit in ("g", "g/10"):
            factor = 10.0 if unit == "g/10" else 1.0
            # of the recording, before its mean was taken off: shows another unit alone
            peak = abs(float(largest[1])) * factor, 0.7, 0.05 * factor
        if count and re.fullmatch(r"(?:\s*-?\d+)+\s*", line) and len(line.rstrip()) % 5 == 0:
            return count, length_s, (unit, peak), number
    raise text.error(
        min(first + HEADING, len(text.lines)),
        "channel without 'POINTS OF ACCEL DATA EQUALLY SPACED', or 'NO. OF POINTS =' and integers",
    )


def _after_integers(text, number):
    """Line after the 100 integers; lines may be cut off at a number of columns."""
    lines = 0
    while re.fullmatch(r"(?:\s*-?\d+)+\s*", text.line(number + lines, "integers")):
        lines += 1
    if not 5 <= lines <= 10:
        raise text.error(number, f"{lines} lines of integers; expected {INTEGERS} integers")
    return number + lines


def _reals(text, number):
    """The reals that are printed, and the line after them: their last line is short."""
    width = 13 if "E" in text.line(number, "reals").upper() else 10
    reals: list[float] = []
    for line in range(number, number + 10):
        row = text.line(line, "reals").rstrip()
        cells = [row[i : i + width] for i in range(0, len(row), width)]
        reals += [_number(cell) for cell in cells if len(cell) == width]
        if line > number and len(cells) <= 3:
            return reals, line + 1
    raise text.error(number, f"expected {REALS} reals, the last two in a line of their own")


def _number(cell):
    try:
        return float(cell)
    except ValueError:
        return 0.0


def _pairs(text, start, count, said, label):
    """Read pairs of time and acceleration, and check that the times are even."""
    row = text.line(start, f"{count} pairs").rstrip()
    blank = len(row) % 7 == 1 and row[0] == " "  # for a printer's carriage
    width, per_line = 7, (len(row) - blank) // 14
    if (len(row) - blank) % 14:
        per_line = next((n for n in (5, 4, 6, 8) if len(row) % (2 * n) == 0), 5)
        width = len(row) // (2 * per_line)
    values, line = fixed_block(text, start, width, 2 * per_line, 2 * count, width + blank)
    time_s, values = values[::2], np.ascontiguousarray(values[1::2])
    digits = len(row[:width].strip().partition(".")[2])
    cells = [f"{time_s[0]:.{digits}f}"]
    dt_s = uniform_step(text, time_s, cells, lambda i: start + i // per_line)
    channel = Channel(label, values, start, azimuth(label), said[0], dt_s, peak=said[1])
    return channel, _end(text, line)
