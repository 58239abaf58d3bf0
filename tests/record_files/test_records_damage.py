"""Readers: whatever is damaged is refused by file and line."""

import os
import re

import numpy as np
import pytest
import record_samples as samples
from record_files.reader import read_record
from record_files.text import read_text
from record_samples import put, read, refusal
from rocking.records import RecordError


def test_truncated_file_is_refused_where_the_number_of_samples_is_declared(tmp_path, sample):
    if not sample.counted:
        pytest.skip("a bare column cannot tell")
    lines = sample.data.split(b"\n")
    for cut in range(1, len(lines) - 1, 5):
        path = put(tmp_path, sample, b"\n".join(lines[:cut]) + b"\n")
        try:
            record = read(path, sample)
        except RecordError:
            assert refusal(path, sample)
        else:  # only whole components may be missing after the one that was asked for
            assert sample.name.startswith(("geonet", "csmip"))
            assert len(record) == len(sample.acceleration_m_s2)


def test_a_file_cut_within_its_last_number_is_not_read_as_another_motion(tmp_path, sample):
    """ "-1.7E-02" cut to "-1.7" is a number too, a hundred times larger."""
    whole = read(put(tmp_path, sample), sample).acceleration_m_s2
    for cut in range(len(sample.data) - 60, len(sample.data)):
        try:
            found = read(put(tmp_path, sample, sample.data[:cut]), sample).acceleration_m_s2
        except RecordError:
            continue
        # A column of numbers without trailing zeros may lose digits that others lack too.
        np.testing.assert_allclose(found, whole[: len(found)], rtol=1e-4)


def test_a_lost_digit_shows_where_there_are_columns(tmp_path):
    for sample in (samples.at2(), samples.knet(), samples.smc(), samples.cosmos()):
        lines = sample.data.decode().split("\n")
        row = len(lines) - 5
        lines[row] = re.sub(r"\d(?=\S*$)", "", lines[row].rstrip(), count=1)
        path = put(tmp_path, sample, "\n".join(lines).encode())
        assert f"line {row + 1}:" in refusal(path, sample)


def test_a_lost_or_doubled_line_of_samples_is_refused(tmp_path, sample):
    if not sample.counted:
        pytest.skip("a bare column cannot tell")
    lines = sample.data.split(b"\n")
    record = read(put(tmp_path, sample), sample)
    for change in ([], [2]):
        for number in range(len(lines) - 30, len(lines) - 3, 3):
            kept = lines[:number] + [lines[number]] * len(change) * 2 + lines[number + 1 :]
            try:
                again = read(put(tmp_path, sample, b"\n".join(kept)), sample)
            except RecordError:
                continue
            np.testing.assert_array_equal(again.acceleration_m_s2, record.acceleration_m_s2)


def test_header_peak_is_checked(tmp_path):
    for sample, old, new in (
        (samples.esm(), b"PGA_CM/S^2: -", b"PGA_CM/S^2: -9"),
        (samples.knet(), b"Max. Acc. (gal)   ", b"Max. Acc. (gal)   9"),
    ):
        path = put(tmp_path, sample, sample.data.replace(old, new))
        assert "header states" in refusal(path, sample)


def test_uneven_time_is_refused_with_its_line(tmp_path):
    sample = samples.two_column()
    lines = sample.data.split(b"\n")
    for number in (1, 20, 60):
        missing = put(tmp_path, sample, b"\n".join(lines[:number] + lines[number + 1 :]))
        assert f"line {number + 1}:" in refusal(missing, sample)
    lines[30] = b"0.5" + lines[30][8:]
    assert "increase" in refusal(put(tmp_path, sample, b"\n".join(lines)), sample)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"", "empty"),
        (b" \n\n\t\n", "empty"),
        (b"\xef\xbb\xbf", "empty"),
        (b"\x00\x01\x02", "binary"),
        (b"0.0 1.0\n0.1 \xff\n", "line 2: expected a number, found 'ÿ'"),
        (b"hello\nworld\n", "format not recognised"),
        (b"0 1 2 3\n1 2 3 4\n", "say which in component"),
        (b"station A\n0,00,1,5\n0,01,1,6\n", "commas seem to separate"),
        (b"0.00,1,55\n0.01,1,62\n", "commas seem to separate"),
        (b"0.0 1.0 " + b"9" * 20_000, "longer than"),
        (b"0.0 1.0\n\n0.1 1.0\n", "line 2: blank line"),
        (b"0.0 1.0\n", "at least 2 samples"),
        (b"time acc\n0.00 1x\n0.01 1.2\n0.02 1.3\n", "line 2: expected numbers"),
    ],
)
def test_other_files_are_refused_in_one_line(tmp_path, data, expected):
    sample = samples.Sample("bad.txt", data, None, 0, {"units": "g"})
    assert expected in refusal(put(tmp_path, sample), sample)


def test_what_is_not_a_file_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for name, expected in (("pipe", "regular file"), (".", "regular"), ("no", "does not exist")):
        with pytest.raises(RecordError, match=expected):
            read_text(tmp_path / name)


def test_declared_numbers_are_checked_before_anything_is_made_of_them(tmp_path):
    sample = samples.at2()
    for count in (b"999999999", b"99999999999999999999", b"-5", b"0", b"1"):
        data = sample.data.replace(b"NPTS=  64", b"NPTS=  " + count)
        assert "line 4" in refusal(put(tmp_path, sample, data), sample)


@pytest.mark.parametrize("line", ["1e308\n-1e308\n", "0.01 1e308\n0.02 -1e308\n"])
def test_numbers_as_large_as_there_are_end_in_one_line_without_warnings(tmp_path, line, recwarn):
    path = tmp_path / "vast.txt"
    path.write_text(line * 500)
    with pytest.raises(RecordError, match=r"vast\.txt") as caught:
        read_record(str(path), dt_s=0.01, units="g")
    assert "\n" not in str(caught.value)
    assert not recwarn.list
