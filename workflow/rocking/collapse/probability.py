"""Where a curve collapses: the one home of probability, first crossings and what is safe.

Near collapse a façade stands at one amplitude, falls at the next and stands again, so a curve
has no single collapse intensity. Its collapse probability at an amplitude is the share of
realisations that fall within ± `spread` of it, realisations that differ in amplitude, node layout
and step together. That is numerical scatter of one façade under one motion; it says nothing of
materials or of other motions. A façade that never fell has no crossing: blank, and its largest
intensity a lower bound.
"""

import math

import numpy as np
import pandas as pd

from yade_scripts.studies.confirm import Confirmation

LEVELS = (0.10, 0.50, 0.90)
WINDOW = math.log(1.01)  # of amplitude, in which what is left unseen is counted
CALM = 0.3  # d/b below which nothing that falls hides
SCATTER, FEW = 0.03, 5  # of d/b about one branch; histories that tell it
ODDS, SHIFT = 9.0, 1.03  # factors on p/(1 − p) and on amplitude: a scan so far off is refuted
KEY = ["model", "record", "direction"]
COLUMNS = [
    *KEY,
    *(f"pga_{name}_g" for name in ("safe", "collapse", "median", "p10", "p90", "all", "max")),
    *("reversals", "runs_planar", "runs_yade", "disagreements"),
    *("collapse_fell", "collapse_realisations", "safe_bound", "confirmed"),
]
PROBABILITY_COLUMNS = [
    *(*KEY, "pga_g", "probability", "realisations"),
    *("probability_yade", "realisations_yade", "agrees"),
]


def probability(pga_g, collapsed, at_g, spread):
    """Collapse probability: share of the amplitudes within ± spread whose realisations collapsed.

    Every realisation stands for the amplitudes nearest to it, by their ratio, so that where a
    search has run more of them they do not count for more. Equal steps make it a plain share.

    Parameters
    ----------
    pga_g, collapsed : array_like, shape (n,)
        Realisations by ascending amplitude; collapsed 0 or 1.
    at_g : array_like, shape (m,)
    spread : float
        Half width relative to the amplitude.

    Returns
    -------
    share : ndarray, shape (m,)
        NaN where no realisation lies.
    realisations : ndarray of int, shape (m,)
    """
    pga_g, at_g = np.asarray(pga_g, float), np.asarray(at_g, float)
    first, last = _within(pga_g, at_g, spread)
    collapsed = np.asarray(collapsed, float)
    total, fell = _ranges(np.ones(pga_g.size), first, last), _ranges(collapsed, first, last)
    width = _widths(pga_g)
    wide, fell_wide = _ranges(width, first, last), _ranges(width * collapsed, first, last)
    with np.errstate(invalid="ignore", divide="ignore"):
        # all at one amplitude: nothing to stand for
        share = np.where(wide > 0.0, fell_wide / wide, fell / total)
    return np.clip(share.round(12), 0.0, 1.0), last - first  # sums of widths leave 1e-15


def _within(pga_g, at_g, spread):
    """First and behind the last of ascending amplitudes within ± spread of each."""
    first = np.searchsorted(pga_g, at_g * (1.0 - spread) * (1.0 - 1e-12), side="left")
    return first, np.searchsorted(pga_g, at_g * (1.0 + spread) * (1.0 + 1e-12), side="right")


def _ranges(values, first, last):
    """Sums of values over ranges of places."""
    total = np.concatenate(([0.0], np.cumsum(values)))
    return total[last] - total[first]


def _widths(pga_g):
    """Width in ln amplitude for which each of ascending amplitudes stands."""
    if pga_g.size < 2:
        return np.zeros(pga_g.size)
    gap = np.diff(np.log(pga_g))
    return 0.5 * (np.append(gap[:1], gap) + np.append(gap, gap[-1:]))


def windows(low_g, high_g):
    """Lower ends of windows of the width ln(1.01) between two amplitudes, from the lower up [g].

    The first begins half a width above the lower one: levels 1 % apart lie within windows, where on
    their edges the last digit would say in which.
    """
    count = math.floor(math.log(high_g / low_g) / WINDOW - 0.5 + 1e-9)
    return low_g * np.exp(WINDOW * (0.5 + np.arange(max(count, 0))))


