"""Readers: what was written comes back; whatever is damaged is refused by file and line."""

import os
import re
from pathlib import Path

import numpy as np
import pytest
import record_samples as samples
from rocking.records import RecordError, detect, integrate, read_record
from rocking.records.formats import FORMATS
from rocking.records.reader import _detect
from rocking.records.record import unit_name
from rocking.records.text import read_text, text_from_bytes

FILES = Path(__file__).parents[3] / "shared" / "formats"
NAMES = [sample.name for sample in samples.all_samples()]


@pytest.fixture(params=samples.all_samples(), ids=NAMES)
def sample(request):
    return request.param


def put(folder, sample, data=None):
    path = folder / sample.name
    path.write_bytes(sample.data if data is None else data)
    return str(path)


def read(path, sample, **changed):
    return read_record(path, **(sample.kwargs | changed))


def refusal(path, sample, **changed):
    """Return the one-line refusal of a file, which names it."""
    with pytest.raises(RecordError) as caught:
        read(path, sample, **changed)
    message = str(caught.value)
    assert path in message
    assert "\n" not in message
    return message


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


def test_uneven_time_is_refused_with_its_line(tmp_path):
    sample = samples.two_column()
    lines = sample.data.split(b"\n")
    for number in (1, 20, 60):
        missing = put(tmp_path, sample, b"\n".join(lines[:number] + lines[number + 1 :]))
        assert f"line {number + 1}:" in refusal(missing, sample)
    lines[30] = b"0.5" + lines[30][8:]
    assert "increase" in refusal(put(tmp_path, sample, b"\n".join(lines)), sample)


def test_times_rounded_in_print_are_even(tmp_path):
    """A step of 1/256 s printed to three decimals jitters by an eighth of a step."""
    a = samples.motion(n=200)
    lines = [f"{i / 256:.3f} {value:.6f}" for i, value in enumerate(a)]
    path = tmp_path / "rounded.txt"
    path.write_text("\n".join(lines))
    assert read_record(path, units="m/s2").dt_s == pytest.approx(1 / 256, rel=1e-3)


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


def test_header_peak_is_checked(tmp_path):
    for sample, old, new in (
        (samples.esm(), b"PGA_CM/S^2: -", b"PGA_CM/S^2: -9"),
        (samples.knet(), b"Max. Acc. (gal)   ", b"Max. Acc. (gal)   9"),
    ):
        path = put(tmp_path, sample, sample.data.replace(old, new))
        assert "header states" in refusal(path, sample)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"", "empty"),
        (b" \n\n\t\n", "empty"),
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


