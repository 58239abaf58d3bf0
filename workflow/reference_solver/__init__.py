"""The second solver, written apart from the first and from YADE, so that they can be compared.

One block on a compliant base, alone or in front of moving return walls: `wall` describes it,
`contact` holds the interface law, `motion` the supports, `adaptive` and `batch` integrate. Several
blocks: `stack`. Façades of a configuration: `facade`.
"""

from .adaptive import AdaptiveHistory, simulate
from .batch import BatchResult, simulate_batch
from .motion import SupportTable
from .wall import Wall

__all__ = [
    "AdaptiveHistory",
    "BatchResult",
    "SupportTable",
    "Wall",
    "simulate",
    "simulate_batch",
]