def doubtful(pga_g, d_over_b, low_g):
    """Windows of amplitude in which a fall could hide among what stood.

    One could if a peak d/b in it or within one window's width beside it is at least `CALM`, and the
    peaks there scatter by more than `SCATTER` about a straight line in ln amplitude: where a
    façade's answers follow one branch, neighbours say what it does between them. Where too few were
    run to tell, or d/b is not known, one could.

    Parameters
    ----------
    pga_g, d_over_b : array_like, shape (n,)
        Of histories that stood, by ascending amplitude.
    low_g : array_like, shape (m,)
        Of `windows`.

    Returns
    -------
    ndarray of bool, shape (m,)
    """
    at, d_over_b = np.log(np.asarray(pga_g, float)), np.asarray(d_over_b, float)
    low = np.log(np.asarray(low_g, float))
    ends = np.searchsorted(at, low - WINDOW), np.searchsorted(at, low + 2.0 * WINDOW)
    found = np.zeros(low.size, bool)
    for k, (i, j) in enumerate(zip(*ends, strict=True)):
        near = d_over_b[max(i - 1, 0) : j + 1]
        if near.size and near.max() < CALM:
            continue
        x, y = at[i:j], d_over_b[i:j]
        if y.size < FEW or np.isnan(y).any():
            found[k] = True
            continue
        x = x - x.mean()
        line = y.mean() + x * (x @ y) / max(x @ x, 1e-30)
        found[k] = np.abs(y - line).max() > SCATTER
    return found


def single_runs(runs, spread):
    """Collapse probability of a curve of single runs, each at an amplitude of its own.

    Every run stands for the amplitudes nearest to it, by their ratio; the probability is the
    share of the interval ± spread whose nearest run collapsed, linear between the rows returned.

    Parameters
    ----------
    runs : DataFrame
        By ascending pga_g, with collapsed (0 or 1), see `outcomes`; at least one row.
    spread : float

    Returns
    -------
    DataFrame
        pga_g, probability_yade, realisations_yade (runs within ± spread, 0 between two distant
        ones).
    """
    pga_g, collapsed = runs["pga_g"].to_numpy(float), runs["collapsed"].to_numpy(float)
    edge = np.sqrt(pga_g[1:] * pga_g[:-1])
    turn = edge[collapsed[1:] != collapsed[:-1]]
    at = np.unique(np.concatenate([pga_g, turn / (1.0 + spread), turn / (1.0 - spread)]))
    ends = [pga_g[0] * (1.0 - 2.0 * spread), pga_g[-1] * (1.0 + 2.0 * spread)]
    at = at[(at >= pga_g[0]) & (at <= pga_g[-1])]
    edge = np.log(np.concatenate([ends[:1], edge, ends[1:]]))
    fallen = np.concatenate(([0.0], np.cumsum(collapsed * np.diff(edge))))
    low, high = np.log(at * (1.0 - spread)), np.log(at * (1.0 + spread))
    share = (np.interp(high, edge, fallen) - np.interp(low, edge, fallen)) / (high - low)
    _, realisations = probability(pga_g, collapsed, at, spread)
    share = np.clip(share.round(9), 0.0, 1.0)
    return pd.DataFrame({"pga_g": at, "probability_yade": share, "realisations_yade": realisations})


def first_crossing(pga_g, share, level):
    """Lowest amplitude at which a share is first reached [g]; NaN if it never is.

    Linear between the amplitudes before and at the crossing.
    """
    above = np.flatnonzero(np.asarray(share) >= level)
    if above.size == 0:
        return np.nan
    k = int(above[0])
    if k == 0 or not share[k - 1] < level:
        return float(pga_g[k])
    weight = (level - share[k - 1]) / (share[k] - share[k - 1])
    return float(pga_g[k - 1] + weight * (pga_g[k] - pga_g[k - 1]))


def reversals(collapsed):
    """How often the outcome changes along ascending amplitudes, beyond the first collapse."""
    changes = int(np.count_nonzero(np.diff(np.asarray(collapsed, int))))
    return max(changes - 1, 0)


def from_scan(scan, spread):
    """Collapse probability of a scanned curve at all its amplitudes.

    Parameters
    ----------
    scan : DataFrame
        pga_g, status, collapsed; failed realisations say nothing and are left out.
    spread : float

    Returns
    -------
    DataFrame
        pga_g, probability, realisations.
    """
    valid = scan[scan["status"] != "failed"].sort_values("pga_g", ignore_index=True)
    share, realisations = probability(valid["pga_g"], valid["collapsed"], valid["pga_g"], spread)
    return pd.DataFrame(
        {"pga_g": valid["pga_g"], "probability": share, "realisations": realisations}
    )


