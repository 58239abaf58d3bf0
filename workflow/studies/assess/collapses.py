"""Where the mechanisms of a façade collapse under each motion, no further than it tells.

A motion fells the façade where it fells one of its mechanisms. So once one has fallen under a
motion, another is asked only whether it falls below that: at amplitudes `RATIO` apart, all at once.
Where it does, a short climb about the lowest of them finds where. A range of collapse that is
narrower than a step may be missed below the other mechanism's, as in the short climb itself.
"""

import math

import numpy as np
import pandas as pd
from rocking.collapse.curve import collapse_curves
from rocking.collapse.quick import LONG_STEP, crossings_of
from rocking.collapse.search import CALM

RATIO = 1.12  # from one amplitude to the next, as of a short climb of W1
DEEP = 0.6  # of the known collapse, where they begin: what falls there climbs from far below
AT_A_TIME = 2  # amplitudes between two looks
BELOW = 1.25  # times below the lowest that falls, where the climb begins; as far above it ends
NOTHING = {"pga_p10_g": math.nan, "pga_median_g": math.nan}


def by_part(parts, turns, most_g, known_g=None, from_g=None):
    """Collapse of some mechanisms, in their order: by part a list of rows, one a turn.

    Parameters
    ----------
    parts : mapping of str to Case
    turns : sequence of (Motion, direction)
    most_g : float
        PGA up to which all are followed.
    known_g : sequence of float, optional
        Half collapse that is known already by turn, NaN where nothing fell: where it is given,
        parts are followed up to the least of it and of the parts before.
    from_g : mapping of str to sequence of float, optional
        By part and turn, up to where it is known to stand; where it is given, no history below is
        run.

    Returns
    -------
    dict of str to list of dict
        As of `quick.crossings_of`, with pga_max_g: up to where the part was followed.
    """
    collapses, least = {}, np.full(len(turns), np.inf)
    if known_g is not None:
        least = np.fmin(least, np.asarray(known_g, float))
    for part, case in parts.items():
        short = np.isfinite(least) & (known_g is not None)
        stands = np.zeros(len(turns)) if from_g is None else np.asarray(from_g[part], float)
        rows: list = [None] * len(turns)
        for mask, follow in ((~short, _climbed), (short, _asked)):
            which = np.flatnonzero(mask)
            if which.size:
                some = [turns[k] for k in which]
                given = case, some, most_g, least[which], stands[which]
                for k, row in zip(which, follow(*given), strict=True):
                    rows[k] = row
        least = np.fmin(least, np.array([row["pga_median_g"] for row in rows], float))
        collapses[part] = rows
    return collapses


def _climbed(case, turns, most_g, _, from_g):
    """Short climbs from where they begin by themselves, or from above where a part stands."""
    rows = [{**NOTHING, "runs_planar": 0, "pga_max_g": float(most_g)} for _ in turns]
    which = [k for k, start in enumerate(from_g) if start < most_g]
    limits = [{"max_pga_g": float(most_g)} | _begun(from_g[k]) for k in which]
    if which:
        climbs = crossings_of(case, [turns[k] for k in which], limits, brief=True)
        for k, climb in zip(which, climbs, strict=True):
            rows[k] |= climb
    return rows


def _begun(from_g):
    """Setting of a climb that begins above where a part stands; none where that is not known."""
    return {"from_g": float(from_g)} if from_g > 0.0 else {}


def _asked(case, turns, most_g, least_g, from_g):
    """Whether and where a part falls below what is known by turn [g], above where it stands.

    The highest amplitudes first, `AT_A_TIME`: where the part stays below d/b of `CALM` at them, as
    a short climb has it, none below is run.
    """
    ends = np.minimum(least_g, most_g)
    count = 1 + math.ceil(math.log(1.0 / DEEP) / math.log(RATIO))
    levels = [end * RATIO ** np.arange(1.0 - count, 0.5) for end in ends]
    levels = [pga_g[pga_g > start] for pga_g, start in zip(levels, from_g, strict=True)]
    first = _listed(case, turns, [pga_g[-AT_A_TIME:] for pga_g in levels])
    moved = list(range(len(turns)))
    for done in range(AT_A_TIME, count, AT_A_TIME):
        moved = [
            k
            for k in moved
            if len(levels[k]) > done and not first[k]["d_over_b"][:AT_A_TIME].max() < CALM
        ]
        lower = [levels[k][:-done][-AT_A_TIME:] for k in moved]
        for k, table in zip(moved, _listed(case, [turns[k] for k in moved], lower), strict=True):
            first[k] = pd.concat([table, first[k]], ignore_index=True)
    rows, again = [], []
    for k, (table, end) in enumerate(zip(first, ends, strict=True)):
        fell = table.loc[table["status"] == "overturned", "pga_g"]
        rows.append({**NOTHING, "runs_planar": len(table), "pga_max_g": float(end)})
        if len(fell):
            deep = from_g[k] == 0.0 and fell.min() <= levels[k][0] * RATIO
            again.append((k, float(fell.min()), deep))
    if again:
        limits = [
            {"max_pga_g": at * BELOW} | ({} if deep else {"from_g": max(at / BELOW, from_g[k])})
            for k, at, deep in again
        ]
        climbs = crossings_of(case, [turns[k] for k, *_ in again], limits, brief=True)
        for (k, at, _), climb in zip(again, climbs, strict=True):
            runs = rows[k]["runs_planar"] + climb["runs_planar"]
            half = climb["pga_median_g"]
            climb["pga_median_g"] = at if math.isnan(half) else half
            rows[k] = {**climb, "runs_planar": runs, "pga_max_g": rows[k]["pga_max_g"]}
    return rows


def _listed(case, turns, levels):
    """Outcomes of a case at stated amplitudes by turn, a table each; of none an empty one."""
    nothing = pd.DataFrame({"pga_g": [], "status": [], "d_over_b": []})
    tables, which = [nothing] * len(turns), [k for k, pga_g in enumerate(levels) if len(pga_g)]
    if which:
        settings = [{"pga_g": levels[k].tolist()} for k in which]
        curves = collapse_curves(
            case,
            [turns[k] for k in which],
            search="list",
            settings=settings,
            fraction=LONG_STEP,
            brief=True,
        )
        for k, curve in zip(which, curves, strict=True):
            tables[k] = curve.table
    return tables
