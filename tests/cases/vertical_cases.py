"""Runs under vertical motion for tests; imported inside YADE's Python."""

import accuracy_cases
import numpy as np

from yade_scripts.commands import shaking
from yade_scripts.engine import adapter, energy_check, simulate
from yade_scripts.model import facade, floor_motions, models


class Noted(energy_check.EnergyCheck):
    """Keeps energy and work at every sample."""

    def __init__(self, scene, motions):
        super().__init__(scene, motions)
        self.rows = []

    def __call__(self):
        super().__call__()
        self.rows.append((self.energy, self.work))


def release(config, beta_s, ratio, vertical_m_s2, limit_s):
    """Outward rotation and energy check of a free-standing façade released under a constant a_z."""
    scene = facade.facade_scene(config, "free", beta_s, release_ratio=ratio)
    time_s = np.array([0.0, limit_s])
    columns = {"ground": np.zeros(2), "vertical": np.full(2, vertical_m_s2)}
    scene, columns = floor_motions.shaken(scene, columns)
    motions = {name: adapter.SupportMotion(time_s, columns[name]) for name in scene.motions}
    step, _ = simulate.choose_step(scene, config["numerics"])
    rules = simulate.StopRules(0.0, 0.99 * limit_s, overturn_ratio=1e9)
    check = Noted(scene, motions)
    h = simulate.run(scene, motions, step, rules, sample_s=0.001, check=check)
    return {
        "time_s": h.time_s.tolist(),
        "rotation_rad": h.rotation_rad.tolist(),
        "ledger": check.rows,
        "stored": check.stored,
        "excess": check.excess,
        "status": h.status,
    }


def set_up(config, beta_s, time_s, columns, factors):
    """Accelerations of a W2 as it is set up for some factors, by motion; nothing is run."""
    job = {**config, "model": "W2", "beta_s": beta_s}
    scene, numerics = models.build_scene(job), models.numerics(job)
    columns = {name: np.array(values) for name, values in columns.items()}
    return [
        {
            name: motion.acceleration_m_s2[: len(time_s)].tolist()
            for name, motion in shaking.set_up(
                scene, numerics, np.array(time_s), columns, factor
            ).motions.items()
        }
        for factor in factors
    ]


def every(releases, launched, shakings, balance):
    """All that the tests of vertical motion ask of YADE, in one process."""
    found = {"releases": [release(**case) for case in releases], "peaks": {}}
    found["launched"] = release(**launched)
    for model, case in shakings.items():
        job = {**case["config"], "model": model, "beta_s": case["beta_s"]}
        time_s = np.array(case["time_s"])
        columns = {name: np.array(values) for name, values in case["columns"].items()}
        run = shaking.set_up(
            models.build_scene(job), models.numerics(job), time_s, columns, case["factor"]
        ).retried()
        found["peaks"][model] = [run.peak_d_over_b, run.status, run.reason]
    found["balance"] = accuracy_cases.balanced(**balance)
    return found