def summary(scan, curve, realisations, spread):
    """Collapse intensities of one curve, from all that was run for it.

    Parameters
    ----------
    scan : DataFrame or None
        Outcomes of the planar solver; None for a model without a planar counterpart.
    curve, realisations : DataFrame
        YADE's runs and the realisations of its ensembles: pga_g, status, collapsed (and, of
        realisations, amplitude_factor).
    spread : float

    Returns
    -------
    dict
        See COLUMNS: highest amplitude that stood with nothing falling within + spread of it or
        below, in either method; lowest that fell; first crossings of 10, 50 and 90 %; amplitude
        from which all collapse; largest that was run; how many fell, of how many, within ± spread
        of the lowest that fell; what may hide below the safe one (`unseen`).
    """
    own = [table for table in (curve, realisations) if len(table)]
    every = outcomes(*own) if scan is None else outcomes(*own, scan)
    dense = every if scan is None else outcomes(scan)
    fell, stood = every[every["collapsed"] == 1]["pga_g"], every[every["collapsed"] == 0]["pga_g"]
    lowest = fell.min() if len(fell) else np.nan
    highest = stood.max() if len(stood) else np.nan
    at_g = dense["pga_g"]
    share, _ = probability(at_g, dense["collapsed"], at_g, spread)
    if scan is None and len(realisations) and len(every):
        at_g, share = single_runs(every, spread)[["pga_g", "probability_yade"]].to_numpy().T
    low, middle, high = (first_crossing(at_g, share, level) for level in LEVELS)
    above = every["pga_g"][every["pga_g"] > highest]
    safe = stood[~(stood * (1.0 + spread) >= lowest)].max()
    low_at, high_at = _within(every["pga_g"].to_numpy(), np.array([lowest]), spread)
    beside = every["collapsed"].iloc[int(low_at[0]) : int(high_at[0])]
    return {
        "pga_safe_g": safe,
        "pga_collapse_g": lowest,
        "pga_median_g": middle,
        "pga_p10_g": low,
        "pga_p90_g": high,
        "pga_all_g": above.min() if len(fell) and len(above) else np.nan,
        "pga_max_g": every["pga_g"].max(),
        "reversals": reversals(dense["collapsed"]),
        "runs_planar": 0 if scan is None else len(scan),
        "runs_yade": len(curve) + len(realisations),
        "collapse_fell": int(beside.sum()) if len(fell) else np.nan,
        "collapse_realisations": len(beside) if len(fell) else np.nan,
        "safe_bound": unseen(dense, dense["pga_g"].min(), np.fmin(lowest, every["pga_g"].max())),
    }


def unseen(runs, low_g, high_g, confidence=0.95):
    """Collapse probability that may hide in 1 % of amplitude below the lowest fall: an upper bound.

    Of n histories in a window that all stood the bound is 1 − (1 − confidence)^(1/n) (Clopper and
    Pearson, 1934); returned is that of the window with the fewest, of those that are `doubtful` and
    the one next to the lowest fall.

    Parameters
    ----------
    runs : DataFrame
        Of `outcomes`, by one solver: between two, peaks differ where nothing hides.
    low_g, high_g : float
        Where the windows begin and end [g]; nothing fell between.

    Returns
    -------
    float
        NaN where nothing fell and no window is doubtful.
    """
    stood = runs[(runs["collapsed"] == 0) & (runs["pga_g"] < high_g)]
    if not len(stood) or not low_g < high_g:
        return np.nan
    low, pga_g = windows(low_g, high_g), stood["pga_g"].to_numpy()
    counts = np.diff(np.searchsorted(pga_g, np.append(low, low[-1:] * math.exp(WINDOW))))
    doubt = doubtful(pga_g, stood["d_over_b"], low)
    doubt[-1:] |= high_g < runs["pga_g"].max()
    counts = counts[doubt]
    if not counts.size:
        return np.nan
    return 1.0 - (1.0 - confidence) ** (1.0 / counts.min()) if counts.min() else 1.0


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


def confirmed(scan, ensemble, spread):
    """Whether YADE's realisations confirm the scan's probabilities, see `confirm.Confirmation`.

    Parameters
    ----------
    scan, ensemble : DataFrame
        Of one curve; None or empty where there is none.
    spread : float

    Returns
    -------
    float
        1: yes, 0: they refute them, NaN: open, or one of the two is missing.
    """
    if scan is None or not len(ensemble):
        return np.nan
    test, own = Confirmation(), outcomes(ensemble)
    rows = alternatives(scan, own["pga_g"], spread)
    for probabilities, collapsed in zip(rows, own["collapsed"], strict=True):
        test.add(probabilities, collapsed)
    return np.nan if test.verdict is None else float(test.verdict)


