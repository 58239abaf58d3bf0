"""Compiled planar solver of the single-block scenes: it screens amplitudes, YADE confirms them."""

from .plane import Planar, moving_supports, prepare
from .runs import Motions, Peaks, Series, bodies, history, peaks, stable_step

__all__ = [
    "Motions",
    "Peaks",
    "Planar",
    "Series",
    "bodies",
    "history",
    "moving_supports",
    "peaks",
    "prepare",
    "stable_step",
]
