"""One history: forces obey Newton, and energies agree with the balance of every step."""

import csv
import json

import numpy as np
import pytest
from yade_process import in_yade, resolved, run_study

from yade_scripts.model import floor_motions

pytestmark = pytest.mark.yade

FEW = {
    "nodes_thickness": 9,
    "nodes_height": 5,
    "nodes_per_block": 5,
    "step_fraction": 0.1,
    "after_motion_s": 1.0,
}

TIME_S = np.linspace(0.0, 2.4, 241)
GROUND = 1.5 * np.where(TIME_S < 1.6, np.sin(2 * np.pi * TIME_S / 0.8), 0.0)


def history(folder, model, pga_g):
    """Columns of a history under two cycles of 0.8 s, floors moving up to 1.2 times the ground."""
    job = {**resolved(numerics=FEW), "model": model, "beta_s": 0.002}
    (folder / "scene.json").write_text(json.dumps(job))
    floors = [(1.0 + 0.05 * j) * GROUND for j in range(1, 5)]
    floor_motions.write(folder / "motion.csv", TIME_S, GROUND, floors)
    words = ["--scene", "scene.json", "--motion", "motion.csv", "--record", "R"]
    done = run_study(
        "history",
        *words,
        *("--direction", "pos", "--pga", str(pga_g), "--output", "history.csv"),
        folder=folder,
    )
    assert done.returncode == 0, done.stderr
    with open(folder / "history.csv", newline="") as handle:
        rows = list(csv.DictReader(handle))
    numbers = [name for name in rows[0] if name not in ("model", "record", "direction", "status")]
    return job, rows[0]["status"], {n: np.array([float(r[n]) for r in rows]) for n in numbers}


def _mean(values):
    return 0.5 * (values[1:] + values[:-1])


def _longest(holds):
    """Indices of the longest stretch in which `holds` is true, its ends left out."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], holds.astype(int), [0]))))
    begin, end = max(edges.reshape(-1, 2), key=lambda pair: pair[1] - pair[0])
    return np.arange(begin + 2, end - 2)


def test_contact_forces_are_what_moves_the_facade(tmp_path):
    """Over the run the contacts carry the weight, and their push is the façade's momentum."""
    job, status, h = history(tmp_path, "W1", 0.153)
    f = job["facade"]
    mass = f["density_kg_m3"] * f["height_m"] * f["thickness_m"] * f["width_m"]
    t = h["time_s"]
    assert status == "ok"
    assert np.abs(h["d_over_b"]).max() > 0.02
    upward = np.trapezoid(h["base_z_n"] + h["walls_z_n"], t) / np.ptp(t)
    assert upward == pytest.approx(mass * 9.80665, rel=0.01)
    # outward, where no sample can have missed an impact: impulse is the change of momentum
    spin = np.gradient(h["rotation_rad"], t)
    ground = np.concatenate(([0.0], np.cumsum(_mean(h["ground_m_s2"]) * np.diff(t))))
    momentum = mass * (ground + h["velocity_m_s"] - 0.5 * f["height_m"] * spin)
    push = h["base_y_n"] + h["walls_y_n"]
    apart = _longest(h["walls_y_n"] == 0.0)
    assert np.ptp(t[apart]) > 0.2
    impulse = np.concatenate(([0.0], np.cumsum(_mean(push[apart]) * np.diff(t[apart]))))
    gained = momentum[apart] - momentum[apart][0]
    assert np.abs(gained - impulse).max() < 0.05 * np.ptp(momentum)
    assert np.abs(h["ground_m_s2"]).max() == pytest.approx(0.153 * 9.80665, rel=0.01)


def test_what_is_lost_is_what_dashpots_and_friction_take(tmp_path):
    """Input less stored, from samples, beside the full balance of every step."""
    job, _, h = history(tmp_path, "W1", 0.153)
    columns = {"ground": (GROUND * (0.153 * 9.80665 / np.abs(GROUND).max())).tolist()}
    balance = in_yade(
        "accuracy_cases",
        "balanced",
        config=job,
        model="W1",
        beta_s=0.002,
        fraction=job["numerics"]["step_fraction"],
        time_s=TIME_S.tolist(),
        columns=columns,
    )
    lost = sum(balance["last"][5:8])
    assert h["lost_j"][-1] == pytest.approx(lost, rel=0.05)
    assert lost > 0.0
    assert np.diff(h["lost_j"]).min() > -0.02 * lost  # nothing comes back


def test_an_intensity_that_is_none_is_refused_in_one_line(tmp_path):
    words = ["--scene", "s", "--motion", "m", "--record", "R", "--direction", "pos"]
    done = run_study("history", *words, "--pga", "0", "--output", "h.csv", folder=tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "PGA of 0 g" in done.stderr
