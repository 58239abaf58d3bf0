"""Record formats: one module a format, found by name or by looking at the file.

A format is a pair of functions: `sniff(text)` tells whether a file looks like it,
`read(text)` returns its acceleration channels.

Why own readers: ObsPy reads K-NET but none of AT2, GeoNet, ESM ASCII, COSMOS, CSMIP
and SMC, and would bring a dozen packages for one header; gmprocess reads most of
them but brings ObsPy, OpenQuake and a database layer, and neither refuses a damaged
file line by line. Each reader here is a page.
"""

from dataclasses import dataclass
from typing import Any

from . import at2, columns


@dataclass(frozen=True)
class Format:
    """A registered format; `states_units`: its files carry units and step themselves."""

    name: str
    description: str
    sniff: Any
    read: Any


# Order matters: formats with a marked header first, bare columns last.
FORMATS = {
    form.name: form
    for form in (
        Format("at2", at2.DESCRIPTION, at2.sniff, at2.read),
        Format("csv", "comma-separated columns", columns.sniff_csv, columns.read_csv),
        Format(
            "two-column", "time and acceleration", columns.sniff_two_column, columns.read_two_column
        ),
        Format(
            "single-column",
            "accelerations, one a line",
            columns.sniff_single_column,
            columns.read_single_column,
        ),
    )
}
