"""Cosines and sines of the compiled solver."""

import math

import numpy as np
import pytest
from rocking.solver.sines import cos_sin


def _units_off(angles):
    """Errors of cosine and sine of each angle, in units of their last digit; shape (n, 2)."""
    found = np.array([cos_sin(float(angle), True) for angle in angles])
    wide = np.asarray(angles, np.longdouble)
    exact = np.stack((np.cos(wide), np.sin(wide)), axis=1)
    return np.abs(found - exact) / np.spacing(np.abs(exact.astype(float)))


@pytest.mark.parametrize(
    ("low", "high", "most"),
    [(1e-12, 0.1, 0.51), (0.1, math.pi / 4.0, 0.8), (0.7, 1.7, 1.5), (1.7, 1e3, 1.5)],
)
def test_series_are_right_to_the_last_digit_or_two(low, high, most):
    rng = np.random.default_rng(7)
    angles = rng.uniform(low, high, 5000) * rng.choice((-1.0, 1.0), 5000)
    assert _units_off(angles).max() < most


def test_every_quarter_of_a_turn_has_its_signs():
    quarters = np.arange(-9, 10) * (math.pi / 2.0)
    for off in (-0.3, 0.0, 0.3):
        for angle in quarters + off:
            expected = math.cos(angle), math.sin(angle)
            assert cos_sin(float(angle), True) == pytest.approx(expected, abs=3e-16)


def test_an_angle_that_is_not_wanted_is_zero_and_one_that_is_not_finite_gives_none():
    assert cos_sin(0.4, False) == (1.0, 0.0)
    for angle in (math.nan, math.inf, -math.inf):
        assert np.isnan(cos_sin(angle, True)).all()
