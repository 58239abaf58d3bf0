"""Where a mechanism is, without the façade that it is of."""

from typing import NamedTuple

LEAST_PART_M = 0.3  # lower parts are no mechanism of a façade
WHOLE_PART = "whole"
CORNERS = {-1: "left", 1: "right"}
EXTENT = ("crack_deg", "left_m", "right_m", "middle_m", "top_m")  # columns of tables


class Site(NamedTuple):
    """Where a mechanism is, for `Family.at`: what is left of it when forces change."""

    part: str  # see `Candidate`
    foot_m: float
    hinge_m: float | None = None
    held_m: float | None = None
    side: int = 0
    at_foot: str = ""  # keys of what is there, see `names`
    crack_deg: float | None = None  # of a wedge of the return walls that goes along
    left_m: float | None = None  # along the façade from its middle: ends of what moves, where that
    right_m: float | None = None  # is not its whole width
    middle_m: float | None = None  # where it opens, of horizontal bending
    top_m: float | None = None  # and the height at which its cracks end


def site_of(candidate):
    """`Site` of a `Candidate`, or of a row of a table with its columns."""
    at_foot = getattr(candidate, "at_foot", "")
    at_foot = at_foot if isinstance(at_foot, str) else ""
    hinge_m, held_m = map(known, (candidate.hinge_m, candidate.held_m))
    foot_m, side = float(candidate.foot_m), int(candidate.side)
    more = {key: known(getattr(candidate, key, None)) for key in EXTENT}
    return Site(candidate.part, foot_m, hinge_m, held_m, side, at_foot, **more)


def known(value):
    """A number, or None where a table has none."""
    return None if value is None or value != value else float(value)
