"""Where a mechanism is, without the façade that it is of."""

from typing import NamedTuple

LEAST_PART_M = 0.3  # lower parts are no mechanism of a façade
WHOLE_PART = "whole"
CORNERS = {-1: "left", 1: "right"}


class Site(NamedTuple):
    """Where a mechanism is, for `Family.at`: what is left of it when forces change."""

    part: str  # see `Candidate`
    foot_m: float
    hinge_m: float | None = None
    held_m: float | None = None
    side: int = 0
    words: str = ""  # what is at the foot


def site_of(candidate):
    """`Site` of a `Candidate`, or of a row of a table with its columns."""
    words = getattr(candidate, "words", "")
    hinge_m, held_m = map(_known, (candidate.hinge_m, candidate.held_m))
    foot_m, side = float(candidate.foot_m), int(candidate.side)
    return Site(candidate.part, foot_m, hinge_m, held_m, side, words)


def _known(value):
    """A height as a number; None where a table has none."""
    return None if value is None or value != value else float(value)
