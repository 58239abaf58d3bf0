"""PEER AT2: heading lines, one of them with NPTS and DT, then accelerations, 5E15.7 or free.

The line of NPTS and DT, usually the fourth, in the variants of the original PEER (Pacific
Engineering), NGA (2005) and NGA-West2 databases::

    NPTS=  2000, DT= .02000 SEC
    1991    0.0100    NPTS, DT
    NPTS=   7999, DT=   .0050 SEC,

Units are in a line above it: "IN UNITS OF G", "The units are (g)", "Acceleration in g".
"""

import re

from ..text import gridded_block, parse_count, parse_number
from .channel import Channel
from .header import is_numbers, stated_unit

HEADING = 20  # lines within which NPTS is looked for
_NAMED = re.compile(r"\s*NPTS\s*=\s*(\d+)\s*,\s*DT\s*=\s*([\d.]+)\s*(?:SEC)?\s*,?\s*", re.I)
_TRAILING = re.compile(r"\s*(\d+)\s+([\d.]+)\s+NPTS\s*,\s*DT\s*", re.I)
_UNITS = re.compile(r"\bUNITS\s+OF\s+(\S+)", re.I)


def _count_line(text):
    """Return the line (from 1) with NPTS, 0 when there is none."""
    return next((i for i, line in enumerate(text.lines[:HEADING], 1) if "NPTS" in line.upper()), 0)


def sniff(text):
    """Tell whether a heading line has NPTS or the third states the units."""
    third = text.lines[2] if len(text.lines) > 3 else ""
    return bool(_count_line(text) or _UNITS.search(third))


def read(text):
    """Read the file's one channel."""
    number = _count_line(text)
    if number:
        header = text.lines[number - 1]
        match = _NAMED.fullmatch(header) or _TRAILING.fullmatch(header)
        if not match:
            raise text.error(number, f"expected NPTS and DT, found {header.strip()[:60]!r}")
        count = parse_count(text, number, match[1], "the number of samples NPTS")
        dt_s = parse_number(text, number, match[2], "the time step DT")
        rounding = 0.5 * 10.0 ** -len(match[2].partition(".")[2])
    else:  # a heading that fails to say; what the table states must do
        count, dt_s, rounding = None, None, 0.0
        rows = enumerate(text.lines[:HEADING], 1)
        number = next((i for i, line in rows if is_numbers(line)), 5) - 1
    heading = text.lines[:number]
    unit = stated_unit(heading)
    for line, words in enumerate(heading, 1):
        found = _UNITS.search(words)
        if found and unit is None:
            raise text.error(line, f"expected ACCELERATION … IN UNITS OF G, found {found[1]!r}")
    values = gridded_block(text, number + 1, 15, 15, 5, count)
    # The title ends in the component: "RINALDI RECEIVING STA, 228", "… , 360 (CDMG STATION 5)".
    title = heading[1] if len(heading) > 2 else ""
    label = title.rsplit(",", 1)[-1].partition("(")[0].strip()[:40]
    azimuth = int(label) if re.fullmatch(r"[0-9]{1,3}", label) else None
    return [Channel(label or "1", values, number + 1, azimuth, unit, dt_s, rounding)]
