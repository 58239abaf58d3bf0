"""Under what share of a run's motions a façade stands, as it is and with its rows of ties.

The rows follow from few motions that fit the spectrum of the demand. Here each motion of the run
counts once in each direction, scaled to the PGA of the demand: what `assessment.tie_share` asks.
"""

from rocking.collapse.case import Variant
from rocking.collapse.curve import collapse_curves

COLUMNS = ["model", "rows", "pga_g", "curves", "stood", "failed", "share_stands"]


def shares(cases, entries, shaken, pga_g):
    """Rows of COLUMNS: each model without added rows of ties, and with them where there are any.

    Parameters
    ----------
    cases : sequence of rocking.collapse.case.Case
        Of each model one, without the rows.
    entries : list of dict
        The rows, entries of facade.ties.
    shaken : sequence of (Motion, direction)
    pga_g : float
        Of all motions [g].

    A history that failed neither stood nor fell: it is left out of the share, which is NaN where
    none is left.
    """
    rows = []
    for case in cases:
        with_rows = case.varied(Variant("ties", added={"facade.ties": entries}))
        for count, trial in ((0, case), (len(entries), with_rows)) if entries else ((0, case),):
            curves = collapse_curves(trial, shaken, search="list", settings={"pga_g": [pga_g]})
            status = [curve.status[0] for curve in curves]
            stood, failed = status.count("ok"), status.count("failed")
            valid = len(status) - failed
            share = stood / valid if valid else float("nan")
            rows.append((case.model, count, pga_g, len(status), stood, failed, share))
    return [dict(zip(COLUMNS, row, strict=True)) for row in rows]