def outcomes(*tables):
    """Amplitude, outcome and d/b of every run that did not fail, by ascending amplitude."""
    parts = []
    for table in tables:
        valid = table[table["status"] != "failed"]
        pga_g = valid["pga_g"] * valid.get("amplitude_factor", 1.0)
        part = pd.DataFrame({"pga_g": pga_g, "collapsed": valid["collapsed"].astype(int)})
        parts.append(part.assign(d_over_b=valid.get("d_over_b", np.nan)))
    return pd.concat(parts).sort_values("pga_g", ignore_index=True)


def brackets(table, row, count=10):
    """Collapse of one curve as intervals of equal weight, for a likelihood.

    A curve whose probability is known counts as `count` realisations: the k-th collapses where the
    probability first reaches (k − ½)/count, between that amplitude and the one before; where it
    never does, above the largest. A curve without one counts as one realisation, between what
    is safe and what collapsed.

    Parameters
    ----------
    table : DataFrame
        Rows of tables/collapse_probability.csv of the curve; those of YADE alone if not scanned.
    row : mapping
        Its row of tables/ida_collapse.csv.
    count : int

    Returns
    -------
    list of (low, high, weight)
        [g]; high = ∞ where the realisation never collapsed. Empty where every run failed.
    """
    by = "" if table["realisations"].notna().any() else "_yade"
    dense = table[table[f"realisations{by}"].notna()]
    if not len(dense):
        known = {k: float(row[f"pga_{k}_g"]) for k in ("safe", "collapse", "max")}
        if math.isfinite(known["collapse"]):
            return [(np.nan_to_num(known["safe"]), known["collapse"], 1.0)]
        return [(known["max"], math.inf, 1.0)] if math.isfinite(known["max"]) else []
    pga_g, share = dense["pga_g"].to_numpy(), np.maximum.accumulate(dense[f"probability{by}"])
    out = []
    for level in (np.arange(count) + 0.5) / count:
        k = int(np.searchsorted(share, level))
        low = pga_g[k - 1] if k else 0.0
        out.append((low, pga_g[k] if k < len(pga_g) else math.inf, 1.0 / count))
    return out


def collapse_ranges(pga_g, share):
    """Intervals of amplitude in which a majority collapses, ascending.

    Returns
    -------
    list of (low, high)
        [g]; the last may end with the scan.
    """
    mostly = np.asarray(share) >= 0.5
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mostly, [False])).astype(int)))
    pga_g = np.asarray(pga_g)
    return [(float(pga_g[a]), float(pga_g[b - 1])) for a, b in edges.reshape(-1, 2)]


def compared(scan, ensemble, spread, error=0.01):
    """Collapse probability against amplitude by both methods, and whether they agree.

    At the scan's amplitudes the planar probability; at the levels of YADE's ensemble the share of
    its realisations too. The two agree unless an exact test (Fisher) of the two shares, of YADE's
    realisations and of the planar ones within ± spread, rejects with a probability of error
    `error`.

    Parameters
    ----------
    scan, ensemble : DataFrame
        Of one curve; None or empty where there is none.
    spread, error : float

    Returns
    -------
    DataFrame
        pga_g, probability, realisations, probability_yade, realisations_yade, agrees; blank where a
        method says nothing.
    """
    from scipy.stats import fisher_exact  # slow to load, and a plan needs none

    dense = pd.DataFrame(columns=["pga_g", "probability", "realisations"])
    if scan is not None:
        dense = from_scan(scan, spread)
        valid = scan[scan["status"] != "failed"].sort_values("pga_g")
    rows = []
    valid_realisations = ensemble[ensemble["status"] != "failed"] if len(ensemble) else ensemble
    for pga_g, group in valid_realisations.groupby("pga_g") if len(valid_realisations) else ():
        fell, own = int(group["collapsed"].sum()), len(group)
        row = {"pga_g": pga_g, "probability_yade": fell / own, "realisations_yade": own}
        if scan is not None:
            (share,), (count,) = probability(valid["pga_g"], valid["collapsed"], [pga_g], spread)
            planar = round(share * count) if count else 0
            p = fisher_exact([[fell, own - fell], [planar, count - planar]])[1] if count else 1.0
            row |= {"probability": share, "realisations": count, "agrees": int(p >= error)}
        rows.append(row)
    both = [dense, *([pd.DataFrame(rows)] if rows else [])]
    table = pd.concat([part for part in both if len(part)] or both)
    return table.reindex(columns=PROBABILITY_COLUMNS[3:]).sort_values("pga_g", ignore_index=True)
