"""Perturbed ensembles of one model, record and direction, after its single runs.

They are run until they confirm the dense scan behind the curve; `ida` writes their table.
"""

import numpy as np

from yade_scripts.commands import perturb
from yade_scripts.commands.confirm import Confirmation, turns
from yade_scripts.commands.tables import KEY, REALISATION, RUN_COLUMNS
from yade_scripts.engine import simulate

COLUMNS = {**KEY, **REALISATION, **RUN_COLUMNS}


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


def analyse(runner, curve, plan):
    """Rows of a plan's ensembles; none without levels, or where section ensemble says so.

    A plan has runs and levels [g] and, for `confirm.Confirmation`, `told` and `probability`: of
    every run that counts, and by level of every realisation. `curve` are rows of the single runs.
    """
    settings = runner.case["ensemble"]
    asked = settings["enabled"] != "off" and runner.case["model"] in settings["models"]
    return confirm(runner, curve, plan, settings) if asked and plan.get("levels") else []
