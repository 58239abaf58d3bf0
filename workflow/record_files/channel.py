"""What a format module hands back: one channel of a file, still in its own units."""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Channel:
    """One acceleration channel.

    Parameters
    ----------
    label : str
        Component as the file names it ("S26W", "90 DEG", "E-W", a column's heading).
    azimuth_deg : int or None
        Direction of positive motion, clockwise from north, when the file states it.
    values : ndarray, shape (n,)
        Acceleration in `units`.
    line : int
        Line of the first sample, for messages.
    units : str or None
        Canonical unit; None when the file does not state it.
    dt_s : float or None
        Time step; None when the file does not state it.
    dt_rounding_s : float
        Half a unit of its last printed digit, where digits are few (.0024 may be 0.00244).
    peak : tuple
        The header's largest acceleration (magnitude, in `units`; None when it states none) and
        the relative or absolute disagreement (in `units`), whichever is larger, that its rounding
        explains.
    about : dict
        Station, event, source, licence and the like where the file states them.
    provenance : str
        One of `record.SOURCES`.
    component : str or None
        What of the label is a component; None: all of it.
    against : str
        What speaks against its values as accelerations, such as a unit of velocity; empty: nothing.
    steps : tuple of float
        Steps that a heading states [s] where they differ from each other; `dt_s` is None then.
    """

    label: str
    values: np.ndarray
    line: int
    azimuth_deg: int | None = None
    units: str | None = None
    dt_s: float | None = None
    dt_rounding_s: float = 0.0
    peak: tuple[float | None, float, float] = (None, 0.0, 0.0)
    about: dict = field(default_factory=dict)
    provenance: str = "file"
    component: str | None = None
    against: str = ""
    steps: tuple[float, ...] = ()


MAX_CHANNELS = 200


def channels(text, read_one):
    """All channels of a file that holds one after another.

    `read_one` takes the text and the line of a heading; it returns the channel, or None for one
    that is left aside, and the line after.
    """
    kept: list[Channel] = []
    line = 1
    while line <= len(text.lines):
        if not text.lines[line - 1].strip():
            line += 1
            continue
        if len(kept) == MAX_CHANNELS:
            raise text.error(line, f"more than {MAX_CHANNELS} channels")
        channel, line = read_one(text, line)
        if channel:
            kept.append(channel)
    return kept
