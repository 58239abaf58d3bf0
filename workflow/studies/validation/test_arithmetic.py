"""Arithmetic of the study by hand: what is run where, and what stands in its table."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from studies.validation import predictions

GABLES = Path(__file__).resolve().parents[3] / "config" / "predictions" / "gables"


def test_a_gable_s_motions_are_scaled_to_the_stated_pga_at_its_foot(monkeypatch):
    """What the solver is given times its factor has the stated peak, whatever the record has."""
    seen = []

    def peaks(plane, motion, numerics, size, **_):
        seen.append(np.asarray(size))
        return SimpleNamespace(overturned=np.asarray(size) * 0.0 + 1.0 > 0.0)

    feet = []

    def driving(scene, t, columns):
        feet.append(np.abs(columns["ground"]).max())
        return columns

    signs, loaded = iter((1.0, -1.0)), predictions.load

    def load(name, table):
        found, sign = loaded(name, table), next(signs)
        peak = found.acceleration_m_s2[np.abs(found.acceleration_m_s2).argmax()]
        return replace(found, acceleration_m_s2=sign * np.sign(peak) * found.acceleration_m_s2)

    monkeypatch.setattr(predictions, "load", load)  # one with its peak either way
    monkeypatch.setattr(predictions, "peaks", peaks)
    monkeypatch.setattr(predictions, "driving", driving)
    specimen, _ = predictions.read(GABLES)
    specimen = {**specimen, "records": specimen["records"][:2], "phase_deg": [0.0]}
    specimen |= {"amplification": [2.0], "variants": dict(list(specimen["variants"].items())[:1])}
    table = predictions.foot_and_top(specimen, pd.DataFrame(), GABLES, False, 1)
    assert len(seen) == 2
    for foot, size in zip(feet, seen, strict=True):
        assert foot * size / 9.80665 == pytest.approx(specimen["pga_g"], rel=1e-9)
    assert table["pga_g"].tolist() == specimen["pga_g"]
    assert (table["probability"] == 1.0).all()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_run_s_own_pga_is_that_of_its_foot_whichever_way_it_goes(monkeypatch, sign):
    foot = sign * np.array([0.0, 3.0, -1.0, 0.0])
    motion = 0.01 * np.arange(4), foot, foot
    answer = SimpleNamespace(overturned=np.array([True]))
    monkeypatch.setattr(predictions, "foot_and_top_files", lambda *given: motion)
    monkeypatch.setattr(predictions, "driving", lambda *given: None)
    monkeypatch.setattr(predictions, "peaks", lambda *given: answer)
    specimen, _ = predictions.read(GABLES)
    specimen = {**specimen, "amplification": []}
    runs = pd.DataFrame({"run": [1], "foot": ["a"], "top": ["b"]})
    table = predictions.foot_and_top(specimen, runs, GABLES, False, 1)
    assert table["pga_g"].to_numpy() == pytest.approx(3.0 / 9.80665)
    assert (table["probability"] == 1.0).all()
