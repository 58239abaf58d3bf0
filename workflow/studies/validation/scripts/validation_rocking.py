"""A free-rocking experiment in one table: measured restitution by run, and both solvers'."""

import math
from pathlib import Path

import numpy as np
from rocking.runtime.script import run
from rocking.solver import Motions, history, to_plane
from rocking.tables import read_json, write_table
from studies.shared.restitution import e_exp, e_one_sided, read_archive, rebounds
from studies.validation import study as validation

from yade_scripts.model.facade import facade_scene

SAMPLES = 20000
SMALLEST = {"two": 1e-3, "one": 1e-4}  # θ/α of a rebound; those against return walls are low
QUARTILES = ("p25", "median", "p75")


def main(job):
    experiment = validation.read(Path(job.input.files[0]).parent)
    measured, rows = validation.quartiles(experiment), []
    cases = read_json(job.input.cases)
    for case, yade in zip(cases, read_archive(job.input.histories), strict=True):
        facade = case["config"]["facade"]
        h, b, sides = facade["height_m"], facade["thickness_m"], facade["sides"]
        closed = e_one_sided(h, b) if sides == "one" else 1 - 1.5 * b**2 / (b**2 + h**2)
        histories = {"planar": planar(case), "YADE": (yade["time_s"], yade["theta_over_alpha"])}
        restitution = {
            solver: e_exp(rebounds(*history, sides=sides, smallest=SMALLEST[sides]))
            for solver, history in histories.items()
        }
        for _, run_ in experiment.runs[experiment.runs["height_m"] == h].iterrows():
            impact = int(run_.get("impact", 1))
            about = measured.loc[run_["run"]]
            row = {"run": int(run_["run"]), "height_m": h, "impact": impact}
            row |= {"trials": int(about["trials"])} | {q: about[q] for q in QUARTILES}
            row |= {"closed_form": closed, "variant": case["id"].rpartition("|")[0]}
            row |= {"beta_s": case["beta_s"][0]}
            for solver, e in restitution.items():
                ratio = e[impact - 1]
                within = int(about["p25"] <= ratio <= about["p75"])
                rows.append({**row, "solver": solver, "ratio": ratio, "within": within})
    write_table(rows, job.output[0])


def planar(case):
    """Time and outward rotation over α of one release."""
    config, limit = case["config"], case["limit_s"]
    scene = facade_scene(
        config, case["model"], case["beta_s"][0], release_ratio=case["release_ratio"]
    )
    still = np.array([0.0, limit])
    numerics = {**config["numerics"], "rest_time_s": limit, "after_motion_s": 0.0}
    numerics["overturn_ratio"] = 10.0
    moved = history(
        to_plane(scene), Motions(still, 0.0 * still), numerics, sample_s=limit / SAMPLES
    )
    facade = config["facade"]
    return moved.time_s, -moved.pose[:, 2] / math.atan2(facade["thickness_m"], facade["height_m"])


run(main, globals())
