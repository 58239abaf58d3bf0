"""Surrogates: peaks, rest at both ends, determinism, and that they are not the records."""

from pathlib import Path

import numpy as np
import pytest
from rocking.records import (
    G_M_S2,
    RecordError,
    generate,
    integrate,
    load,
    measures,
    read_csv,
    read_record,
    read_specs,
    read_table,
    surrogate,
    write_csv,
)
from rocking.records.surrogate_model import Pulse

from smdof.spectra import response_spectrum

CONFIG = Path(__file__).parents[2] / "config"
TABLE, PARAMETERS = CONFIG / "records.tsv", CONFIG / "surrogates.yaml"
REAL = Path(__file__).parents[3] / "shared" / "records"
NAMES = ["BUCAR0", "RRS228", "1ST280", "HVSC1"]


@pytest.mark.parametrize("seed", [1977, 1, 2])
@pytest.mark.parametrize("name", NAMES)
def test_peaks_and_duration_are_those_of_the_table(name, seed):
    record, targets = load(name, TABLE, seed=seed), read_table(TABLE)[name].targets
    peaks = measures(record)
    for key in ("pga_g", "pgv_cm_s", "pgd_cm"):
        assert peaks[key] == pytest.approx(targets[key], rel=0.01)
    assert peaks["duration_s"] == pytest.approx(targets["duration_s"], abs=record.dt_s)
    assert record.source == "surrogate"


@pytest.mark.parametrize("name", NAMES)
def test_motion_starts_and_ends_at_rest(name, tmp_path):
    record = load(name, TABLE)
    v, d = integrate(record.acceleration_m_s2, record.dt_s)
    assert abs(record.acceleration_m_s2[[0, -1]]).max() < 1e-6
    assert abs(v[-1]) < 1e-9
    assert abs(d[-1]) < 1e-9
    # The nine digits that are written move the end by less than a tenth of a micrometre.
    write_csv(record, tmp_path / "r.csv")
    again = read_csv(tmp_path / "r.csv")
    assert abs(integrate(again.acceleration_m_s2, again.dt_s)[1][-1]) < 1e-7


@pytest.mark.parametrize("name", NAMES)
def test_same_inputs_same_bytes_and_another_seed_another_motion(name, tmp_path):
    for file in ("a", "b"):
        write_csv(load(name, TABLE), tmp_path / f"{file}.csv")
    for kind in ("csv", "json"):
        assert (tmp_path / f"a.{kind}").read_bytes() == (tmp_path / f"b.{kind}").read_bytes()
    one, other = (load(name, TABLE, seed=seed).acceleration_m_s2 for seed in (1977, 1978))
    assert abs(one - other).max() > 0.1 * abs(one).max()


@pytest.mark.parametrize(
    ("cycles", "phase_deg"), [(2.0, 0.0), (2.0, 40.0), (3.0, 90.0), (1.7, 0.0)]
)
def test_pulse_is_the_derivative_of_its_velocity(cycles, phase_deg):
    """The closed form of the velocity against exact integration of the acceleration."""
    pulse, dt_s = Pulse(0.7, 1.3, cycles, phase_deg, 4.0), 0.001
    t = dt_s * np.arange(8001)
    tau = t - 4.0
    velocity = 0.35 * (1 + np.cos(2 * np.pi * tau / (cycles * 1.3)))
    velocity *= np.cos(2 * np.pi * tau / 1.3 + np.radians(phase_deg))
    velocity[abs(tau) > 0.5 * cycles * 1.3] = 0.0
    v, d = integrate(pulse.acceleration(t), dt_s)
    np.testing.assert_allclose(v, velocity, atol=2e-6)
    if cycles.is_integer():  # whole numbers of cycles leave no displacement behind
        assert abs(d[-1]) < 1e-6


# Peaks of recorded motions of many kinds, and of magnitudes far apart (pga_g, pgv, pgd, duration)
OTHERS = [
    (0.84, 166.1, 28.8, 14.9),
    (1.1, 46.1, 14.6, 20.5),
    (0.32, 71.9, 29.3, 39.3),
    (0.136, 18.8, 4.87, 35.2),
    (0.308, 23.1, 10.65, 40.0),
    (0.82, 81.3, 17.7, 48.0),
    (0.05, 3.0, 0.5, 20.0),
    (0.4, 125.0, 90.0, 60.0),
    (0.001, 0.1, 0.05, 30.0),
]


@pytest.mark.parametrize("targets", OTHERS)
def test_a_record_without_parameters_gets_them_from_its_peaks(targets):
    peaks = measures(generate("other", *targets))
    found = [peaks[key] for key in ("pga_g", "pgv_cm_s", "pgd_cm", "duration_s")]
    np.testing.assert_allclose(found, targets, rtol=0.01)


@pytest.mark.parametrize(
    ("targets", "expected"),
    [
        ((0.2, 60.0, 2.0, 20.0), r"PGA·PGD/PGV² = 0\.11; a motion that starts and ends at rest"),
        ((0.2, 20.0, 0.92, 20.0), r"PGA·PGD/PGV² = 0\.45; a motion that starts and ends at rest"),
        ((0.2, 20.0, 5.0, 1e9), "duration_s is 1e"),
        ((9.0, 20.0, 5.0, 20.0), "pga_g is 9"),
        ((float("nan"), 20.0, 5.0, 20.0), "pga_g is nan"),
    ],
)
def test_peaks_no_motion_can_have_are_refused(targets, expected):
    with pytest.raises(RecordError, match=expected):
        generate("x", *targets)


