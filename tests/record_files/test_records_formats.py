"""Readers: what was written comes back, as the file and the table state it."""

import re

import numpy as np
import pytest
import record_samples as samples
from record_files import RecordError, read_record
from record_files.units import G_M_S2, unit_name
from record_samples import put, read, refusal

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2


def test_motion_comes_back(tmp_path, sample):
    record = read(put(tmp_path, sample), sample)
    assert record.dt_s == pytest.approx(samples.DT_S, rel=1e-9)
    np.testing.assert_allclose(
        record.acceleration_m_s2, sample.acceleration_m_s2, atol=sample.tolerance_m_s2
    )
    assert record.source == "file"
    assert record.baseline == "none"


def test_line_ends_and_byte_order_mark_do_not_matter(tmp_path, sample):
    plain = read(put(tmp_path, sample), sample).acceleration_m_s2
    for data in (
        sample.data.replace(b"\n", b"\r\n"),
        b"\xef\xbb\xbf" + sample.data,
        sample.data + b"\x1a",
    ):
        again = read(put(tmp_path, sample, data), sample)
        np.testing.assert_array_equal(again.acceleration_m_s2, plain)


def test_numbers_of_any_width_are_read_from_a_free_file(tmp_path):
    sample = samples.at2(2)
    header = sample.data.decode().split("\n")[:4]
    values = [f"{v / 9.80665:.{6 + i % 3}g}" for i, v in enumerate(sample.acceleration_m_s2)]
    path = put(tmp_path, sample, "\n".join([*header, *values]).encode() + b"\n")
    np.testing.assert_allclose(
        read(path, sample).acceleration_m_s2, sample.acceleration_m_s2, atol=2e-5
    )


@pytest.mark.parametrize("token", ["nan", "inf", "1e999", "x", "1_0", "--1", "1,5", "٣"])
def test_no_sample_but_finite_decimals(tmp_path, sample, token):
    lines = sample.data.decode().split("\n")
    number = len(lines) - (8 if sample.name.startswith(("cosmos", "csmip")) else 4)
    target = lines[number]
    last = re.findall(r"\S+", target)[-1]
    if sample.name.startswith(("smc", "cosmos", "csmip", "geonet")):
        width = 8 if sample.name.startswith("geonet") else 10
        lines[number] = target[:-width] + token.rjust(width)
    else:
        lines[number] = target[: target.rindex(last)] + token
    path = put(tmp_path, sample, "\n".join(lines).encode())
    assert f"line {number + 1}:" in refusal(path, sample)


def test_stated_step_and_units_must_agree_with_the_file(tmp_path, sample):
    path = put(tmp_path, sample)
    if sample.kwargs.get("dt_s") is None:
        assert "time step" in refusal(path, sample, dt_s=0.01)
        assert read(path, sample, dt_s=samples.DT_S).dt_s == samples.DT_S
    if sample.kwargs.get("units") is None:
        assert "unknown units 'mi/h'" in refusal(path, sample, units="mi/h")
        stated = read(path, sample).units_read
        other = "g" if stated != "g" else "m/s2"
        assert f"the file is in {stated}" in refusal(path, sample, units=other)


def test_coarsely_rounded_step_gives_way_to_the_stated_one(tmp_path):
    sample = samples.at2(2)
    sample.data = sample.data.replace(b"DT=   .0200", b"DT=   .0024")
    path = put(tmp_path, sample)
    assert read(path, sample, dt_s=0.00244).dt_s == 0.00244
    assert "time step" in refusal(path, sample, dt_s=0.0025)


def test_wrong_units_give_an_impossible_peak(tmp_path):
    sample = samples.two_column()
    path = put(tmp_path, sample)
    assert read(path, sample).units_read == "m/s2"
    strong = samples.Sample("x.txt", _scaled(sample, 30), sample.acceleration_m_s2, 1)
    assert "units right" in refusal(put(tmp_path, strong), strong, units="g")
    weak = samples.Sample("x.txt", _scaled(sample, 1e-2), sample.acceleration_m_s2, 1)
    assert "units right" in refusal(put(tmp_path, weak), weak, units="mm/s2")


def _scaled(sample, factor):
    rows = [line.split() for line in sample.data.decode().splitlines()]
    return "\n".join(f"{t}\t{factor * float(a):.9g}" for t, a in rows).encode()


def test_missing_units_and_step_are_asked_for(tmp_path):
    sample = samples.single_column()
    path = put(tmp_path, sample)
    assert "states no units" in refusal(path, sample, units=None)
    assert "states no time step" in refusal(path, sample, dt_s=None)


