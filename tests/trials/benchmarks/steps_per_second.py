"""Steps per second of every model in YADE, and their ratio to the first one's, in one run.

    .venv/bin/python tests/trials/benchmarks/steps_per_second.py --pga 0.1 --rounds 3
    .venv/bin/python tests/trials/benchmarks/steps_per_second.py --against ../before --models W1 W2c

Processor time of one pulse of shaking, nodes and step as a study would choose them. Models take
turns, and so does another checkout where one is given; the best round counts, since other work on
the machine only ever slows a run. With another checkout d/b is compared too.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT), str(ROOT / "workflow")]

from rocking.configuration import config  # noqa: E402
from rocking.configuration.study import as_in_the_study  # noqa: E402
from rocking.fidelity import choose, read_fidelity  # noqa: E402

PYTHON = os.environ.get("YADE_PYTHON", "/usr/bin/python3")
BETA_S, LIMIT_S = 0.00276, 600.0
RUN = """
import json, sys, time
sys.path.insert(0, sys.argv[1])
import numpy as np
from dataclasses import replace
from yade_scripts.engine import adapter, energy_check
from yade_scripts.model import models
from yade_scripts.commands import shaking
job = json.load(sys.stdin)
adapter.load_yade()
scene, numerics = models.build_scene(job), models.numerics(job)
time_s = np.linspace(0.0, 6.0, 1201)
# floors sway more than the ground, as a chain would
pulses = np.sin(2.0 * np.pi * time_s / 0.8) * np.exp(-(((time_s - 2.0) / 1.0) ** 2))
names = ("ground", "floor1", "floor2", "floor3", "floor4")
columns = {name: (1.0 + 0.3 * j) * pulses for j, name in enumerate(names)}
case = shaking.set_up(scene, numerics, time_s, columns, 9.80665 * job["pga_g"])
begun = []
case = replace(case, rules=replace(case.rules, limit_s=job["limit_s"]))
began = lambda built: begun.append(time.process_time())
history = case.run(setup=began, check=energy_check.EnergyCheck(case.sections, case.motions))
rate = history.steps / (time.process_time() - begun[0])
print("RESULT" + json.dumps([rate, history.peak_d_over_b, history.dt_s]))
"""


def measure(root, job):
    """Steps a second of processor time, peak d/b and step [s] of one run by the code in `root`."""
    done = subprocess.run(
        [PYTHON, "-c", RUN, str(root)],
        input=json.dumps(job),
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=True,
    )
    return json.loads(done.stdout.rpartition("RESULT")[2])


def main():
    """Measure and print a line a model."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--models", nargs="+", default=["W1", "W2", "W1c", "W2c", "W3"])
    parser.add_argument("--pga", type=float, default=0.1, help="amplitude of the ground [g]")
    parser.add_argument("--seconds", type=float, default=3.0, help="simulated, at most")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--against", type=Path, help="another checkout, measured in turn")
    args = parser.parse_args()
    resolved, measured = (
        config.resolve(as_in_the_study({})),
        read_fidelity(ROOT / "config" / "fidelity.yaml"),
    )
    roots = [ROOT] + ([args.against.resolve()] if args.against else [])
    found: dict = {}
    for _ in range(args.rounds):
        for model in args.models:
            job = {**resolved, "model": model, "beta_s": BETA_S}
            job["numerics"] = choose(job, model, measured)[0]
            job.update(pga_g=args.pga, limit_s=args.seconds)
            for root in roots:
                found.setdefault((model, root), []).append(measure(root, job))
    best = {key: max(rate for rate, *_ in runs) for key, runs in found.items()}
    for model in args.models:
        rate, (_, ratio, step) = best[model, ROOT], found[model, ROOT][0]
        line = f"{model:5} {rate:9.0f} steps/s, {rate / best[args.models[0], ROOT]:.3f} of"
        line += f" {args.models[0]}, {rate * step:6.2f} simulated s/s, d/b {ratio:.6f}"
        if args.against:
            other = found[model, roots[1]][0][1]
            line += f"; {rate / best[model, roots[1]]:.2f} times the other's, d/b {other:.6f}"
        print(line, flush=True)


if __name__ == "__main__":
    main()
