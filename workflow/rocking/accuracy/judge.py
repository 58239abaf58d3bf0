"""Dense scans by the independent planar solver, and what of them a reported curve holds.

The judge (`rocking.reference`) shares no code with the solver that screens. It runs every amplitude
at steps of `ida.level_ratio` from half the lowest collapse that the workflow found until all over a
factor `ida.beyond` fall, and steps of `accuracy.judge_step` from below its own lowest collapse to
where everything within ± `ensemble.amplitude_spread` falls. The dense probability at an amplitude
is the share of its histories within that spread that fall; nodes and tolerance are the same.
"""

import math

import numpy as np
import pandas as pd
from scipy.optimize import isotonic_regression

from rocking.collapse import probability
from rocking.reference.facade import outcomes

BLOCK = 16  # amplitudes between two looks at whether the façade has fallen for good
KEY = probability.KEY
SCAN_COLUMNS = (*KEY, "pga_g", "level", "d_over_b", "status", "collapsed")
BAND_COLUMNS = (
    *KEY,
    *("pga_collapse_g", "judge_collapse_g", "judge_fine_g", "collapse_error"),
    *("pga_p10_g", "judge_p10_g", "pga_median_g", "judge_median_g", "pga_p90_g", "judge_p90_g"),
    *("held", "held_pooled", "reversals", "judge_reversals", "judge_runs"),
)


def scan(job, motion_path, direction, settings, start_g):
    """Outcomes of one curve by the judge.

    Parameters
    ----------
    job : dict
        A scene file.
    motion_path : path
        Floor motions.
    direction : str
    settings : dict
        level_ratio, beyond, max_pga_g, judge_step, reference_nodes, reference_tolerance,
        amplitude_spread.
    start_g : float
        Lowest amplitude.

    Returns
    -------
    DataFrame
        pga_g, level (1 for the coarse levels, 0 for the finer ones), d_over_b, status, collapsed;
        by ascending amplitude.
    """

    def run(pga_g, level):
        nodes, tolerance = settings["reference_nodes"], settings["reference_tolerance"]
        found = outcomes(job, motion_path, direction, pga_g, nodes=nodes, tolerance=tolerance)
        table = pd.DataFrame({"pga_g": pga_g, "level": level, "d_over_b": found.d_over_b})
        table["status"] = found.status
        table["collapsed"] = (table["status"] == "overturned").astype(int)
        return table

    ratio, last = 1.0 + settings["level_ratio"], settings["max_pga_g"]
    start = min(start_g, last)
    levels = start * ratio ** np.arange(1 + math.ceil(math.log(last / start) / math.log(ratio)))
    levels[-1] = last
    beyond = math.ceil(math.log(settings["beyond"]) / math.log(ratio))
    coarse = pd.DataFrame()
    for first in range(0, levels.size, BLOCK):
        coarse = pd.concat([coarse, run(levels[first : first + BLOCK], 1)], ignore_index=True)
        if len(coarse) >= beyond and coarse["collapsed"].iloc[-beyond:].all():
            break
    fallen = coarse.loc[coarse["collapsed"] == 1, "pga_g"]
    if fallen.empty:
        return coarse
    spread, step = settings["amplitude_spread"], 1.0 + settings["judge_step"]
    fine, at = [coarse], fallen.min() * (1.0 - spread) ** 2 / ratio
    while at < last:
        more = at * step ** np.arange(BLOCK)
        fine.append(run(more[more <= last], 0))
        at *= step**BLOCK
        table = pd.concat(fine).sort_values("pga_g", ignore_index=True)
        within = table[table["pga_g"] < at * (1.0 - spread)]  # counted in full
        share, _ = probability.probability(
            table["pga_g"], table["collapsed"], within["pga_g"], spread
        )
        if share.max() == 1.0:
            break
    return pd.concat(fine).sort_values("pga_g", ignore_index=True)


def held(pga_g, share, low_g, high_g):
    """Part of a collapse probability that lies between two amplitudes.

    F(high) − F(low), with F the share made non-decreasing, linear between amplitudes; what is never
    reached (NaN) lies above all amplitudes.

    Parameters
    ----------
    pga_g, share : array_like, shape (n,)
        Dense probability by ascending amplitude.
    low_g, high_g : float

    Returns
    -------
    running, pooled : float
        With F the largest share up to an amplitude, whose crossings of 10 and 90 % are what
        "first reached" means; and with F the non-decreasing sequence nearest to the shares in
        least squares, which spreads islands of collapse over what stands above them.
    """
    pga_g, share = np.asarray(pga_g, float), np.asarray(share, float)
    at = [math.inf if math.isnan(g) else g for g in (low_g, high_g)]
    out = []
    for curve in (np.maximum.accumulate(share), isotonic_regression(share).x):
        below, above = np.interp(at, pga_g, curve, left=0.0)
        out.append(float(above - below))
    return tuple(out)


def compare(table, row, spread):
    """What one reported curve holds of the judge's scan.

    Parameters
    ----------
    table : DataFrame
        Of `scan`.
    row : mapping
        The curve's row of tables/ida_collapse.csv.
    spread : float
        Half width within which a share is counted, over the amplitude.

    Returns
    -------
    dict
        BAND_COLUMNS; blank where neither fell.
    """
    valid = table[table["status"] != "failed"]
    pga_g, fell = valid["pga_g"].to_numpy(), valid["collapsed"].to_numpy()
    share, _ = probability.probability(pga_g, fell, pga_g, spread)
    levels = (probability.first_crossing(pga_g, share, level) for level in probability.LEVELS)
    low, middle, high = levels
    coarse = valid[valid["level"] == 1]
    lowest = coarse.loc[coarse["collapsed"] == 1, "pga_g"].min()
    running, pooled = held(pga_g, share, row["pga_p10_g"], row["pga_p90_g"])
    return {
        **{key: row[key] for key in (*KEY, "reversals")},
        **{f"pga_{key}_g": row[f"pga_{key}_g"] for key in ("collapse", "p10", "median", "p90")},
        "judge_collapse_g": lowest,
        "judge_fine_g": valid.loc[valid["collapsed"] == 1, "pga_g"].min(),
        "collapse_error": row["pga_collapse_g"] / lowest - 1.0,
        "judge_p10_g": low,
        "judge_median_g": middle,
        "judge_p90_g": high,
        "held": running,
        "held_pooled": pooled,
        "judge_reversals": probability.reversals(coarse["collapsed"]),
        "judge_runs": len(table),
    }
