"""Support motions: piecewise-linear accelerations, integrated exactly."""

from dataclasses import dataclass, field

import numpy as np


def integrate_linear(acceleration, dt_s):
    """Velocity and displacement of a piecewise-linear acceleration, shape (..., nt), from rest.

    v grows by (a₀ + a₁)h/2 and u by v₀h + (2a₀ + a₁)h²/6 in a step, exactly.
    """
    a0, a1 = acceleration[..., :-1], acceleration[..., 1:]
    start = np.zeros(acceleration.shape[:-1] + (1,))
    velocity = np.concatenate((start, np.cumsum(0.5 * (a0 + a1) * dt_s, axis=-1)), axis=-1)
    gain = velocity[..., :-1] * dt_s + (2.0 * a0 + a1) * dt_s**2 / 6.0
    return velocity, np.concatenate((start, np.cumsum(gain, axis=-1)), axis=-1)


@dataclass(frozen=True)
class SupportTable:
    """Accelerations of the base and of the return-wall segments.

    The block is solved in the base's frame, so only the walls' motion relative
    to the base is integrated; after the last sample everything stands still
    relative to the base and the base's acceleration is zero.

    Parameters
    ----------
    dt_s : float
        Common sampling step.
    base_m_s2 : array_like, shape (nt,)
        Positive outward (+y).
    walls_m_s2 : array_like, shape (m, nt), or None
        Absolute accelerations of the segments, base up; None moves them with the base.
    vertical_m_s2 : array_like, shape (nt,), or None
        Of base and walls alike, positive upward.

    Raises
    ------
    ValueError
        If the step is not positive, a value is not finite or the lengths differ.
    """

    dt_s: float
    base_m_s2: np.ndarray
    walls_m_s2: np.ndarray | None = None
    vertical_m_s2: np.ndarray | None = None
    relative_m_s2: np.ndarray = field(init=False, repr=False)
    relative_m_s: np.ndarray = field(init=False, repr=False)
    relative_m: np.ndarray = field(init=False, repr=False)

    def __post_init__(self):
        """Check the samples and integrate the relative motion of the walls."""
        base = np.ascontiguousarray(self.base_m_s2, float)  # one compiled loop for all motions
        if not (np.isfinite(self.dt_s) and self.dt_s > 0.0):
            raise ValueError(f"motion: the step must be positive, got {self.dt_s} s")
        if base.ndim != 1 or base.size < 2 or not np.all(np.isfinite(base)):
            raise ValueError("motion: expected one row of at least 2 finite base accelerations")
        object.__setattr__(self, "base_m_s2", base)
        lift = 0.0 * base if self.vertical_m_s2 is None else np.asarray(self.vertical_m_s2, float)
        if lift.shape != base.shape or not np.all(np.isfinite(lift)):
            raise ValueError(f"motion: expected {base.size} finite vertical accelerations")
        object.__setattr__(self, "vertical_m_s2", lift)
        if self.walls_m_s2 is None:
            for name in ("relative_m_s2", "relative_m_s", "relative_m"):
                object.__setattr__(self, name, np.zeros((0, base.size)))
            return
        walls = np.atleast_2d(np.asarray(self.walls_m_s2, float))
        if walls.shape[1] != base.size or not np.all(np.isfinite(walls)):
            raise ValueError(
                f"motion: expected finite wall accelerations of {base.size} samples, "
                f"got shape {walls.shape}"
            )
        relative = walls - base
        velocity, displacement = integrate_linear(relative, self.dt_s)
        object.__setattr__(self, "walls_m_s2", walls)
        object.__setattr__(self, "relative_m_s2", relative)
        object.__setattr__(self, "relative_m_s", velocity)
        object.__setattr__(self, "relative_m", displacement)

    @property
    def duration_s(self):
        """Time of the last sample."""
        return (self.base_m_s2.size - 1) * self.dt_s
