"""Histories of façades in OpenSees beside the project's solvers, law for law, and their time.

    python3 -m venv /tmp/venv && /tmp/venv/bin/pip install openseespy numpy
    .venv/bin/python tests/trials/opensees/run.py --python /tmp/venv/bin/python --output o.csv

IS101_Lo + from the recorded suite at 0.1, 0.2 and 0.3 g, its first 9 s, in which the peaks are:
W1 and W2 in one block, and W1, W2 and W2m in four courses, each 1.5 times as high as the one below;
nine nodes along every edge, a building of 64 t. OpenSees takes the scene that YADE takes. Its
sliders have no dashpot along them and keep their slip while they are open, so the reference solver
of stacks runs that law too (`same_law`), and the full one (`full_law`), which the compiled solver
has. Times are of the
processor, of one history: OpenSees from its first step on, the compiled solver alone and of 64 side
by side, YADE as it says itself (`--yade`). `--engines drake mujoco` runs them beside W1 in one
block, which is all that they are set up for (`tests/trials/engines`, needs
requirements-engines.in), at half and a twentieth of the stable step of YADE. A row is written as
soon as it is known; those that the table holds are not run again. OpenSees takes some 5 to 60 s a
history.
"""

import argparse
import importlib
import json
import math
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from reference_solver.stack import StackSolver
from rocking import Case, Motion
from rocking.collapse.curve import run_by
from rocking.configuration.study import as_in_the_study
from rocking.solver import peaks
from rocking.tables import write_table

from yade_scripts.model.models import build_scene
from yade_scripts.model.motion import amplitude
from yade_scripts.model.scene import to_json
from yade_scripts.model.stiffness import critical_step

HERE = Path(__file__).resolve().parent
SUITE = HERE.parents[2] / "config/suites/recorded_suite.tsv"
RECORD, DIRECTION, END_S, NODES = "IS101_Lo", "pos", 9.0, 9
CASES = (("W1", 0), ("W2", 0), ("W1", 4), ("W2", 4), ("W2m", 4))
PGA_G = (0.1, 0.2, 0.3)
STEPS_S = (5e-4, 2.5e-4)  # of OpenSees
TOGETHER = 64
LIMIT_S = 7200.0
COLUMNS = ["model", "courses", "pga_g", "dt_s", "opensees", "same_law", "error", "full_law"]
COLUMNS += ["compiled", "yade", "opensees_s", "compiled_s", "compiled_64_s", "yade_s"]
COLUMNS += ["drake", "drake_s", "mujoco", "mujoco_s", "status", "steps", "again"]
ENGINES = HERE.parent / "engines"


def case_of(model, courses):
    """Case with as many nodes along every edge as OpenSees gets springs."""
    keys = ("nodes_thickness", "nodes_height", "nodes_per_block")
    changes = {f"numerics.{key}": NODES for key in keys}
    if courses:
        changes |= {"facade.courses": courses, "facade.courses_growth": 1.5}
    return Case.configured(model, as_in_the_study(changes | {"return_wall.building_mass_kg": 64e3}))


def motion_of_suite():
    """First seconds of the record, as a motion of its own."""
    record = Motion.named(RECORD, SUITE).record
    count = round(END_S / record.dt_s)
    return Motion.sampled(record.acceleration_m_s2[:count], record.dt_s, "m/s2", name=RECORD)


def in_opensees(python, scene, time_s, columns, **how):
    """What `in_opensees.py` answers, in a Python that has openseespy."""
    moving = {name: np.asarray(values).tolist() for name, values in columns.items()}
    asked = {"scene": json.loads(to_json(scene)), "time_s": time_s.tolist(), "columns": moving}
    done = subprocess.run(
        [python, str(HERE / "in_opensees.py")],
        input=json.dumps(asked | how),
        text=True,
        capture_output=True,
        timeout=LIMIT_S,
    )
    if not done.stdout:
        raise RuntimeError(f"OpenSees gave no answer: {done.stderr[-300:]}")
    return json.loads(done.stdout)


def without_drag(scene):
    """The scene whose dry joints have no dashpot along them."""
    nodes = scene.nodes
    return replace(scene, nodes=nodes.select(slice(None), drag=np.zeros(len(nodes))))


