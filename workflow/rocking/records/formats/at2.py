"""PEER AT2: four header lines, then accelerations in g, 5E15.7 or free.

The fourth line has three variants, for the original PEER (Pacific Engineering), NGA
(2005) and NGA-West2 databases::

    NPTS=  2000, DT= .02000 SEC
    1991    0.0100    NPTS, DT
    NPTS=   7999, DT=   .0050 SEC,
"""

import re

from ..record import unit_name
from ..text import gridded_block, parse_count, parse_number
from .channel import Channel

DESCRIPTION = "PEER AT2"
_NAMED = re.compile(r"\s*NPTS\s*=\s*(\d+)\s*,\s*DT\s*=\s*([\d.]+)\s*(?:SEC)?\s*,?\s*", re.I)
_TRAILING = re.compile(r"\s*(\d+)\s+([\d.]+)\s+NPTS\s*,\s*DT\s*", re.I)
_UNITS = re.compile(r"\bUNITS\s+OF\s+(\S+)", re.I)


def sniff(text):
    """Tell whether the third and fourth lines look like an AT2 header."""
    if len(text.lines) < 4:
        return False
    return bool(_UNITS.search(text.lines[2])) or "NPTS" in text.lines[3].upper()


def read(text):
    """Read the file's one channel."""
    kind = text.line(3, "an AT2 header of 4 lines")
    units = _UNITS.search(kind)
    if "ACCEL" not in kind.upper() or not units:
        raise text.error(3, f"expected ACCELERATION … IN UNITS OF G, found {kind.strip()[:60]!r}")
    unit = unit_name(units[1].rstrip(".,"))
    if unit is None:
        raise text.error(3, f"unknown units {units[1][:20]!r}; expected G")
    header = text.line(4, "NPTS and DT")
    match = _NAMED.fullmatch(header) or _TRAILING.fullmatch(header)
    if not match:
        raise text.error(4, f"expected NPTS and DT, found {header.strip()[:60]!r}")
    count = parse_count(text, 4, match[1], "the number of samples NPTS")
    dt_s = parse_number(text, 4, match[2], "the time step DT")
    values = gridded_block(text, 5, 15, 15, 5, count)
    # The title ends in the component: "RINALDI RECEIVING STA, 228".
    label = text.lines[1].rsplit(",", 1)[-1].strip()[:40]
    azimuth = int(label) if re.fullmatch(r"\d{1,3}", label) else None
    rounding = 0.5 * 10.0 ** -len(match[2].partition(".")[2])
    return [Channel(label or "1", values, 5, azimuth, unit, dt_s, rounding)]
