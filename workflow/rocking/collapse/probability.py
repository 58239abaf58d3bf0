"""Where a curve collapses: probability, first crossings and what is reported of them.

Near collapse a façade stands at one amplitude, falls at the next and stands again, so a curve
has no single collapse intensity. Its collapse probability at an amplitude is the share of
realisations that fall within ± `spread` of it, realisations that differ in amplitude, node layout
and step together. That is numerical scatter of one façade under one motion; it says nothing of
materials or of other motions. A façade that never fell has no crossing: blank, and its largest
intensity a lower bound. What may hide below the lowest fall stands in `hidden`, whether YADE agrees
in `agreement`.
"""

import math

import numpy as np
import pandas as pd

from rocking.collapse.crossing import between, first_crossing
from rocking.collapse.equivalent import SLOPE, equivalent, thresholds
from rocking.collapse.hidden import unseen

LEVELS = (0.10, 0.50, 0.90)
TOLD = 1e-3  # half width, over the amplitude, to which a threshold is told
KEY = ["model", "record", "direction"]
ENDS = [f"pga_{name}_{end}_g" for name in ("p10", "median", "p90") for end in ("low", "high")]
COLUMNS = [
    *KEY,
    *(f"pga_{name}_g" for name in ("safe", "collapse", "median", "p10", "p90", "all", "max")),
    *("pga_equivalent_g", "pga_building_g", "building_first"),
    *ENDS,
    *("reversals", "runs_planar", "runs_yade", "disagreements"),
    *("collapse_fell", "collapse_realisations", "safe_bound", "confirmed"),
]
PROBABILITY_COLUMNS = [
    *(*KEY, "pga_g", "probability", "realisations"),
    *("probability_yade", "realisations_yade", "agrees", "probability_building"),
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


def summary(scan, curve, realisations, spread, slope=SLOPE):
    """Collapse intensities of one curve, from all that was run for it.

    Parameters
    ----------
    scan : DataFrame or None
        Outcomes of the planar solver; None for a model without a planar counterpart.
    curve, realisations : DataFrame
        YADE's runs and the realisations of its ensembles: pga_g, status, collapsed (and, of
        realisations, amplitude_factor).
    spread : float
    slope : float
        Of the hazard, see `equivalent`.

    Returns
    -------
    dict
        See COLUMNS: highest amplitude that stood with nothing falling within + spread of it or
        below, in either method; lowest that fell; first crossings of 10, 50 and 90 %; amplitude
        from which all collapse; largest that was run; threshold that falls as often in a year;
        between which amplitudes the crossings may lie (`crossing.between`); how many fell, of how
        many, within ± spread of the lowest that fell; what may hide below the safe one (`unseen`).
        Of the building `building.told` says more.
    """
    by_yade = [table for table in (curve, realisations) if len(table)]
    every = outcomes(*by_yade) if scan is None else outcomes(*by_yade, scan)
    dense = every if scan is None else outcomes(scan)
    fell, stood = every[every["collapsed"] == 1]["pga_g"], every[every["collapsed"] == 0]["pga_g"]
    lowest = fell.min() if len(fell) else np.nan
    highest = stood.max() if len(stood) else np.nan
    at_g = dense["pga_g"]
    share, _ = probability(at_g, dense["collapsed"], at_g, spread)
    ends = ranges(dense, spread)
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
        "pga_equivalent_g": equivalent(at_g, share, slope),
        **dict(zip(ENDS, [g for pair in ends for g in pair], strict=True)),
        "reversals": reversals(dense["collapsed"]),
        "runs_planar": 0 if scan is None else len(scan),
        "runs_yade": len(curve) + len(realisations),
        "collapse_fell": int(beside.sum()) if len(fell) else np.nan,
        "collapse_realisations": len(beside) if len(fell) else np.nan,
        "safe_bound": unseen(dense, dense["pga_g"].min(), np.fmin(lowest, every["pga_g"].max())),
    }


def ranges(runs, spread, levels=LEVELS):
    """Between which amplitudes each level is first reached, see `crossing.between` [g].

    Parameters
    ----------
    runs : DataFrame
        Of `outcomes`.
    spread : float
    levels : sequence of float

    Returns
    -------
    list of (low, high)
    """
    pga_g, collapsed = runs["pga_g"].to_numpy(float), runs["collapsed"].to_numpy(float)
    width = _widths(pga_g)
    return [between(pga_g, collapsed, width, spread, level) for level in levels]


