"""ESM / ITACA / DYNA ASCII: "KEY: value" lines, then one acceleration a line.

Two variants: DYNA 1.2 as ESM writes it, and the older one with raw acceleration. Both
state SAMPLING_INTERVAL_S, NDATA, UNITS and PGA_CM/S^2.
"""

import re

from ..record import unit_name
from ..text import free_block, parse_count, parse_number
from .channel import Channel

NAME, DESCRIPTION = "esm", "ESM, ITACA ASCII"
MAX_HEADER = 200
_KEY = re.compile(r"([A-Z][A-Z0-9_/^]*)\s*:(.*)")


def sniff(text):
    """Tell whether the first line is EVENT_NAME: …."""
    return text.lines[0].startswith("EVENT_NAME:")


def read(text):
    """Read the file's one channel."""
    header, lines = {}, {}
    first = 1
    for first, line in enumerate(text.lines, 1):
        match = _KEY.match(line)
        if not match:
            break
        if match[1] in header:
            raise text.error(first, f"{match[1]} appears twice")
        if first > MAX_HEADER:
            raise text.error(first, f"more than {MAX_HEADER} header lines")
        header[match[1]], lines[match[1]] = match[2].strip(), first
    else:
        raise text.error(len(text.lines), "the file ends in the header")
    if not header.get("NDATA"):
        raise text.error(lines.get("NDATA", first), "no NDATA in the header")
    if "ACCELERATION" not in header.get("DATA_TYPE", "ACCELERATION").upper():
        raise text.error(
            lines["DATA_TYPE"], f"expected acceleration, found {header['DATA_TYPE']!r}"
        )
    # Units and step that the header fails to say are asked for, or stated in the table.
    unit, dt_s = unit_name(header.get("UNITS", "")), None
    if header.get("UNITS") and unit is None:
        raise text.error(lines["UNITS"], f"unknown units {header['UNITS'][:20]!r}")
    if header.get("SAMPLING_INTERVAL_S"):
        step = header["SAMPLING_INTERVAL_S"]
        dt_s = parse_number(text, lines["SAMPLING_INTERVAL_S"], step, "the time step")
    count = parse_count(text, lines["NDATA"], header["NDATA"], "the number of samples NDATA")
    values = free_block(text, first, len(text.lines), count)
    peak, absolute = None, 0.0
    if header.get("PGA_CM/S^2") and unit == "cm/s2":
        stated = header["PGA_CM/S^2"]
        peak = abs(parse_number(text, lines["PGA_CM/S^2"], stated, "PGA"))
        absolute = 0.6 * 10.0 ** -len(stated.partition(".")[2])  # its last digit
    label = header.get("STREAM", "")
    return [
        Channel(
            label,
            values,
            first,
            None,
            unit,
            dt_s,
            peak_stated=peak,
            peak_tolerance=(0.001, absolute),
        )
    ]
