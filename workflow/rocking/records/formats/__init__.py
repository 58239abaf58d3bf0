"""Record formats: one module a format, found by name or by looking at the file.

A format is a pair of functions: `sniff(text)` tells whether a file looks like it,
`read(text)` returns its acceleration channels.

Why own readers: ObsPy (1.5) reads K-NET but none of AT2, GeoNet, ESM ASCII, COSMOS,
CSMIP and SMC; gmprocess (2.8) reads most of them but installs some 115 packages,
OpenQuake and Django among them, and neither refuses a damaged file by its line. Each
reader here is a page.
"""

from dataclasses import dataclass
from typing import Any

from . import at2, columns, cosmos, csmip, esm, geonet, knet, packed, smc


@dataclass(frozen=True)
class Format:
    """A registered format."""

    name: str
    description: str
    sniff: Any
    read: Any


MARKED = (at2, geonet, esm, cosmos, csmip, smc, knet, packed)  # by a header; looked for first
BARE = {
    "csv": ("columns apart by commas", columns.read_columns),
    "two-column": ("time and acceleration", columns.read_columns),
    "columns": ("more columns", columns.read_columns),
    "wrapped": ("several a line", columns.read_wrapped),
    "single-column": ("one a line", columns.read_single),
}
FORMATS = {
    **{m.NAME: Format(m.NAME, m.DESCRIPTION, m.sniff, m.read) for m in MARKED},
    **{
        name: Format(name, words, columns.sniffs(name), read)
        for name, (words, read) in BARE.items()
    },
}
