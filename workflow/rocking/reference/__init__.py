"""Planar rigid-block solver, independent of YADE and of the scene code, used as the reference.

Mechanics of one block on a compliant base and, optionally, in front of moving
return walls: `wall` describes it, `contact` holds the interface law, `motion`
the supports, `adaptive` and `batch` integrate.
"""

from .adaptive import AdaptiveHistory, simulate
from .batch import BatchResult, simulate_batch
from .integrate import Steps
from .motion import SupportTable
from .wall import Wall

__all__ = [
    "AdaptiveHistory",
    "BatchResult",
    "Steps",
    "SupportTable",
    "Wall",
    "simulate",
    "simulate_batch",
]
