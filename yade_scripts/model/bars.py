"""What joins two blocks of a scene apart from contact nodes, as plain data: links, ties, floors."""

import math
from dataclasses import dataclass

import numpy as np


def _check(bar, positive=(), least_0=()):
    """Refuse values of a bar that are not finite or too small, and one on a single block."""
    what = f"{type(bar).__name__.lower()} '{bar.name}'"
    for label in (*positive, *least_0):
        value, least = getattr(bar, label), "positive" if label in positive else "at least 0"
        if not (np.isfinite(value) and (value > 0.0 or (value == 0.0 and label in least_0))):
            raise ValueError(f"{what}: {label} must be {least}, got {value}")
    if bar.a == bar.b:
        raise ValueError(f"{what} joins a block to itself")


@dataclass(frozen=True)
class Link:
    """A spring and a dashpot in parallel between two blocks, linear both ways.

    The force on `a` along the unit vector `direction` is −k·u − c·u̇ with u the displacement of a
    past b, both taken at `position_m` in the reference position; a support as `b` stands for the
    ground. ValueError if k or c is negative or not finite, or the link joins a block to itself.
    """

    name: str
    a: int
    b: int
    stiffness_n_m: float
    dashpot_ns_m: float
    position_m: tuple
    direction: tuple = (0.0, 1.0, 0.0)

    def __post_init__(self):
        """Check the values."""
        _check(self, least_0=("stiffness_n_m", "dashpot_ns_m"))


@dataclass(frozen=True)
class Tie:
    """A rod between a point of block `a` and one of block `b`, which can only pull.

    With e its lengthening past its slack, by which its ends part before it is taut (less than
    nothing: it is stretched from the start), and p the part
    of it that is plastic, it pulls with k·(e − p) between 0 and its capacity along the line between
    the points as they are; past the capacity p grows, and at e = `elongation_m`, not less than
    capacity/k, it snaps for good. Its ends `end_a_m` and `end_b_m` are those of the reference
    position. ValueError of one line for other values.
    """

    name: str
    a: int
    b: int
    end_a_m: tuple
    end_b_m: tuple
    stiffness_n_m: float
    capacity_n: float
    slack_m: float
    elongation_m: float

    def __post_init__(self):
        """Check the values."""
        _check(self, ("stiffness_n_m", "capacity_n", "elongation_m"))
        if not np.isfinite(self.slack_m):
            raise ValueError(f"tie '{self.name}': slack_m must be finite, got {self.slack_m}")
        if self.length_m <= 0.0:
            raise ValueError(f"tie '{self.name}' needs two ends")
        if self.elongation_m < self.capacity_n / self.stiffness_n_m * (1.0 - 1e-9):
            raise ValueError(f"tie '{self.name}' would snap before it pulls {self.capacity_n:g} N")

    @property
    def length_m(self):
        """Distance of its ends in the reference position."""
        return math.dist(self.end_a_m, self.end_b_m)

    @property
    def direction(self):
        """Unit vector from its end on b to that on a, in the reference position."""
        offset = np.subtract(self.end_a_m, self.end_b_m)
        return tuple(float(v) for v in offset / self.length_m)


def taut(ties):
    """Ties that pull at once: of two that pull one point opposite ways the first alone."""
    kept: list[Tie] = []
    for tie in ties:
        ends = (tie.a, tie.b, tie.end_a_m, tuple(-v for v in tie.direction))
        if ends not in [(x.a, x.b, x.end_a_m, x.direction) for x in kept]:
            kept.append(tie)
    return kept


@dataclass(frozen=True)
class Floor:
    """A floor or roof on a point of block `a`: its weight, and friction against its carrier `b`.

    The load is a vertical force on the point, wherever it goes. With u the horizontal displacement
    of the point past the carrier, which does not turn, and p the part of it that has slipped, the
    carrier holds it with −k·(u − p), at most the capacity, past which p grows; the force may point
    either way. u counts from `from_m`, where a wall that leans has its point at rest. k is
    positive, load and capacity are not negative: else a ValueError of one line.
    """

    name: str
    a: int
    b: int
    position_m: tuple
    load_n: float
    stiffness_n_m: float
    capacity_n: float
    from_m: float = 0.0

    def __post_init__(self):
        """Check the values."""
        _check(self, ("stiffness_n_m",), ("load_n", "capacity_n"))
