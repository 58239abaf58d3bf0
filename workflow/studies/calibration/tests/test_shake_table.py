"""The shake-table wall: tilted rest as geometry, gap, one-sidedness, and its entry point."""

import json
import math

import numpy as np
import pytest
from rocking.mechanics import closed_forms
from studies.calibration.free_rocking import SECTIONS
from studies.shared.restitution import read_archive
from yade_process import resolved, run_study

pytestmark = pytest.mark.yade

H, B, TILT = 3.0, 0.25, 0.348


def wall(**facade):
    config = resolved(
        models=["W1"],
        facade={
            "height_m": H,
            "thickness_m": B,
            "width_m": 3.0,
            "density_kg_m3": 1810.0,
            "e_mpa": 4050.0,
            "gap_m": 0.004,
            "tilt_deg": TILT,
            **facade,
        },
        return_wall={"thickness_m": 0.25},
        numerics={"step_fraction": 0.2, "after_motion_s": 1.0},
    )
    return {key: config[key] for key in SECTIONS}


def shaken(folder, motions, **facade):
    """Run (name, time, acceleration) motions; returns what the archive says of each by name."""
    tests = []
    for name, time, acceleration in motions:
        path = folder / f"{name}.csv"
        np.savetxt(
            path,
            np.stack([time, acceleration], axis=1),
            "%.9g",
            ",",
            header="time_s,ground_m_s2",
            comments="",
        )
        tests.append(
            {
                "id": name,
                "config": wall(**facade),
                "model": "W1",
                "beta_s": 0.00086,
                "motion": str(path),
                "factor": 1.0,
            }
        )
    (folder / "tests.json").write_text(json.dumps(tests))
    done = run_study(
        "walls",
        "--list",
        folder / "tests.json",
        "--output",
        folder / "out.npz",
    )
    assert done.returncode == 0, done.stderr
    return {r["id"]: r for r in read_archive(folder / "out.npz")}


def ramp(level_g):
    """Ground accelerating inwards, slowly up to a level: the wall is pushed outwards."""
    return np.array([0.0, 6.0, 8.0]), -9.81 * level_g * np.array([0.0, 1.0, 1.0])


def test_rests_tilted_and_falls_beyond_its_static_capacity(tmp_path):
    """It stays at h·sin φ when left alone; a slow push overturns it earlier by tan φ.

    On this base, which gives way under the toe, an upright wall tips at 0.065 g, not at
    tan α = 0.083 g.
    """
    upright = closed_forms.tip_over_compliant_base(H, B, 1810.0, 4.05e9 / H)[1]
    capacity = upright - math.tan(math.radians(TILT))
    quiet = np.array([0.0, 1.0]), np.zeros(2)
    done = shaken(
        tmp_path,
        [("quiet", *quiet), ("below", *ramp(0.93 * capacity)), ("above", *ramp(1.03 * capacity))],
    )
    rest = H * math.sin(math.radians(TILT))
    # released upright in its own frame, it settles outwards under the eccentric weight and
    # rings about that: rotation ρgh·(h/2)sin φ/(jkn·b²/12) of a linear base jkn = E/h
    settled = H * (1810.0 * 9.81 * H * 0.5 * rest / (4.05e9 / H * B**2 / 12.0))
    moved = done["quiet"]["d_m"] - rest
    assert moved.max() == pytest.approx(2.0 * settled, rel=0.05)
    assert moved.min() > -0.05 * settled
    assert done["below"]["status"] == "ok"
    assert done["below"]["d_m"].max() - rest < 0.1 * B
    assert done["above"]["status"] == "overturned"
    # an upright wall stands the same push
    done = shaken(tmp_path, [("upright", *ramp(1.03 * capacity))], tilt_deg=0.0)
    assert done["upright"]["status"] == "ok"


def test_gap_lets_it_lean_back_that_far_only(tmp_path):
    """Pushed inwards, the upright wall closes the gap and leans on the return walls."""
    push = np.array([0.0, 2.0, 2.5]), 9.81 * 0.12 * np.array([0.0, 1.0, 1.0])
    done = shaken(tmp_path, [("in", *push)], tilt_deg=0.0)["in"]
    assert done["status"] == "ok"
    held = done["d_m"][(done["time_s"] > 2.0) & (done["time_s"] < 2.5)]
    # the gap, and the compression of contacts with E/(h/2) on two walls of 0.25 m
    assert held.min() < -0.004
    assert held.min() > -0.0055


def test_missing_key_is_named(tmp_path):
    (tmp_path / "tests.json").write_text(json.dumps([{"id": "a"}]))
    done = run_study(
        "walls",
        "--list",
        tmp_path / "tests.json",
        "--output",
        tmp_path / "out.npz",
    )
    assert done.returncode == 1
    assert "wall 1 has no config" in done.stderr
    assert done.stderr.count("\n") == 1
