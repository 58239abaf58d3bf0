"""One history, by whichever solver."""

import math
from dataclasses import dataclass

import pandas as pd


class Outcome:
    """What is compared by a few facts (`_facts`, hashable) and by every row of its table."""

    table: pd.DataFrame

    @property
    def _facts(self) -> tuple:
        raise NotImplementedError

    def __eq__(self, other: object) -> bool:
        """Tell whether facts and every row are the same."""
        if type(other) is not type(self):
            return NotImplemented
        return self._facts == other._facts and self.table.equals(other.table)

    def __hash__(self) -> int:
        """Return the hash of the facts."""
        return hash(self._facts)


@dataclass(frozen=True, eq=False)
class History(Outcome):
    """One history: how a case moved under one motion at one intensity.

    Attributes
    ----------
    table : DataFrame
        time_s, d_over_b, velocity_m_s, rotation_rad (outward), and what the solver adds.
    d_over_b : float
        Largest |d|/b; NaN where the run failed.
    status : str
    broken : int or None
        Bonds that broke; None where the solver does not count them.
    """

    table: pd.DataFrame
    d_over_b: float
    status: str
    broken: int | None = None

    @property
    def _facts(self) -> tuple:
        peak = None if math.isnan(self.d_over_b) else self.d_over_b
        return peak, self.status, self.broken, len(self.table)

    def __repr__(self) -> str:
        """Return one line: outcome, peak, rows."""
        return f"History {self.status}: peak d/b {self.d_over_b:.3f}, {len(self.table)} rows"
