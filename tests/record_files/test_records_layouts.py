"""What a block of plain numbers is: a motion in drawn layouts, and each rule by itself."""

import numpy as np
import pytest
from record_files.header import stated_channels, stated_counts, stated_steps, stated_unit
from record_samples import motion
from rocking.records import RecordError, read_record

from tests.trials.layouts import run

N, DT_S = 240, 0.01
A, B, C = (scale * motion(N, seed, DT_S) for seed, scale in ((3, 0.1), (4, 0.06), (5, 0.03)))
G = 9.80665


@pytest.mark.slow
def test_no_drawn_layout_is_read_as_another_motion():
    """Of another seed than those that the rules were made on; at most a tenth is refused."""
    tally = run(300, 2026)
    assert tally["wrong"] == 0
    assert tally["refused"] <= 30
    assert tally["right"] > 150


def put(tmp_path, *lines):
    path = tmp_path / "record.txt"
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")
    return path


def words(values, digits=5):
    return [f"{v:.{digits}f}" for v in values]


def read(path, expected, **stated):
    record = read_record(path, **stated)
    assert record.dt_s == pytest.approx(DT_S)
    np.testing.assert_allclose(record.acceleration_m_s2 / G, expected, atol=1e-5)
    return record


def test_channels_under_plain_titles_are_channels(tmp_path):
    """A title of two words and captions that are no unit: three channels, never one of 720."""
    rows = [" ".join(row) for row in zip(*map(words, (A, B, C)), strict=True)]
    for caption in ("North East Up", "roof first ground", "some title of many words in a line"):
        path = put(tmp_path, "Town hall. Accelerations in g, dt = 0.01 s", caption, *rows)
        with pytest.raises(RecordError, match="the first of 3 components"):
            read_record(path)
        for component, expected in (("#1", A), ("#3", C)):
            read(path, expected, component=component)


def test_channels_that_move_alike_are_a_question(tmp_path):
    rows = [" ".join(row) for row in zip(*map(words, (A, 1.02 * A, 1.05 * A)), strict=True)]
    with pytest.raises(RecordError, match="one record read line by line, or 3 channels"):
        read_record(put(tmp_path, *rows), units="g", dt_s=DT_S, component="1")
    path = put(tmp_path, "240 samples", *rows)
    read(path, 1.02 * A, units="g", dt_s=DT_S, component="#2")


def test_a_motion_of_the_period_of_a_line_is_no_table_of_channels(tmp_path):
    """Ten numbers a line of 10 Hz at 0.01 s: neighbours down the columns are the same."""
    a = 0.2 * np.sin(2 * np.pi * np.arange(N) / 10 + 0.3)
    rows = [" ".join(words(row)) for row in a.reshape(-1, 10)]
    stated = {"units": "g", "dt_s": DT_S, "component": "1"}
    with pytest.raises(RecordError, match="State the format, wrapped or columns"):
        read_record(put(tmp_path, *rows), **stated)
    read(put(tmp_path, *rows), a, **stated, format="wrapped")
    read(put(tmp_path, "NPTS= 240", *rows), a, **stated)


@pytest.mark.parametrize("first", ["240 0.0100", "0.01 240", "240\n0.01"])
@pytest.mark.parametrize("per_line", [1, 8])
def test_a_first_line_of_count_and_step_is_no_acceleration(tmp_path, first, per_line):
    flat = words(A)
    rows = [" ".join(flat[i : i + per_line]) for i in range(0, N, per_line)]
    read(put(tmp_path, "garden wall shake", first, *rows), A, units="g")
    with pytest.raises(RecordError, match="time step is 0.01 s, but dt_s 0.02"):
        read_record(put(tmp_path, first, *rows), units="g", dt_s=0.02)
    with pytest.raises(RecordError):
        read_record(put(tmp_path, first, *rows[:-3]), units="g")


def test_times_in_turn_with_accelerations_are_times(tmp_path):
    flat = [w for i, a in enumerate(words(A)) for w in (f"{i * DT_S:.2f}", a)]
    for per_line in (1, 2, 8):
        rows = [" ".join(flat[i : i + per_line]) for i in range(0, 2 * N, per_line)]
        for head in ([], ["240  0.01"]):
            read(put(tmp_path, *head, *rows), A, units="g")


def test_running_numbers_are_no_times(tmp_path):
    rows = [f"{i} {a}" for i, a in enumerate(words(A), 1)]
    read(put(tmp_path, *rows), A, units="g", dt_s=DT_S)
    with pytest.raises(RecordError, match="no time step"):
        read_record(put(tmp_path, *rows), units="g")


