"""YADE's viewer: walls move as they do in a run; what cannot be shown is said in one line."""

import json

import numpy as np
import pytest
from yade_process import in_yade, resolved, run_study

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2


@pytest.mark.yade
def test_without_a_display_the_viewer_is_refused_in_one_line(monkeypatch, tmp_path):
    monkeypatch.delenv("DISPLAY", raising=False)
    done = run_study("view", "--scene", "s.json", folder=tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "display" in done.stderr


@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.parametrize("model", ["W2", "W3"])
def test_frames_follow_their_walls_when_yade_runs_by_itself(model, tmp_path):
    """Play is YADE's own run: every wall is drawn where its motion, integrated twice, has it."""
    scene, table = tmp_path / "scene.json", tmp_path / "motion.csv"
    scene.write_text(json.dumps({**resolved(), "model": model, "beta_s": 0.00276}))
    time_s = np.arange(0.0, 1.0, 0.01)
    share = {"ground": 1.0, "floor1": 1.2, "floor2": 1.5, "floor3": 1.8, "floor4": 2.0}
    head = ",".join(["time_s", *(f"{name}_m_s2" for name in share)])
    ground = np.sin(2.0 * np.pi * time_s)
    columns = np.transpose([time_s, *(s * ground for s in share.values())])
    np.savetxt(table, columns, delimiter=",", header=head, comments="")
    words = ["--scene", str(scene), "--motion", str(table), "--record", "X", "--direction", "pos"]
    found = in_yade("view_cases", "played", arguments=[*words, "--pga", "0.2"], until_s=0.4)
    assert "base" in found["frames"]
    assert sum(name.startswith("return wall") for name in found["frames"]) == 4 * (model == "W2")
    once = 0.2 * STANDARD_GRAVITY_M_S2  # ∫∫ sin ωt = t/ω − sin ωt/ω²
    omega, t = 2.0 * np.pi, found["time_s"]
    moved_m = once * (t / omega - np.sin(omega * t) / omega**2)
    for name, frame_m in found["frames"].items():
        expected = share[found["motions"][name]] * moved_m
        assert frame_m == pytest.approx(expected, abs=0.005), name  # it follows every 5 ms
        assert frame_m > 0.05
    assert found["facade_m"] > 0.02
