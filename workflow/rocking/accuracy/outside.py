"""The W1 cases of the accuracy study in an outside engine: what its comparisons share."""

import importlib
import math
import sys

import numpy as np

from rocking.tables import write_table
from yade_scripts.files import read_json
from yade_scripts.model import facade, floor_motions
from yade_scripts.model.motion import amplitude
from yade_scripts.model.stiffness import critical_step

SAMPLE_S = 0.002
AFTER_S = 2.0  # simulated beyond the motion


class Peak:
    """Largest |d|/b of a façade followed in its base's frame, and how its run ended."""

    def __init__(self, scene):
        """Take the monitored point and the start from the scene."""
        block = scene.blocks[scene.index(scene.monitor)]
        self.arm = np.subtract(scene.monitor_point_m, block.centre_m)[1:].tolist()
        self.start, self.b = block.displacement_m[1], scene.thickness_m
        self.value, self.status = 0.0, "ok"

    def add(self, y_m, angle_rad):
        """Take a sample of the centroid's displacement and the rotation; tell whether to stop."""
        y, z = self.arm
        d = self.start + y_m + math.cos(angle_rad) * y - math.sin(angle_rad) * z - y
        self.value = max(self.value, abs(d) / self.b)
        if not math.isfinite(d):
            self.status = "failed"
        elif self.value >= 1.0:
            self.status = "overturned"
        return self.status != "ok"


def compare(job, method, package, run_case, fractions):
    """Run every W1 case of the chart at some steps; write the table of runs.

    Parameters
    ----------
    job : object
        Snakemake's: input.plan, output[0].
    method, package : str
        The engine's name and the Python package to import.
    run_case : callable
        (scene, time_s, ground_m_s2, dt_s) → (Peak, simulated_s, wall_s), start-up apart.
    fractions : sequence of float
        Steps, over the critical one of our own scheme.

    Raises
    ------
    ValueError
        One line when the engine is not installed.
    """
    try:
        importlib.import_module(package)
    except ImportError:
        raise ValueError(
            f"{method} is not installed: .venv/bin/pip install -r requirements-engines.in"
        ) from None
    plan = read_json(job.input.plan)
    scene_job = read_json(plan["scenes"]["W1"])
    scene = facade.facade_scene(scene_job, "W1", scene_job["beta_s"])
    critical = float(critical_step(scene))
    rows = []
    for case in (c for c in plan["cases"] if c["case"] in plan["charted"] and c["model"] == "W1"):
        time_s, columns = floor_motions.read(plan["motions"][case["record"]])
        ground = columns[floor_motions.GROUND]
        factor = amplitude(ground, case["direction"], case["pga_g"])
        for fraction in fractions:
            dt = fraction * critical
            peak, simulated, wall = run_case(scene, time_s, factor * ground, dt)
            rows.append(
                {
                    "case": case["case"],
                    "model": "W1",
                    "record": case["record"],
                    "direction": case["direction"],
                    "pga_g": case["pga_g"],
                    "method": method,
                    "nodes": scene_job["numerics"]["nodes_height"],
                    "factor": 1.0,
                    "dt_s": dt,
                    "dt_over_dt_crit": fraction,
                    "d_over_b": peak.value,
                    "status": peak.status,
                    "steps": round(simulated / dt),
                    "simulated_s": simulated,
                    "wall_s": wall,
                }
            )
            print(rows[-1], file=sys.stderr)
    write_table(rows, job.output[0])
