"""One history, by whichever solver."""

from dataclasses import dataclass

import pandas as pd


@dataclass(frozen=True)
class History:
    """One history.

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

    def __repr__(self):
        """Return one line: outcome, peak, rows."""
        return f"History {self.status}: peak d/b {self.d_over_b:.3f}, {len(self.table)} rows"
