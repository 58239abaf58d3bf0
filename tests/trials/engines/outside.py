"""The W1 cases of the accuracy study in another engine (needs requirements-engines.in).

    .venv/bin/snakemake --cores 2 --config run=engines -- results/engines/accuracy/plan.json
    .venv/bin/python tests/trials/engines/outside.py mujoco results/engines/accuracy

writes engine_mujoco.csv beside the plan; `accuracy={engines: [<that file>]}` puts it into the
study's table and chart.
"""

import argparse
import importlib
import math
import sys
from pathlib import Path

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


def compare(plan_path, output, engine):
    """Run every W1 case of the chart at some steps; write the table of runs.

    Parameters
    ----------
    plan_path, output : path-like
        accuracy/plan.json of a run; the table, with columns of `studies.accuracy.yade.accuracy`.
    engine : module
        NAME; PACKAGE to import; STEPS over the critical one of our own scheme; run_case, which
        takes scene, time_s, ground_m_s2 and dt_s and returns Peak, simulated_s and wall_s, without
        start-up.

    Raises
    ------
    SystemExit
        One line when the engine is not installed.
    """
    try:
        importlib.import_module(engine.PACKAGE)
    except ImportError:
        sys.exit(
            f"error: {engine.NAME} is not installed:"
            " .venv/bin/pip install -r requirements-engines.in"
        )
    plan = read_json(plan_path)
    scene_job = read_json(plan["scenes"]["W1"])
    scene = facade.facade_scene(scene_job, "W1", scene_job["beta_s"])
    critical = float(critical_step(scene))
    rows = []
    for case in (c for c in plan["cases"] if c["case"] in plan["charted"] and c["model"] == "W1"):
        time_s, columns = floor_motions.read(plan["motions"][case["record"]])
        ground = columns[floor_motions.GROUND]
        factor = amplitude(ground, case["direction"], case["pga_g"])
        for fraction in engine.STEPS:
            dt = fraction * critical
            peak, simulated, wall = engine.run_case(scene, time_s, factor * ground, dt)
            rows.append(
                {
                    "case": case["case"],
                    "model": "W1",
                    "record": case["record"],
                    "direction": case["direction"],
                    "pga_g": case["pga_g"],
                    "method": engine.NAME,
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
    write_table(rows, output)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("engine", choices=("drake", "mujoco"))
    parser.add_argument("folder", type=Path, help="folder of plan.json")
    args = parser.parse_args()
    engine = importlib.import_module(f"in_{args.engine}")
    compare(args.folder / "plan.json", args.folder / f"engine_{args.engine}.csv", engine)


if __name__ == "__main__":
    main()
