"""Prescribed motions along y: their amplitude, their integral, their end."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

GROUND, VERTICAL = "ground", "vertical"  # names of motions beside those of floors
SIGNS = {"pos": 1.0, "neg": -1.0}  # of the record along the outward normal


def along(name):
    """Name of the motion along the façade (x) that goes with one out of plane; None for None."""
    return f"along {name}" if name else None


def amplitude(ground_m_s2, direction, pga_g):
    """Factor that brings a motion to a peak ground acceleration [g]; its sign is the direction."""
    return SIGNS[direction] * pga_g * STANDARD_GRAVITY_M_S2 / float(np.max(np.abs(ground_m_s2)))


@lru_cache(maxsize=4)
def _numbers(data):
    return np.frombuffer(data).tolist()


def numbers(time_s):
    """Times of a motion as a list, the same one for all motions of one time axis.

    YADE keeps every number that it converts for ever, see `engine.memory`: so it keeps these once.
    """
    return _numbers(np.asarray(time_s, float).tobytes())


@dataclass
class SupportMotion:
    """A support's prescribed acceleration along y, linear between samples.

    A motion that does not end at zero gets one more sample that does: YADE holds the last value,
    and floors that still ring would part from each other without end.
    """

    time_s: np.ndarray
    acceleration_m_s2: np.ndarray

    def __post_init__(self):
        """Let the acceleration end at zero."""
        largest = np.max(np.abs(self.acceleration_m_s2))
        if abs(self.acceleration_m_s2[-1]) > 1e-9 * largest:
            end = 2.0 * self.time_s[-1] - self.time_s[-2]
            self.time_s = np.append(self.time_s, end)
            self.acceleration_m_s2 = np.append(self.acceleration_m_s2, 0.0)

    @classmethod
    def none(cls, duration_s):
        """Rest for so long [s]."""
        return cls(np.array([0.0, duration_s]), np.zeros(2))

    @property
    def duration_s(self):
        """Time of the last sample [s]."""
        return float(self.time_s[-1])

    @property
    def velocity_m_s(self):
        """Velocity from rest at every sample, integrated exactly, shape (n,)."""
        step, a = np.diff(self.time_s), self.acceleration_m_s2
        return np.concatenate(([0.0], np.cumsum(0.5 * step * (a[1:] + a[:-1]))))

    def position(self, time_s):
        """Position from rest [m], integrated exactly; constant speed after the last sample."""
        t, a, v = self.time_s, self.acceleration_m_s2, self.velocity_m_s
        step = np.diff(t)
        y = np.concatenate(
            ([0.0], np.cumsum(v[:-1] * step + step**2 * (2.0 * a[:-1] + a[1:]) / 6.0))
        )
        time_s = np.asarray(time_s, float)
        i = np.clip(np.searchsorted(t, time_s, side="right") - 1, 0, len(t) - 2)
        s = np.minimum(time_s, t[-1]) - t[i]
        slope = (a[i + 1] - a[i]) / step[i]
        inside = y[i] + v[i] * s + 0.5 * a[i] * s**2 + slope * s**3 / 6.0
        return inside + v[-1] * np.maximum(time_s - t[-1], 0.0)

    def peak_speed(self):
        """Largest |velocity| of the integrated motion [m/s]."""
        return float(np.max(np.abs(self.velocity_m_s)))