def variants():
    """Return {name: (data, what is stated)} of one motion as users' files hold it."""
    a = samples.motion()
    g = [f"{v / 9.80665:.7f}" for v in a]
    t = [f"{samples.DT_S * i:.2f}" for i in range(len(a))]
    pairs = list(zip(t, g, strict=True))
    rows = [" ".join(f"{v:>11}" for v in g[i : i + 8]) for i in range(0, len(g), 8)]
    comma = str.maketrans(".", ",")
    head = ["A title", "64 points at equal spacing of 0.02 sec", "The units are (g)"]
    npts = "NPTS=  64, DT= .02000 SEC"
    step, both = {"dt_s": samples.DT_S}, {"dt_s": samples.DT_S, "units": "g"}

    def join(*lines, encoding="utf-8"):
        return "\n".join([*lines, ""]).encode(encoding)

    return {
        "AT2 in OpenSees' words": (join(*head, npts, *rows), {}),
        "AT2 with a longer heading": (join(*head, "a row", "*** Begin data ***", npts, *rows), {}),
        "AT2 with a closing line": (join(*head, npts, *rows, "*** End data ***"), {}),
        "AT2 without NPTS": (join(*head, "no numbers here", *rows), step | {"format": "at2"}),
        "AT2 without units": (join("A", "B, 90", "C", npts, *rows), {"units": "g"}),
        "AT2 with doubled line ends": (join(*head, npts, *rows).replace(b"\n", b"\r\r\n"), {}),
        "AT2 with the station after the component": (
            join("A", "B, 090 (STATION 5)", "IN UNITS OF G. FILTER 1 Hz", npts, *rows),
            {"component": "90"},
        ),
        "several a line, headed": (join(*head, *rows), {}),
        "several a line, bare": (join(*rows), both),
        "several a line, decimal commas": (join(*(row.translate(comma) for row in rows)), both),
        "one a line, step in the heading": (join("dt = 0.02 s", "units: g", *g), {}),
        "one a line, decimal commas": (join(*(v.translate(comma) for v in g)), both),
        "one a line, point first": (join(*(v.replace("0.", ".", 1) for v in g)), both),
        "sampling rate in the heading": (join("# Sampling rate (Hz): 50", *g), {"units": "g"}),
        "semicolons and decimal commas": (
            join("Zeit [s];Beschleunigung [g]", *(";".join(p).translate(comma) for p in pairs)),
            {},
        ),
        "tabs and decimal commas": (
            join("time\tacc", *("\t".join(p).translate(comma) for p in pairs)),
            {"units": "g"},
        ),
        "Latin-1": (
            join("# Güímar, 28° N", "# Time (s),Acc (g)", *map(",".join, pairs), encoding="cp1252"),
            {},
        ),
        "unnamed channels": (
            join("Time (s),,", *(f"{x},{y},{y}9" for x, y in pairs)),
            {"units": "g", "component": 1},
        ),
        "a comma at the end": (join("t,acc_g,", *(f"{x},{y}," for x, y in pairs)), {}),
        "components without a time": (
            join(
                "DT: 0.02 sec", "  N-S   E-W   U-D", *(f"{v} -{v} 0.1".replace("--", "") for v in g)
            ),
            {"units": "g", "component": "n-s"},
        ),
        "many columns": (
            join("time ax ay az", *(f"{x} 0.1 {y} 0.2" for x, y in pairs)),
            {"units": "g", "component": "2"},
        ),
        "units after the name": (join("Time s;Acc g", *map(";".join, pairs)), {}),
    }


@pytest.mark.parametrize("name", variants())
def test_variants_of_users_files_are_read(tmp_path, name):
    data, stated = variants()[name]
    path = tmp_path / "record.txt"
    path.write_bytes(data)
    record = read_record(path, **stated)
    assert record.dt_s == pytest.approx(samples.DT_S)
    np.testing.assert_allclose(record.acceleration_m_s2, samples.motion(), atol=1e-6)


@pytest.mark.parametrize(
    ("sample", "old", "new", "stated", "asked"),
    [
        (samples.esm(), "UNITS: cm/s^2", "UNITS: ", {"units": "gal"}, "states no units"),
        (samples.esm(), "SAMPLING_INTERVAL_S: 0.020000", "X: 1", {"dt_s": 0.02}, "no time step"),
        (samples.geonet(), "intervals of 0.020", "unknown steps", {"dt_s": 0.02}, "no time step"),
        (samples.geonet(), "mm/s/s at", "?", {"units": "mm/s2"}, "states no units"),
        (samples.cosmos(), "    20.000000", "  -999.00000", {"dt_s": 0.02}, "no time step"),
    ],
)
def test_the_table_states_what_a_header_fails_to_say(tmp_path, sample, old, new, stated, asked):
    assert old.encode() in sample.data
    path = put(tmp_path, sample, sample.data.replace(old.encode(), new.encode()))
    assert asked in refusal(path, sample)
    again = read(path, sample, **stated)
    np.testing.assert_allclose(
        again.acceleration_m_s2, sample.acceleration_m_s2, atol=sample.tolerance_m_s2
    )


def test_a_damaged_time_does_not_make_an_acceleration_of_the_time(tmp_path):
    sample = samples.columns()
    lines = sample.data.decode().splitlines()
    lines[20], lines[21] = lines[21], lines[20]
    path = put(tmp_path, sample, "\n".join(lines).encode())
    assert "line 22: time goes from" in refusal(path, sample)


# Real files, beside the repository when they are there ------------------------------------

