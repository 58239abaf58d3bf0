"""One history of the cracked building by brick size: period, answer, cost."""

from pathlib import Path

import numpy as np
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table
from studies.building.modes import Solver
from studies.building.yade.complete import apart

from yade_scripts.model.scene import from_dict


def main(job):
    rows = []
    inputs = zip(job.input.scenes, job.input.costs, job.input.histories, strict=True)
    for scene_file, cost_file, history_file in inputs:
        model, size = Path(scene_file).stem.split("_")
        scene = from_dict(read_json(scene_file)["scene"])
        cost, history = read_json(cost_file), read_frame(history_file)
        modes = Solver(apart(scene)).modes(12)
        rows.append(
            {
                "model": model,
                "coarsening": float(size),
                "bricks": scene.notes["bricks"],
                "nodes": len(scene.nodes),
                "period_s": modes.period_s[modes.largest("y")],
                "d_over_b": cost["d_over_b"],
                "top_m": np.abs(history["top_m"]).max(),
                "status": cost["status"],
                "step_s": cost["step_s"],
                "steps": cost["steps"],
                "cpu_s": cost["cpu_s"],
            }
        )
    write_table(rows, job.output[0])


run(main, globals())
