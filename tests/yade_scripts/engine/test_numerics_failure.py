"""A run that fails numerically is noticed, retried, recorded as failed, and never a collapse."""

import json

import numpy as np
import pytest
from numerics_cases import SAMPLE_STEPS
from rocking.collapse import probability
from rocking.collapse.ida import branches, read_curve
from yade_process import in_yade, resolved

from smdof.chain import floor_motions

CASES = "numerics_cases"
yade = pytest.mark.yade
WITHIN_STEPS = 30  # a step three times the critical one or longer is noticed within so many


@yade
@pytest.mark.parametrize("model", ["W1", "W2"])
@pytest.mark.parametrize("factor", [3.0, 8.0, 20.0])
def test_overturning_by_too_long_a_step_is_a_failure_and_no_collapse(model, factor):
    outcome = in_yade(CASES, "forced_run", config=resolved(), model=model, factor=factor)
    # the shaking is half of what uplifts the façade: whatever overturns it is not physics
    assert outcome["unchecked"] in ("overturned", "failed")
    assert outcome["status"] == "failed"
    assert outcome["blank"]
    assert "numerical failure" in outcome["reason"]
    assert outcome["steps"] <= WITHIN_STEPS


@yade
@pytest.mark.parametrize(("model", "factor"), [("W1", 1.8), ("W2", 1.6), ("W3", 3.0)])
def test_slow_growth_of_energy_is_a_failure_and_no_collapse(model, factor):
    outcome = in_yade(CASES, "forced_run", config=resolved(), model=model, factor=factor)
    assert outcome["status"] == "failed"
    assert "numerical failure" in outcome["reason"]


@yade
def test_the_same_shaking_below_the_critical_step_is_no_failure():
    outcome = in_yade(CASES, "forced_run", config=resolved(), model="W1", factor=0.9)
    assert (outcome["status"], outcome["unchecked"]) == ("ok", "ok")


@yade
@pytest.mark.parametrize(
    ("model", "peak_g"), [("W1", 0.2), ("W1", 1.0), ("W2", 0.2), ("W2", 1.0), ("W3", 0.4)]
)
def test_energy_balances_in_sound_runs_that_rock_and_overturn(model, peak_g):
    time_s = np.arange(0.0, 6.0, 0.005)
    pulse = np.sin(2 * np.pi * time_s / 0.7) * (time_s < 2.1)
    motion = floor_motions(pulse, 0.005)
    columns = {f"floor{j + 1}": row.tolist() for j, row in enumerate(motion.floors_m_s2)}
    record = {
        "time_s": motion.time_s.tolist(),
        "columns": {"ground": motion.ground_m_s2.tolist(), **columns},
    }
    config = resolved(numerics={"step_fraction": 0.1})
    outcome = in_yade(CASES, "shaken_run", config=config, model=model, record=record, peak_g=peak_g)
    assert outcome["status"] != "failed"
    assert outcome["excess"] < 0.02
    assert (outcome["walls"] > 0) == (model == "W2")  # W2's walls work on the façade: counted


@yade
@pytest.mark.parametrize("value", ["nan", "inf"])
def test_values_that_are_not_numbers_are_noticed_at_the_next_sample(value):
    outcome = in_yade(CASES, "poisoned_run", config=resolved(), value=value, at_step=1000)
    assert outcome["status"] == "failed"
    assert outcome["blank"]
    assert 0 <= outcome["steps"] - 1000 <= SAMPLE_STEPS + 1


@yade
def test_a_failed_run_is_tried_once_more_at_half_the_step():
    config = resolved()
    # between one and two critical steps: unstable as it stands, sound at the half
    rescued = in_yade(CASES, "retried_run", config=config, factor=1.8, retry=True)
    assert rescued["status"] == "ok"
    assert rescued["dt_s"] == pytest.approx(0.5 * rescued["tried_s"])
    assert "at half the step, after energy from nowhere" in rescued["reason"]
    alone = in_yade(CASES, "retried_run", config=config, factor=1.8, retry=False)
    assert alone["status"] == "failed"
    # beyond two, half the step is unstable too: tried once, not for ever
    lost = in_yade(CASES, "retried_run", config=config, factor=8.0, retry=True)
    assert lost["status"] == "failed"
    assert lost["dt_s"] == pytest.approx(0.5 * lost["tried_s"])


@yade
def test_a_blow_between_two_samples_is_not_a_failure():
    """The push of a short impact is missed by coarse samples: the second try sees it."""
    coarse = resolved()["numerics"]["sample_interval_s"]
    alone = in_yade(CASES, "struck_run", config=resolved(), interval_s=coarse, retry=False)
    assert alone["status"] == "failed"
    assert "energy from nowhere" in alone["reason"]
    again = in_yade(CASES, "struck_run", config=resolved(), interval_s=coarse, retry=True)
    fine = in_yade(CASES, "struck_run", config=resolved(), interval_s=0.001, retry=False)
    assert again["status"] == fine["status"] == "ok"
    assert again["peak"] == pytest.approx(fine["peak"], rel=0.01)
    assert 0.3 < fine["peak"] < 0.9


@yade
def test_an_interrupted_run_stops_yade_too():
    outcome = in_yade(CASES, "interrupted_run", config=resolved())
    assert outcome["caught"]
    assert not outcome["running"]
    assert outcome["end_s"] == pytest.approx(1.0, abs=0.02)


@yade
def test_a_failed_row_is_blank_and_its_reason_is_in_the_journal_and_the_log(tmp_path):
    config = resolved(ida={"mode": "grid", "grid_g": [0.03, 0.04]})
    outcome = in_yade(CASES, "failed_analysis", config=config, folder=str(tmp_path))
    rows = outcome["rows"]
    assert [row["status"] for row in rows] == ["failed", "failed"]  # nor does one end the curve
    assert {(row["d_over_b"], row["collapsed"]) for row in rows} == {(None, None)}
    entries = [json.loads(line) for line in (tmp_path / "j.jsonl").read_text().splitlines()]
    assert all("numerical failure" in entry["reason"] for entry in entries)
    assert all("numerical failure" in line for line in outcome["said"])


def test_failed_rows_are_neither_drawn_nor_counted_as_collapse(tmp_path):
    path = tmp_path / "curve.csv"
    head = "model,record,direction,pga_g,d_over_b,collapsed,status,dt_s,steps,wall_s\n"
    tail = "1e-4,10,1.0\n"
    path.write_text(
        head + f"W1,A,pos,0.1000,0.100000,0,ok,{tail}W1,A,pos,0.2000,,,failed,{tail}"
        f"W1,A,pos,0.3000,1.000000,1,overturned,{tail}W1,A,pos,0.4000,,,failed,{tail}"
    )
    curve = read_curve(path)
    stood, fell = branches(curve)
    assert list(stood["pga_g"]) == [0.1]
    assert list(fell["pga_g"]) == [0.3]
    row = probability.summary(None, curve, (), 0.01)
    assert (row["pga_safe_g"], row["pga_collapse_g"]) == (0.1, 0.3)
