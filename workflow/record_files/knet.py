"""K-NET and KiK-net ASCII: 17 header lines, then digitiser counts, 8(I8,1X).

Acceleration is count × Scale Factor, less its mean: the counts' zero is the sensor's
resting position, not an acceleration, and the header's Max. Acc. is taken from it too.
"""

import re

import numpy as np

from .channel import Channel
from .text import MAX_SAMPLES, gridded_block, parse_number

HEADER = 17
_SCALE = re.compile(r"([\d.]+)\(gal\)/([\d.]+)")
_KEYS = ("Sampling Freq(Hz)", "Duration Time(s)", "Dir.", "Scale Factor", "Max. Acc. (gal)")
_AZIMUTH = {"N-S": 0, "E-W": 90}


def sniff(text):
    """Tell whether the first line is Origin Time."""
    return text.lines[0].startswith("Origin Time")


def read(text):
    """Read the file's one channel."""
    fields = {}
    for number in range(1, HEADER + 1):
        line = text.line(number, f"{HEADER} header lines")
        for key in _KEYS:
            if line.startswith(key):
                fields[key] = (number, line[len(key) :].strip())
    for key in _KEYS:
        if key not in fields:
            raise text.error(HEADER, f"no {key!r} in the header")
    number, word = fields["Sampling Freq(Hz)"]
    rate = parse_number(text, number, word.lower().removesuffix("hz"), "the sampling rate")
    if rate <= 0:
        raise text.error(number, "expected a positive sampling rate")
    number, word = fields["Duration Time(s)"]
    count = rate * parse_number(text, number, word, "the duration")
    if not 2 <= count <= MAX_SAMPLES or abs(count - round(count)) > 1e-6:
        raise text.error(number, f"{count:g} samples; expected a whole number up to {MAX_SAMPLES}")
    number, word = fields["Scale Factor"]
    scale = _SCALE.fullmatch(word)
    if not scale:
        raise text.error(number, f"expected a scale as 1234(gal)/5678, found {word[:40]!r}")
    top = parse_number(text, number, scale[1], "a scale")
    bottom = parse_number(text, number, scale[2], "a scale")
    if not bottom > 0:
        raise text.error(number, "expected a positive scale")
    counts = gridded_block(text, HEADER + 1, 9, 8, 8, round(count))
    gal = counts * (top / bottom)
    peak = abs(parse_number(text, *fields["Max. Acc. (gal)"], "the largest acceleration"))
    _, label = fields["Dir."]
    azimuth, stated = _AZIMUTH.get(label), (peak, 0.02, 0.01)
    return [Channel(label, gal - np.mean(gal), HEADER + 1, azimuth, "cm/s2", 1 / rate, peak=stated)]
