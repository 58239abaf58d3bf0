"""YADE's viewer: what cannot be shown is said in one line."""

import pytest
from yade_process import run_study


@pytest.mark.yade
def test_without_a_display_the_viewer_is_refused_in_one_line(monkeypatch, tmp_path):
    monkeypatch.delenv("DISPLAY", raising=False)
    done = run_study("view", "--scene", "s.json", folder=tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "display" in done.stderr
