"""Façade runs inside YADE against closed forms, hand calculations and a second route."""

import numpy as np
import pytest
from rocking.mechanics.closed_forms import block, quarter_period, tip_over_compliant_base
from yade_process import in_yade, resolved

from smdof.chain import floor_motions
from yade_scripts.model import facade, stiffness

pytestmark = pytest.mark.yade

PULSE_DT = 0.01


def pulse(peak_m_s2, duration_s=0.8, total_s=1.6):
    """One sine cycle of ground acceleration (starts and ends at rest)."""
    t = np.arange(0.0, total_s + 1e-9, PULSE_DT)
    return t, np.where(t <= duration_s, peak_m_s2 * np.sin(2 * np.pi * t / duration_s), 0.0)


@pytest.mark.parametrize("model", ["free", "W1", "W2"])
def test_contacts_in_yade_are_the_nodes_of_the_scene(model):
    """Every node makes one contact, with its own stiffness, dashpots and friction."""
    got = in_yade("facade_cases", "contacts", config=resolved(), model=model, beta_s=0.002)
    assert None not in got["yade"]
    yade = np.array(got["yade"])
    assert np.allclose(yade[:, :5], got["scene"], rtol=1e-9)
    # base nodes also carry the settlement W/Σkn; return-wall nodes only the imposed 0.1 mm
    base = resolved()["numerics"]["nodes_thickness"]
    assert np.allclose(yade[base:, 5], 1e-4, rtol=1e-3)


def test_driven_support_follows_its_motion():
    """The base's displacement is the double integral of its acceleration, façade or not."""
    t, a = pulse(1.5)
    got = in_yade(
        "facade_cases",
        "drive",
        config=resolved(),
        time_s=t.tolist(),
        acceleration_m_s2=a.tolist(),
        dt_s=1e-4,
    )
    v = np.concatenate(([0.0], np.cumsum(0.5 * PULSE_DT * (a[1:] + a[:-1]))))
    d = np.cumsum(PULSE_DT * v[:-1] + PULSE_DT**2 * (2 * a[:-1] + a[1:]) / 6)[-1]
    assert got == pytest.approx(d, rel=1e-3)


def test_support_keeps_its_speed_after_its_motion():
    """A motion that is cut off while it accelerates ends there: constant speed from then on."""
    t, a = pulse(1.5, duration_s=3.2, total_s=0.8)
    case = dict(config=resolved(), time_s=t.tolist(), acceleration_m_s2=a.tolist(), dt_s=2e-4)
    one, two, three = (in_yade("facade_cases", "drive", until_s=s, **case) for s in (1, 1.5, 2))
    assert two - one == pytest.approx(three - two, rel=1e-6)
    assert two - one > 0.1


@pytest.mark.parametrize("ratio", [0.2, 0.5])
def test_quarter_period_of_free_rocking(ratio):
    """Stiff contacts: time from release to the first impact is acosh(1/(1−θ0/α))/p."""
    stiff = {
        "height_m": 2.0,
        "thickness_m": 0.1,
        "width_m": 1.0,
        "e_mpa": 1e5,
        "density_kg_m3": 1800.0,
    }
    # few nodes at the base: the closed form has a rigid toe, more nodes give it way
    config = resolved(
        facade=stiff, return_wall={"count": 1, "thickness_m": 0.1}, numerics={"nodes_thickness": 5}
    )
    step = 0.2 * stiffness.critical_step(facade.facade_scene(config, "W1", 0.0))
    got = in_yade(
        "facade_cases",
        "release",
        config=config,
        beta_s=0.0,
        ratio=ratio,
        dt_s=step,
        limit_s=1.2,
        sample_s=2e-4,
    )
    t, theta = np.array(got["time_s"]), np.array(got["rotation_rad"])
    # the wall stops the façade at θ = 0: follow the last free samples down to it
    last = int(np.argmin(theta[t < 1.0])) - 3
    rate = (theta[last] - theta[last - 1]) / (t[last] - t[last - 1])
    crossing = t[last] - theta[last] / rate
    expected = quarter_period(ratio, block(2.0, 0.1).p_rad_s)
    assert crossing == pytest.approx(expected, rel=5e-3)


def test_two_runs_agree_to_the_last_bit():
    """A run does not depend on what the process ran before it."""
    t, a = pulse(1.0)
    case = dict(
        config=resolved(),
        model="W1",
        beta_s=0.00276,
        time_s=t.tolist(),
        columns={"ground": a.tolist()},
        factor=1.0,
    )
    one, two = (in_yade("facade_cases", "shaken", **case) for _ in range(2))
    assert one == two
    assert one["status"] == "ok"
    assert one["peak"] > 0.05


def test_w2_with_rigid_building_is_w1():
    """Floors that move with the ground make W2 the same façade as W1, with more nodes."""
    t, a = pulse(1.0)
    columns = {"ground": a.tolist()} | {f"floor{j}": a.tolist() for j in range(1, 5)}
    case = dict(config=resolved(), beta_s=0.00276, time_s=t.tolist(), columns=columns, factor=1.0)
    w1 = in_yade("facade_cases", "shaken", model="W1", **case)
    w2 = in_yade("facade_cases", "shaken", model="W2", **case)
    assert w1["status"] == "ok"
    assert w1["peak"] > 0.1
    assert w2["peak"] == pytest.approx(w1["peak"], rel=0.01)


