"""A study: its runs, their records, and which files each part of it consists of.

The rules ask `Study` and the small classes beside it (one a topic) which files they need; methods
that take `wildcards` are input functions of rules. Nothing here touches Snakemake.
"""

from rocking.study.accuracy import Accuracy
from rocking.study.assessment import Assessment
from rocking.study.boundary import Boundary
from rocking.study.building import Building
from rocking.study.calibration import Calibration
from rocking.study.compare import Compare
from rocking.study.complete import Complete
from rocking.study.core import Study
from rocking.study.fragility import Fragility
from rocking.study.premises import Premises
from rocking.study.risk import Risk
from rocking.study.strengthening import Strengthening
from rocking.study.surrogates import Surrogates
from rocking.study.two_components import TwoComponents
from rocking.study.uncertainty import Uncertainty
from rocking.study.vertical import Vertical

__all__ = [
    "Accuracy",
    "Assessment",
    "Boundary",
    "Building",
    "Calibration",
    "Compare",
    "Complete",
    "Fragility",
    "Premises",
    "Risk",
    "Strengthening",
    "Study",
    "Surrogates",
    "TwoComponents",
    "Uncertainty",
    "Vertical",
]
