"""USGS SMC: 11 lines of text, 48 integers, 50 reals, comments, accelerations in cm/s².

Integers 8I10: the 16th is the number of comment lines, the 17th of samples. Reals
5E15.7: the 2nd is the sampling rate, the 30th and 32nd the largest and smallest value;
1.7E+38 means unknown. Data 8 columns of 10 characters. The first line is the kind, "2 CORRECTED
ACCELEROGRAM"; of a file that calls its kind UNKNOWN the heading's "pk acc" says that it is one.
"""

import re

from .channel import Channel
from .text import fixed_block, parse_count, parse_number

TEXT_LINES, INTEGER_LINES, REAL_LINES = 11, 6, 10
MAX_COMMENTS = 10_000
UNKNOWN = 1.7e38
_COMPONENT = re.compile(r"component\s*=\s*(.*)", re.I)
_KIND = re.compile(
    r"\s*\d?\s*((?:UN)?CORRECTED ACCELEROGRAM|ACCELEROGRAM|UNKNOWN|VELOCITY"
    r"|DISPLACEMENT|\w+ SPECTR\w+)",
    re.I,
)


def sniff(text):
    """Tell whether the first line names the kind and the second is a star."""
    return len(text.lines) > 2 and bool(_KIND.match(text.lines[0])) and _starred(text)


def _starred(text):
    return text.lines[1].strip() == "*"


def read(text):
    """Read the file's one channel."""
    match = _KIND.match(text.lines[0])
    if not match:
        raise text.error(1, "expected '2 CORRECTED ACCELEROGRAM'")
    kind = match[1].upper()
    if "ACCELEROGRAM" not in kind and kind != "UNKNOWN":
        raise text.error(1, f"{kind.lower()}; expected an accelerogram")
    acceleration = kind != "UNKNOWN" or re.search(r"\bpk\s+acc", "\n".join(text.lines[:11]), re.I)
    comments_line, count_line = TEXT_LINES + 2, TEXT_LINES + 3
    comments = _fields(text, comments_line, 8, 10)[7].strip()
    if not re.fullmatch(r"\d{1,5}", comments) or int(comments) > MAX_COMMENTS:
        raise text.error(comments_line, f"expected the number of comments, found {comments!r}")
    count = parse_count(
        text, count_line, _fields(text, count_line, 8, 10)[0], "the number of samples"
    )
    rate_line = TEXT_LINES + INTEGER_LINES + 1
    rate = parse_number(text, rate_line, _fields(text, rate_line, 5, 15)[1], "the sampling rate")
    if not 0 < rate < 1e6:
        said = "no sampling rate" if rate > 0.99 * UNKNOWN else f"a sampling rate of {rate:g} Hz"
        raise text.error(
            rate_line, f"the header states {said}; expected evenly spaced samples and their rate"
        )
    peak = _peak(text, rate_line)
    first = TEXT_LINES + INTEGER_LINES + REAL_LINES + 1
    for number in range(first, first + int(comments)):
        if not text.line(number, "a comment").startswith("|"):
            raise text.error(number, "expected a comment starting with |")
    first += int(comments)
    values, line = fixed_block(text, first, 10, 8, count)
    for number in range(line, len(text.lines) + 1):
        if text.lines[number - 1].strip():
            raise text.error(number, f"more values than the {count} samples the header declares")
    component = _COMPONENT.search(text.line(6, "the station and component"))
    label = component[1].strip()[:40] if component else ""
    azimuth = int(label) if re.fullmatch(r"\d{1,3}", label) else None
    unit = "cm/s2" if acceleration else None
    return [Channel(label, values, first, azimuth, unit, 1 / rate, peak=(peak, 0.001, 0.0))]


def _fields(text, number, count, width):
    line = text.line(number, "header numbers").rstrip()
    if len(line) != count * width:
        raise text.error(number, f"expected {count} numbers in columns of {width} characters")
    return [line[i : i + width] for i in range(0, count * width, width)]


def _peak(text, rate_line):
    """Largest magnitude of the header's extremes, None when they are unknown."""
    number = rate_line + 5  # reals 26–30
    largest = parse_number(text, number, _fields(text, number, 5, 15)[4], "the largest value")
    smallest = parse_number(
        text, number + 1, _fields(text, number + 1, 5, 15)[1], "the smallest value"
    )
    known = [abs(value) for value in (largest, smallest) if abs(value) < 0.99 * UNKNOWN]
    return max(known) if len(known) == 2 else None
