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


def format_of(text):
    """Name of the format that a file looks like; empty for none."""
    marked = (name for name, module in MARKED.items() if module.sniff(text))
    return next(marked, None) or columns.kind_of(text)
