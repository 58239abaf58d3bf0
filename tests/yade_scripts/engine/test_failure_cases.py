"""Cases where methods fail: rest, extreme releases and shapes, grazing, chatter, sliding."""

import numpy as np
import pandas as pd
import pytest
from reference_solver.facade import peak_and_end
from sliding_block import slip_rectangular_pulse
from yade_process import in_yade, resolved

pytestmark = pytest.mark.yade
BETA_S = 0.00276


def released(ratio, seconds, beta_s=BETA_S, **facade):
    """A run without a motion of a façade let go at such a share θ0/α of its slenderness."""
    given = {"model": "W1", "beta_s": beta_s, "ratio": ratio, "seconds": seconds}
    return in_yade("accuracy_cases", "released", config=resolved(facade=facade), **given)


@pytest.mark.parametrize(("model", "beta_s"), [("W1", 0.0), ("W2", BETA_S)])
def test_flat_on_flat_at_rest_for_a_minute(model, beta_s):
    """No creep, no drift, no rattling growth: 60 s within a millionth of the thickness."""
    got = in_yade(
        "accuracy_cases", "rest", config=resolved(), model=model, beta_s=beta_s, seconds=60.0
    )
    assert got["status"] == "ok"
    assert got["d"] < 1e-6 * 0.375
    assert got["speed"] < 1e-6


def test_release_just_below_the_edge_returns_or_falls_by_the_static_pivot():
    """θ0/α = 0.99 lies beyond the compliant base's static limit: it falls outward, at once."""
    assert released(0.99, 20.0)["status"] == "overturned"
    got = released(0.95, 20.0, beta_s=0.0005, e_mpa=50000.0)
    assert got["status"] == "ok"
    assert max(got["rotation"][1:]) <= 1.001 * got["rotation"][0]


def test_tiny_release_settles():
    """θ0/α = 0.001 is within the elastic deformation of the base: it settles, less friction."""
    got = released(0.001, 10.0)
    assert got["status"] == "ok"
    alpha = np.arctan2(0.375, 6.48)
    assert np.max(np.abs(got["rotation"])) < 0.01 * alpha
    assert abs(got["rotation"][-1]) < 0.5e-3 * alpha


@pytest.mark.parametrize(("h", "b"), [(6.0, 0.15), (1.0, 0.5)])
def test_very_slender_and_stocky_blocks_come_to_rest(h, b):
    got = released(0.3, 30.0, beta_s=0.001, height_m=h, thickness_m=b)
    assert got["status"] == "ok"
    late = np.array(got["rotation"])[-50:]
    assert np.ptp(late) < 1e-3 * np.arctan2(b, h)


def half_sine(peak_m_s2, pulse_s, total_s, dt_s):
    t = np.arange(0.0, total_s, dt_s)
    return t, np.where(t <= pulse_s, peak_m_s2 * np.sin(np.pi * t / pulse_s), 0.0)


def compare(config, beta_s, t, a, tmp_path, nodes=25):
    """Peak d/b in YADE and in the planar solver of one W1 run."""
    path = tmp_path / "motion.csv"
    pd.DataFrame({"time_s": t, "ground_m_s2": a}).to_csv(path, index=False)
    job = {**config, "model": "W1", "beta_s": beta_s}
    pga_g = float(np.max(np.abs(a))) / 9.81
    expected, _ = peak_and_end(job, path, "pos", pga_g, nodes=nodes, tolerance=1e-5)
    got = in_yade(
        "accuracy_cases",
        "shaken",
        config=config,
        model="W1",
        beta_s=beta_s,
        time_s=t.tolist(),
        columns={"ground": a.tolist()},
    )
    assert got["status"] == "ok"
    return got["peak"], expected


@pytest.mark.parametrize(
    ("facade", "beta_s", "pulse", "within"),
    [
        # a gap that the façade just reaches on its way back
        pytest.param({"gap_m": 0.004}, BETA_S, (1.3, 0.5), 0.02, id="grazing return walls"),
        # ten times the damping: impacts without rebound, closing and opening at once
        pytest.param({}, 10 * BETA_S, (-0.8, 0.4), 0.02, id="chatter at high damping"),
        # friction just above the slenderness
        pytest.param({"friction_deg": 4.0}, BETA_S, (-0.85, 0.4), 0.03, id="sliding and rocking"),
    ],
)
def test_one_pulse_of_contacts_that_graze_chatter_or_slide(facade, beta_s, pulse, within, tmp_path):
    t, a = half_sine(*pulse, 3.0, 0.005)
    peak, expected = compare(resolved(facade=facade), beta_s, t, a, tmp_path)
    assert peak == pytest.approx(expected, rel=within)


def test_a_record_with_a_huge_sampling_step(tmp_path):
    """0.2 s between samples: straight lines, hundreds of steps each, corners and all."""
    a = np.array([0.0, -1.4, 1.2, -0.9, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    peak, expected = compare(resolved(), BETA_S, 0.2 * np.arange(a.size), a, tmp_path)
    assert peak == pytest.approx(expected, rel=0.02)


def test_sliding_against_the_closed_form():
    """A stocky free block on a base with μ = tan 8°, rectangular pulse: Newmark's slip."""
    friction = np.tan(np.radians(8.0))
    config = resolved(
        facade={"height_m": 0.8, "thickness_m": 0.4, "friction_deg": 8.0, "e_mpa": 50000.0}
    )
    t = np.arange(0.0, 4.0, 0.002)
    pulse = 0.3  # mean of the flanks
    a = np.clip(np.minimum(t, pulse + 0.002 - t) / 0.002, 0.0, 1.0) * 3.0
    got = in_yade(
        "accuracy_cases",
        "shaken",
        config=config,
        model="free",
        beta_s=1e-4,
        time_s=t.tolist(),
        columns={"ground": a.tolist()},
        fraction=0.2,
    )
    assert got["status"] == "ok"
    expected = slip_rectangular_pulse(3.0, pulse, friction)
    assert abs(got["d"][-1]) == pytest.approx(expected, rel=0.02)
