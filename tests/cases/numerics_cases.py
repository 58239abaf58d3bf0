"""Runs forced to fail numerically; imported inside YADE's Python."""

import math
import os
import signal
import threading
from dataclasses import replace

import numpy as np

from yade_scripts.commands import ida, shaking
from yade_scripts.commands.journal import Journal
from yade_scripts.commands.runner import Runner
from yade_scripts.engine import adapter, energy_check, loop, simulate
from yade_scripts.model import facade, models
from yade_scripts.model.stiffness import critical_step

BETA_S = 0.00276
SAMPLE_STEPS = 5  # steps between samples of `poisoned_run`
QUIET = 0.03  # of gravity: far below what uplifts the façade (b/h = 0.058)


def _motion(duration_s=4.0, peak_g=QUIET):
    time_s = np.linspace(0.0, duration_s, 401)
    return time_s, peak_g * 9.81 * np.sin(7.0 * time_s)


def _outcome(history, **more):
    return {
        "status": history.status,
        "reason": history.reason,
        "steps": history.steps,
        "blank": math.isnan(history.peak_d_over_b),
        "dt_s": history.dt_s,
        **more,
    }


def forced_run(config, model, factor):
    """A run whose step is `factor` times the critical one, which the entry points refuse."""
    scene = models.build_scene({**config, "model": model, "beta_s": BETA_S})
    time_s, acceleration = _motion()
    columns = dict.fromkeys(scene.motions, acceleration)
    case = shaking.set_up(scene, config["numerics"], time_s, columns, 1.0)
    case = replace(case, step_s=factor * case.critical_step_s)
    with_check, without = case.checked(), case.run()
    return _outcome(with_check, unchecked=without.status)


def shaken_run(config, model, record, peak_g):
    """Largest energy from nowhere in a run at its proper step, and how the run ended."""
    scene = models.build_scene({**config, "model": model, "beta_s": BETA_S})
    time_s, columns = np.array(record["time_s"]), record["columns"]
    columns = {n: np.array(v) for n, v in columns.items()}
    numerics = models.numerics({**config, "model": model})
    case = shaking.set_up(scene, numerics, time_s, columns, peak_g * 9.81)
    check = energy_check.EnergyCheck(scene, case.motions)
    history = case.run(check=check)
    return _outcome(history, excess=check.excess, walls=len(check.walls))


def poisoned_run(config, value, at_step):
    """A sound run in which one velocity becomes `value` ("nan", "inf") at a step."""
    scene = facade.facade_scene(config, "W1", BETA_S)
    time_s, acceleration = _motion()
    columns = dict.fromkeys(scene.motions, acceleration)
    case = shaking.set_up(scene, config["numerics"], time_s, columns, 1.0)

    def spoil(built):
        state = built.omega.bodies[built.body[scene.index(scene.monitor)]].state

        def at_one_step():
            if built.omega.iter == at_step:
                state.vel = (0.0, float(value), 0.0)

        built.omega.engines = [loop.runner(at_one_step, 1), *built.omega.engines]

    return _outcome(replace(case, sample_s=SAMPLE_STEPS * case.step_s).run(setup=spoil))


def retried_run(config, factor, retry):
    """One intensity at `factor` times the critical step, with and without the second try."""
    scene = facade.facade_scene(config, "W1", BETA_S)
    time_s, acceleration = _motion()
    step = factor * critical_step(scene)
    proper, simulate.choose_step = simulate.choose_step, lambda *_: (step, step)
    try:
        numerics = {**config["numerics"], "retry_half_step": retry}
        history = shaking.set_up(scene, numerics, time_s, {"ground": acceleration}, 1.0).retried()
    finally:
        simulate.choose_step = proper
    return _outcome(history, tried_s=step)


def struck_run(config, interval_s, retry):
    """Return walls that strike a standing façade across a gap, as an ordinary run of the IDA."""
    config = {**config, "facade": {**config["facade"], "gap_m": 0.02}}
    scene = facade.facade_scene(config, "W2", BETA_S)
    # 0.2 m/s within 0.1 s, held for 0.2 s, and to rest again
    time_s = np.array([0.0, 0.001, 0.1, 0.101, 0.3, 0.301, 0.4, 0.401, 2.0])
    push = 2.0 * np.array([0.0, 1.0, 1.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0])
    columns = {f"floor{j}": push for j in range(1, 5)} | {"ground": np.zeros(time_s.size)}
    numerics = {**config["numerics"], "retry_half_step": retry, "sample_interval_s": interval_s}
    history = shaking.set_up(scene, numerics, time_s, columns, 1.0).retried()
    return _outcome(history, peak=history.peak_d_over_b)


def interrupted_run(config):
    """Ctrl-C in the middle of a long run, and a run after it in the same process."""
    scene = facade.facade_scene(config, "W1", BETA_S)
    time_s, acceleration = _motion()
    motions = {name: adapter.SupportMotion(time_s, acceleration) for name in scene.motions}
    step = 0.1 * critical_step(scene)
    # a shell's background jobs, and what they start, ignore the signal
    signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    caught = False
    try:
        simulate.run(
            scene,
            motions,
            step,
            simulate.StopRules(1e3, 1e3, overturn_ratio=1e9),
            setup=lambda built: timer.start(),
        )
    except KeyboardInterrupt:
        caught = True
    running = adapter.load_yade().Omega().running
    after = simulate.run(scene, motions, step, simulate.StopRules(1.0, 1.0))
    return {"caught": caught, "running": running, "end_s": float(after.time_s[-1])}


def failed_analysis(config, folder):
    """A whole analysis in which every run fails at both steps; its rows and what it says."""
    time_s, acceleration = _motion()
    said = []
    proper, simulate.choose_step = simulate.choose_step, lambda *_: (0.0168, 0.0168)
    try:
        job = {**config, "model": "W1", "beta_s": BETA_S}
        motion, journal = (time_s, {"ground": acceleration}), Journal(f"{folder}/j.jsonl")
        rows = ida.analyse(Runner(job, *motion, "A", "pos", journal, said.append))
    finally:
        simulate.choose_step = proper
    return {"rows": rows, "said": said}
