"""Peak d/b of every case of the accuracy study from the independent planar solver."""

import json
import os
import time
from concurrent.futures import ProcessPoolExecutor

import pandas as pd
from rocking.curves.reference import peak_d_over_b
from rocking.runtime.script import run


def one(arguments):
    """Reference of one case, with its time."""
    scene, motion, case, settings = arguments
    began = time.perf_counter()
    peak = peak_d_over_b(
        scene,
        motion,
        case["direction"],
        case["pga_g"],
        nodes=settings["reference_nodes"],
        tolerance=settings["reference_tolerance"],
    )
    return {
        **case,
        "d_over_b": peak,
        "nodes": settings["reference_nodes"],
        "wall_s": time.perf_counter() - began,
    }


def main(job):
    with open(job.input.plan) as handle:
        plan = json.load(handle)
    scenes = {}
    for model, path in plan["scenes"].items():
        with open(path) as handle:
            scenes[model] = json.load(handle)
    work = [
        (scenes[c["model"]], plan["motions"][c["record"]], c, job.params.accuracy)
        for c in plan["cases"]
    ]
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    with ProcessPoolExecutor(int(getattr(job, "threads", 1))) as pool:
        rows = list(pool.map(one, work))
    pd.DataFrame(rows).to_csv(job.output[0], index=False, float_format="%.9g", lineterminator="\n")


if __name__ == "__main__":
    run(main, globals())
