"""Energy balance of runs in YADE."""

import numpy as np
import pytest
from yade_process import in_yade, resolved

pytestmark = pytest.mark.yade


def test_undamped_rocking_keeps_its_energy_for_a_minute():
    """Frictionless, undamped, two-sided rocking at the default step: drift below 1e-3."""
    config = resolved(facade={"friction_deg": 0.0})
    got = in_yade("accuracy_cases", "drift", config=config, seconds=60.0, ratio=0.5)
    total = np.array(got["total"])
    swing = np.ptp(total)
    f = config["facade"]
    h, b = f["height_m"], f["thickness_m"]
    mass = f["density_kg_m3"] * h * b * f["width_m"]
    scale = mass * 9.81 * 0.5 * (np.hypot(h, b) - h)  # what overturns it
    assert abs(total[-20:].mean() - total[:20].mean()) / scale < 1e-3
    assert swing / scale < 0.02
    # it is really rocking: kinetic energy is of the order of what was released
    assert total.mean() > 0.1 * scale


def test_dashpots_only_take_energy():
    """A damped release loses energy at every impact and never gains."""
    got = in_yade("accuracy_cases", "released", config=resolved(), model="W1", beta_s=0.0004,
                  ratio=0.6, seconds=15.0)  # fmt: skip
    theta, t = np.array(got["rotation"]), np.array(got["time"])
    peaks = [p for p in _peaks(theta) if p > 1e-4]
    assert len(peaks) >= 3
    assert np.all(np.diff(peaks) < 1e-4 * peaks[0])  # twin samples of one maximum
    assert t[-1] > 2.0


def _peaks(theta):
    inner = (theta[1:-1] > theta[:-2]) & (theta[1:-1] >= theta[2:]) & (theta[1:-1] > 0.002)
    return theta[1:-1][inner]
