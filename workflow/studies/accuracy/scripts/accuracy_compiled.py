"""The compiled planar solver at many nodes and steps on the cases of the accuracy study, timed."""

import itertools
import time

from rocking.runtime.script import run
from rocking.tables import read_json, write_table
from studies.accuracy.errors import COMPILED
from studies.accuracy.histories import PeakSolver

from yade_scripts.model import floor_motions


def main(job):
    plan, settings = read_json(job.input.plan), job.params.accuracy
    scenes = {m: read_json(path) for m, path in plan["scenes"].items()}
    grid = list(itertools.product(settings["compiled_nodes"], settings["compiled_steps"]))
    rows = []
    for case in plan["cases"]:
        motion = floor_motions.read(plan["motions"][case["record"]])
        solver = PeakSolver(scenes[case["model"]], *motion, case["direction"])
        for nodes, step in [grid[0], *grid]:  # the first one compiles
            began = time.perf_counter()
            peaks = solver.peaks(case["pga_g"], nodes, step)
            wall = time.perf_counter() - began
            status = "failed" if peaks.failed[0] else "overturned" if peaks.overturned[0] else "ok"
            row = {**case, "method": COMPILED, "nodes": nodes, "factor": 1.0, "dt_s": peaks.step_s}
            row |= {"dt_over_dt_crit": step, "d_over_b": peaks.d_over_b[0], "status": status}
            end = float(peaks.end_s[0])
            rows.append({**row, "steps": round(end / peaks.step_s), "simulated_s": end})
            rows[-1]["wall_s"] = wall
        del rows[-len(grid) - 1]
    write_table(rows, job.output[0], digits="%.9g")


run(main, globals())
