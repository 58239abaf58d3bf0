"""Speed against accuracy: which cases, which runs, their errors, and the fidelity they justify."""

import itertools
import math

import numpy as np
import pandas as pd

TABLE_COLUMNS = (
    "scene",
    "method",
    "nodes",
    "dt_over_dt_crit",
    "error",
    "realtime_factor",
    "wall_s",
    "d_over_b",
    "d_over_b_reference",
    "repeats",
    "default",
    "amplification",
)


def collapse_pga(curve):
    """Lowest collapsing PGA of an IDA table [g]; the highest that was run if nothing collapsed."""
    fell = curve.loc[curve["status"] == "overturned", "pga_g"]
    return float(fell.min() if len(fell) else curve["pga_g"].max())


def choose_cases(curves, shares):
    """Cases of the study: shares of the collapse PGA of each curve.

    Parameters
    ----------
    curves : list of DataFrame
        IDA tables.
    shares : sequence of float

    Returns
    -------
    list of dict
        case, model, record, direction, pga_g, share.
    """
    cases = []
    for curve in curves:
        model, record, direction = curve.iloc[0][["model", "record", "direction"]]
        for share in shares:
            pga_g = round(share * collapse_pga(curve), 4)
            name = f"{model} {record} {direction} {pga_g:g} g"
            cases.append(
                {
                    "case": name,
                    "model": model,
                    "record": record,
                    "direction": direction,
                    "pga_g": pga_g,
                    "share": share,
                }
            )
    return cases


def plan_runs(cases, settings, sensitivity):
    """Runs of the study, the default and its perturbed twin first.

    Parameters
    ----------
    cases : list of dict
        From `choose_cases`.
    settings : dict
        Section accuracy: nodes, step_fractions.
    sensitivity : float
        Relative change of amplitude of the twin run that tells whether a history repeats.

    Returns
    -------
    list of dict
        case, model, record, direction, pga_g, method, nodes, step_fraction, factor.
    """
    keys = ("case", "model", "record", "direction", "pga_g")
    runs = []
    for case in cases:
        base = {k: case[k] for k in keys} | {"nodes": None, "step_fraction": None, "factor": 1.0}
        runs.append(base | {"method": "default"})
        runs.append(base | {"method": "default", "factor": 1.0 + sensitivity})
        grid = itertools.product(settings["nodes"], settings["step_fractions"])
        runs += [
            base | {"method": "nodes and step", "nodes": n, "step_fraction": f} for n, f in grid
        ]
    seen = set()
    for case in cases:  # other ways of running the default: the first case of each model
        if case["model"] not in seen:
            seen.add(case["model"])
            base = {k: case[k] for k in keys} | {"nodes": None, "step_fraction": None}
            others = ("lag not compensated", "python drive", "full 3D")
            runs += [base | {"factor": 1.0, "method": method} for method in others]
            if case["model"] == "W1":  # some 10,000 steps/s: a step of 0.05 would take minutes
                runs.append(base | {"factor": 1.0, "method": "Polyhedra", "step_fraction": 0.2})
    return runs


def errors(runs, reference, limit):
    """Table of speed against accuracy.

    Parameters
    ----------
    runs : DataFrame
        Table of `yade_scripts/studies/accuracy.py`, or of another engine in the same columns.
    reference : DataFrame
        case, d_over_b.
    limit : float
        Change of d/b under the tiny perturbation up to which a history repeats.

    Returns
    -------
    DataFrame
        TABLE_COLUMNS; error is |d/b − reference|/reference, NaN for failed runs, and
        amplification the change of d/b over the relative change of amplitude that caused it.
    """
    exact = reference.set_index("case")["d_over_b"]
    base = runs[(runs["method"] == "default") & (runs["factor"] == 1.0)].set_index("case")
    twin = runs[(runs["method"] == "default") & (runs["factor"] != 1.0)].set_index("case")
    change = (base["d_over_b"].clip(upper=1.0) - twin["d_over_b"].clip(upper=1.0)).abs()
    rows = runs[runs["factor"] == 1.0]
    target = rows["case"].map(exact)
    value = rows["d_over_b"].where(rows["status"] != "failed").clip(upper=1.0)
    return pd.DataFrame(
        {
            "scene": rows["case"],
            "method": rows["method"],
            "nodes": rows["nodes"],
            "dt_over_dt_crit": rows["dt_over_dt_crit"],
            "error": (value - target).abs() / target,
            "realtime_factor": rows["simulated_s"] / rows["wall_s"],
            "wall_s": rows["wall_s"],
            "d_over_b": value,
            "d_over_b_reference": target,
            "repeats": (rows["case"].map(change) <= limit).astype(int),
            "default": (rows["method"] == "default").astype(int),
            "amplification": rows["case"].map(change / (twin["factor"] - 1.0).abs()),
        }
    )


def observed_rate(step, error):
    """Observed order of convergence: least-squares slope of log error over log step."""
    step, error = np.asarray(step, float), np.asarray(error, float)
    if np.any(step <= 0.0) or np.any(error <= 0.0) or step.size < 2:
        raise ValueError("observed_rate: expected at least 2 positive steps and errors")
    return float(np.polyfit(np.log(step), np.log(error), 1)[0])


def pareto_front(cost, error):
    """Mask of the points that no other point beats in both cost and error."""
    cost, error = np.asarray(cost, float), np.asarray(error, float)
    front = np.zeros(cost.size, bool)
    best = math.inf
    for i in np.lexsort((error, cost)):
        if error[i] < best:
            front[i], best = True, error[i]
    return front
