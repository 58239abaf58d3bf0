"""When bonds are looked at again, and peaks between samples: arithmetic, without YADE."""

import numpy as np
import pytest

from yade_scripts.engine.bonds import safe_wait
from yade_scripts.engine.simulate import cubic_peak


@pytest.mark.parametrize("left_m", [1e-6, 1e-4, 1e-2])
@pytest.mark.parametrize("speed_m_s", [0.0, 0.05, 1.0])
def test_no_node_moves_by_more_than_is_left_before_the_next_look(left_m, speed_m_s):
    """At up to 5 g, more than façades bear that bonds hold; nor is it looked at far too often."""
    wait_s = safe_wait(left_m, speed_m_s)
    moved = speed_m_s * wait_s + 0.5 * 5.0 * 9.81 * wait_s**2
    assert left_m / 5.0 < moved < left_m


@pytest.mark.parametrize("turn", [0.13, 0.37, 0.5, 0.81])
@pytest.mark.parametrize("skew", [0.2, 1.0, 5.0])
def test_a_peak_between_samples_is_that_of_the_motion(turn, skew):
    """A cubic that turns once between two samples, ẏ = −(t − s)(t + a), of either sign."""
    t = np.array([0.0, 1.0])

    def value(t):
        return 5.0 + t * (-(t**2) / 3.0 + 0.5 * (turn - skew) * t + turn * skew)

    rate = -(t - turn) * (t + skew)
    for sign in (1.0, -1.0):
        found = cubic_peak(t, sign * value(t), sign * rate)
        assert found == pytest.approx(value(turn), abs=8e-4)  # 32 steps between two samples
    assert max(value(t)) < value(turn) - 2e-3
