"""A free-rocking experiment in one table: measured ratios by height, and those of both solvers."""

import math
from pathlib import Path

import numpy as np
from rocking.calibration.restitution import e_exp, read_archive, rebounds
from rocking.runtime.script import run
from rocking.solver import Motions, history, prepare
from rocking.studies import validation
from rocking.tables import read_json, write_table

from yade_scripts.model.facade import facade_scene

SAMPLES = 20000
SMALLEST = 1e-3  # θ/α of a rebound


def main(job):
    experiment = validation.read(Path(job.input.files[0]).parent)
    measured = experiment.measured.groupby("run")["measured_-"]
    quartiles = measured.quantile([0.25, 0.5, 0.75]).unstack()
    heights = experiment.runs.set_index("run")["height_m"]
    yade, rows = read_archive(job.input.histories), []
    for case, done in zip(read_json(job.input.cases), yade, strict=True):
        variant, _, number = case["id"].rpartition("|")
        h, b = (case["config"]["facade"][key] for key in ("height_m", "thickness_m"))
        low, middle, high = quartiles.loc[int(number)]
        row = {
            "run": int(number),
            "height_m": heights[int(number)],
            "trials": measured.size()[int(number)],
        }
        row |= {
            "p25": low,
            "median": middle,
            "p75": high,
            "housner": 1 - 1.5 * b**2 / (b**2 + h**2),
        }
        row |= {"variant": variant, "beta_s": case["beta_s"][0]}
        for solver, (t, theta) in {
            "planar": planar(case),
            "YADE": (done["time_s"], done["theta_over_alpha"]),
        }.items():
            e = e_exp(rebounds(t, theta, sides="two", smallest=SMALLEST))[0]
            rows.append({**row, "solver": solver, "ratio": e, "within": int(low <= e <= high)})
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
    found = history(prepare(scene), Motions(still, 0.0 * still), numerics, sample_s=limit / SAMPLES)
    facade = config["facade"]
    return found.time_s, -found.pose[:, 2] / math.atan2(facade["thickness_m"], facade["height_m"])


run(main, globals())
