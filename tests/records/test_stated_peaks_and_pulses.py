"""Peaks that a file's head states, and the parts of a surrogate with a record's own pulses."""

import re

import numpy as np
import pytest
from record_samples import all_samples, put, read, refusal
from rocking.records import Record, read_record
from rocking.records.pulses import find_pulses, pulse_spec
from rocking.records.surrogate_model import Pulse

DT = 0.01
# how the head states the peak, width and digits of its number, and what of it may be rounding
STATED = {
    "csmip.V2": (b"PEAK ACCELERATION =", 11, 3, 0.001),
    "geonet.V1A": (b"Acceleration:  Peak", 9, 1, 0.002),
    "geonet.V2A": (b"Acceleration:  Peak", 9, 1, 0.002),
}


@pytest.mark.parametrize("name", STATED)
@pytest.mark.parametrize("factor", [0.8, 0.95, 0.0, 1.05, 1.25])
def test_a_stated_peak_that_the_samples_have_not_is_refused(tmp_path, name, factor):
    """A lost sample or a wrong unit of the text; just beyond what rounding explains too (0)."""
    sample = next(one for one in all_samples() if one.name == name)
    words, width, digits, rounding = STATED[name]
    assert read(put(tmp_path, sample), sample).acceleration_m_s2.size
    factor = factor or 1.0 + 1.6 * rounding
    for other, fits in ((factor, False), (1.0 + 0.5 * rounding, True)):
        parts = sample.data.split(words)
        for k in range(1, len(parts)):
            value = float(parts[k][:width])
            parts[k] = f"{other * value:{width}.{digits}f}".encode() + parts[k][width:]
        path = put(tmp_path, sample, words.join(parts))
        if fits:
            read(path, sample)
        else:
            assert "peak" in refusal(path, sample).lower()


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


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_extremes_of_an_smc_head_are_a_peak_whichever_is_larger(tmp_path, sign):
    sample = next(one for one in all_samples() if one.name == "smc.smc")
    largest = 100.0 * sample.acceleration_m_s2.max(), 100.0 * sample.acceleration_m_s2.min()
    words = [f"{value:>15.7E}".encode() for value in largest]
    assert all(sample.data.count(word) == 1 for word in words)
    top, other = sorted(words, key=lambda word: -abs(float(word)))
    stated = f"{sign * 1.3 * abs(float(top)):>15.7E}".encode()
    path = put(tmp_path, sample, sample.data.replace(top, stated))
    assert "the header states" in refusal(path, sample)
    turned = f"{-float(top):>15.7E}".encode()
    read(put(tmp_path, sample, sample.data.replace(top, turned)), sample)


@pytest.mark.parametrize(
    ("name", "form", "width", "per_m_s2"),
    [
        ("csmip.V2", ">10.3f", 10, 100.0),
        ("geonet.V1A", ">8.1f", 8, 1000.0),
        ("cosmos.v2", ">13.6f", 10, 100.0),
        ("smc.smc", ">15.7E", 10, 100.0),
    ],
)
def test_a_peak_that_does_not_fit_names_the_line_of_the_first_sample(
    tmp_path, name, form, width, per_m_s2
):
    sample = next(one for one in all_samples() if one.name == name)
    values = sample.acceleration_m_s2 * per_m_s2
    peak = values[np.abs(values).argmax()]
    stated, larger = (format(one, form).encode() for one in (peak, 1.5 * peak))
    assert sample.data.count(stated)
    said = refusal(put(tmp_path, sample, sample.data.replace(stated, larger, 1)), sample)
    assert "the header states" in said
    row = sample.data.decode().splitlines()[int(re.search(r"line (\d+)", said)[1]) - 1]
    assert float(row[:width]) == pytest.approx(values[0], abs=0.06)


def test_commas_between_columns_and_exponents_without_a_point_are_read(tmp_path):
    """Such as 1e-2: it has no decimal mark, and none is missing."""
    rows = [f"{k}e-2,{(-1) ** k * k}e-3,{k}e-3" for k in range(1, 40)]
    path = tmp_path / "own.csv"
    path.write_text("time_s,NS (g),EW (g)\n" + "\n".join(rows) + "\n")
    found = read_record(str(path), component="EW (g)")
    assert found.acceleration_m_s2 == pytest.approx(9.80665e-3 * np.arange(1, 40))
