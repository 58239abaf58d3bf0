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
    got = in_yade(
        "accuracy_cases",
        "released",
        config=resolved(),
        model="W1",
        beta_s=0.0004,
        ratio=0.6,
        seconds=15.0,
    )
    theta, t = np.array(got["rotation"]), np.array(got["time"])
    peaks = [p for p in _peaks(theta) if p > 1e-4]
    assert len(peaks) >= 3
    assert np.all(np.diff(peaks) < 1e-4 * peaks[0])  # twin samples of one maximum
    assert t[-1] > 2.0


# the energy balance costs by the node and by the step
FEW = {"nodes_thickness": 5, "nodes_height": 5, "nodes_per_block": 5, "after_motion_s": 0.3}


def shake(amplitude_m_s2, relative=0.0):
    """Two cycles of 0.8 s for the base, and floors that move `relative` times more."""
    t = np.linspace(0.0, 2.4, 241)
    ground = amplitude_m_s2 * np.where(t < 1.6, np.sin(2 * np.pi * t / 0.8), 0.0)
    floors = {f"floor{j}": ((1.0 + relative * j / 4) * ground).tolist() for j in range(1, 5)}
    return {"time_s": t.tolist(), "columns": {"ground": ground.tolist(), **floors}}


@pytest.mark.slow
@pytest.mark.parametrize(("model", "amplitude", "relative"), [("W1", 0.9, 0.0), ("W2", 0.5, 0.2)])
def test_energy_of_a_run_balances_to_second_order(model, amplitude, relative):
    """Input = stored + dashpots + friction; the residual falls with the step squared."""
    coarse, fine = (
        in_yade(
            "accuracy_cases",
            "balanced",
            config=resolved(numerics=FEW),
            model=model,
            beta_s=0.002,
            fraction=fraction,
            **shake(amplitude, relative),
        )
        for fraction in (0.4, 0.2)
    )
    assert coarse["status"] == fine["status"] == "ok"
    assert fine["peak"] > 0.1  # it rocks
    assert fine["residual"] < 1e-3 * fine["overturning"]
    assert np.log(coarse["residual"] / fine["residual"]) / np.log(2.0) > 1.5
    _, put_in, _, _, _, dashpots, friction, fracture, _ = fine["last"]
    assert dashpots > 0.25 * put_in
    assert friction > 0.0
    assert fracture == 0.0


@pytest.mark.slow
def test_energy_counts_what_breaking_bonds_take():
    """A bonded façade torn off by parting floors: no node breaks for less than in pure tension."""
    config = resolved(numerics=FEW)
    got = in_yade(
        "accuracy_cases",
        "balanced",
        config=config,
        model="W2c",
        beta_s=0.002,
        fraction=0.1,
        **shake(1.0, 0.5),
    )
    wall, f = config["return_wall"], config["facade"]
    area = wall["count"] * wall["thickness_m"] * f["height_m"]
    jkn = f["e_mpa"] * 1e6 / (0.5 * f["height_m"])
    assert got["broken"] > 0.95 * (wall["tension_mpa"] * 1e6) ** 2 * area / (2.0 * jkn)
    assert got["residual"] < 1e-3 * got["overturning"]


def _peaks(theta):
    inner = (theta[1:-1] > theta[:-2]) & (theta[1:-1] >= theta[2:]) & (theta[1:-1] > 0.002)
    return theta[1:-1][inner]
