"""Runs with two-way return walls for tests; imported inside YADE's Python."""

from dataclasses import replace

import numpy as np

from yade_scripts.commands import shaking
from yade_scripts.engine import adapter, loop, simulate
from yade_scripts.model import facade, models, yielding


def chain_alone(config, ground, dt_s, beta_s=0.002):
    """Displacement of the masses relative to the ground, no façade before them.

    The façade is there, but the nodes between it and the walls are not.
    """
    scene = facade.facade_scene(config, "W2m", beta_s)
    scene = replace(scene, nodes=scene.nodes.select(scene.nodes.b == 0))
    time_s = np.arange(len(ground)) * dt_s
    motions = {"ground": adapter.SupportMotion(time_s, np.array(ground))}
    step, _ = simulate.choose_step(scene, config["numerics"])
    rules = simulate.StopRules(time_s[-1], time_s[-1], overturn_ratio=1e9, max_speed_m_s=1e9)
    rows = []

    def setup(built):
        omega = built.omega
        states = [omega.bodies[built.body[i]].state for i in range(2, len(scene.blocks))]

        def sample():
            rows.append([omega.time + omega.dt, *(s.pos[1] + offset for s in states)])

        offset = -scene.blocks[2].centre_m[1]
        omega.engines = [*omega.engines, loop.runner(sample, 10)]

    history = simulate.run(scene, motions, step, rules, setup=setup)
    return {"rows": rows, "speed": history.steps / history.wall_s, "step": step}


def shaken(config, runs, time_s, columns):
    """Peak d/b and status of runs (model, mass of the building [kg], factor on the motion)."""
    found = []
    columns = {name: np.array(values) for name, values in columns.items()}
    for model, mass_kg, *factor in runs:
        wall = {**config["return_wall"], "building_mass_kg": mass_kg}
        job = {**config, "return_wall": wall, "model": model, "beta_s": 0.002}
        scene = models.build_scene(job)
        times = np.array(time_s)
        moved = yielding.of_case(job, times, columns)
        case = shaking.set_up(scene, models.numerics(job), times, moved, *factor or (1.0,))
        h = case.retried()
        found.append({"peak": h.peak_d_over_b, "status": h.status, "reason": h.reason})
    return found


def momenta(config, model, time_s, ground, stride):
    """Place and velocity of all free blocks every so many steps, relative to the ground.

    Returns
    -------
    dict
        names, mass_kg; rows: time, then y and its rate of each.
    """
    scene = facade.facade_scene(config, model, 0.002)
    free = [i for i, block in enumerate(scene.blocks) if "y" in block.free]
    case = shaking.set_up(
        scene, config["numerics"], np.array(time_s), {"ground": np.array(ground)}, 1.0
    )
    rows = []

    def setup(built):
        omega = built.omega
        states = [omega.bodies[built.body[i]].state for i in free]
        centres = [scene.blocks[i].centre_m[1] for i in free]

        def sample():
            places = [s.pos[1] - y for s, y in zip(states, centres, strict=True)]
            rows.append([omega.time, *places, *(s.vel[1] for s in states)])

        loop.between(sample, stride, first=1)

    step, _ = simulate.choose_step(scene, config["numerics"])
    motions = {"ground": adapter.SupportMotion(np.array(time_s), np.array(ground))}
    rules = simulate.StopRules(time_s[-1], time_s[-1], overturn_ratio=1e9)
    history = simulate.run(case.scene, motions, step, rules, setup=setup)
    blocks = [scene.blocks[i] for i in free]
    return {
        "names": [block.name for block in blocks],
        "mass_kg": [block.mass_kg for block in blocks],
        "rows": rows,
        "peak": history.peak_d_over_b,
    }
