"""Integration, measures, baseline treatment and the normalised file."""

import json
from dataclasses import replace

import numpy as np
import pytest
import record_samples as samples
from record_files.record import significant_duration
from rocking.records import (
    G_M_S2,
    Record,
    RecordError,
    integrate,
    load,
    measures,
    read_csv,
    records_row,
    treat,
    write_csv,
)


def sine(n=2001, dt_s=0.005, amplitude=2.0, period_s=1.0):
    t = dt_s * np.arange(n)
    a = amplitude * np.sin(2 * np.pi * t / period_s)
    return Record("sine", a, dt_s, "file", "m/s2")


def test_integration_is_exact_for_piecewise_linear_acceleration():
    """a = c·t: v = c·t²/2 and d = c·t³/6, to rounding, whatever the step."""
    for dt_s in (0.1, 0.01):
        t = dt_s * np.arange(51)
        v, d = integrate(3.0 * t, dt_s)
        np.testing.assert_allclose(v, 1.5 * t**2, atol=1e-13)
        np.testing.assert_allclose(d, 0.5 * t**3, atol=1e-13)


def test_integration_error_of_a_sine_falls_with_the_square_of_the_step():
    def error(dt_s):
        t = dt_s * np.arange(round(2.0 / dt_s) + 1)
        v, d = integrate(np.cos(2 * np.pi * t), dt_s)
        return np.array([abs(v[-1]), abs(d - (1 - np.cos(2 * np.pi * t)) / (2 * np.pi) ** 2).max()])

    coarse, fine = error(0.02)[1], error(0.01)[1]
    assert coarse / fine == pytest.approx(4.0, rel=0.02)


def test_measures_of_a_sine():
    """PGV = A·T/π from rest, PGD = A t/ω; Arias grows evenly, so 5–95 % is 90 % of the time."""
    peaks = measures(sine())
    assert peaks["pga_g"] == pytest.approx(2.0 / G_M_S2, rel=1e-12)
    assert peaks["pgv_cm_s"] == pytest.approx(100 * 2.0 / np.pi, rel=1e-3)
    assert peaks["pgd_cm"] == pytest.approx(100 * 2.0 * 10.0 / (2.0 * np.pi), rel=1e-3)  # A t/ω
    assert peaks["duration_s"] == pytest.approx(10.0)
    assert peaks["significant_duration_s"] == pytest.approx(9.0, rel=0.02)


def test_significant_duration_of_a_box():
    a = np.zeros(1001)
    a[200:301] = 1.0
    assert significant_duration(a, 0.01) == pytest.approx(0.9, abs=0.02)


def test_records_row_has_the_contract_s_columns():
    assert list(records_row(sine())) == [
        "record",
        "source",
        "dt_s",
        "duration_s",
        "pga_g",
        "pgv_cm_s",
        "pgd_cm",
    ]


@pytest.mark.parametrize(
    ("method", "degree"), [("mean", 0), ("linear", 1), ("poly", 2), ("poly", 4)]
)
def test_baseline_takes_out_its_polynomial_and_leaves_what_is_orthogonal(method, degree):
    record = sine()
    x = np.linspace(-1, 1, len(record))
    legendre = np.polynomial.legendre.Legendre.basis(degree)(x)
    drifting = Record("r", record.acceleration_m_s2 + 0.3 * legendre, record.dt_s, "file")
    clean = treat(record, method, order=degree)
    np.testing.assert_allclose(
        treat(drifting, method, order=degree).acceleration_m_s2, clean.acceleration_m_s2, atol=1e-12
    )
    assert "removed" in clean.baseline
    next_one = 0.3 * np.polynomial.legendre.Legendre.basis(degree + 1)(x)  # but for the samples
    bent = replace(record, acceleration_m_s2=record.acceleration_m_s2 + next_one)
    left = treat(bent, method, order=degree).acceleration_m_s2 - clean.acceleration_m_s2
    np.testing.assert_allclose(left, next_one, atol=0.02 * 0.3)


def test_no_treatment_is_the_record_as_given():
    record = sine()
    assert treat(record).baseline == "none"
    np.testing.assert_array_equal(treat(record).acceleration_m_s2, record.acceleration_m_s2)


