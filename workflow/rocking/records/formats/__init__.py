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


# Order matters: formats with a marked header first, bare columns last.
FORMATS = {
    form.name: form
    for form in (
        Format("at2", at2.DESCRIPTION, at2.sniff, at2.read),
        Format("geonet", geonet.DESCRIPTION, geonet.sniff, geonet.read),
        Format("esm", esm.DESCRIPTION, esm.sniff, esm.read),
        Format("cosmos", cosmos.DESCRIPTION, cosmos.sniff, cosmos.read),
        Format("csmip", csmip.DESCRIPTION, csmip.sniff, csmip.read),
        Format("smc", smc.DESCRIPTION, smc.sniff, smc.read),
        Format("knet", knet.DESCRIPTION, knet.sniff, knet.read),
        Format("packed", packed.DESCRIPTION, packed.sniff, packed.read),
        Format("csv", "columns apart by commas", columns.sniff_csv, columns.read_columns),
        Format(
            "two-column", "time and acceleration", columns.sniff_two_column, columns.read_columns
        ),
        Format("columns", "more columns", columns.sniff_columns, columns.read_columns),
        Format("wrapped", "several a line", columns.sniff_wrapped, columns.read_wrapped),
        Format("single-column", "one a line", columns.sniff_single, columns.read_single),
    )
}