def test_blocks_one_after_another_are_channels_or_a_question(tmp_path):
    parts = [words(A), words(B)]
    path = put(tmp_path, "Component N", *parts[0], "Component E", *parts[1])
    read(path, B, units="g", dt_s=DT_S, component="#2")
    with pytest.raises(RecordError, match="one record, or as many channels"):
        read_record(put(tmp_path, *parts[0], "", *parts[1]), units="g", dt_s=DT_S)
    path = put(tmp_path, "240 points", *parts[0], *parts[1])
    read(path, A, units="g", dt_s=DT_S, component="#1")


@pytest.mark.parametrize(
    ("caption", "said"),
    [("Velocity [m/s]", "velocity"), ("vel", "velocity"), ("d (cm)", "displacement")],
)
def test_a_velocity_beside_is_refused_whatever_is_stated(tmp_path, caption, said):
    rows = [
        f"{i * DT_S:.2f},{a},{b}" for i, (a, b) in enumerate(zip(*map(words, (A, B)), strict=True))
    ]
    path = put(tmp_path, f"Time [s],Acceleration [g],{caption}", *rows)
    read(path, A, component="1")
    for units in (None, "g", "m/s2"):
        with pytest.raises(RecordError, match=said):
            read_record(path, component="2", units=units)


@pytest.mark.parametrize(
    ("heading", "unit"),
    [
        ("Units: counts", "counts"),
        ("units = m/s", "velocity"),
        ("Einheit: mV", "voltage"),
        ("unit: bananas", "bananas"),
        ("acc [g] x 1000", "factor"),
    ],
)
def test_a_stated_unit_that_is_no_acceleration_refuses(tmp_path, heading, unit):
    with pytest.raises(RecordError, match=unit):
        read_record(put(tmp_path, heading, *words(A)), dt_s=DT_S, units="g")


@pytest.mark.parametrize(
    ("heading", "factor"),
    [("Units: mg", 1e3), ("acceleration in percent of g", 1e2), ("UNITS ARE SEC AND G/10", 10.0)],
)
def test_parts_of_g_are_converted(tmp_path, heading, factor):
    read(put(tmp_path, heading, *words(factor * A)), A, dt_s=DT_S)


@pytest.mark.parametrize(
    ("line", "count", "step", "unit"),
    [
        ("TIMESERIES X, 240 samples, 100 sps, 2020-01-01, FLOAT, cm/s2", 240, 0.01, "cm/s2"),
        ("INTERVALO DE MUESTREO, C1-C6 (s) : /0.005/0.005/0.005", None, 0.005, None),
        ("NUM. TOTAL DE MUESTRAS, C1-C6 : /48600/48600/48600", 48600, None, None),
        ("UNIDADES DE LOS DATOS : Gal (cm/s/s)", None, None, "cm/s2"),
        ("fréquence d'échantillonnage = 200 Hz", None, 0.005, None),
        ("Anzahl Werte: 240, Zeitschritt 0,01 s, Einheit: m/s²", 240, 0.01, "m/s2"),
        ("Bandpass 0.1-25 Hz, instrument period 0.04 s, Vs30 = 360 m/s", None, None, None),
        ("5 values per line, peak 0.35 g at 2.3 s", None, None, None),
    ],
)  # fmt: skip
def test_what_headings_say_in_some_languages(line, count, step, unit):
    assert stated_counts([line]) == ([count] if count else [])
    assert [value for value, _ in stated_steps([line])] == pytest.approx([step] if step else [])
    assert stated_unit([line]).unit == unit


def test_a_stated_rate_that_contradicts_refuses(tmp_path):
    path = put(tmp_path, "x, 240 samples, 100 sps, FLOAT, g", *words(A))
    read(path, A)
    for dt_s in (0.02, 0.005):
        with pytest.raises(RecordError, match="time step is 0.01 s"):
            read_record(path, dt_s=dt_s)
    rows = [f"{i * DT_S:.2f} {a}" for i, a in enumerate(words(A))]
    with pytest.raises(RecordError, match="0.01 s, but the heading states 0.005 s"):
        read_record(put(tmp_path, "dt = 0.005 s, g", *rows), units="g")


@pytest.mark.parametrize(
    "line",
    [
        ["NPTS= 240 DT= .01 SEC"],
        ["DT= 1.00E-02 SEC, NPTS= 240"],
        ["240; 0.0100; NPTS; DT"],
        ["NPTS= 240", "DT= .0100 SEC"],
        ["NPTS=  240, DT= .0100 SEC  NSS"],
        ["NPTS, DT: 240 0.01"],
    ],
)
def test_headings_of_peer_in_their_variants(tmp_path, line):
    rows = [" ".join(f"{v:.7E}" for v in A[i : i + 5]) for i in range(0, N, 5)]
    head = ["A RECORD", "SOMEWHERE 03/04/05, BARN, BRN090", "ACCELERATION IN UNITS OF G", *line]
    record = read(put(tmp_path, *head, *rows), A, component="90")
    assert record.details["format"] == "at2"


