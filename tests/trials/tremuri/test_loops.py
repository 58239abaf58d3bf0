"""The storeys of TREMURI's house as arrays, against the laws that a run marches with."""

import numpy as np
import pytest

from tests.trials.tremuri.loops import FLAG_SHARE, HARDENING, Response
from yade_scripts.model.storeys import FLAG, LAWS, MEMORY, NEVER_M, Loops, StoreyRules

YIELD_N, K_N_M = np.array([4e3, 3e3]), np.array([2e6, 1e6])


@pytest.mark.parametrize("law", LAWS)
def test_both_have_the_same_forces_along_any_path(law):
    drifts = np.cumsum(5e-4 * np.random.default_rng(4).standard_normal((3000, 2)), axis=0)
    number, u_y = LAWS.index(law), YIELD_N / K_N_M
    share = FLAG_SHARE if number == FLAG else 1.0
    rules = StoreyRules(number, K_N_M, u_y, HARDENING, 0.0, share, NEVER_M, 0.0, 1.0)
    one, other = Loops(rules, np.zeros((2, MEMORY))), Response(law, YIELD_N, K_N_M, 1)
    for drift in drifts:
        less = [one.less(i, u) for i, u in enumerate(drift)]
        assert other.move(drift[None])[0] == pytest.approx(K_N_M * drift - less, abs=1e-6)
    assert np.all(other.peak_m > 2.0 * u_y)
