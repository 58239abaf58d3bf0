"""ESM / ITACA / DYNA ASCII: "KEY: value" lines, then one acceleration a line.

Two variants: DYNA 1.2 as ESM writes it, and the older one with raw acceleration. Both
state SAMPLING_INTERVAL_S, NDATA, UNITS and PGA_CM/S^2.
"""

import re

from .channel import Channel
from .text import free_block, parse_count, parse_number
from .units import unit_name

MAX_HEADER = 200
_KEY = re.compile(r"([A-Z][A-Z0-9_/^]*)\s*:(.*)")


def sniff(text):
    """Tell whether the first line is EVENT_NAME: …."""
    return text.lines[0].startswith("EVENT_NAME:")


def read(text):
    """Read the file's one channel."""
    header: dict[str, tuple[int, str]] = {}
    first = 1
    for first, line in enumerate(text.lines, 1):
        match = _KEY.match(line)
        if not match:
            break
        if match[1] in header:
            raise text.error(first, f"{match[1]} appears twice")
        if first > MAX_HEADER:
            raise text.error(first, f"more than {MAX_HEADER} header lines")
        header[match[1]] = first, match[2].strip()
    else:
        raise text.error(len(text.lines), "the file ends in the header")
    nowhere = first, ""
    declared = header.get("NDATA", nowhere)
    if not declared[1]:
        raise text.error(declared[0], "no NDATA in the header")
    number, kind = header.get("DATA_TYPE", (first, "ACCELERATION"))
    if "ACCELERATION" not in kind.upper():
        raise text.error(number, f"expected acceleration, found {kind!r}")
    # Units and step that the header fails to say are asked for, or stated in the table.
    number, word = header.get("UNITS", nowhere)
    unit = unit_name(word)
    if word and unit is None:
        raise text.error(number, f"unknown units {word[:20]!r}")
    number, word = header.get("SAMPLING_INTERVAL_S", nowhere)
    dt_s = parse_number(text, number, word, "the time step") if word else None
    count = parse_count(text, *declared, "the number of samples NDATA")
    values = free_block(text, first, count)
    peak, absolute = None, 0.0
    number, word = header.get("PGA_CM/S^2", nowhere)
    if word and unit == "cm/s2":
        peak = abs(parse_number(text, number, word, "PGA"))
        absolute = 0.6 * 10.0 ** -len(word.partition(".")[2])  # its last digit
    _, label = header.get("STREAM", nowhere)
    return [Channel(label, values, first, None, unit, dt_s, peak=(peak, 0.001, absolute))]
