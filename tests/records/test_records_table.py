"""The records table: good rows, and every bad one by its line."""

import os
from pathlib import Path

import numpy as np
import pytest
import record_samples as samples
from rocking.records import RecordError, load, read_table

PAPER = Path(__file__).parents[2] / "config" / "records.tsv"
TARGETS = "pga_g\tpgv_cm_s\tpgd_cm\tduration_s"


@pytest.fixture
def table(tmp_path):
    def write(*lines):
        path = tmp_path / "records.tsv"
        path.write_text("\n".join(lines) + "\n")
        return str(path)

    return write


def refusal(path):
    with pytest.raises(RecordError) as caught:
        read_table(path)
    assert path in str(caught.value)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_the_study_s_four_motions():
    rows = read_table(PAPER)
    assert list(rows) == ["BUCAR0", "RRS228", "1ST280", "HVSC1"]
    assert rows["HVSC1"].targets == {
        "pga_g": 1.58,
        "pgv_cm_s": 106.6,
        "pgd_cm": 21.77,
        "duration_s": 29.0,
    }
    assert rows["BUCAR0"].about["mw"] == 7.5
    assert rows["BUCAR0"].station == "Building Research Institute"
    assert {row.source for row in rows.values()} == {"surrogate"}


def test_a_user_s_table_needs_few_columns(table, tmp_path):
    sample = samples.geonet()
    (tmp_path / sample.name).write_bytes(sample.data)
    path = table(
        "record\tfile\tcomponent",
        "# a comment",
        f"mine\t{sample.name}\tS64E",
        "",
        f"absolute\t{tmp_path / sample.name}\t#2",
    )
    stations = {name: row.station for name, row in read_table(path).items()}
    assert stations == {"mine": "mine", "absolute": "absolute"}  # a record without one is its own
    mine = load("mine", path)
    np.testing.assert_allclose(mine.acceleration_m_s2, sample.acceleration_m_s2, atol=6e-5)
    assert mine.name == "mine"
    np.testing.assert_array_equal(load("absolute", path).acceleration_m_s2, mine.acceleration_m_s2)


def test_format_units_and_step_of_the_table_are_used(table, tmp_path):
    sample = samples.single_column()
    (tmp_path / sample.name).write_bytes(sample.data)
    head = "record\tfile\tformat\tdt_s\tunits"
    record = load("a", table(head, f"a\t{sample.name}\tsingle-column\t0.02\tm/s2"))
    assert (record.dt_s, record.units_read) == (0.02, "m/s2")
    doubled = load("a", table(head, f"a\t{sample.name}\t\t0.01\tg"))
    np.testing.assert_allclose(doubled.acceleration_m_s2, 9.80665 * record.acceleration_m_s2)


@pytest.mark.parametrize("name", ["BUCAR0", "1ST280", "a.b_c+d-e", "x" * 64, "_a", "+1"])
def test_plain_names_are_taken(table, name):
    assert name in read_table(table(f"record\t{TARGETS}", f"{name}\t0.2\t20\t5\t10"))


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (["record\tfiel", "a\tb"], "line 1: unknown column 'fiel'; did you mean 'file'?"),
        (["record\tpga", "a\t1"], "did you mean 'pga_g'?"),
        (["record file", "a b"], "not tab-separated"),
        (["record|file", "a|b"], "unknown column 'record|file'"),
        (["record,file", "a,b"], "line 2: record a: no file 'b'"),
        (["record,event", 'a,"b'], "line 2: a quotation mark"),
        (["record,file", "a,b,c"], "line 2: 3 cells; expected 2 separated by commas"),
        (["record\tdt_s", "a\t0,01"], "found '0,01'; write a decimal point, not a comma"),
        (["file", "a"], "no column 'record'"),
        (["record\trecord", "a\ta"], "appears twice"),
        (["record"], "no record below"),
        (["# nothing"], "no header"),
        (["record\tfile", "a\tno.AT2"], "line 2: record a: no file 'no.AT2'"),
        (["record\tfile", "a\t"], "a surrogate needs a value of pga_g, pgv_cm_s"),
        ([f"record\t{TARGETS}", "a\t1\t2\t3\t"], "a surrogate needs a value of duration_s"),
        ([f"record\t{TARGETS}", "a\t1\t2\t3\tx"], "line 2: expected a number in duration_s"),
        ([f"record\t{TARGETS}", "a\t1\t2\t3\tnan"], "expected a number in duration_s"),
        ([f"record\t{TARGETS}", "a\t-1\t2\t3\t4"], "expected it positive"),
        ([f"record\t{TARGETS}", "a\t1\t2\t3\t4", "A\t1\t2\t3\t4"], "line 3: record 'A' is already"),
        ([f"record\t{TARGETS}", "a\t1\t2\t3\t4\t5"], "6 cells"),
        ([f"record\t{TARGETS}", "a 1 2 3 4"], "separated by tabs"),
        ([f"record\tformat\t{TARGETS}", "a\tat3\t1\t2\t3\t4"], "did you mean 'at2'?"),
        ([f"record\tunits\t{TARGETS}", "a\tfurlong\t1\t2\t3\t4"], "unknown units 'furlong'"),
        ([f"record\tdt_s\t{TARGETS}", "a\t5\t1\t2\t3\t4"], "dt_s is 5"),
    ],
)
def test_bad_tables_are_refused(table, lines, expected):
    assert expected in refusal(table(*lines))


@pytest.mark.parametrize("asked", ["RRS282", "rrs228"])
def test_an_unknown_record_is_answered_with_the_nearest(table, asked):
    path = table(f"record\t{TARGETS}", "RRS228\t0.2\t20\t5\t10")
    with pytest.raises(RecordError, match="did you mean 'RRS228'"):
        load(asked, path)


@pytest.mark.parametrize(
    ("separator", "number", "end"), [("\t", "0.01", ""), (",", "0.01", ",,"), (";", "0,01", ";")]
)
def test_a_table_as_a_spreadsheet_saves_it_is_the_same_table(table, separator, number, end):
    """Commas or semicolons, cells in quotation marks, rows padded; decimal commas beside ;."""
    names = ["record", "event", "station", "dt_s", *TARGETS.split("\t")]
    event = '"Somewhere, 1990"' if separator == "," else "Somewhere, 1990"
    row = ["mine", event, "ABC", number, "0.3", "20", "5", "12"]
    path = table(*(separator.join(cells) + end for cells in (names, row)), separator * 7)
    (found,) = read_table(path).values()
    assert found.about == {"event": "Somewhere, 1990", "station": "ABC"}
    assert (found.dt_s, found.targets["pga_g"], found.line) == (0.01, 0.3, 2)


def test_what_is_there_and_no_file_is_told_from_what_is_not(tmp_path):
    path = tmp_path / "records.csv"
    path.write_text("record,file\na,pipe\n")
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(RecordError, match="record a: no regular file 'pipe'"):
        read_table(path)
