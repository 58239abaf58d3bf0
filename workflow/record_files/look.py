"""A block of numbers under examination, and what it is found to be."""

from dataclasses import dataclass, field

import numpy as np

from .block import NumberBlock
from .text import Text


@dataclass(frozen=True)
class Layout:
    """What a block is.

    Attributes
    ----------
    kind : str
        Name of a format: "csv", "two-column", "columns", "wrapped" or "single-column".
    block : NumberBlock
    channels : list of (label, values, line)
        With the captions that the file has, empty where it has none.
    time_s : ndarray or None
        Times as printed, before their unit counts; caption and cells of them in `time`.
    time : (str, list)
    declared : (int or None, float or None)
        Number of samples and step of a first line of numbers.
    """

    kind: str
    block: NumberBlock
    channels: list
    time_s: np.ndarray | None = None
    time: tuple = ("", [])
    declared: tuple = (None, None)


@dataclass
class Look:
    """A block under examination; `rows` is what is left of it."""

    text: Text
    block: NumberBlock
    rows: list
    lines: list
    gaps: dict
    counts: list
    declared: tuple = (None, None)
    x: np.ndarray = field(default_factory=lambda: np.empty(0))

    @property
    def widths(self):
        """Return the number of numbers of each line."""
        return [len(row) for row in self.rows]

    def error(self, message, row=0):
        """Return the RecordError for a row."""
        return self.text.error(self.lines[row], message)
