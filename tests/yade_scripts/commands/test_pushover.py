"""Static capacity in YADE against the closed forms: bare, W1 and W1c."""

import numpy as np
import pandas as pd
import pytest
from rocking.mechanics import closed_forms
from rocking.mechanics.smoothing import smoothed
from rocking.pushover import (
    VARIANTS,
    closed_form,
    complete_curve,
    laid,
    summary,
    theta_of,
    variant,
)
from yade_process import in_yade, resolved

from yade_scripts.commands.pushover import push_motion
from yade_scripts.model import models

H, B, W, RHO = 6.48, 0.375, 4.4, 1800.0


def test_variants_whose_courses_fill_the_facade():
    """Courses of 0.216 and 0.648 m fill 6.48 m; neither fills 5.76 m of courses of 0.32 m."""
    assert set(laid(resolved())) == set(VARIANTS)
    low = resolved(facade={"height_m": 5.76}, w3={"course_height_m": 0.32})
    assert set(VARIANTS) - set(laid(low)) == {"course_0.216_m", "course_0.648_m"}
    with pytest.raises(ValueError, match="w3.course_height_m = 0.324"):
        laid(resolved(facade={"height_m": 5.75}))


def job(model, **sections):
    numerics = {"nodes_thickness": 33, "step_fraction": 0.25, **sections.pop("numerics", {})}
    config = resolved(numerics=numerics, **sections)
    return {**config, "model": model, "beta_s": 0.00276}


def pushed(model, speed_m_s=0.05, **sections):
    data = job(model, **sections)
    result = in_yade("w3_cases", "push_case", job=data, speed_m_s=speed_m_s, reach=1.0)
    raw = pd.DataFrame(result["curve"], columns=["d_over_b", "lambda_dem"])
    return complete_curve(raw, data, model), result["broken"]


@pytest.mark.yade
@pytest.mark.parametrize("model", ["free", "W1"])
def test_capacity_on_the_compliant_base(model):
    """λ(θ) of a block on a no-tension elastic base, rising and falling branch alike."""
    curve, broken = pushed(model)
    assert broken == 0
    # nodes that open one by one make a fine saw tooth
    error = pd.Series(smoothed(curve, "lambda_dem") - smoothed(curve, "lambda_elastic"))
    inside = curve["d_over_b"].between(0.005, 0.97)
    assert (error[inside].abs() < 0.02 * B / H).all()
    # given back what the base takes, λ0 is b/h to 1 %
    assert abs(summary(curve)["lambda0_dem"] / (B / H) - 1.0) < 0.01
    assert curve["d_over_b"].max() > 0.98  # the falling branch was followed to the end
    assert curve["lambda_dem"].iloc[-1] < 0.0  # the compliant block is past its equilibrium


@pytest.mark.yade
def test_capacity_on_a_nearly_rigid_base():
    """With a stiff base the curve is tan(α − θ), no correction needed."""
    stiff = 300.0 * 1.8e9 / H
    curve, _ = pushed("free", facade={"base_stiffness_pa_m": stiff})
    theta = theta_of(curve["d_over_b"], job("free")["facade"])
    inside = curve["d_over_b"].between(0.2, 0.95)
    rigid = closed_forms.capacity_rigid(theta, H, B)
    assert (np.abs(curve["lambda_dem"] - rigid)[inside] < 0.03 * B / H).all()


@pytest.mark.yade
def test_bonded_contact_first_cracks_at_its_tensile_strength():
    """W1c: λ and position at the peak agree with the elastic façade on two elastic joints.

    Three unknowns (shift, rise, rotation) and linear joints at base and back; the top of
    the back joint reaches σt at the λ found here, and the bonds unzip from there.
    """
    data = job("W1c", numerics=dict(nodes_height=17))
    scene = models.build_scene(data)
    result = in_yade("w3_cases", "push_case", job=data, speed_m_s=0.02, reach=0.1)
    curve = np.array(result["curve"])
    expected = first_crack(scene)
    assert result["broken"] == 17
    before = curve[:, 1] < 0.5 * expected
    first = slice(0, int(np.argmin(before)))
    slope = np.polyfit(curve[first, 1], curve[first, 0], 1)[0]
    assert np.isfinite(slope)
    assert 0.97 * expected < curve[:, 1].max() < 1.08 * expected  # cracks unzip a little later
    after = curve[curve[:, 0] > 0.05]
    assert after[:, 1].max() < 0.04  # nothing left of the bond


