"""YADE's viewer: walls move as they do in a run; what cannot be shown is said in one line."""

import json

import numpy as np
import pytest
from yade_process import in_yade, resolved, run_study

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2


@pytest.mark.yade
def test_without_a_display_the_viewer_is_refused_in_one_line(monkeypatch, tmp_path):
    monkeypatch.delenv("DISPLAY", raising=False)
    done = run_study("view", *named(tmp_path, "W2"), folder=tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "display" in done.stderr


@pytest.mark.yade
@pytest.mark.parametrize("missing", ["scene.json", "motion.csv"])
def test_a_file_that_is_not_there_is_named_before_the_viewer_opens(monkeypatch, tmp_path, missing):
    monkeypatch.setenv("DISPLAY", ":7")
    words = named(tmp_path, "W2")
    (tmp_path / missing).unlink()
    done = run_study("view", *words, folder=tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert f"No such file or directory: '{tmp_path / missing}'" in done.stderr


SHARE = {"ground": 1.0, "floor1": 1.2, "floor2": 1.5, "floor3": 1.8, "floor4": 2.0}


def named(folder, model, pga_g=0.2):
    """Words for a model under one second of sine, whose files are written."""
    scene, table = folder / "scene.json", folder / "motion.csv"
    scene.write_text(json.dumps({**resolved(), "model": model, "beta_s": 0.00276}))
    time_s = np.arange(0.0, 1.0, 0.01)
    head = ",".join(["time_s", *(f"{name}_m_s2" for name in SHARE)])
    ground = np.sin(2.0 * np.pi * time_s)
    columns = np.transpose([time_s, *(share * ground for share in SHARE.values())])
    np.savetxt(table, columns, delimiter=",", header=head, comments="")
    words = ["--scene", str(scene), "--motion", str(table), "--record", "X", "--direction", "pos"]
    return [*words, "--pga", str(pga_g)]


def played(folder, model, pga_g, until_s):
    """What `view_cases.played` tells of it."""
    words = named(folder, model, pga_g)
    return in_yade("view_cases", "played", arguments=words, until_s=until_s)


@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.parametrize("model", ["W2", "W3"])
def test_frames_follow_their_walls_when_yade_runs_by_itself(model, tmp_path):
    """Play is YADE's own run: every wall is drawn where its motion, integrated twice, has it."""
    found = played(tmp_path, model, 0.2, 0.4)
    assert "base" in found["frames"]
    assert sum(name.startswith("return wall") for name in found["frames"]) == 4 * (model == "W2")
    once = 0.2 * STANDARD_GRAVITY_M_S2  # ∫∫ sin ωt = t/ω − sin ωt/ω²
    omega, t = 2.0 * np.pi, found["time_s"]
    moved_m = once * (t / omega - np.sin(omega * t) / omega**2)
    for name, frame_m in found["frames"].items():
        expected = SHARE[found["motions"][name]] * moved_m
        assert frame_m == pytest.approx(expected, abs=0.005), name  # it follows every 5 ms
        assert frame_m > 0.05
    assert found["facade_m"] > 0.02


@pytest.mark.yade
@pytest.mark.slow
def test_play_pauses_where_the_facade_has_fallen(tmp_path):
    assert 0.5 < played(tmp_path, "W1", 0.6, 8.0)["time_s"] < 5.0