REAL = {  # file: (format, component, step, samples)
    "COSMOS_V1_Cosmos12TimeSeriesTest.v1": ("cosmos", None, 0.01, 7000),
    "CSMIP_V2_ce36456p_CE36456.V2": ("csmip", "0", 0.02, 3250),
    "CSV_pyslammer_Nahanni_1985_NS1-280.csv": ("csv", None, 0.005, 4113),
    "ESM_dyna_HL.DLFA..HNE.D.20190728.160908.C.ACC.ASC": ("esm", None, 0.005, 13876),
    "ESM_old_20101114230825_3104_ap_RawAcc_E.asc": ("esm", None, 0.01, 5600),
    "GeoNet_20110222_015029_MQZ.V2A": ("geonet", "E", 0.02, 3300),
    "GeoNet_20160214_001347_HVSC_20.V1A": ("geonet", "S26W", 0.005, 11478),
    "GeoNet_20180212_211557_WPWS_20.V2A": ("geonet", "S74E", 0.02, 5800),
    "GeoNet_small_D00129A02.V1A": ("geonet", "#1", 0.01, 1483),
    "KNET_CHB0031412312349.EW": ("knet", "E-W", 0.01, 6000),
    "PEER_NGA2005_NGA_no_1063_RRS228.AT2": ("at2", "228", 0.01, 1991),
    "PEER_NGAWest2_RSN292_ITALY_A-STU270.AT2": ("at2", None, 0.0024, 16392),
    "PEER_NGAWest2_RSN763_LOMAP_GIL067.AT2": ("at2", None, 0.005, 7999),
    "PEER_original_PEA_ARL360.at2": ("at2", None, 0.02, 2000),
    "SINGLECOL_slammer_NS1-280": ("single-column", None, 0.005, 4113),
    "SMC_0111a.smc": ("smc", "360", 0.005, 6001),
    "TWOCOL_SortedEQFile_120111.txt": ("two-column", None, 0.01, 3000),
}


def real_file(name):
    if not (FILES / name).is_file():
        pytest.skip("the real record is not here")
    return FILES / name


@pytest.mark.parametrize("name", REAL)
def test_real_file(name):
    path = real_file(name)
    form, component, dt_s, count = REAL[name]
    assert detect(path) == form
    bare = form in ("single-column", "two-column")
    record = read_record(
        path,
        component=component,
        units="g" if bare else None,
        dt_s=dt_s if form == "single-column" else None,
    )
    assert len(record) == count
    assert record.dt_s == pytest.approx(dt_s, rel=1e-6)


def test_one_motion_in_two_formats_is_the_same():
    comma = read_record(real_file("CSV_pyslammer_Nahanni_1985_NS1-280.csv"))
    column = read_record(real_file("SINGLECOL_slammer_NS1-280"), units="g", dt_s=0.005)
    np.testing.assert_array_equal(comma.acceleration_m_s2, column.acceleration_m_s2)


@pytest.mark.parametrize(
    ("name", "component", "peaks"),
    [  # velocity [m/s] and displacement [m] peaks that the files' own headings state
        ("CSMIP_V2_ce36456p_CE36456.V2", "90", (0.28253, 0.05449)),
        ("CSMIP_V2_ce36456p_CE36456.V2", "UP", (0.11377, 0.03820)),
        ("GeoNet_20110222_015029_MQZ.V2A", "E", (0.14011, 0.016576)),
        ("GeoNet_20110222_015029_MQZ.V2A", "N", (0.05863, 0.025745)),
    ],
)
def test_integrated_peaks_agree_with_the_file_s_own(name, component, peaks):
    """Units and step are right when integration gives the processing agency's velocity.

    Its displacement starts from an initial value of some millimetres that the
    acceleration does not hold, so it agrees less closely.
    """
    record = read_record(real_file(name), component=component)
    v, d = integrate(record.acceleration_m_s2, record.dt_s)
    assert np.abs(v).max() == pytest.approx(peaks[0], rel=0.01)
    assert np.abs(d).max() == pytest.approx(peaks[1], rel=0.08)


def test_every_format_has_a_sample_and_a_real_file():
    ours = {"columns", "wrapped", "packed"}
    assert {form for form, *_ in REAL.values()} == set(FORMATS) - ours
    found = {detect_name(sample) for sample in [*samples.all_samples(), samples.packed()]}
    assert found == set(FORMATS)


def detect_name(sample):
    return _detect(text_from_bytes(sample.name, sample.data)).name
