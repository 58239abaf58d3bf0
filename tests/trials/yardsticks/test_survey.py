"""What counts as a history that repeats, without running one."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from tests.trials.yardsticks import survey

PGA = 2.0


def judged(monkeypatch, curve, by_step=0.0):
    """What `yardstick` says where the reference's peak is a function of amplitude over PGA."""

    def run(factors, *, step_s):
        shift = by_step if step_s < survey.STEP_S else 0.0
        found = [curve(f / PGA - 1.0) * (1.0 + shift) for f in factors]
        return SimpleNamespace(d_over_b=np.array(found))

    solver = SimpleNamespace(peaks=run, step_s=survey.STEP_S)
    monkeypatch.setattr(survey, "solver_of", lambda case, motion: solver)
    return survey.yardstick(None, None, PGA)


def test_a_smooth_curve_repeats_however_steep_it_is(monkeypatch):
    """8 % of d/b for 1 % of amplitude, and bent; the slope is d/b's own, relative."""
    found = judged(monkeypatch, lambda x: 0.4 * np.exp(8.0 * x + 100.0 * x**2))
    assert (found["steady"], found["repeats"]) == (1, 1)
    assert found["slope"] == pytest.approx(8.0, rel=1e-3)
    assert found["off_line"] < 2e-4
    assert found["yardstick"] == pytest.approx(0.4)
    assert found["lowest"] < 0.4 < found["highest"]


@pytest.mark.parametrize("place", survey.LINE)
def test_a_spike_beside_it_does_not_repeat_though_it_is_steady(monkeypatch, place):
    """2 % at any one of the four neighbours, which 1e-6 of amplitude does not see."""
    found = judged(monkeypatch, lambda x: 0.4 * (1.0 + 0.02 * (abs(x - place) < 2e-5)))
    assert (found["steady"], found["repeats"]) == (1, 0)
    assert found["off_line"] > survey.MOVED


def test_a_step_of_the_curve_does_not_repeat(monkeypatch):
    """1 % more from half of 1e-4 of amplitude on."""
    found = judged(monkeypatch, lambda x: 0.4 * (1.0 + 0.01 * (x > 5e-5)))
    assert (found["steady"], found["repeats"]) == (1, 0)


def test_what_a_step_or_a_millionth_of_amplitude_moves_is_not_steady(monkeypatch):
    """Nor is a façade that falls."""
    assert judged(monkeypatch, lambda x: 0.4, by_step=0.003)["steady"] == 0
    assert judged(monkeypatch, lambda x: 0.4 + 0.01 * (x > 0.0))["steady"] == 0
    assert judged(monkeypatch, lambda x: 1.0)["steady"] == 0


def test_the_summary_counts_by_both_rules():
    """One history that repeats, 0.4 % too small; one that is steady alone, 3 % too large."""
    rows = [
        {"model": "W1", "steady": 1, "repeats": 1, "yardstick": 0.5, "own": 0.498},
        {"model": "W1", "steady": 1, "repeats": 0, "yardstick": 0.5, "own": 0.515},
        {"model": "W1", "steady": 0, "repeats": 0, "yardstick": 1.0},
    ]
    lines = survey.summary(pd.DataFrame(rows, columns=survey.COLUMNS)).splitlines()
    assert lines[0] == "W1: 1 of 3, repeats"
    assert "1 of 1 within 1 %, 1 within 0.5 %" in lines[1]
    assert lines[2] == "W1: 2 of 3, steady"
    assert "1 of 2 within 1 %, 1 within 0.5 %" in lines[3]
    assert "worst +3.00 %" in lines[3]
