"""A YADE process that runs without end and says so; `trials` interrupts it.

    python3 victim.py ROOT < job.json

It prints `on` when a run has been set up, `ended WHY` when the run has ended, `after TIME` after
a further run in the same process, and starts again.
"""

import json
import random
import signal
import sys

sys.path.insert(0, sys.argv[1])

import numpy as np

from yade_scripts.engine import adapter, parent_process, simulate
from yade_scripts.model import models

FURTHER_S = 0.02


def say(*words):
    print(*words, flush=True)


def failing(at_time_s):
    """Set-up of a runner that raises at a time of the run."""
    from yade_scripts.engine import loop

    def setup(built):
        def fail():
            if built.omega.time >= at_time_s:
                raise ValueError("runner")

        built.omega.engines = [*built.omega.engines, loop.runner(fail, 1)]

    return setup


def main():
    parent_process.follow()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # background jobs ignore it
    job = json.load(sys.stdin)
    adapter.load_yade()
    draw = random.Random(job["seed"])
    scene = models.build_scene(job)
    time_s = np.linspace(0.0, 4.0, 401)
    still = {
        name: adapter.SupportMotion(time_s, 0.3 * np.sin(7.0 * time_s)) for name in scene.motions
    }
    step = 0.1 * simulate.choose_step(scene, models.numerics(job))[1]

    def run(limit_s, setup=None):
        rules = simulate.StopRules(limit_s, limit_s, overturn_ratio=1e9, max_speed_m_s=1e9)
        return simulate.run(scene, still, step, rules, setup=setup)

    while True:
        setup = failing(draw.uniform(0.0, 0.05)) if job["kind"] == "error" else None
        try:
            say("on")
            run(1e4, setup)
        except (KeyboardInterrupt, ValueError) as error:
            say("ended", type(error).__name__)
        say("after", f"{run(FURTHER_S).time_s[-1]:.4f}")


main()
