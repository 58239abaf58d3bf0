"""Whether YADE's outcomes agree with the collapse probabilities of a dense scan."""

import numpy as np
import pandas as pd

from rocking.collapse.probability import PROBABILITY_COLUMNS, from_scan, outcomes, probability
from yade_scripts.commands.confirm import Confirmation
from yade_scripts.commands.search import DIGITS

ODDS, SHIFT = 9.0, 1.03  # factors on p/(1 − p) and on amplitude: a scan so far off is refuted


def alternatives(scan, pga_g, spread):
    """Collapse probabilities that YADE's outcomes are held against, see `confirm.Confirmation`.

    The scan's share within ± spread, kept off 0 and 1 by Jeffreys' (k + ½)/(n + 1). A façade that
    falls more often has `ODDS` times as large a p/(1 − p), or what the scan says `SHIFT` times
    higher up, whichever is more; one that falls less often likewise.

    Parameters
    ----------
    scan : DataFrame
        Of a dense scan.
    pga_g : array_like, shape (n,)
    spread : float

    Returns
    -------
    ndarray, shape (n, 3)
        Of the scan, of more often, of less often.
    """
    seen, pga_g = outcomes(scan), np.asarray(pga_g, float)

    def said(at_g):
        share, count = probability(seen["pga_g"], seen["collapsed"], at_g, spread)
        return (np.where(count > 0, share, 0.0) * count + 0.5) / (count + 1.0)

    p = said(pga_g)
    more = np.maximum(ODDS * p / (1.0 - p + ODDS * p), said(pga_g * SHIFT))
    less = np.minimum(p / (ODDS * (1.0 - p) + p), said(pga_g / SHIFT))
    return np.column_stack((p, more, less))


def told(scan, pga_g, spread):
    """`alternatives` of single runs that tell something of the scan's probabilities.

    Those between its lowest collapse and the highest amplitude that stood. Below and above it
    outcomes hardly differ by any rival; the lowest collapse was chosen for having fallen.

    Parameters
    ----------
    scan, pga_g, spread
        As of `alternatives`.

    Returns
    -------
    list of list of 3 floats or None
        One for each amplitude.
    """
    pga_g, status = np.asarray(pga_g, float), scan["status"]
    lowest = scan.loc[status == "overturned", "pga_g"].min()
    highest = scan.loc[status == "ok", "pga_g"].max()
    between = (pga_g > lowest + 10.0**-DIGITS) & (pga_g < highest)
    rows = alternatives(scan, pga_g, spread).round(4).tolist()
    return [row if inside else None for row, inside in zip(rows, between, strict=True)]


def confirmed(scan, curve, ensemble, spread):
    """Whether YADE's runs confirm the scan's probabilities, see `confirm.Confirmation`.

    Parameters
    ----------
    scan, curve, ensemble : DataFrame
        Of one curve: the dense scan, YADE's single runs (see `told`) and its realisations; None or
        empty where there is none.
    spread : float

    Returns
    -------
    float
        1: yes, 0: they refute them, NaN: open, or scan or realisations are missing.
    """
    if scan is None or not len(ensemble):
        return np.nan
    test, realisations = Confirmation(), outcomes(ensemble)
    rows = alternatives(scan, realisations["pga_g"], spread)
    for probabilities, collapsed in zip(rows, realisations["collapsed"], strict=True):
        test.add(probabilities, collapsed)
    alone = outcomes(curve) if len(curve) else curve.reindex(columns=["pga_g", "collapsed"])
    for probabilities, collapsed in zip(
        told(scan, alone["pga_g"], spread), alone["collapsed"], strict=True
    ):
        if probabilities:
            test.add(probabilities, collapsed, alone=True)
    return np.nan if test.verdict is None else float(test.verdict)


def compared(scan, ensemble, spread, error=0.01):
    """Collapse probability against amplitude by both methods, and whether they agree.

    At the scan's amplitudes the planar probability; at the levels of YADE's ensemble the share of
    its realisations too. The two agree unless an exact test (Fisher) of the two shares, of YADE's
    realisations and of the planar ones within ± spread, rejects with a probability of error
    `error`.

    Parameters
    ----------
    scan, ensemble : DataFrame
        Tables of one curve. A missing table is None or empty; without a scan the result is empty.
    spread, error : float

    Returns
    -------
    DataFrame
        pga_g, probability, realisations, probability_yade, realisations_yade, agrees; blank where a
        method says nothing.
    """
    from scipy.stats import fisher_exact  # slow to load, and a plan needs none

    if scan is None:
        return pd.DataFrame(columns=PROBABILITY_COLUMNS[3:])
    dense = from_scan(scan, spread)
    valid = scan[scan["status"] != "failed"].sort_values("pga_g")
    rows = []
    valid_realisations = ensemble[ensemble["status"] != "failed"] if len(ensemble) else ensemble
    for pga_g, group in valid_realisations.groupby("pga_g") if len(valid_realisations) else ():
        fell, runs = int(group["collapsed"].sum()), len(group)
        (share,), (count,) = probability(valid["pga_g"], valid["collapsed"], [pga_g], spread)
        planar = round(share * count) if count else 0
        p = fisher_exact([[fell, runs - fell], [planar, count - planar]])[1] if count else 1.0
        seen = {"probability_yade": fell / runs, "realisations_yade": runs}
        row = {"pga_g": pga_g, **seen, "probability": share, "realisations": count}
        rows.append(row | {"agrees": int(p >= error)})
    both = [dense, *([pd.DataFrame(rows)] if rows else [])]
    table = pd.concat([part for part in both if len(part)] or both)
    return table.reindex(columns=PROBABILITY_COLUMNS[3:]).sort_values("pga_g", ignore_index=True)


def disagreements(table):
    """Levels at which both methods were compared and differ.

    Parameters
    ----------
    table : DataFrame
        Of `compared`.

    Returns
    -------
    int or NA
        NA where none was compared: no scan, or no ensemble in YADE.
    """
    known = table["agrees"].dropna()
    return int((known == 0).sum()) if len(known) else pd.NA
