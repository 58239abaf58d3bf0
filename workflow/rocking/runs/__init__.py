"""The runs that a configuration describes, their records, and what runs have in common.

Nothing here knows a path of the results, which stand in the rules, and nothing touches Snakemake.
"""

from rocking.runs.runs import CurveKey, Runs
from rocking.runs.shared import Shared

__all__ = ["CurveKey", "Runs", "Shared"]