def first_crack(scene):
    """λ at which the linear system (base nodes in contact under the weight) first reaches σt."""
    nodes, mass = scene.nodes, scene.blocks[1].mass_kg
    arm = nodes.position_m - np.array(scene.blocks[1].centre_m)
    active = np.ones(len(nodes), bool)
    for _ in range(100):  # base nodes that would be in tension are open
        k, load_push, load_weight = np.zeros((3, 3)), np.zeros(3), np.zeros(3)
        load_push[0], load_weight[1] = mass * 9.81, -mass * 9.81
        rows = []
        for i in range(len(nodes)):
            # displacement of a node: y, z and a rotation about x
            motion = np.array([[1.0, 0.0, -arm[i, 2]], [0.0, 1.0, arm[i, 1]]])
            n = nodes.normal[i, 1:]
            d = nodes.kn_n_m[i] * np.outer(n, n)
            d += nodes.ks_n_m[i] * (np.eye(2) - np.outer(n, n))
            rows.append((motion, n))
            if active[i]:
                k += motion.T @ d @ motion
        push, weight = np.linalg.solve(k, load_push), np.linalg.solve(k, load_weight)
        bonded = nodes.bonded
        limits = [
            (nodes.tension_n[i] / nodes.kn_n_m[i] - rows[i][1] @ rows[i][0] @ weight)
            / (rows[i][1] @ rows[i][0] @ push)
            for i in range(len(nodes))
            if bonded[i] and rows[i][1] @ rows[i][0] @ push > 0
        ]
        found = min(limits)
        opening = np.array(
            [rows[i][1] @ rows[i][0] @ (weight + found * push) for i in range(len(nodes))]
        )
        now = bonded | (opening <= 0.0)
        if np.array_equal(now, active):
            return found
        active = now
    return found


def test_push_starts_slowly_and_travels_the_distance():
    motion = push_motion(0.05, 0.2)
    end = motion.duration_s
    assert motion.position(end) == pytest.approx(0.2, rel=0.01)
    speed = np.gradient(motion.position(np.linspace(0, end, 4001)), np.linspace(0, end, 4001))
    assert np.all(np.diff(speed) > -1e-6)  # never slower again
    assert speed.max() == pytest.approx(0.05, rel=1e-3)
    assert motion.position(0.1) < 1e-4


def test_static_multiplier_is_the_kinematic_one():
    """0.276 for 4.4 m and an overlap of 0.125 m; b/h without interlocking."""
    upper, lower, _ = closed_form(np.array([0.0]), job("W3"), "W3")
    assert models.static_multiplier(job("W3")) == pytest.approx(upper[0], rel=1e-6)
    assert upper[0] == pytest.approx(lower[0])
    assert upper[0] == pytest.approx(0.276, abs=5e-4)
    assert models.static_multiplier(job("W1")) == pytest.approx(B / H)


def test_static_multiplier_of_a_bonded_facade_is_its_first_crack():
    """0.07 MPa over two walls of 0.375 m, tension linear from the toe: ∫ f_t t (z/h) z dz."""
    z = np.linspace(0.0, H, 2001)
    pull = 2 * 0.07e6 * 0.375 * z / H
    moment = np.sum(0.5 * (pull[1:] * z[1:] + pull[:-1] * z[:-1]) * np.diff(z))
    weight = 1800.0 * 9.81 * H * B * 4.4
    expected = B / H + moment / (0.5 * weight * H)
    assert models.static_multiplier(job("W1c")) == pytest.approx(expected, rel=1e-6)


def test_smoothing_keeps_straight_lines():
    d = np.sort(np.r_[0.0, np.random.default_rng(1).uniform(0, 1, 400), 1.0])
    even = pd.DataFrame({"d_over_b": np.linspace(0, 1, 401), "v": np.linspace(3, 5, 401)})
    assert np.allclose(smoothed(even, "v")[:-5], even["v"][:-5], atol=1e-9)
    flat = pd.DataFrame({"d_over_b": d, "v": np.full(len(d), 2.0)})
    assert np.allclose(smoothed(flat, "v"), 2.0)


def test_smoothing_takes_the_teeth_off_a_saw():
    """Of slips that lie closer than the window their mean is left: 8 points, up and down."""
    d = np.linspace(0, 1, 401)
    saw = pd.DataFrame({"d_over_b": d, "v": 2.0 + 0.1 * (-1.0) ** np.arange(401)})
    assert np.abs(smoothed(saw, "v")[8:-8] - 2.0).max() < 0.1 / 8
    assert smoothed(saw, "v")[0] == saw["v"][0]  # nothing lies before the first


def test_variants_change_one_thing_each():
    config = job("W3")
    for name in ("default", "half_step", "overlap_0.0625_m", "header_rigid"):
        changed = variant(config, name)
        flat = [
            (s, k) for s in ("w3", "pushover") for k in config[s] if config[s][k] != changed[s][k]
        ]
        expected = {"default": 0, "header_rigid": 2}.get(name, 1)
        assert len(flat) == expected, (name, flat)
    half = 0.5 * config["w3"]["step_fraction"]
    assert variant(config, "half_step")["w3"]["step_fraction"] == half
