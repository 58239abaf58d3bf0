"""The parts of a surrogate with a record's own pulses."""

import numpy as np
import pytest
from rocking.records import Record
from rocking.records.surrogate_model import Pulse

from studies.surrogates.pulses import find_pulses, pulse_spec

DT = 0.01


def record(*pulses):
    """Pulses in a hum of 9 Hz that lasts from 2 to 22 s of 24 s, too fast to be a pulse."""
    t = DT * np.arange(2401)
    hum = 0.5 * np.sin(18.0 * np.pi * t) * ((t > 2.0) & (t < 22.0))
    return Record("trial", hum + sum(p.acceleration(t) for p in pulses), DT, "file")


@pytest.mark.parametrize(("period_s", "low_hz"), [(1.0, 0.8), (2.0, 0.4), (6.0, 0.3), (0.4, 1.5)])
def test_the_noise_beside_pulses_begins_above_the_shortest_of_them(period_s, low_hz):
    """At 0.8 of its frequency, from 0.3 to 1.5 Hz; its envelope is that of the hum."""
    pulse = Pulse(1.0, period_s, 1.6, 0.0, 12.0)
    spec = pulse_spec(record(pulse), 1)
    (found,) = spec.pulses
    assert spec.noise.low_cut_hz == pytest.approx(np.clip(0.8 / found.period_s, 0.3, 1.5), rel=1e-9)
    assert spec.noise.low_cut_hz == pytest.approx(low_hz, rel=0.15)
    # ∫a² of the hum grows evenly over its 20 s: 5 % at 3 s, 75 % at 17 s, 95 % at 21 s
    assert spec.noise.rise_s == pytest.approx(3.0, abs=0.4)
    assert spec.noise.strong_end_s == pytest.approx(17.0, abs=0.4)
    assert spec.noise.decay_s == pytest.approx(2.0, abs=0.2)
    assert spec.noise.rms_m_s2 == pytest.approx(0.5 / np.sqrt(2.0), rel=0.05)


def test_of_two_pulses_the_shorter_one_sets_the_cut():
    spec = pulse_spec(record(Pulse(1.0, 3.0, 1.6, 0.0, 7.0), Pulse(0.6, 1.0, 1.6, 0.0, 16.0)), 2)
    periods = [pulse.period_s for pulse in spec.pulses]
    assert max(periods) > 2.0 * min(periods)
    assert spec.noise.low_cut_hz == pytest.approx(0.8 / min(periods))


def test_a_record_shorter_than_the_longest_pulses_is_searched_for_the_others():
    t = DT * np.arange(401)
    made = Pulse(0.5, 1.0, 1.2, 0.0, 1.5)
    (found,) = find_pulses(Record("short", made.acceleration(t), DT, "file"), 1)
    assert found.period_s == pytest.approx(1.0, rel=0.1)
    assert found.time_s == pytest.approx(1.5, abs=0.05)
    assert find_pulses(Record("shortest", made.acceleration(t[100:200]), DT, "file"), 1) == ()


@pytest.mark.parametrize("hum_m_s2", [0.1, 0.5])
def test_the_noise_has_the_frequency_of_what_the_pulses_leave(hum_m_s2):
    """1.2 times PGA/(2π PGV) of it: of a harmonic that alone would be its frequency."""
    t = DT * np.arange(2401)
    hum = hum_m_s2 * np.cos(11.0 * np.pi * (t - 2.0)) * ((t > 2.0) & (t < 22.0))
    made = hum + Pulse(0.2, 2.0, 1.6, 0.0, 12.0).acceleration(t)
    spec = pulse_spec(Record("trial", made, DT, "file"), 1)
    rest = made - spec.pulses[0].acceleration(t)
    velocity = np.concatenate([[0.0], np.cumsum(0.5 * DT * (rest[1:] + rest[:-1]))])
    ratio = np.abs(rest).max() / np.abs(velocity).max()
    assert 1.0 < 1.2 * ratio / (2.0 * np.pi) < 8.0
    assert spec.noise.frequency_hz == pytest.approx(1.2 * ratio / (2.0 * np.pi), rel=1e-6)