def timed(scan, factor, count):
    """Peak by the compiled solver, and processor time of one of so many histories, least of 3."""
    took = []
    for _ in range(3):
        began = time.process_time()
        found = peaks(
            scan.planes[0], scan.motions, scan.numerics, [factor] * count,
            carried=scan.carried, step_s=scan.steps_s[0],
        )  # fmt: skip
        took.append((time.process_time() - began) / count)
    return found.d_over_b[0], min(took)


def in_engine(name, scene, time_s, ground):
    """Peak and processor time of another engine, which knows W1 in one block."""
    if str(ENGINES) not in sys.path:
        sys.path.insert(0, str(ENGINES))
    engine = importlib.import_module(f"in_{name}")
    step_s = min(engine.STEPS) * float(critical_step(scene))
    began = time.process_time()
    peak = engine.run_case(scene, time_s, ground, step_s)[0]
    return {name: peak.value, f"{name}_s": time.process_time() - began}


def row_of(model, courses, pga_g, dt_s, motion, args):
    """One row of the table."""
    case = case_of(model, courses)
    scene = build_scene(case.sections)
    time_s, columns = motion.columns(case)
    factor = float(amplitude(columns["ground"], DIRECTION, pga_g))
    how = {"factor": factor, "dt_s": dt_s, "end_s": END_S}
    found = in_opensees(args.python, scene, np.asarray(time_s), columns, **how)
    laws = (without_drag(scene), {"keeps": True}), (scene, {})
    same, full = (
        StackSolver(one, time_s, columns, **law).peaks([factor], until_s=END_S).d_over_b[0]
        for one, law in laws
    )
    scan = run_by("planar", case, motion, DIRECTION)
    value, alone = timed(scan, factor, 1)
    _, together = timed(scan, factor, TOGETHER)
    row = {
        **{"model": model, "courses": courses, "pga_g": pga_g, "dt_s": dt_s},
        **{"opensees": found["d_over_b"], "same_law": same, "full_law": full},
        **{"error": found["d_over_b"] / same - 1.0, "compiled": value},
        **{"opensees_s": found["cpu_s"], "compiled_s": alone, "compiled_64_s": together},
        **{key: found[key] for key in ("status", "steps", "again")},
    }
    if args.yade:
        table = run_by("yade", case, motion, DIRECTION, limit_s=LIMIT_S).run([pga_g])
        row |= {"yade": table["d_over_b"].iloc[0], "yade_s": table["wall_s"].iloc[0]}
    if model == "W1" and not courses:
        for name in args.engines:
            row |= in_engine(
                name, scene, np.asarray(time_s), factor * np.asarray(columns["ground"])
            )
    return row


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--python", required=True, help="a Python that has openseespy")
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--yade", action="store_true", help="run YADE beside it")
    parser.add_argument("--engines", nargs="+", choices=("drake", "mujoco"), default=())
    parser.add_argument("--cases", nargs="+", help="as W1:0, model and courses")
    parser.add_argument("--pga", nargs="+", type=float, default=PGA_G)
    parser.add_argument("--dt", nargs="+", type=float, default=STEPS_S)
    args = parser.parse_args()
    looks = "import importlib.util as u, sys; sys.exit(not u.find_spec('openseespy'))"
    if subprocess.run([args.python, "-c", looks], timeout=60.0).returncode:
        sys.exit(f"error: {args.python} has no openseespy: {args.python} -m pip install openseespy")
    rows = pd.read_csv(args.output).to_dict("records") if args.output.exists() else []
    keys = ("model", "courses", "pga_g", "dt_s")
    known = {tuple(row[key] for key in keys) for row in rows}
    asked = [c.split(":") for c in args.cases or ()]
    motion = motion_of_suite()
    for model, courses in [(m, int(n)) for m, n in asked] or CASES:
        for pga_g in args.pga:
            for dt_s in args.dt:
                if (model, courses, pga_g, dt_s) in known:
                    continue
                rows.append(row_of(model, courses, pga_g, dt_s, motion, args))
                write_table(rows, args.output, COLUMNS)
                print({k: v for k, v in rows[-1].items() if v == v}, flush=True)
    error = pd.DataFrame(rows)["error"].abs()
    print(
        f"{int((error <= 0.01).sum())} of {len(error)} within 1 %, worst {100 * error.max():.2f} %"
    )
    return 0 if math.isfinite(error.max()) else 1


if __name__ == "__main__":
    sys.exit(main())