def volume_1(blank=""):
    """An older print of volume 1: pairs of time and tenths of g, in seven characters."""
    zeros = [*[format(0, "5d") * 16] * 6, format(0, "5d") * 4]
    reals = [*[format(0.0, "10.3f") * 8] * 6, format(0.0, "10.3f") * 2]
    lines = []
    for name, a in (("EW", A), ("NS", B)):
        cells = [f"{i * DT_S:7.3f}{10 * v:7.3f}" for i, v in enumerate(a)]
        lines += [
            *(
                "UNCORRECTED ACCELEROGRAM DATA        PROCESSED: 01/02/2003",
                f"CHAN  1: {name}",
            ),
            *("NO. OF POINTS =    240  RECORD LENGTH =  2.400 SEC", "UNITS ARE SEC AND G/10."),
            *(*zeros, *reals),
            *(blank + "".join(cells[i : i + 5]) for i in range(0, N, 5)),
            "/&  ----------  END OF DATA FOR CHANNEL  ----------",
        ]
    return lines


@pytest.mark.parametrize("blank", ["", " "])
def test_older_prints_of_volume_1(tmp_path, blank):
    path = put(tmp_path, *volume_1(blank))
    for component, a in (("EW", A), ("NS", B)):
        record = read_record(path, component=component)
        assert (len(record), record.units_read) == (N, "g/10")
        assert record.dt_s == pytest.approx(DT_S)
        np.testing.assert_allclose(record.acceleration_m_s2 / G, a, atol=6e-5)


@pytest.mark.parametrize(("width", "per_line"), [(8, 10), (9, 8)])
def test_an_older_print_without_times(tmp_path, width, per_line):
    """Ten values of 8 characters a line, or eight of 9; its rate stands among the reals."""
    lines = volume_1()
    head, ends = lines[:4], [k for k, line in enumerate(lines) if line.startswith("/&")]
    integers, reals = lines[4:11], [format(100.0, "10.3f") + lines[11][10:], *lines[12:18]]
    cells = [format(10.0 * v + 0.0001 * (v == 0.0), f"{width}.4f") for v in A]
    rows = ["".join(cells[i : i + per_line]) for i in range(0, N, per_line)]
    path = put(tmp_path, *head, *integers, *reals, *rows, lines[ends[0]])
    record = read_record(path)
    assert (len(record), record.dt_s, record.units_read) == (N, 0.01, "g/10")
    np.testing.assert_allclose(record.acceleration_m_s2 / G, A, atol=2e-5)


@pytest.mark.parametrize(("lines", "read_as"), [(40, "csmip"), (41, None)])
def test_a_heading_of_volume_1_ends_within_forty_lines(tmp_path, lines, read_as):
    first, *rest = volume_1()
    path = put(tmp_path, first, *["A REMARK"] * (lines - 4), *rest)
    if read_as:
        np.testing.assert_allclose(
            read_record(path, component="EW").acceleration_m_s2 / G, A, atol=6e-5
        )
    else:
        with pytest.raises(RecordError, match="line 41: channel without 'POINTS OF ACCEL"):
            read_record(path, component="EW")


@pytest.mark.parametrize(
    ("line", "count"),
    [
        *(("Three components", 3), ("two channels", 2), ("four traces", 4), ("6 columns", 6)),
        *(("tre componenti", 3), ("due canali", 2), ("trois canaux", 3), ("drei Spalten", 3)),
        *(("tres componentes", 3), ("zwei Komponenten", 2), ("no more is said", 0)),
    ],
)
def test_how_many_channels_a_heading_states(line, count):
    assert stated_channels(["A record", line]) == count


def test_a_stated_format_is_tried_as_such_and_says_what_it_wanted(tmp_path):
    path = put(tmp_path, *words(A))
    for form in ("csmip", "smc", "knet", "two-column"):
        with pytest.raises(RecordError, match=f"read as {form}, as stated: "):
            read_record(path, format=form, units="g", dt_s=DT_S)


def test_quoted_cells_and_decimal_commas(tmp_path):
    rows = [f'"{i * DT_S:.2f}";"{a}"'.replace(".", ",") for i, a in enumerate(words(A))]
    read(put(tmp_path, '"t";"a"', *rows), A, units="g")
