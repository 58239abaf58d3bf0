"""Arithmetic of the study by hand: what is run where, and what stands in its table."""

import numpy as np
import pytest
from rocking.records import Record

from studies.limits import study as limits


def test_a_scan_is_too_costly_by_its_steps_and_not_below_the_limit(monkeypatch):
    """So many runs of so many steps to the motion's end, at a stated cost of each."""
    t = 0.01 * np.arange(300)
    record = Record("burst", np.sin(6.0 * t) * np.exp(-((t - 1.0) ** 2)), 0.01, "file")
    monkeypatch.setattr(limits, "LIMIT_S", 0.0)
    found = limits.verdict_of("W1", {}, record, "pos")
    assert found["verdict"] == "too costly"
    duration_s = found["steps"] * found["step_s"]
    assert duration_s >= 3.0 - 0.01
    scan_s = limits.SCAN_RUNS * found["steps"] * limits.STEP_COST_S
    assert f"some {scan_s / 3600.0:.1f} h" in found["why"]
    monkeypatch.setattr(limits, "STEP_COST_S", 3600.0 / limits.SCAN_RUNS)
    again = limits.verdict_of("W1", {}, record, "pos")
    assert f"some {found['steps']:.1f} h" in again["why"]
    seen = []
    monkeypatch.setattr(limits, "LIMIT_S", 3600.0 * found["steps"])
    monkeypatch.setattr(limits.search, "climb", lambda *given: seen.append(given) or 1 / 0)
    with pytest.raises(ZeroDivisionError):  # at the limit itself it goes on to search
        limits.verdict_of("W1", {}, record, "pos")
    assert len(seen) == 1
