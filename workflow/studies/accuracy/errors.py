"""Speed against accuracy: which runs, their errors, and what they say of each method."""

import itertools
import math

import numpy as np
import pandas as pd

from studies.accuracy.histories import REPORTING
from yade_scripts.model import registry

ADAPTIVE = "adaptive reference"
COMPILED = "compiled planar"
GRID = "nodes and step"  # of YADE
WITHIN = 0.01  # the error up to which a history counts as right
TABLE_COLUMNS = (
    *("scene", "method", "nodes", "dt_over_dt_crit", "error", "realtime_factor", "wall_s"),
    *("d_over_b", "d_over_b_reference", "repeats", "default", "amplification", "half"),
)


def reporting(table):
    """Rows of the reporting half of a table; the whole table if it has no such half."""
    mine = table[table["half"] == REPORTING]
    return mine if len(mine) else table


def charted(drawn, count):
    """Cases that other engines run too: the first so many drawn ones of the half that reports."""
    return set(reporting(drawn).groupby("model", sort=False).head(count)["case"])


def plan_runs(drawn, settings, scenes):
    """Runs of YADE of the `histories.sampled` cases, record by record.

    `scenes` are the case files by model; what one chooses is run where the grid of `settings`
    (section accuracy: nodes, step_fractions) lacks it. A run has case, model, record, direction,
    pga_g, method, nodes, step_fraction and factor.
    """
    keys = ["case", "model", "record", "direction", "pga_g"]
    runs = []
    for case in drawn.sort_values(["record", "case"])[keys].to_dict("records"):
        run = {**case, "method": GRID, "nodes": None, "step_fraction": None, "factor": 1.0}
        grid = list(itertools.product(settings["nodes"], settings["step_fractions"]))
        if chosen_pair(scenes[case["model"]]) not in grid:
            runs.append(run)
        runs += [{**run, "nodes": n, "step_fraction": f} for n, f in grid]
    return runs


def chosen_pair(scene):
    """Nodes a return wall and step over the critical one of a case file."""
    numerics = scene["numerics"]
    return numerics[registry.model(scene["model"]).nodes_up], numerics["step_fraction"]


def errors(runs, histories, defaults):
    """Table of speed against accuracy: TABLE_COLUMNS and model.

    Runs are of YADE (`studies.accuracy.yade.accuracy`), or of another engine or solver in its
    columns.
    Histories have case, half, d_over_b (the reference), d_over_b_compiled (the converged compiled
    solver's, by which the reference solver is measured), repeats, amplification. Defaults are
    (nodes, step fraction) of the main job by model. The error is |d/b − reference|/reference, NaN
    for failed runs.
    """
    known = histories.set_index("case")
    rows = runs.reset_index(drop=True)
    reference = rows["case"].map(known["d_over_b"])
    judged = rows["case"].map(known["d_over_b_compiled"])
    reference = reference.mask(rows["method"] == ADAPTIVE, judged)
    value = rows["d_over_b"].where(rows["status"] != "failed").clip(upper=1.0)
    default = [
        method == GRID
        and nodes == defaults[model][0]
        and math.isclose(fraction, defaults[model][1] or 0.0, rel_tol=1e-3)
        for model, method, nodes, fraction in rows[
            ["model", "method", "nodes", "dt_over_dt_crit"]
        ].itertuples(index=False)
    ]
    return pd.DataFrame(
        {
            "scene": rows["case"],
            "model": rows["model"],
            "method": rows["method"],
            "nodes": rows["nodes"],
            "dt_over_dt_crit": rows["dt_over_dt_crit"].round(4),
            "error": (value - reference).abs() / reference,
            "realtime_factor": rows["simulated_s"] / rows["wall_s"],
            "wall_s": rows["wall_s"],
            "d_over_b": value,
            "d_over_b_reference": reference,
            "repeats": rows["case"].map(known["repeats"]),
            "default": np.array(default, int),
            "amplification": rows["case"].map(known["amplification"]),
            "half": rows["case"].map(known["half"]),
        }
    )


def summary(table, keys=("model", "half")):
    """Spread of the errors of every method, nodes and step over its repeating histories.

    A failed run counts as not within 1 %. The table of `errors` is parted by `keys` before method,
    nodes, dt_over_dt_crit. Columns are those, default, histories, within_1_percent (share),
    error_median, error_90, error_worst, worst (its case), cost (wall over simulated time).
    """
    by = [*keys, "method", "nodes", "dt_over_dt_crit"]
    part = table[table["repeats"] == 1].assign(cost=1.0 / table["realtime_factor"])
    rows = []
    for values, group in part.groupby(by, dropna=False):
        error = group["error"].fillna(np.inf)
        rows.append(
            {
                **dict(zip(by, values, strict=True)),
                "default": int(group["default"].max()),
                "histories": len(group),
                "within_1_percent": float((error <= WITHIN).mean()),
                "error_median": float(error.median()),
                "error_90": float(error.quantile(0.9, interpolation="higher")),
                "error_worst": float(error.max()),
                "worst": group.loc[error.idxmax(), "scene"],
                "cost": float(group["cost"].median()),
            }
        )
    return pd.DataFrame(rows)


def same_cases(table):
    """Rows of the repeating cases that every method of a model ran."""
    part = table[table["repeats"] == 1]
    keep = []
    for _, mine in part.groupby("model"):
        settings = mine.groupby(["method", "nodes", "dt_over_dt_crit"], dropna=False)["scene"]
        common = set.intersection(*(set(scenes) for _, scenes in settings))
        keep.append(mine[mine["scene"].isin(common)])
    return pd.concat(keep)


def pareto_front(cost, error):
    """Mask of the points that no other point beats in both cost and error."""
    cost, error = np.asarray(cost, float), np.asarray(error, float)
    front = np.zeros(cost.size, bool)
    best = math.inf
    for i in np.lexsort((error, cost)):
        if error[i] < best:
            front[i], best = True, error[i]
    return front
