"""PEER AT2: heading lines, one of them with NPTS and DT, then accelerations, 5E15.7 or free.

The line of NPTS and DT, usually the fourth, in the variants of the original PEER (Pacific
Engineering), NGA (2005) and NGA-West2 databases, and in those of programs that write the form::

    NPTS=  2000, DT= .02000 SEC
    1991    0.0100    NPTS, DT
    NPTS=   7999, DT=   .0050 SEC,
    DT= 5.00E-03 SEC; NPTS= 7999

or two lines, one with each. Units are in a line above it: "IN UNITS OF G", "The units are (g)",
"Acceleration in g", "UNITS OF G". What follows NPTS and DT in their line does not count.
"""

import re

from .channel import Channel
from .header import NUMBER, is_numbers, stated_counts, stated_step, stated_unit
from .text import gridded_block, parse_count, parse_number

HEADING = 20  # lines within which NPTS is looked for
_COUNT = re.compile(r"\bNPTS\b\s*[=:]?\s*(\d+)\b(?!\.)", re.I)
_STEP = re.compile(rf"\bDT\b\s*(?:\(\w+\))?\s*[=:]?\s*({NUMBER})(?![\w.])(\s*MS\b)?", re.I)
_TRAILING = re.compile(rf"\s*(\d+)\s*[,;]?\s+({NUMBER})\s*[,;]?\s*NPTS\s*[,;/]?\s*DT\b", re.I)
_LEADING = re.compile(rf"\s*NPTS\s*[,;/]\s*DT\s*[=:]?\s*(\d+)\s*[,;]?\s+({NUMBER})", re.I)
_UNITS = re.compile(r"\bUNITS\s+OF\s+(\S+)", re.I)


def _count_line(text):
    """Return the line (from 1) with NPTS, 0 when there is none."""
    return next((i for i, line in enumerate(text.lines[:HEADING], 1) if "NPTS" in line.upper()), 0)


def sniff(text):
    """Tell whether a heading states NPTS and DT, or its third line the units, of numbers in a row.

    As many lines of several numbers as NPTS says are columns with a heading alike.
    """
    number = _count_line(text)
    if number:
        count, step, number = _numbers(text, number)
        rows = [line for line in text.lines[number:] if line.strip()]
        columns = bool(count) and len(rows) == int(count) and len(rows[0].split()) > 1
        return bool(step) and not columns and is_numbers(rows[0] if rows else "x")
    third = text.lines[2] if len(text.lines) > 3 else ""
    return bool(_UNITS.search(third) and re.search("ACCEL", third, re.I))


def _numbers(text, number):
    """Return count and step as words, None each, and the last line that states one of them."""
    line = text.lines[number - 1]
    both = _TRAILING.match(line) or _LEADING.match(line)
    if both:
        return both[1], both[2], number
    count, step = _COUNT.search(line), _STEP.search(line)
    for other in (number - 1, number + 1):  # the step in a line of its own
        if not step and 1 <= other <= len(text.lines):
            step = _STEP.match(text.lines[other - 1].strip())
            number = max(number, other) if step else number
    milli = bool(step and step[2])
    return count and count[1], step and (f"{float(step[1]) / 1e3:g}" if milli else step[1]), number


def read(text):
    """Read the file's one channel."""
    number = _count_line(text)
    if number:
        header = text.lines[number - 1]
        words, step, number = _numbers(text, number)
        if not words or not step:
            raise text.error(number, f"expected NPTS and DT, found {header.strip()[:60]!r}")
        count = parse_count(text, number, words, "the number of samples NPTS")
        dt_s = parse_number(text, number, step, "the time step DT")
        digits = len(step.lower().partition("e")[0].partition(".")[2])
        rounding = 0.5 * 10.0**-digits if "e" not in step.lower() else 0.0
    else:  # a heading that fails to say; what the table states must do
        count, (dt_s, rounding) = None, stated_step(text.lines[:HEADING])
        rows = enumerate(text.lines[:HEADING], 1)
        number = next((i for i, line in rows if is_numbers(line)), 5) - 1
    heading = text.lines[:number]
    said = stated_unit(heading)
    if said.against:
        line = next((i for i, words in enumerate(heading, 1) if "UNIT" in words.upper()), 1)
        raise text.error(line, f"{said.against}; expected ACCELERATION … IN UNITS OF G")
    values = gridded_block(text, number + 1, 15, 15, 5, count)
    counts = stated_counts(heading) if count is None else []
    if counts and len(values) not in counts:
        declared = " and ".join(map(str, counts))
        raise text.error(number + 1, f"{len(values)} samples, but the heading declares {declared}")
    # The title ends in the component: "RINALDI RECEIVING STA, 228", "… , 360 (CDMG STATION 5)".
    title = heading[1] if len(heading) > 2 else ""
    label = title.rsplit(",", 1)[-1].partition("(")[0].strip()[:40]
    return [Channel(label or "1", values, number + 1, azimuth(label), said.unit, dt_s, rounding)]


def azimuth(label):
    """Direction [°] in which a name of PEER's ends ("228", "A-STU270", "HVSC S26W" has none)."""
    match = re.fullmatch(r"(?:.*?[^\d.])?(\d{1,3})(\s*(?:deg\w*|°))?", label.strip(), re.I)
    if not match or int(match[1]) > 360:
        return None
    return int(match[1]) if match[2] or len(match[1]) == 3 or match[1] == label else None
