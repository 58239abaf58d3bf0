"""Pulses of a record: what was put in is found, with its sign, and a surrogate keeps it."""

from pathlib import Path

import numpy as np
import pytest
from rocking.records import Record, integrate, load, measures, read_table
from rocking.records.surrogate import generate
from rocking.records.surrogate_model import Pulse

from studies.surrogates.pulses import PERIODS_S, find_pulses, pulse_spec

DT = 0.01
# far apart, on periods of the search, of opposite signs
MADE = (
    Pulse(0.8, float(PERIODS_S[16]), 2.0, 30.0, 8.0),
    Pulse(0.3, float(PERIODS_S[8]), 1.6, 200.0, 15.0),
)


def motion(pulses, noise=0.0):
    t = DT * np.arange(2001)
    a = sum(pulse.acceleration(t) for pulse in pulses)
    a += noise * np.random.default_rng(3).standard_normal(t.size) * np.exp(-((t - 9) ** 2) / 8)
    return Record("trial", a, DT, "file")


def test_pulses_are_found_with_their_parameters_the_strongest_first():
    for made, found in zip(MADE, find_pulses(motion(MADE), 2), strict=True):
        assert found.period_s == pytest.approx(made.period_s)
        assert found.cycles == made.cycles
        assert found.time_s == pytest.approx(made.time_s, abs=DT)
        assert found.amplitude_m_s == pytest.approx(made.amplitude_m_s, rel=0.01)
        difference = (found.phase_deg - made.phase_deg + 180.0) % 360.0 - 180.0
        assert abs(difference) < 1.0


def test_the_mirrored_record_has_the_mirrored_pulses():
    record = motion(MADE, noise=0.2)
    mirrored = Record("trial", -record.acceleration_m_s2, DT, "file")
    for p, q in zip(find_pulses(record, 3), find_pulses(mirrored, 3), strict=True):
        np.testing.assert_allclose(
            p.acceleration(record.time_s), -q.acceleration(record.time_s), atol=1e-9
        )


def test_each_pulse_leaves_less_of_the_velocity():
    record = motion(MADE, noise=0.6)
    t = record.time_s
    left = []
    for count in range(1, 4):
        rest = record.acceleration_m_s2 - sum(p.acceleration(t) for p in find_pulses(record, count))
        velocity, _ = integrate(rest, DT)
        left.append(np.sum(velocity**2))
    assert np.all(np.diff(left) < 0.0)


def test_a_surrogate_with_pulses_keeps_peaks_and_the_way_the_ground_went():
    record = motion(MADE, noise=0.6)
    peaks = measures(record)
    target = [peaks[name] for name in ("pga_g", "pgv_cm_s", "pgd_cm", "duration_s")]
    made = generate("trial", *target, spec=pulse_spec(record, 2), seed=1)
    for name in ("pga_g", "pgv_cm_s", "pgd_cm"):
        assert measures(made)[name] == pytest.approx(peaks[name], rel=0.01)
    velocity = integrate(record.acceleration_m_s2, DT)[0]
    like = np.interp(record.time_s, made.time_s, integrate(made.acceleration_m_s2, made.dt_s)[0])
    assert np.corrcoef(velocity, like)[0, 1] > 0.8


@pytest.mark.parametrize("name", ["RRS228", "1ST280"])
def test_shipped_descriptions_give_motions_of_their_peaks(name):
    table = Path(__file__).parents[3] / "config" / "suites" / "pulse_surrogates.tsv"
    stated, made = read_table(table)[name].targets, measures(load(name, table, seed=3))
    for peak, value in stated.items():
        assert made[peak] == pytest.approx(value, rel=0.01)
