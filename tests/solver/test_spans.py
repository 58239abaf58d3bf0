"""Largest displacement of every second of a history, beside the history itself."""

import numpy as np
import pytest
from rocking import Motion
from rocking.collapse.curve import run_by
from rocking.records import Record
from rocking.solver import history, peaks
from rocking.solver.inputs import SPAN_S, steps_of
from study_cases import study_case

T = 0.01 * np.arange(400)
PULSES = Motion(Record("pulses", -np.sin(2.5 * np.pi * T) * (T < 1.6), 0.01, source="file"))
COURSES = {"facade.courses": 3, "facade.courses_growth": 1.5}


@pytest.mark.parametrize(("model", "wall"), [("W1", {}), ("W2m", {}), ("W2", COURSES)])
def test_each_second_has_the_largest_displacement_of_the_history_in_it(model, wall):
    """Against every step of the series, of histories alone and side by side, until they fall."""
    building = {"return_wall.building_mass_kg": 6.6e4} if model.endswith("m") else {}
    case = study_case(model, {**wall, **building, "numerics.after_motion_s": 2.0})
    screen = run_by("planar", case, PULSES, "pos")
    plane, how = screen.planes[0], {"carried": screen.carried, "step_s": screen.steps_s[0]}
    motions, factors = screen.shaking(np.linspace(0.05, 0.45, 12))
    numerics = {**screen.numerics, "brief": None}
    found = peaks(plane, motions, numerics, factors, **how)
    assert found.overturned.any()
    assert not found.overturned.all()
    steps = steps_of(found.step_s)
    assert steps * found.step_s == pytest.approx(SPAN_S, rel=2e-3)
    for k in (0, int(np.argmax(found.overturned)) - 1, len(factors) - 1):
        alone = peaks(plane, motions[k], numerics, factors[k : k + 1], **how)
        width = alone.spans.shape[1]
        assert np.array_equal(alone.spans[0], found.spans[k, :width])
        series = history(plane, motions[k], numerics, factors[k], sample_s=0.0, **how)
        d_over_b = np.abs(series.d_m) / plane.thickness_m
        each = np.maximum.reduceat(d_over_b, np.arange(0, d_over_b.size, steps))
        assert found.spans[k, : each.size] == pytest.approx(each, abs=1e-12)
        assert np.all(found.spans[k, each.size :] == 0.0)
    assert np.array_equal(found.spans.max(axis=1), found.d_over_b)
    assert np.count_nonzero(found.spans > 0.01, axis=1).max() > 2
