"""Cases of the accuracy study by the independent adaptive solver, the reference of all others."""

import os
import time

from reference_solver.facade import peak_and_end
from rocking.runtime.script import pool_of, run
from rocking.tables import read_json, write_table
from studies.accuracy.errors import ADAPTIVE


def row_of(arguments):
    """Row of one case, with its time."""
    scene, motion, case, settings = arguments
    began = time.perf_counter()
    nodes, tolerance = settings["reference_nodes"], settings["reference_tolerance"]
    peak, end = peak_and_end(
        scene, motion, case["direction"], case["pga_g"], nodes=nodes, tolerance=tolerance
    )
    return {
        **case,
        "method": ADAPTIVE,
        "nodes": nodes,
        "factor": 1.0,
        "dt_s": None,
        "dt_over_dt_crit": None,
        "d_over_b": peak,
        "status": "overturned" if peak >= 1.0 else "ok" if peak < 1.0 else "failed",
        "steps": None,
        "simulated_s": end,
        "wall_s": time.perf_counter() - began,
    }


def main(job):
    settings = job.params.accuracy
    plan = read_json(job.input.plan)
    scenes = {model: read_json(path) for model, path in plan["scenes"].items()}
    work = [(scenes[c["model"]], plan["motions"][c["record"]], c, settings) for c in plan["cases"]]
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    with pool_of(job) as pool:
        rows = list(pool.map(row_of, work))
    write_table(rows, job.output[0], digits="%.9g")


run(main, globals())
