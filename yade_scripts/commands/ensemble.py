"""Perturbed ensembles of one model, record and direction, after its single runs.

Where a dense scan stands behind the curve they are run until they confirm it; else they search the
collapse band themselves. `ida` writes their tables.
"""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.commands import perturb
from yade_scripts.commands.confirm import Confirmation, turns
from yade_scripts.commands.search import collapse_bounds, drive, next_amplitude, one_by_one
from yade_scripts.commands.tables import KEY, REALISATION, RUN_COLUMNS
from yade_scripts.engine import simulate

COLUMNS = {**KEY, **REALISATION, **RUN_COLUMNS}
SENSITIVITY_COLUMNS = {
    **KEY,
    "perturbation": ".3g",
    "d_over_b": ".6f",
    "d_over_b_perturbed": ".6f",
    "change": ".3e",
    "repeats": "d",
}


def number(value):
    """Return a value of a row; NaN where the run failed."""
    return math.nan if value is None else value


def measure_sensitivity(runner, curve, settings):
    """Rows of the sensitivity table: d/b under a tiny change of amplitude, up to a collapse."""
    rows: list[dict] = []
    status = {row["pga_g"]: row["status"] for row in curve}
    d_over_b = {row["pga_g"]: number(row["d_over_b"]) for row in curve}
    size = settings["sensitivity_perturbation"]
    for g in perturb.probe_intensities(status):
        row = runner.run(g, perturb.Realisation(0, 1.0 + size))
        value = number(row["d_over_b"])
        change = perturb.sensitivity(d_over_b[g], value)
        rows.append(
            {
                **{key: row[key] for key in KEY},
                "perturbation": size,
                "d_over_b": d_over_b[g],
                "d_over_b_perturbed": value,
                "change": change,
                "repeats": int(change <= settings["sensitivity_threshold"]),
            }
        )
    worst = max((row["change"] for row in rows), default=math.nan)
    runner.say(f"sensitivity at {len(rows)} intensities: at most {worst:.2g}")
    return rows


def run_realisations(runner, pga_g, realisations):
    """Rows of every realisation at one intensity."""
    rows = [runner.run(pga_g, realisation) for realisation in realisations]
    outcome = [r["collapsed"] for r in rows if r["status"] != simulate.FAILED]
    share = float(np.mean(outcome)) if outcome else float("nan")
    runner.say(f"ensemble of {len(rows)} at {pga_g:.3f} g: {100 * share:.0f} % collapse")
    return rows


def confirm(runner, curve, plan, settings):
    """Rows of realisations at a plan's levels, until YADE's runs confirm the scan's probabilities.

    The single runs that tell something of them count first. Every level gets a realisation; unless
    the scan is confirmed then (`confirm.Confirmation`) all of `realisations` are run at every
    level, in the order of `confirm.turns`.
    """
    levels, realisations = plan["levels"], perturb.draw_realisations(settings)
    test, rows, missing = Confirmation(), [], set(range(len(levels)))
    alone = {row["pga_g"]: row["collapsed"] for row in curve if row["status"] != simulate.FAILED}
    for pga_g, probabilities in zip(plan["runs"], plan["told"], strict=True):
        if probabilities and pga_g in alone:
            test.add(probabilities, alone[pga_g], alone=True)
    for level, number in turns(levels, len(realisations)):
        rows.append(runner.run(levels[level], realisations[number]))
        if rows[-1]["status"] != simulate.FAILED:
            test.add(plan["probability"][level][number], rows[-1]["collapsed"])
        missing.discard(level)
        if settings["stop"] == "confirmed" and test.verdict == 1 and not missing:
            break
    told = {1: "confirm", 0: "refute", None: "neither confirm nor refute"}[test.verdict]
    runner.say(f"{len(rows)} realisations {told} the dense scan")
    return rows


def analyse(runner, curve, plan=None):
    """Rows of a plan's ensembles, and of sensitivity; without one the collapse band is searched.

    A plan has runs and levels [g] and, for `confirm.Confirmation`, `told` and `probability`: of
    every run that counts, and by level of every realisation. `curve` are rows of the single runs.
    """
    settings, ida = runner.case["ensemble"], runner.case["ida"]
    if settings["enabled"] == "off":
        return [], []
    if plan is not None:
        named = runner.case["model"] in settings["models"]
        return confirm(runner, curve, plan, settings) if named and plan["levels"] else [], []
    if runner.case["model"] not in settings["models"]:
        return [], measure_sensitivity(runner, curve, settings)
    status = {row["pga_g"]: row["status"] for row in curve}
    rows: list[dict] = []
    if settings["enabled"] == "on":
        first = collapse_bounds(status)[1] or math.inf
        realisations = perturb.draw_realisations(settings)
        for g in sorted(g for g in status if g < first):
            rows += run_realisations(runner, g, realisations)
    return rows + search_band(runner, status, settings, ida), []


def search_band(runner, status, settings, ida):
    """Rows of realisations, each at an amplitude of its own, until the collapse band is known."""
    rows: list[dict] = []
    realisations = iter(
        perturb.draw_realisations({**settings, "realisations": settings["max_runs"]})
    )

    def following(done):
        return next_amplitude(done, settings, ida) if len(rows) < settings["max_runs"] else None

    def run(ask):
        (g,) = ask.pga_g
        rows.append(runner.run(g, replace(next(realisations), amplitude_factor=1.0)))
        return [rows[-1]["status"]]

    drive(one_by_one(following, status), run)
    runner.say(f"{len(rows)} realisations at amplitudes of their own")
    return rows
