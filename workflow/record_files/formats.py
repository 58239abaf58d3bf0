"""Record formats: one module a format, found by name or by looking at the file.

In a module, `sniff(text)` tells whether a file looks like its format and `read(text)` returns the
acceleration channels.

Why own readers: ObsPy (1.5) reads K-NET but none of AT2, GeoNet, ESM ASCII, COSMOS,
CSMIP and SMC; gmprocess (2.8) reads most of them but installs some 115 packages,
OpenQuake and Django among them, and neither refuses a damaged file by its line. Each
reader here is a page.
"""

from . import at2, columns, cosmos, csmip, esm, geonet, knet, packed, smc

MARKED = {  # by a header; looked for first
    "at2": at2,
    "geonet": geonet,
    "esm": esm,
    "cosmos": cosmos,
    "csmip": csmip,
    "smc": smc,
    "knet": knet,
    "packed": packed,
}
FORMATS = {
    **{name: module.read for name, module in MARKED.items()},
    "csv": columns.read_columns,
    "two-column": columns.read_columns,
    "columns": columns.read_columns,
    "wrapped": columns.read_wrapped,
    "single-column": columns.read_single,
}

WANTS = {  # what each is, in a refusal of a file that is stated to be one
    "at2": "heading lines, NPTS and DT in one of them, then accelerations in a row",
    "geonet": "16 lines of text, 4 of integers, 6 of reals, then accelerations in mm/s²",
    "esm": "lines 'KEY: value' from EVENT_NAME, then one acceleration a line",
    "cosmos": "a first line with '(Format v… with … text lines)'",
    "csmip": "a text heading, integers, reals, then 'POINTS OF ACCEL DATA' or pairs",
    "smc": "11 lines of text from '2 CORRECTED ACCELEROGRAM', 48 integers, 50 reals",
    "knet": "17 lines from 'Origin Time', then counts",
    "packed": "a first line 'ROCKING MOTIONS 1'",
    "csv": "columns apart by commas, semicolons or tabs, the time first or captions",
    "two-column": "two numbers a line, time and acceleration",
    "columns": "time and accelerations side by side, or accelerations alone",
    "wrapped": "accelerations in a row, several a line",
    "single-column": "one acceleration a line",
}


def format_of(text):
    """Name of the format that a file looks like; empty for none."""
    marked = (name for name, module in MARKED.items() if module.sniff(text))
    return next(marked, None) or columns.kind_of(text)