@pytest.mark.parametrize("late", [False, True], ids=["coda", "second shock"])
def test_run_that_stops_when_shaking_no_longer_matters_misses_nothing(late):
    """A weak coda of 20 s is left out without a trace; a second shock after a pause is not."""
    t, a = pulse(0.8)
    time_s = np.arange(0.0, t[-1] + 20.0, PULSE_DT)
    shock = np.interp(time_s, t, a, right=0.0)
    coda = 0.02 * np.sin(2.0 * np.pi * 5.0 * time_s) * (time_s > t[-1])
    if late:  # stronger than the first
        shock += 1.1 * np.interp(time_s - t[-1] - 8.0, t, a, left=0.0, right=0.0)
    case = dict(
        model="W1",
        beta_s=0.00276,
        time_s=time_s.tolist(),
        factor=1.0,
        columns={"ground": (shock + coda).tolist()},
    )
    short = in_yade("facade_cases", "shaken", config=resolved(), **case)
    patient = {"quiet_ratio": 0.0, "rest_velocity_m_s": 1e-9}
    whole = in_yade("facade_cases", "shaken", config=resolved(numerics=patient), **case)
    assert short["peak"] == pytest.approx(whole["peak"], rel=1e-5)
    assert whole["reason"].startswith("time limit")
    assert len(short["d"]) < 0.6 * len(whole["d"])
    case |= {"columns": {"ground": a.tolist()}, "time_s": t.tolist()}
    first = in_yade("facade_cases", "shaken", config=resolved(), **case)
    assert (short["peak"] > 1.05 * first["peak"]) == late


def test_static_capacity_of_a_compliant_base():
    """A slow push just below the no-tension Winkler capacity stands, just above it overturns."""
    config = resolved(numerics={"step_fraction": 0.25})
    t = np.arange(0.0, 16.0, PULSE_DT)
    ramp = np.minimum(t / 8.0, 1.0)
    f = config["facade"]
    jkn = facade.joint_stiffness(config)[0]
    limit = (
        9.81 * tip_over_compliant_base(f["height_m"], f["thickness_m"], f["density_kg_m3"], jkn)[1]
    )
    case = dict(
        config=config,
        model="W1",
        beta_s=0.00276,
        time_s=t.tolist(),
        columns={"ground": (-ramp).tolist()},
    )
    below = in_yade("facade_cases", "shaken", factor=0.97 * limit, **case)
    above = in_yade("facade_cases", "shaken", factor=1.03 * limit, **case)
    assert below["status"] == "ok"
    assert above["status"] == "overturned"


def test_full_three_dimensional_scene_agrees_with_the_planar_one():
    """Symmetric façade, symmetric motion: three dimensions add nothing to the planar model."""
    t, a = pulse(1.0)
    case = dict(
        config=resolved(),
        beta_s=0.00276,
        time_s=t.tolist(),
        columns={"ground": a.tolist()},
        factor=1.0,
        model="W1",
    )
    planar = in_yade("facade_cases", "shaken", **case)
    full = in_yade("facade_cases", "shaken", planar=False, **case)
    assert planar["status"] == "ok"
    assert full["peak"] == pytest.approx(planar["peak"], rel=0.01)


def test_floor_motions_carry_no_drift_between_supports():
    """Floors integrated by YADE's scheme end where the chain says, to 0.01 mm."""
    t, a = pulse(3.0)
    motion = floor_motions(a, PULSE_DT, tail_s=3.0)
    step = motion.time_s[1]
    relative = motion.floors_m_s2[-1] - motion.ground_m_s2
    v = np.concatenate(([0.0], np.cumsum(0.5 * step * (relative[1:] + relative[:-1]))))
    d = np.concatenate(
        ([0.0], np.cumsum(step * v[:-1] + step**2 * (2 * relative[:-1] + relative[1:]) / 6))
    )
    assert np.max(np.abs(d - motion.relative_m[-1])) < 1e-5


def test_nothing_listens_while_yade_runs():
    """YADE as a library loads no prompt and opens neither its own port nor XML-RPC's."""
    assert in_yade("facade_cases", "prompt_and_ports") == [False, 0]


@pytest.mark.parametrize("width_m", [1.0, 2.0, 4.0])
def test_planar_motion_does_not_depend_on_the_width(width_m):
    """Per metre of width a façade is the same one, whatever frame YADE gives its clump."""
    wall = {"height_m": 0.8, "thickness_m": 0.11, "width_m": width_m, "density_kg_m3": 1750.0}
    config = resolved(facade=wall, return_wall={"count": 1, "thickness_m": 0.22 * width_m})
    step = 0.2 * stiffness.critical_step(facade.facade_scene(config, "W1", 0.00025))
    case = dict(config=config, beta_s=0.00025, ratio=0.5, dt_s=step, limit_s=0.6)
    theta = np.array(in_yade("facade_cases", "release", **case)["rotation_rad"])
    narrow = resolved(facade=wall | {"width_m": 0.5}, return_wall={"count": 1, "thickness_m": 0.11})
    other = np.array(
        in_yade("facade_cases", "release", **case | {"config": narrow})["rotation_rad"]
    )
    assert theta[0] == pytest.approx(0.5 * np.arctan2(0.11, 0.8), rel=1e-6)
    assert np.max(np.abs(theta - other)) < 1e-6
