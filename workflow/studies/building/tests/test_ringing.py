"""Periods read off a free vibration, and the second mode along an axis."""

import numpy as np
import pytest
from studies.building import explicit
from studies.building.modes import Modes


@pytest.mark.parametrize("period_s", [0.11, 0.27])
@pytest.mark.parametrize("decay_1_s", [0.0, 0.5])
def test_the_period_of_a_free_vibration_is_read_off_its_crossings(period_s, decay_1_s):
    """What comes before AFTER_S is of another period; a quiet tail of noise does not count."""
    t = np.arange(0.0, explicit.AFTER_S + 4.0, 0.002)
    wave = np.exp(-decay_1_s * t) * np.cos(2.0 * np.pi * t / period_s + 0.3)
    wave[t < explicit.AFTER_S] = np.sin(2.0 * np.pi * t[t < explicit.AFTER_S] / 0.05)
    tail = t > explicit.AFTER_S + 3.0
    wave[tail] = 1e-4 * np.sin(2.0 * np.pi * t[tail] / 0.02)
    assert explicit.ringing_period(t, wave) == pytest.approx(period_s, rel=2e-3)


@pytest.mark.parametrize(
    ("along_y", "period_s", "second"),
    [
        ((0.1, 0.6, 0.05, 0.2), (0.5, 0.3, 0.2, 0.1), 3),
        ((0.6, 0.2, 0.0, 0.1), (0.3, 0.29, 0.2, 0.1), 3),  # the second is a twin of the first
        ((0.6, 0.1, 0.3, 0.0), (0.3, 0.28, 0.1, 0.05), 2),
    ],
)
def test_the_second_mode_along_an_axis_bends_and_is_no_twin(along_y, period_s, second):
    modes, ratio = object.__new__(Modes), np.zeros((4, 6))
    ratio[:, 1] = along_y
    object.__setattr__(modes, "effective_ratio", ratio)
    period = np.array(period_s)
    object.__setattr__(modes, "omega", 2.0 * np.pi / period)
    assert modes.period_s == pytest.approx(period)
    assert explicit.second_along_y(modes) == second
