"""Captions of columns, and what they call times and components."""

import re

from .header import heading_unit

TIME_UNITS = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds", "sek", "segundos", "secondi"), 1.0),
    **dict.fromkeys(("ms", "msec", "milliseconds"), 1e-3),
}
TIME = re.compile(
    r"\W*(time\w*|zeit|temps|tempo|tiempo|zaman|sec|secs|seconds?|ms|t\W*[(\[]\s*m?s\w*)(?![\w-])",
    re.I,
)
COMPONENT = re.compile(
    r"(?i)(n-?s|e-?w|u-?d|w-?e|s-?n|[nsewuzxyltv]|up|north\w*|south\w*|east\w*|west\w*|nord|sud|est"
    r"|ovest|ost|norte|sur|este|oeste|vert\w*|long\w*|trans\w*|radial|[rt]|h[12nle]\w*"
    r"|(ch|can|kan)\w*[-.]?\d*|[ns]\d+[ew]|acc\w*|ace\w*|a[xyz_]\w*|a\d+|\d{1,3}\s*(deg\w*|°))"
    r"\W*(?:[ (\[_,/].*)?"
)


def labels_of(block, columns):
    """Return the captions of columns, empty strings where no line names them."""
    lines = [line for line in block.heading if line.strip()][-3:]
    for place, line in enumerate(reversed(lines)):
        words = line.lstrip("#%!*/ \t")
        marks = (block.separator, "\t", ";", ",", "|", None)
        split = [
            block.cells(words.strip()),
            re.split(r"\s{2,}", words.strip()),
            *(words.split(m) for m in marks),
        ]
        labels = next((c for c in split if len(c) == columns), None)
        if labels is None:
            if place and re.search(r"\w", line):
                break
            continue
        labels = [cell.strip("\"' ")[:80] for cell in labels]
        if columns > 1 and any(re.search(r"[=:]|^[^a-z%°]+$|^of$", c, re.I) for c in labels if c):
            break  # a sentence of as many words
        above = list(reversed(lines))[place + 1 :]
        if above and all(
            heading_unit(c).unit or c.strip("()[]").lower() in TIME_UNITS for c in labels
        ):
            for s in (block.separator, None):
                names = [c.strip("\"' ") for c in above[0].lstrip("#%!*/ \t").split(s)]
                if len(names) == columns:
                    return [f"{n} [{u.strip('()[]')}]" for n, u in zip(names, labels, strict=True)]
        return labels
    return [""] * columns