def gain(frequency_hz, **options):
    """Amplitude ratio and phase [rad] of a sine through a filter, away from the ends."""
    record = sine(n=8001, period_s=1 / frequency_hz)
    treated = treat(record, **options)
    t, inner = record.time_s, slice(2000, 6000)
    wave = np.exp(-2j * np.pi * frequency_hz * t)
    ratio = np.sum((treated.acceleration_m_s2 * wave)[inner]) / np.sum(
        (record.acceleration_m_s2 * wave)[inner]
    )
    return abs(ratio), np.angle(ratio)


def test_filters_halve_at_their_corners_without_phase():
    """Butterworth run both ways: gain 1/(1 + (f/fc)^2n), phase zero."""
    for options, f, expected in (
        ({"highpass_hz": 0.5}, 0.5, 0.5),
        ({"highpass_hz": 0.5}, 1.0, 1 / (1 + 0.5**8)),
        ({"lowpass_hz": 10.0}, 10.0, 0.5),
        ({"lowpass_hz": 10.0, "filter_order": 2}, 5.0, 1 / (1 + 0.5**4)),
        ({"highpass_hz": 0.5, "lowpass_hz": 10.0}, 2.0, 1.0),
    ):
        ratio, phase = gain(f, **options)
        assert ratio == pytest.approx(expected, rel=0.01)
        assert phase == pytest.approx(0.0, abs=0.01)
    assert "highpass 0.5 Hz, order 4" in treat(sine(), highpass_hz=0.5).baseline


@pytest.mark.parametrize(
    "options",
    [
        {"method": "spline"},
        {"method": "poly", "order": 20},
        {"highpass_hz": 0},
        {"lowpass_hz": 100.0},
        {"highpass_hz": 5, "lowpass_hz": 2},
        {"filter_order": 0},
    ],
)
def test_impossible_treatments_are_refused(options):
    with pytest.raises(RecordError, match="record sine"):
        treat(sine(), **options)


def test_load_takes_the_configuration_s_section(tmp_path):
    sample = samples.two_column()
    (tmp_path / sample.name).write_bytes(sample.data)
    table = tmp_path / "t.tsv"
    table.write_text(f"record\tfile\tunits\na\t{sample.name}\tm/s2\n")
    section = {
        "method": "poly",
        "order": 2,
        "highpass_hz": None,
        "lowpass_hz": 8.0,
        "filter_order": 3,
    }
    assert load("a", table, baseline=section).baseline.startswith("polynomial of degree 2 removed;")
    assert load("a", table, baseline="mean").baseline == "mean removed"
    assert load("a", table).baseline == "none"


def test_normalised_file_keeps_the_record(tmp_path):
    record = treat(sine(n=500), "mean")
    path = tmp_path / "sine.csv"
    write_csv(record, path)
    again = read_csv(path)
    np.testing.assert_allclose(again.acceleration_m_s2, record.acceleration_m_s2, rtol=1e-8)
    for key in ("name", "dt_s", "source", "units_read", "baseline", "details"):
        assert getattr(again, key) == getattr(record, key)
    first = path.read_bytes()
    write_csv(again, path)
    assert path.read_bytes() == first
    assert first.startswith(b"time_s,acceleration_m_s2\n0,")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["sine.csv", "sine.json"]


def test_a_damaged_pair_is_refused(tmp_path):
    path, side = tmp_path / "a.csv", tmp_path / "a.json"
    write_csv(sine(n=50), path)
    good = json.loads(side.read_text())
    for bad in (
        "",
        "{",
        "[]",
        json.dumps(good | {"dt_s": 0.01}),
        json.dumps(good | {"source": "guess"}),
        json.dumps({key: value for key, value in good.items() if key != "baseline"}),
    ):
        side.write_text(bad)
        with pytest.raises(RecordError, match=r"a\.json"):
            read_csv(path)
    side.unlink()
    with pytest.raises(RecordError, match="does not exist"):
        read_csv(path)


def test_impossible_records_cannot_be_made():
    for a, dt_s in (([1.0], 0.01), ([1.0, np.nan], 0.01), ([1.0, 2.0], 0.0), ([1.0, 2.0], np.nan)):
        with pytest.raises(RecordError, match="record x"):
            Record("x", np.array(a), dt_s, "file")
