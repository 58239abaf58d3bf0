"""Intensity measures against closed forms: harmonics, steps, blows."""

import numpy as np
import pytest
from record_samples import harmonic
from rocking.mechanics.closed_forms import block
from rocking.records import Record
from rocking.records.intensity_measures import (
    HOUSNER_S,
    MEASURES,
    incremental_velocity,
    per_pga,
    record_measures,
)


def test_measures_of_a_harmonic_are_those_of_the_closed_forms():
    p = block(6.48, 0.375).p_rad_s
    found = record_measures(harmonic(), 1.0, 0.05, p)
    assert found["pga_g"] == pytest.approx(0.3, rel=1e-6)
    assert found["pgv_cm_s"] == pytest.approx(100 * 0.3 * 9.80665 / np.pi, rel=1e-3)
    assert found["sa_t1_g"] == pytest.approx(0.3 / (2 * 0.05), rel=0.02)  # resonance, 1/2ζ
    assert found["p_pgv_over_g"] == pytest.approx(p * 0.3 / np.pi, rel=1e-3)
    # between two zeros the velocity changes by aT/π
    assert found["miv_cm_s"] == pytest.approx(100 * 0.3 * 9.80665 / np.pi, rel=1e-3)
    # far above resonance Sa is the static a, so AvgSa about a period of 0.01 s is the PGA
    assert record_measures(harmonic(), 0.01, 0.05, p)["sa_avg_g"] == pytest.approx(0.3, rel=0.01)
    stiff = record_measures(harmonic(), 0.01, 0.05, p)
    assert stiff["sa_t1_g"] == pytest.approx(0.3, rel=0.01)  # a rigid oscillator sees the PGA


def test_measures_scale_with_the_record_so_the_factors_do_not():
    p = 1.5
    one = per_pga(record_measures(harmonic(0.1), 0.27, 0.05, p))
    other = per_pga(record_measures(harmonic(0.7), 0.27, 0.05, p))
    assert set(one) == set(MEASURES)
    for name, value in one.items():
        assert other[name] == pytest.approx(value, rel=1e-9), name
    assert one["pga_g"] == 1.0


def test_spectrum_intensity_of_a_slow_step_is_that_of_a_plateau():
    """A constant acceleration from rest: Sd = 2a/ω² undamped, so PSV = 2aT/2π; less by damping."""
    record = Record("step", np.full(4000, 1.0), 0.005, "surrogate")
    decay = 1.0 + np.exp(-np.pi * 0.05 / np.sqrt(1 - 0.05**2))  # first overshoot at 5 %
    expected = np.trapezoid(decay * HOUSNER_S / (2 * np.pi), HOUSNER_S)
    found = record_measures(record, 0.27, 0.05, 1.5)["housner_cm"]
    assert found == pytest.approx(100 * expected, rel=0.01)


def test_average_acceleration_after_a_blow_is_the_geometric_mean():
    """A blow of velocity v: PSA = f(ζ) 2πv/T, so AvgSa has the geometric mean of its periods."""
    values, dt_s, zeta = np.zeros(8000), 0.001, 0.05
    values[2] = 10.0
    speed, root = 10.0 * dt_s, np.sqrt(1.0 - zeta**2)
    peak = np.exp(-zeta / root * np.arctan(root / zeta))  # of ω u over v
    found = record_measures(Record("blow", values, dt_s, "surrogate"), 1.0, zeta, 1.5)
    periods = np.linspace(0.2, 3.0, 10)
    expected = peak * 2.0 * np.pi * speed / np.exp(np.mean(np.log(periods))) / 9.80665
    assert found["sa_avg_g"] == pytest.approx(expected, rel=5e-3)


def test_incremental_velocity_takes_the_largest_lobe_exactly():
    # triangles between the zeros: 1/2·1·1, −1/2·2·2 (its zeros half way between samples), 1/2
    a = np.array([0.0, 1.0, 0.0, -1.0, -2.0, -1.0, 1.0, 0.0])
    lobe = 0.5 * 1 + 1.5 + 1.5 + 0.5 * 0.5 * 1
    assert incremental_velocity(a, 1.0) == pytest.approx(lobe)
    assert incremental_velocity(-a, 0.5) == pytest.approx(0.5 * lobe)
