"""Runs of the complete building for tests; imported inside YADE's Python."""

from dataclasses import replace

import numpy as np
from studies.building.yade.complete import apart
from studies.building.yade.complete_history import Recorder

from yade_scripts.commands import shaking
from yade_scripts.model import facade
from yade_scripts.model.scene import from_dict


def shaken(job, time_s, ground, drop):
    """Time and displacements of top floor and façade; without what lies between, if `drop`."""
    scene = from_dict(job["scene"])
    if drop:
        scene = apart(scene)
    columns = {"ground": np.array(ground)}
    case = shaking.set_up(scene, job["numerics"], np.array(time_s), columns, 1.0)
    case = replace(case, rules=replace(case.rules, rest_time_s=1e9))
    recorder = Recorder(scene, 0.004)
    history = case.checked(setup=recorder)
    rows = [(row[0], row[1], row[3]) for row in recorder.rows]
    return {"rows": rows, "status": history.status, "broken": recorder.rows[-1][-1]}


def beside_w1(config, job, time_s, ground):
    """Peak d/b and status of a complete building and of W1 under one motion."""
    columns = {"ground": np.array(ground)}
    found = {}
    scenes = {
        "CB": (from_dict(job["scene"]), job["numerics"]),
        "W1": (facade.facade_scene(config, "W1", config["beta_s"]), config["numerics"]),
    }
    for name, (scene, numerics) in scenes.items():
        history = shaking.set_up(scene, numerics, np.array(time_s), columns, 1.0).checked()
        found[name] = {"peak": history.peak_d_over_b, "status": history.status}
    return found