@pytest.mark.parametrize(("error", "meets"), [(0.009, True), (0.011, False)])
def test_peaks_that_are_missed_by_more_than_a_hundredth_are_refused(monkeypatch, error, meets):
    monkeypatch.setattr(surrogate, "_solve", lambda model, spec, target: (spec, error))
    if meets:
        assert generate("x", 0.3, 20.0, 5.0, 20.0).details["peak_error"] == pytest.approx(error)
    else:
        with pytest.raises(RecordError, match=r"within 1% \(nearest 1\.1%"):
            generate("x", 0.3, 20.0, 5.0, 20.0)


GOOD = """
A:
  dt_s: 0.01
  pulses: [{amplitude_m_s: 0.5, period_s: 1.0, cycles: 2.0, phase_deg: 0, time_s: 4.0}]
  noise: {rms_m_s2: 1.0, frequency_hz: 3.0, damping: 0.6, low_cut_hz: 0.5, high_cut_hz: 20,
          rise_s: 2.0, strong_end_s: 6.0, decay_s: 2.0}
  solve: [pulses.0.amplitude_m_s, pulses.0.period_s, noise.rms_m_s2]
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("dt_s: 0.01", "dt: 0.01", r"A: unknown key 'dt'; did you mean 'dt_s'\?"),
        ("period_s: 1.0", "period_s: -1", r"A\.pulses\.0\.period_s: -1; expected it positive"),
        ("period_s: 1.0", "period_s: .nan", "expected a number"),
        ("period_s: 1.0", "period_s: true", "expected a number"),
        ("period_s: 1.0, ", "", "'period_s' is missing"),
        ("cycles: 2.0", "cycles: 1.0", "expected more than 1"),
        ("noise.rms_m_s2]", "noise.rms]", "did you mean 'noise.rms_m_s2'"),
        ("noise.rms_m_s2]", "pulses.0.period_s]", "repeated"),
        (", noise.rms_m_s2]", "]", "three or more"),
        ("A:", "- A:", "line 3: not YAML|expected a mapping"),
        ("A:", "A: &x [", "not YAML"),
        ("A:", "A: !!python/object/apply:os.system ['true']\nB:", "not YAML"),
        ("dt_s: 0.01", "dt_s: 9", "A.dt_s: 9"),
    ],
)
def test_bad_parameters_are_refused(tmp_path, old, new, expected):
    path = tmp_path / "surrogates.yaml"
    path.write_text(GOOD)
    assert read_specs(path)["A"].noise.frequency_hz == 3.0
    assert old in GOOD
    path.write_text(GOOD.replace(old, new))
    with pytest.raises(RecordError, match=expected) as caught:
        read_specs(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_nested_aliases_stay_small(tmp_path):
    """A few lines of YAML that would print as gigabytes are refused as fast as any other."""
    layers = "\n".join(f"b{i}: &b{i} [{', '.join([f'*b{i - 1}'] * 9)}]" for i in range(1, 30))
    path = tmp_path / "surrogates.yaml"
    path.write_text(f"b0: &b0 [x]\n{layers}\n")
    with pytest.raises(RecordError):
        read_specs(path)


def real(name):
    paths = {
        "RRS228": "RRS228_northridge_rinaldi_228.AT2",
        "1ST280": "1ST280_nahanni_site1_280.csv",
    }
    path = REAL / paths[name]
    if not path.is_file():
        pytest.skip("the real record is not here")
    return read_record(path)


@pytest.mark.parametrize("name", ["RRS228", "1ST280"])
def test_spectrum_is_like_the_record_s(name):
    """Mean |ln| of the ratio of 5 %-damped spectra, 0.05–3 s, below 0.35 (a factor of 1.4)."""
    periods = np.geomspace(0.05, 3.0, 60)
    pair = [
        response_spectrum(r.acceleration_m_s2, r.dt_s, periods).psa_m_s2
        for r in (real(name), load(name, TABLE))
    ]
    assert np.abs(np.log(pair[1] / pair[0])).mean() < 0.35


@pytest.mark.parametrize("name", ["RRS228", "1ST280"])
def test_surrogate_is_not_a_copy(name):
    """No shift in time brings surrogate and record to correlate as copies would."""
    record, ours = real(name), load(name, TABLE)
    t = np.arange(0, 40, 0.01)
    a, b = (np.interp(t, r.time_s, r.acceleration_m_s2, right=0.0) / G_M_S2 for r in (record, ours))
    correlation = np.correlate(a, b, "full") / np.sqrt(np.sum(a**2) * np.sum(b**2))
    assert abs(correlation).max() < 0.8


def test_polarity_of_rinaldi_s_pulse_is_the_record_s():
    v_real, v_ours = (
        integrate(r.acceleration_m_s2, r.dt_s)[0] for r in (real("RRS228"), load("RRS228", TABLE))
    )
    assert v_real[abs(v_real).argmax()] * v_ours[abs(v_ours).argmax()] > 0


def test_a_record_keeps_its_motion_in_a_table_elsewhere(tmp_path):
    """The project's parameters apply unless there are others beside the table."""
    copy = tmp_path / "mine.tsv"
    copy.write_bytes(TABLE.read_bytes())
    there, here = load("BUCAR0", TABLE), load("BUCAR0", copy)
    np.testing.assert_array_equal(there.acceleration_m_s2, here.acceleration_m_s2)
    (tmp_path / "surrogates.yaml").write_text(GOOD)
    other = load("BUCAR0", copy)
    assert abs(other.acceleration_m_s2 - there.acceleration_m_s2).max() > 0.1


def test_every_entry_of_the_parameters_is_used():
    assert set(read_specs(PARAMETERS)) == set(NAMES)
