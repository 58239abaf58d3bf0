"""Readers: one motion as users' files hold it."""

import numpy as np
import pytest
import record_samples as samples
from record_samples import put, read, refusal
from rocking.records import RecordError, read_record


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
        "samples and step in the first line": (join("64 0.02", *g), {"units": "g"}),
        "Fortran's double precision": (
            join("dt = 0.02 s", "units: g", *(f"{float(v):.7E}".replace("E", "D") for v in g)),
            {},
        ),
        "UTF-16": (
            join("Time (s),Acc (g)", *map(",".join, pairs), encoding="utf-16"),
            {},
        ),
        "units in a row of their own": (join("t,a", "s,g", *map(",".join, pairs)), {}),
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


def test_a_step_in_the_place_of_a_sample_is_refused(tmp_path):
    path = tmp_path / "record.txt"
    path.write_text("\n".join(["0.02", *(f"{v:.6f}" for v in samples.motion())]) + "\n")
    with pytest.raises(RecordError, match="line 1.*the first number is 0.02, the stated step"):
        read_record(path, dt_s=0.02, units="m/s2")


def test_a_count_in_other_words_holds_where_at2_is_stated(tmp_path):
    """Of a file of another format that lost a line, read as PEER's because the user says so."""
    head = ["EVENT_NAME: A", "STATION_CODE: ABC", "SAMPLING_INTERVAL_S: 0.02", "NDATA: 64"]
    path = tmp_path / "a.txt"
    samples = [f"{18.0 * (-0.9) ** k:.6f}" for k in range(64)]
    how = {"format": "at2", "units": "cm/s2", "dt_s": 0.02}
    path.write_text("\n".join([*head, *samples]) + "\n")
    assert len(read_record(path, **how)) == 64
    path.write_text("\n".join([*head, *samples[:9], *samples[10:]]) + "\n")
    with pytest.raises(RecordError, match="63 samples, but the heading declares 64"):
        read_record(path, **how)


def test_a_caption_s_unit_counts_before_the_heading_s(tmp_path):
    """0.5 g beside a velocity, under a heading in cm/s²; a caption without a unit takes that."""
    path = tmp_path / "a.csv"
    rows = [f"{0.01 * k:.2f},{0.5 * (-0.9) ** k:.6f},{0.01 * (-0.9) ** k:.6f}" for k in range(60)]
    for captions, factor in (("Acc [g],Vel [m/s]", 9.80665), ("Acc,Vel [m/s]", 0.01)):
        text = ["Acceleration in cm/s2", f"Time [s],{captions}", *rows]
        path.write_text("\n".join(text) + "\n")
        record = read_record(path, component="1")
        assert np.abs(record.acceleration_m_s2).max() == pytest.approx(0.5 * factor)
        with pytest.raises(RecordError, match="a unit of velocity"):
            read_record(path, component="2")


def test_a_step_of_few_digits_is_no_rounding_of_another(tmp_path):
    """0.01 s as printed may stand for 0.0102, and not for 0.0055."""
    path = tmp_path / "a.txt"
    samples = [f"{0.5 * (-0.9) ** k:.6f}" for k in range(80)]
    path.write_text("\n".join(["Town hall, g", "dt = 0.01 s", *samples]) + "\n")
    with pytest.raises(RecordError, match="time step is 0.01 s, but dt_s 0.0055 is stated"):
        read_record(path, units="g", dt_s=0.0055)
    assert read_record(path, units="g", dt_s=0.0102).dt_s == pytest.approx(0.0102)
    timed = [f"{0.0055 * k:.4f}  {value}" for k, value in enumerate(samples)]
    path.write_text("\n".join(["Town hall, g", "dt = 0.01 s", *timed]) + "\n")
    with pytest.raises(RecordError, match="is 0.0055 s, but the heading states 0.01 s"):
        read_record(path, units="g")