def half_collapse(table):
    """PGA of half collapse of each curve, else the middle between what stood and what fell [g].

    Parameters
    ----------
    table : DataFrame
        Of tables/ida_collapse.csv.
    """
    middle = 0.5 * (table["pga_safe_g"].fillna(0.0) + table["pga_collapse_g"])
    return table["pga_median_g"].fillna(middle)


def one_number(table):
    """PGA by which curves are compared: the equivalent one, else as `half_collapse` [g].

    It counts all ranges of collapse, where half collapse is the first crossing alone.

    Parameters
    ----------
    table : DataFrame
        Of tables/ida_collapse.csv; of an earlier version without the equivalent PGA.
    """
    known = table.get("pga_equivalent_g", pd.Series(np.nan, table.index)).astype(float)
    return known.fillna(half_collapse(table))


def outcomes(*tables):
    """Amplitude, outcome, d/b and `reach` of every run that did not fail, by amplitude."""
    parts = []
    for table in tables:
        valid = table[table["status"] != "failed"]
        pga_g = valid["pga_g"] * valid.get("amplitude_factor", 1.0)
        part = pd.DataFrame({"pga_g": pga_g, "collapsed": valid["collapsed"].astype(int)})
        parts.append(part.assign(**{k: valid.get(k, np.nan) for k in ("d_over_b", "reach")}))
    return pd.concat(parts).sort_values("pga_g", ignore_index=True)


def dense_share(table, row):
    """Collapse probability of one curve by ascending amplitude, from the tables of a run.

    Amplitudes that the tables' digits do not tell apart are one, with the largest of their
    probabilities. A curve without a probability, of few runs in YADE, is a threshold at what
    collapsed, or stands as far as it was run.

    Parameters
    ----------
    table : DataFrame
        Rows of tables/collapse_probability.csv of the curve; none if not scanned.
    row : mapping
        Its row of tables/ida_collapse.csv.

    Returns
    -------
    pga_g, share : ndarray, shape (n,)
        Empty where every run failed.
    """
    pga_g, share = _told(table)
    if pga_g.size:
        return pga_g, share
    known = {k: float(row[f"pga_{k}_g"]) for k in ("safe", "collapse", "max")}
    if math.isfinite(known["collapse"]):
        low = np.nan_to_num(known["safe"]) or 0.5 * known["collapse"]
        return np.array([low, known["collapse"]]), np.array([0.0, 1.0])
    there = int(math.isfinite(known["max"]))
    return np.array([known["max"]] * there), np.zeros(there)


def _told(table):
    """Amplitudes and shares of rows that hold a probability."""
    dense = table[table["realisations"].notna()]
    pga_g, share = dense["pga_g"].to_numpy(float), dense["probability"].to_numpy(float)
    first = np.flatnonzero(np.diff(pga_g, prepend=-1.0) > 0.0)  # of rows with the same digits
    return pga_g[first], np.maximum.reduceat(share, first) if first.size else share


def brackets(table, row, count=10, slope=None):
    """Collapse of one curve as intervals of equal weight, for a likelihood.

    A curve whose probability is known counts as `count` realisations. By first crossings the k-th
    collapses where the probability first reaches (k − ½)/count, between that amplitude and the one
    before; where it never does, above the largest. With a slope of the hazard it collapses at the
    threshold that falls as often as the probability exceeds (k − ½)/count, see
    `equivalent.thresholds`. A curve without a probability counts as one realisation, between what
    is safe and what collapsed.

    Parameters
    ----------
    table, row
        As of `dense_share`.
    count : int
    slope : float, optional

    Returns
    -------
    list of (low, high, weight)
        [g]; high = ∞ where the realisation never collapsed. Empty where every run failed.
    """
    pga_g, share = _told(table)
    if not pga_g.size:
        known = {k: float(row[f"pga_{k}_g"]) for k in ("safe", "collapse", "max")}
        if math.isfinite(known["collapse"]):
            return [(np.nan_to_num(known["safe"]), known["collapse"], 1.0)]
        return [(known["max"], math.inf, 1.0)] if math.isfinite(known["max"]) else []
    levels = (np.arange(count) + 0.5) / count
    if slope is not None:
        low, high = thresholds(pga_g, share, levels, slope)
        same = high <= low * (1.0 + 2.0 * TOLD)
        low = np.where(same, low * (1.0 - TOLD), low)
        high = np.where(same, high * (1.0 + TOLD), high)
        return [(a, b, 1.0 / count) for a, b in zip(low, high, strict=True)]
    share, out = np.maximum.accumulate(share), []
    for level in levels:
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
