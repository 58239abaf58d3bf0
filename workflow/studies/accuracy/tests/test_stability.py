"""The critical step predicted from K, M and C against the one that YADE shows."""

import numpy as np
import pytest
from studies.accuracy.yade import stability
from yade_process import in_yade, resolved

from yade_scripts.engine import simulate
from yade_scripts.model import facade
from yade_scripts.model.stiffness import critical_step

BETA_S = 0.00276


@pytest.mark.yade
@pytest.mark.parametrize(
    ("name", "stiffness", "beta_s"),
    [("W1", 1.0, BETA_S), ("W2", 31.6, 10 * BETA_S), ("stack", 0.0316, 0.0)],
)
def test_observed_limit_is_the_predicted_one(name, stiffness, beta_s):
    got = in_yade(
        "studies.accuracy.tests.stability_cases",
        "limit",
        config=resolved(),
        name=name,
        stiffness_factor=stiffness,
        beta_s=beta_s,
    )
    assert got == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("ratio", [0.98, 1.02])
@pytest.mark.parametrize("zeta", [0.0, 0.3, 3.0])
def test_spectral_radius_passes_one_at_the_critical_step(zeta, ratio):
    """Companion matrix of the scheme for one oscillator, built from its recurrence."""
    omega = 40.0
    dt = ratio * 2.0 / omega * (np.sqrt(1.0 + zeta**2) - zeta)
    k, c = (omega * dt) ** 2, 2.0 * zeta * omega * dt
    radius = np.max(np.abs(np.linalg.eigvals([[2.0 - k - c, c - 1.0], [1.0, 0.0]])))
    assert (radius > 1.0 + 1e-6) == (ratio > 1.0)


def test_stack_is_softer_than_its_joints_and_needs_a_smaller_step():
    """A chain of equal masses: ω_max grows towards 2√(k/m) with its length."""
    limits = [critical_step(stability.stack_scene(n, 0.0)) for n in (1, 2, 10, 20)]
    assert np.all(np.diff(limits) < 0.0)
    assert limits[3] / limits[2] > 0.99


def test_a_step_beyond_the_critical_one_is_refused():
    config = resolved()
    scene = facade.facade_scene(config, "W1", BETA_S)
    limit = critical_step(scene)
    numerics = {**config["numerics"], "step_s": 1.001 * limit}
    with pytest.raises(ValueError, match="beyond the critical step"):
        simulate.choose_step(scene, numerics)
    assert simulate.choose_step(scene, {**numerics, "step_s": 0.999 * limit})[0] < limit
