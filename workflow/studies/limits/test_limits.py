"""Verdicts of the map of where the methods fail, on cells whose answer is known beforehand."""

import numpy as np
import pytest
from rocking.records import Record

from studies.limits import study as limits


def burst(dt_s=0.01):
    """Three seconds of two sines that begin and end at rest."""
    t = np.arange(0.0, 3.0 + 1e-9, dt_s)
    wave = np.sin(np.pi * t / 3.0) ** 2 * (np.sin(2 * np.pi * t) + np.sin(5 * np.pi * t + 1.0))
    return Record("burst", wave, dt_s, source="surrogate")


@pytest.mark.parametrize("model", ["W1", "W2"])
def test_the_default_facade_is_agreed_upon(model):
    found = limits.verdict_of(model, {}, burst(), "pos")
    assert found["verdict"] == "agree", found
    assert abs(found["error"]) <= limits.AGREE
    assert 0.0 < found["d_over_b"] < 1.0


def test_what_cannot_stand_is_refused_with_what_would_work():
    found = limits.verdict_of("W1", {"facade": {"height_m": 18.0}}, burst(), "pos")
    assert found["verdict"] == "refused"
    assert "expected at most 13.36 (m)" in found["why"]


def test_a_long_scan_is_too_costly(monkeypatch):
    monkeypatch.setattr(limits, "LIMIT_S", 1e-6)
    found = limits.verdict_of("W1", {}, burst(), "pos")
    assert (found["verdict"], "scan would take" in found["why"]) == ("too costly", True)


def test_another_step_and_duration_keep_the_motion():
    record = burst()
    finer, longer = limits.shaped(record, dt_s=0.002), limits.shaped(record, duration_s=12.0)
    at = np.arange(0.0, 2.99, 0.01)
    fine = np.interp(at, finer.dt_s * np.arange(len(finer)), finer.acceleration_m_s2)
    whole = np.interp(at, record.dt_s * np.arange(len(record)), record.acceleration_m_s2)
    assert fine == pytest.approx(whole, abs=1e-12)
    assert len(longer) * longer.dt_s == pytest.approx(12.0)
    n = len(record)
    assert np.array_equal(longer.acceleration_m_s2[n : 2 * n], record.acceleration_m_s2)


def test_every_cell_is_asked_once():
    asked = [(axis, value, b, model) for axis, value, b, model, _, _ in limits.cells()]
    assert len(asked) == len(set(asked))
    assert {axis for axis, *_ in asked} == {"height [m]", *limits.AXES}


@pytest.mark.slow
def test_light_walls_get_a_step_that_suits_their_mass(monkeypatch):
    """Before walls of half a tonne a history repeats, and the reference solver of stacks agrees."""
    light = {"return_wall": {"building_mass_kg": 500.0}}
    found = limits.verdict_of("W2m", light, burst(), "pos")
    monkeypatch.setattr(limits, "LIMIT_S", 0.0)  # of the heavy ones the step is enough
    heavy = limits.verdict_of("W2m", {"return_wall": {"building_mass_kg": 66e3}}, burst(), "pos")
    assert found["verdict"] == "agree", found
    assert found["step_s"] < 0.2 * heavy["step_s"]
