"""What free headings say about units and step, in the spellings met in record files.

AT2 and plain columns share it; a heading that says nothing clear gives None, and the
reader asks for what is missing.
"""

import re

from ..record import MAX_DT_S, MIN_DT_S, unit_name

NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
_STEP = re.compile(
    r"(?:\bDT\b|TIME[ _]?STEP|SAMPLING (?:INTERVAL|PERIOD)|"
    r"EQUAL(?:LY)?[- ]SPAC(?:ING|ED)(?: OF| AT)?)"
    rf"\s*(?:\(S(?:EC)?\))?\s*[:=]?\s*({NUMBER})\s*(MS\b)?",
    re.I,
)
_RATE = re.compile(
    rf"SAMPL(?:E|ING)[ _]?(?:RATE|FREQ\w*)\s*(?:\(\w+\))?\s*[:=]?\s*({NUMBER})", re.I
)
_COUNT = re.compile(
    r"NPTS\s*[:=]\s*(\d{1,9})\b|^\s*(\d{1,9})\s+(?:[\d.]+\s+)?(?:NPTS|POINTS)\b"
    r"|NUMBER OF (?:DATA|POINTS|SAMPLES)\s*[:=]\s*(\d{1,9})\b",
    re.I,
)
_BRACKETED = re.compile(r"[(\[]([^()\[\]]+)[)\]]")
_SUFFIX = re.compile(r"[_\s,](g|(?:m|cm|mm)_s2|\S*[/²]\S*|gal)$", re.I)
_ACCELERATION = re.compile(r"(?:a|acc[a-z]*)?", re.I)
_UNIT = re.compile(r"(?:UNITS?|ACCEL\w*)\W*(?:(?:OF|ARE|IS|IN)\b)?[\s:=(\[]*([^\s()\[\],;]+)", re.I)


def is_numbers(line):
    """Tell whether a line holds numbers alone, apart by blanks, commas or semicolons."""
    words = re.split(r"[\s,;]+", line.strip(" \t,;"))
    return all(re.fullmatch(NUMBER, word) for word in words)


def stated_unit(lines):
    """Return the canonical acceleration unit the lines name ("units of g"), or None."""
    words = (match[1] for line in lines for match in _UNIT.finditer(line[:200]))
    return next(filter(None, (unit_name(word.rstrip(".,")) for word in words)), None)


def heading_unit(heading):
    """Return the unit in a column's heading ("Acc. (g's)", "a_m_s2", "acc g", "cm/s2"), or None."""
    bracketed = _BRACKETED.search(heading)
    if bracketed:
        return unit_name(bracketed[1])
    suffix = _SUFFIX.search(heading)
    return unit_name(suffix[1] if suffix else heading)


def heading_component(heading):
    """Return what a column's heading says but "acceleration" and a unit ("N-S"), or ""."""
    words = _SUFFIX.sub("", _BRACKETED.sub("", heading)).strip(" _.,:;")
    return "" if unit_name(words) or _ACCELERATION.fullmatch(words) else words


def stated_count(lines):
    """Return the number of samples the lines declare, or None."""
    found = (_COUNT.search(line[:200]) for line in lines)
    return next((int(match[1] or match[2] or match[3]) for match in found if match), None)


def stated_step(lines):
    """Return (step in s or None, half a unit of its last printed digit)."""
    for line in lines:
        step, rate = _STEP.search(line[:200]), _RATE.search(line[:200])
        value, rounding = 0.0, 0.0
        if step:
            value = float(step[1]) / (1000.0 if step[2] else 1.0)
            if not step[2] and "e" not in step[1].lower():
                rounding = 0.5 * 10.0 ** -len(step[1].partition(".")[2])
        elif rate:
            value = 1.0 / max(float(rate[1]), 1e-9)
        if MIN_DT_S <= value <= MAX_DT_S:
            return value, rounding
    return None, 0.0
