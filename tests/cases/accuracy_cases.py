"""Accuracy and stability cases; imported inside YADE's Python."""

import math
from dataclasses import replace

import energy_probe
import numpy as np
from facade_cases import quiet

from yade_scripts.commands import shaking
from yade_scripts.engine import adapter, balance, energy_check, simulate
from yade_scripts.model import facade, models
from yade_scripts.model.stiffness import critical_step


def drift(config, seconds, ratio):
    """Energies of an undamped frictionless free-rocking block."""
    scene = facade.facade_scene(config, "free", 0.0, release_ratio=ratio)
    probe = energy_probe.EnergyProbe(scene, 0.02)
    rules = simulate.StopRules(seconds + 1.0, seconds, overturn_ratio=1e9)
    step, _ = simulate.choose_step(scene, config["numerics"])
    simulate.run(scene, quiet(scene), step, rules, setup=probe.attach)
    return {"total": probe.total.tolist(), "rows": probe.rows[-1]}


def tumbling(config, seconds):
    """A façade that turns about all its axes without weight: energies of energies and check [J]."""
    scene = facade.facade_scene(config, "W1", 0.0, planar=False, two_components=True)
    free = scene.index(scene.monitor)
    flight = {"displacement_m": (0.0, 50.0, 50.0), "angular_velocity_rad_s": (1.0, 0.5, 0.8)}
    scene.blocks[free] = replace(scene.blocks[free], **flight)
    scene, motions = replace(scene, gravity_m_s2=1e-9), quiet(scene)
    check = energy_check.EnergyCheck(scene, motions)
    check.reason = "none"  # where nothing is needed to overturn, any energy would end the run
    energies = balance.EnergyBalance(scene, 0.1)
    rules = simulate.StopRules(seconds, seconds, overturn_ratio=1e9)
    simulate.run(scene, motions, 2e-3, rules, setup=energies.attach, check=check)
    block = scene.blocks[free]
    spin = np.array(block.angular_velocity_rad_s)
    return {
        "kinetic": [row[2] for row in energies.rows],
        "check": check.energy,
        "start": float(energies.start[0]),
        "first": 0.5 * float(block.inertia_kg_m2 @ spin**2),
    }


def rest(config, model, beta_s, seconds):
    """Largest |d| and last speed of a façade left alone."""
    scene = facade.facade_scene(config, model, beta_s)
    rules = simulate.StopRules(seconds + 1.0, seconds)
    step, _ = simulate.choose_step(scene, config["numerics"])
    h = simulate.run(scene, quiet(scene), step, rules)
    late = h.time_s > 0.9 * seconds
    return {
        "d": float(np.max(np.abs(h.d_m))),
        "drift": float(abs(h.d_m[-1] - h.d_m[0])),
        "speed": float(np.max(np.abs(h.velocity_m_s[late]))),
        "status": h.status,
    }


def released(config, model, beta_s, ratio, seconds):
    """Peak d/b, status and last rotation after a release."""
    scene = facade.facade_scene(config, model, beta_s, release_ratio=ratio)
    rules = simulate.StopRules(0.0, seconds, overturn_ratio=2.0)
    step, _ = simulate.choose_step(scene, config["numerics"])
    h = simulate.run(scene, quiet(scene), step, rules)
    return {
        "status": h.status,
        "rotation": h.rotation_rad.tolist(),
        "d": h.d_m.tolist(),
        "time": h.time_s.tolist(),
        "reason": h.reason,
    }


def shaken(config, model, beta_s, time_s, columns, fraction=None):
    """Peak d/b of one run, with the history."""
    numerics = {**config["numerics"], **({"step_fraction": fraction} if fraction else {})}
    scene = facade.facade_scene(config, model, beta_s)
    time_s = np.array(time_s)
    columns = {k: np.array(v) for k, v in columns.items()}
    case = shaking.set_up(scene, numerics, time_s, columns, 1.0)
    h = replace(case, sample_s=0.002).run()
    return {
        "peak": h.peak_d_over_b,
        "status": h.status,
        "d": h.d_m.tolist(),
        "time": h.time_s.tolist(),
        "dt_s": h.dt_s,
    }


def vibration(config, beta_s, fractions, duration_s, amplitude):
    """Top displacement at a fixed instant of a façade that never uplifts, by step."""
    scene = facade.facade_scene(config, "free", beta_s)
    time_s = np.linspace(0.0, duration_s, 401)
    motion = adapter.SupportMotion(
        time_s, amplitude * np.sin(2.0 * math.pi * time_s / duration_s) ** 2
    )
    out = []
    for fraction in fractions:
        steps = round(duration_s / (fraction * critical_step(scene)))
        rules = simulate.StopRules(10.0, duration_s, overturn_ratio=1e9)
        # an end between two steps would hide the order of the scheme
        h = simulate.run(
            scene, {"ground": motion}, duration_s / steps, rules, sample_s=duration_s / steps
        )
        out.append((duration_s / steps, float(np.interp(0.9 * duration_s, h.time_s, h.d_m))))
    return out


def balanced(config, model, beta_s, time_s, columns, fraction):
    """Books of one run: last row, largest residual, and the energy that overturns the façade."""
    numerics = {**config["numerics"], "step_fraction": fraction}
    job = {**config, "numerics": numerics, "model": model, "beta_s": beta_s}
    columns = {k: np.array(v) for k, v in columns.items()}
    shaken = shaking.set_up(models.build_scene(job), numerics, np.array(time_s), columns, 1.0)
    energies = balance.EnergyBalance(shaken.scene, shaken.sample_s, shaken.motions)
    history = shaken.run(setup=energies.attach)
    rows = np.array(energies.rows)
    return {
        "status": history.status,
        "peak": history.peak_d_over_b,
        "broken": rows[-1][7],
        "last": rows[-1].tolist(),
        "residual": float(np.max(np.abs(rows[:, -1]))),
        "overturning": shaken.scene.overturning_energy_j,
    }
