"""Peaks that a file's head states."""

import re

import numpy as np
import pytest
from record_samples import all_samples, put, read, refusal
from rocking.records import read_record

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