def test_times_rounded_in_print_are_even(tmp_path):
    """A step of 1/256 s printed to three decimals jitters by an eighth of a step."""
    a = samples.motion(n=200)
    lines = [f"{i / 256:.3f} {value:.6f}" for i, value in enumerate(a)]
    path = tmp_path / "rounded.txt"
    path.write_text("\n".join(lines))
    assert read_record(path, units="m/s2").dt_s == pytest.approx(1 / 256, rel=1e-3)


@pytest.mark.parametrize("stated", [{}, {"dt_s": 0.01}])
def test_time_that_falls_is_no_acceleration(tmp_path, stated):
    """Two columns, the first from the end to the start: not taken for one row of samples."""
    path = tmp_path / "back.txt"
    rows = enumerate(samples.motion(n=200))
    path.write_text("\n".join(f"{2.0 - 0.01 * i:.2f} {0.1 * v:.6f}" for i, v in rows))
    with pytest.raises(RecordError, match=r"line 2: time goes from 2 to 1\.99 s"):
        read_record(path, units="m/s2", **stated)


def test_component_by_label_azimuth_and_place(tmp_path):
    sample = samples.geonet()
    path = put(tmp_path, sample)
    whole = read(path, sample).acceleration_m_s2
    for component in ("s64e", "116", "#2"):
        np.testing.assert_array_equal(
            read(path, sample, component=component).acceleration_m_s2, whole
        )
    vertical = read(path, sample, component="Up").acceleration_m_s2
    np.testing.assert_allclose(vertical, -0.3 * whole, atol=2e-4)
    for component in (None, "", "N", "26", "#0", "#4"):
        message = refusal(path, sample, component=component)
        assert "S26W" in message
        assert "S64E" in message


@pytest.mark.parametrize(
    ("heading", "component"),
    [
        ("Acceleration (g's)", ""),
        ("acceleration_m_s2", ""),
        ("acc g", ""),
        ("cm/s2", ""),
        ("N-S", "N-S"),
        ("acc_x (g)", "acc_x"),
        ("HNE_m_s2", "HNE"),
    ],
)
def test_a_column_of_accelerations_is_no_component(tmp_path, heading, component):
    """Captions name what tells one component from another, not the unit that the file has."""
    path = tmp_path / "plain.csv"
    rows = (f"{0.01 * i:.2f},0.1{i % 7}\n" for i in range(99))
    path.write_text(f"Time (s),{heading}\n" + "".join(rows))
    units = None if any(unit in heading for unit in ("g", "s2")) else "g"
    assert read_record(path, units=units).details["component"] == component


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("g", "g"),
        ("G", "g"),
        ("g's", "g"),
        ("m/s2", "m/s2"),
        ("M/S^2", "m/s2"),
        ("m/s²", "m/s2"),
        ("cm/s/s", "cm/s2"),
        ("CM/SEC/SEC", "cm/s2"),
        ("cm/sec2", "cm/s2"),
        ("gal", "cm/s2"),
        ("mm/s/s", "mm/s2"),
        ("m / s**2", "m/s2"),
        ("cm/s", None),
        ("m", None),
        ("kg", None),
    ],
)
def test_spellings_of_units(text, unit):
    assert unit_name(text) == unit


@pytest.mark.parametrize(("factor", "fits"), [(1.01, True), (1.5, False), (0.5, False)])
def test_the_peak_that_a_k_net_header_states_is_that_of_its_samples(tmp_path, factor, fits):
    """Else counts and scale do not belong together, and every amplitude would be off."""
    sample = samples.knet()
    stated = f"{100.0 * np.abs(sample.acceleration_m_s2).max():.3f}".encode()
    assert stated in sample.data
    path = put(
        tmp_path, sample, sample.data.replace(stated, f"{factor * float(stated):.3f}".encode())
    )
    if fits:
        assert len(read(path, sample)) == len(sample.acceleration_m_s2)
    else:
        assert "peak" in refusal(path, sample)


@pytest.mark.parametrize(("label", "azimuth_deg"), [("N-S", 0), ("E-W", 90)])
def test_a_k_net_channel_is_found_by_its_azimuth(tmp_path, label, azimuth_deg):
    """N-S is along 0°, E-W along 90°, clockwise from north; the other one is not in the file."""
    sample = samples.knet()
    path = put(tmp_path, sample, sample.data.replace(b"E-W", label.encode()))
    record = read_record(path, component=str(azimuth_deg))
    np.testing.assert_allclose(
        record.acceleration_m_s2, sample.acceleration_m_s2, atol=sample.tolerance_m_s2
    )
    with pytest.raises(RecordError):
        read_record(path, component=str(90 - azimuth_deg))


def test_the_unit_g_is_the_gravity_in_which_scenes_are_shaken():
    assert G_M_S2 == STANDARD_GRAVITY_M_S2
