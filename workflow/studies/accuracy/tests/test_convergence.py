"""Observed rates of convergence in step and nodes, and the rules that use them."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from reference_solver import facade as reference
from reference_solver.facade import peak_and_end
from rocking import fidelity
from rocking.mechanics.closed_forms import block, overturning_half_sine, overturning_rectangular
from studies.accuracy import errors as study
from yade_process import in_yade, resolved

from yade_scripts.model import facade
from yade_scripts.model.motion import STANDARD_GRAVITY_M_S2, amplitude
from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.stiffness import critical_step, lag_factors

BETA_S = 0.00276


def observed_rate(step, error):
    """Observed order of convergence: least-squares slope of log error over log step."""
    return np.polyfit(np.log(step), np.log(error), 1)[0]


def amplification(omega, zeta, dt, compensated):
    """Eigenvalue of the scheme for one damped oscillator, with and without compensation."""
    factor = 1.0 / (1.0 + 0.5 * dt * 2.0 * zeta * omega) if compensated else 1.0
    k, c = factor * (omega * dt) ** 2, factor * 2.0 * zeta * omega * dt
    values = np.linalg.eigvals([[2.0 - k - c, c - 1.0], [1.0, 0.0]])
    return values[np.argmax(values.imag)]


@pytest.mark.parametrize(("compensated", "order"), [(False, 1.0), (True, 2.0)])
def test_order_of_the_lagged_dashpot(compensated, order):
    """The complex frequency recovered from one step: first order as it is, second with factors."""
    omega, zeta = 100.0, 0.4
    exact = complex(-zeta * omega, omega * np.sqrt(1.0 - zeta**2))
    steps = 0.02 / omega * 2.0 ** -np.arange(4)
    found = [abs(np.log(amplification(omega, zeta, dt, compensated)) / dt - exact) for dt in steps]
    assert observed_rate(steps, found) == pytest.approx(order, abs=0.1)


def test_lag_factors_are_those_of_the_rocking_mode():
    """One return wall up the height: φᵀKφ/φᵀMφ of the rotation about the toe, by hand."""
    config = resolved()
    scene = facade.facade_scene(config, "W1", BETA_S)
    dt = 1e-4
    f, n = config["facade"], scene.nodes
    h, b = f["height_m"], f["thickness_m"]
    mass = f["density_kg_m3"] * h * b * f["width_m"]
    wall = n.joint > 0
    jkn = f["e_mpa"] * 1e6 / (0.5 * h) * 2 * config["return_wall"]["thickness_m"]
    stiffness = jkn * (h**3 / 3.0 + f["shear_stiffness_ratio"] * h * b**2)  # normal and shear
    inertia = mass * (h**2 + b**2) / 3.0
    expected = 1.0 / (1.0 + 0.5 * dt * BETA_S * stiffness / inertia)
    factors = lag_factors(scene, dt)
    assert factors[wall] == pytest.approx(expected, rel=1e-9)
    assert np.all(factors[~wall] == 1.0)
    assert np.all(lag_factors(facade.facade_scene(config, "W1", 0.0), dt) == 1.0)


@pytest.mark.yade
@pytest.mark.parametrize(("beta_s", "order"), [(0.0, 2.0), (0.02, 1.0)])
def test_order_of_the_step_in_yade(beta_s, order):
    """A façade that never uplifts: without return walls nothing compensates the lag."""
    got = in_yade(
        "accuracy_cases",
        "vibration",
        config=resolved(),
        beta_s=beta_s,
        fractions=[0.2, 0.1, 0.05, 0.0125],
        duration_s=0.6,
        amplitude=0.05,
    )
    steps, values = np.array(got).T
    # differences to the finest carry its own error: correct for the expected order
    errors = np.abs(values[:3] - values[3]) / (1.0 - (steps[3] / steps[:3]) ** order)
    assert observed_rate(steps[:3], errors) == pytest.approx(order, abs=0.25)


def test_nodes_of_a_partly_lifted_base_converge_at_second_order():
    """Force of a triangular pressure over part of the width, against its integral."""
    counts = np.array([5, 9, 17, 33, 65])
    widths = np.linspace(0.15, 0.85, 141)
    error = []
    for n in counts:
        x, w = gauss_lobatto(n)
        force = np.maximum(0.0, widths[:, None] - x) @ w
        error.append(np.sqrt(np.mean((force - 0.5 * widths**2) ** 2)))
    assert observed_rate(1.0 / (counts - 1), error) == pytest.approx(2.0, abs=0.3)


@pytest.mark.yade
@pytest.mark.parametrize(("model", "peak"), [("W1", 1.0), ("W2", 0.9)])
def test_default_fidelity_against_the_planar_reference(model, peak, tmp_path):
    """One strong cycle with floors that lag the ground: peak d/b within 1 % at the defaults."""
    t = np.arange(0.0, 3.0, 0.005)
    ground = np.where(t < 0.8, peak * np.sin(2.0 * np.pi * t / 0.8), 0.0)
    columns = {"ground": ground}
    for j in range(1, 5):
        shift = 0.02 * j
        u = t - shift
        columns[f"floor{j}"] = np.where(
            (u > 0) & (u < 0.8), (1.0 + 0.1 * j) * peak * np.sin(2.0 * np.pi * u / 0.8), 0.0
        )
    job = {**resolved(), "model": model, "beta_s": BETA_S}
    path = tmp_path / "motion.csv"
    pd.DataFrame({"time_s": t, **{f"{k}_m_s2": v for k, v in columns.items()}}).to_csv(
        path, index=False
    )
    pga_g = float(np.max(np.abs(ground))) / STANDARD_GRAVITY_M_S2
    expected, _ = peak_and_end(job, path, "pos", pga_g, nodes=25, tolerance=1e-5)
    got = in_yade(
        "accuracy_cases",
        "shaken",
        config=job,
        model=model,
        beta_s=BETA_S,
        time_s=t.tolist(),
        columns={k: v.tolist() for k, v in columns.items()},
    )
    assert 0.1 < expected < 0.9
    assert got["peak"] == pytest.approx(expected, rel=0.01)


def pulse_on_a_rigid_base(time_s, acceleration_over_alpha_g):
    """Outcome of a pulse on a slender wall, in the rigid limit of its base."""
    facade_keys = {"height_m": 4.0, "thickness_m": 0.1, "e_mpa": 1e5, "base_stiffness_pa_m": 5e12}
    numerics = {"nodes_thickness": 3, "step_fraction": 0.3, "after_motion_s": 4.0}
    config = resolved(facade=facade_keys, numerics=numerics)
    a = -block(4.0, 0.1)[0] * 9.81 * np.asarray(acceleration_over_alpha_g)
    return in_yade(
        "accuracy_cases",
        "shaken",
        config=config,
        model="W1",
        beta_s=1e-5,
        time_s=list(time_s),
        columns={"ground": a.tolist()},
    )


@pytest.mark.yade
@pytest.mark.parametrize(("factor", "status"), [(0.99, "ok"), (1.01, "overturned")])
def test_overturning_threshold_of_a_rectangular_pulse(factor, status):
    """x = 2, t1 = ln 2/p: 1 % less comes back to the walls, 1 % more falls."""
    t1, edge = overturning_rectangular(2.0, block(4.0, 0.1)[2]), 1e-3
    t = [0.0, 0.1, 0.1 + edge, 0.1 + t1, 0.1 + t1 + edge, 5.0]
    got = pulse_on_a_rigid_base(t, 2.0 * factor * np.array([0.0, 0.0, 1.0, 1.0, 0.0, 0.0]))
    assert got["status"] == status
    assert got["peak"] > 0.7
    back = min(got["d"][int(np.argmax(got["d"])) :])
    assert (back < 0.01 * got["peak"] * 0.1) == (status == "ok")


@pytest.mark.yade
@pytest.mark.parametrize(("factor", "status"), [(0.99, "ok"), (1.01, "overturned")])
@pytest.mark.parametrize("omega_over_p", [2.0, 3.0, 5.0])
def test_overturning_threshold_of_a_half_sine_pulse(omega_over_p, factor, status):
    """x = 1.8007, 2.2939, 3.2891: 1 % less comes back to the walls, 1 % more falls."""
    omega = omega_over_p * block(4.0, 0.1)[2]
    t = np.append(np.linspace(0.0, np.pi / omega, 401), 5.0)
    x = factor * overturning_half_sine(omega_over_p) * np.append(np.sin(omega * t[:-1]), 0.0)
    got = pulse_on_a_rigid_base(t, x)
    assert got["status"] == status
    assert got["peak"] > 0.7
    back = min(got["d"][int(np.argmax(got["d"])) :])
    assert (back < 0.01 * got["peak"] * 0.1) == (status == "ok")


def test_reference_and_runs_scale_a_motion_alike(tmp_path, monkeypatch):
    """The largest ground acceleration is the PGA in standard gravity, mirrored for "neg"."""
    path, t = tmp_path / "motion.csv", np.linspace(0.0, 1.0, 11)
    rows = np.column_stack([t, -2.0 * np.sin(2.0 * np.pi * t)])
    np.savetxt(path, rows, delimiter=",", header="time_s,ground_m_s2", comments="")
    scales = []

    def stand_in(wall, motion, scale, **settings):
        scales.extend(scale)
        return SimpleNamespace(
            status=["finished"], peak_d_over_b=np.zeros(1), end_time_s=np.zeros(1)
        )

    monkeypatch.setattr(reference, "simulate_batch", stand_in)
    job = {**resolved(), "model": "W1", "beta_s": BETA_S}
    for direction in ("pos", "neg"):
        reference.peak_and_end(job, path, direction, 0.3, nodes=33, tolerance=1e-5)
    peak = np.max(np.abs(rows[:, 1]))
    np.testing.assert_allclose(np.array(scales) * peak, [0.3 * 9.80665, -0.3 * 9.80665])
    given = [amplitude(rows[:, 1], direction, 0.3) for direction in ("pos", "neg")]
    np.testing.assert_array_equal(given, scales)


def test_pareto_front_holds_what_nothing_beats():
    cost, error = np.array([1, 2, 3, 4, 2.0]), np.array([5, 3, 4, 1, 3.5])
    assert study.pareto_front(cost, error).tolist() == [True, True, False, True, False]


def test_fidelity_takes_the_cheapest_pair_within_the_tolerance():
    measured = {
        "W1": [
            {"nodes": 5, "step_fraction": 0.2, "error": 0.03},
            {"nodes": 9, "step_fraction": 0.1, "error": 0.008},
            {"nodes": 17, "step_fraction": 0.05, "error": 0.002},
        ]
    }
    open_values = dict.fromkeys(fidelity.CHOSEN)
    config = {"numerics": {**open_values, "fidelity_tolerance": 0.01}, "w3": resolved()["w3"]}
    chosen, _ = fidelity.choose(config, "W1c", measured)
    assert (chosen["nodes_height"], chosen["step_fraction"]) == (9, 0.1)
    assert chosen["nodes_thickness"] == 17  # across the base half as far apart as up a wall
    config["numerics"]["nodes_height"] = 9  # what is stated is kept, whatever its value
    config["numerics"]["fidelity_tolerance"] = None
    chosen, reason = fidelity.choose(config, "W1", measured)
    assert (chosen["nodes_height"], chosen["step_fraction"]) == (9, 0.05)
    assert "0.002" in reason
    config["numerics"]["fidelity_tolerance"] = 1e-4
    with pytest.raises(ValueError, match=r"finest measured fidelity of W1 has an error of 0\.002"):
        fidelity.choose(config, "W1", measured)
    with pytest.raises(ValueError, match="no convergence was measured for W2"):
        fidelity.choose(config, "W2", measured)
    own = resolved()["w3"]["step_fraction"]
    assert fidelity.choose(config, "W3", measured)[0]["step_fraction"] == own
    stated = dict.fromkeys(fidelity.CHOSEN[:-1], 11) | {"step_fraction": 0.1}
    config["numerics"] |= stated
    for model in ("W1", "W2"):  # all of it stated: nothing measured is asked for
        chosen, reason = fidelity.choose(config, model, measured)
        assert {key: chosen[key] for key in fidelity.CHOSEN} == stated
        assert reason == "stated"


def test_a_lucky_coarse_pair_is_not_taken_for_accurate():
    """3 nodes at a long step hit the answer by chance; finer pairs do not bear it out."""
    pairs = [(3, 0.2, 0.001), (3, 0.1, 0.05), (9, 0.2, 0.02), (9, 0.1, 0.004)]
    rows = [
        {
            "model": "W1",
            "method": "nodes and step",
            "nodes": n,
            "dt_over_dt_crit": f,
            "error": e * scale,
        }
        for n, f, e in pairs
        for scale in (1.0, 0.5, 0.1)
    ]
    table = pd.DataFrame(rows)
    assert all(p["nodes"] == 9 for p in fidelity.fidelity_table(table, 1.0, 5)["W1"])
    cheapest = [
        (p["nodes"], p["step_fraction"]) for p in fidelity.fidelity_table(table, 1.0, 3)["W1"]
    ]
    assert cheapest == [
        (3, 0.2),
        (9, 0.2),
        (3, 0.1),
        (9, 0.1),
    ]  # twice the nodes for half the steps

    def errors(share):
        measured = fidelity.fidelity_table(table, share, 3)["W1"]
        return {(p["nodes"], p["step_fraction"]): p["error"] for p in measured}

    assert errors(1.0) == {(3, 0.2): 0.05, (3, 0.1): 0.05, (9, 0.2): 0.02, (9, 0.1): 0.004}
    assert errors(0.5)[9, 0.1] == 0.002  # half of the histories keep it
    table.loc[9, "error"] = np.nan  # a failed run is wrong, whatever the others are
    assert errors(1.0)[9, 0.1] == 1.0


def test_step_of_the_default_scene_follows_its_stiffness():
    """Critical step ∝ 1/√E without damping."""
    soft, stiff = (
        critical_step(facade.facade_scene(resolved(facade={"e_mpa": e}), "W2", 0.0))
        for e in (450.0, 1800.0)
    )
    assert soft / stiff == pytest.approx(2.0, rel=1e-9)
