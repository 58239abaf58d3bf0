"""Dense scans by the independent planar solver, and what of them a reported curve covers.

The reference solver (`reference_solver`) shares no code with the compiled one. Its
search is `dense`, from half the lowest collapse that the workflow found, with
`accuracy.reference_scan_step` for the fine steps. The dense probability at an amplitude
is the share of its histories within that spread that fall; nodes and tolerance are the same.
"""

import math

import numpy as np
import pandas as pd
from reference_solver.facade import outcomes
from rocking.collapse import probability
from scipy.optimize import isotonic_regression

from studies.accuracy.dense import dense
from yade_scripts.commands.search import drive

KEY = probability.KEY
SCAN_COLUMNS = (*KEY, "pga_g", "level", "d_over_b", "status", "collapsed")
BAND_COLUMNS = (
    *(*KEY, "pga_collapse_g", "reference_collapse_g", "reference_fine_g", "collapse_error"),
    *("pga_p10_g", "reference_p10_g", "pga_median_g", "reference_median_g"),
    *("pga_p90_g", "reference_p90_g"),
    *("coverage", "coverage_pooled", "reversals", "reference_reversals", "reference_runs"),
)


def scan(job, motion_path, direction, settings, start_g):
    """Outcomes of one curve by the reference solver, by ascending amplitude from `start_g` up.

    `settings` has level_ratio, beyond, max_pga_g, amplitude_spread, reference_scan_step,
    reference_nodes and reference_tolerance. Columns are pga_g, level (1 for the coarse levels, 0
    for the finer ones), d_over_b, status and collapsed.
    """
    nodes, tolerance = settings["reference_nodes"], settings["reference_tolerance"]
    parts: list[pd.DataFrame] = []

    def run(ask):
        answer = outcomes(job, motion_path, direction, ask.pga_g, nodes=nodes, tolerance=tolerance)
        level = int(not ask.realisations)
        table = pd.DataFrame({"pga_g": ask.pga_g, "level": level, "d_over_b": answer.d_over_b})
        parts.append(table.assign(status=answer.status))
        return answer.status

    drive(dense(start_g, {**settings, "fine_step": settings["reference_scan_step"]}), run)
    table = pd.concat(parts).sort_values("pga_g", ignore_index=True)
    return table.assign(collapsed=(table["status"] == "overturned").astype(int))


def coverage(pga_g, share, low_g, high_g):
    """Part of a collapse probability that lies between two amplitudes, running and pooled.

    F(high) − F(low), with F the share made non-decreasing, linear between amplitudes; what is never
    reached (NaN) lies above all amplitudes. The share is the dense probability by ascending
    amplitude. Running: F is the largest share up to an amplitude, whose crossings of 10 and 90 %
    are what "first reached" means. Pooled: the non-decreasing sequence nearest to the shares in
    least squares, which spreads ranges of collapse over what stands above them.
    """
    pga_g, share = np.asarray(pga_g, float), np.asarray(share, float)
    at = [math.inf if math.isnan(g) else g for g in (low_g, high_g)]
    out = []
    for curve in (np.maximum.accumulate(share), isotonic_regression(share).x):
        below, above = np.interp(at, pga_g, curve, left=0.0)
        out.append(float(above - below))
    return tuple(out)


def compare(table, row, spread):
    """What a reported curve covers of its dense `scan`: BAND_COLUMNS; blank where neither fell.

    `row` is the curve's of tables/ida_collapse.csv; `spread` the half width within which a share is
    counted, over the amplitude.
    """
    valid = table[table["status"] != "failed"]
    pga_g, fell = valid["pga_g"].to_numpy(), valid["collapsed"].to_numpy()
    share, _ = probability.probability(pga_g, fell, pga_g, spread)
    levels = (probability.first_crossing(pga_g, share, level) for level in probability.LEVELS)
    low, middle, high = levels
    coarse = valid[valid["level"] == 1]
    lowest = coarse.loc[coarse["collapsed"] == 1, "pga_g"].min()
    running, pooled = coverage(pga_g, share, row["pga_p10_g"], row["pga_p90_g"])
    return {
        **{key: row[key] for key in (*KEY, "reversals")},
        **{f"pga_{key}_g": row[f"pga_{key}_g"] for key in ("collapse", "p10", "median", "p90")},
        "reference_collapse_g": lowest,
        "reference_fine_g": valid.loc[valid["collapsed"] == 1, "pga_g"].min(),
        "collapse_error": row["pga_collapse_g"] / lowest - 1.0,
        "reference_p10_g": low,
        "reference_median_g": middle,
        "reference_p90_g": high,
        "coverage": running,
        "coverage_pooled": pooled,
        "reference_reversals": probability.reversals(coarse["collapsed"]),
        "reference_runs": len(table),
    }
