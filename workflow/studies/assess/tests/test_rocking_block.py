"""The rocking block of one degree of freedom beside closed forms."""

import math

import numpy as np
import pytest
from rocking.mechanics.closed_forms import (
    amplitude_after_impacts,
    block,
    overturning_half_sine,
    restitution_one_sided,
)
from studies.assess.rocking_block import overturning_pga, peak_rotation


def test_one_degree_of_freedom_rebounds_as_the_closed_form():
    """Released at θ0/α = 0.5, no shaking: one impact later at 1 − √(1 − 1.21·0.75) = 0.696.

    A restitution above 1 makes the rebound the largest rotation; 4/p ends before the next impact.
    """
    h, b = 10.0, 0.1
    alpha, _, p = block(h, b)
    quiet = np.zeros(round(4.0 / p / 0.005))
    found = peak_rotation(quiet, 0.005, h, b, start_rad=0.5 * alpha, restitution=1.1)
    assert found == pytest.approx(amplitude_after_impacts(0.5, 1.1, 1), rel=2e-3)
    assert found == pytest.approx(0.6959, rel=2e-3)
    finer = peak_rotation(
        np.zeros(50 * quiet.size), 1e-4, h, b, start_rad=0.5 * alpha, restitution=1.1
    )
    assert found == pytest.approx(finer, rel=1e-6)  # steps of 0.5 and 0.1 ms, second order
    assert abs(restitution_one_sided(alpha)) == pytest.approx(0.5, abs=0.01)


def test_one_degree_of_freedom_overturns_where_the_closed_form_says():
    """Half sine with ω/p = 3 overturns a slender block without impact from x = 2.2939 on."""
    h, b = 10.0, 0.2
    alpha, _, p = block(h, b)
    omega = 3.0 * p
    dt = math.pi / omega / 2000
    pulse = np.concatenate([np.sin(omega * dt * np.arange(2001)), np.zeros(30000)])
    x = overturning_half_sine(3.0)
    found = overturning_pga(pulse, dt, h, b, -1.0, 3.0, ratio=1.002)
    assert found / math.tan(alpha) == pytest.approx(x, rel=6e-3)
    assert math.isnan(overturning_pga(pulse, dt, h, b, 1.0, 0.9 * x * alpha))
