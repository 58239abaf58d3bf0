"""Floor motions by PGA: read, checked, mixed between intensities, refused beyond them."""

import os

import numpy as np
import pytest
from rocking import Motion, collapse_curve
from rocking.records import RecordError

from tests.cases import yielding_cases
from yade_scripts.model import floor_motions
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

LEVELS_G = (0.08, 0.096, 0.115, 0.138)


@pytest.fixture
def tabled(tmp_path):
    """A table of what a building that yields does at some PGA, and its motion and case."""
    case, motion = yielding_cases.write_floors_by_pga(tmp_path, LEVELS_G)
    return tmp_path / "by_pga.csv", case, motion


def test_a_table_of_a_yielding_building_is_that_building(tabled):
    """At its intensities W2 has the d/b of the building that yields; between two within 3 %."""
    path, case, motion = tabled
    elastic = case.varied({"smdof.base_shear_ratio": None})
    found = Motion.read_floor_table(path)
    levels = [*LEVELS_G, 0.105]
    how = {"search": "list", "settings": {"pga_g": levels}}
    exact = collapse_curve(case, motion, "neg", **how).table["d_over_b"].to_numpy()
    table = collapse_curve(elastic, found, "neg", **how).table["d_over_b"].to_numpy()
    order = np.argsort(levels)
    between = np.flatnonzero(order == len(LEVELS_G))
    at = np.setdiff1d(np.arange(len(levels)), between)
    assert table[at] == pytest.approx(exact[at], rel=2e-3)
    assert table[between] == pytest.approx(exact[between], rel=0.03)
    scaled = Motion(floors=(found.floors[0], dict(found.floors[1])), label="scaled")
    with pytest.warns(UserWarning, match="scale with the ground"):
        other = collapse_curve(elastic, scaled, "neg", **how).table["d_over_b"].to_numpy()
    assert np.abs(other[at] / exact[at] - 1.0).max() > 0.01


def test_the_highest_intensity_is_known_to_the_last_digit(tabled):
    """A factor that rounding puts a billionth above it gives the highest row."""
    floors = Motion.read_floor_table(tabled[0]).floors[1]
    last = floors.sizes[-1]
    exact, above = floors.at_all([last, -last * (1.0 + 5e-10)])
    highest = floors.levels[-1]["floor1"]
    assert exact["floor1"] == pytest.approx(highest, rel=1e-9, abs=1e-12)
    assert above["floor1"] == pytest.approx(-highest, rel=1e-5, abs=1e-7)


def test_beyond_the_table_nothing_is_known(tabled):
    path, case, _ = tabled
    elastic, found = case.varied({"smdof.base_shear_ratio": None}), Motion.read_floor_table(path)
    with pytest.raises(ValueError, match="ida.max_pga_g = .*expected at most 0.1062"):
        collapse_curve(elastic, found, "pos")
    with pytest.raises(ValueError, match="PGA of 0.2 g: expected at most 0.138 g"):
        collapse_curve(elastic, found, "pos", search="list", settings={"pga_g": [0.2]})
    with pytest.raises(ValueError, match="smdof.base_shear_ratio = 0.1: expected null"):
        collapse_curve(case, found, "pos")
    with pytest.raises(ValueError, match="computes its floors itself and"):
        collapse_curve(yielding_cases.case("W2m", None), found, "pos")


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("pga_g,file\n0.08,at_0.08.csv\n0.115,at_0.115.csv\n", "at most a factor of 1.25 apart"),
        ("pga_g,file\n0.096,at_0.096.csv\n0.08,at_0.08.csv\n", "expected more than 0.096, the row"),
        ("pga_g,file\n0.09,at_0.08.csv\n", "row 1: pga_g = 0.09, but the ground of at_0.08.csv"),
        ("pga_g,file\nweak,at_0.08.csv\n", "row 1: pga_g = 'weak': expected a number"),
        ("g,file\n0.08,at_0.08.csv\n", "expected columns pga_g, file"),
        ("", "the file is empty"),
        ("pga_g,file\n", "expected columns pga_g, file and a row an intensity"),
        ("pga_g,file\n0,at_0.08.csv\n", "pga_g = '0': expected a number > 0"),
        ("pga_g,file\nnan,at_0.08.csv\n", "pga_g = 'nan': expected a number > 0"),
        ("pga_g,file\n0.08,\n", "line 2: 2 cells; expected pga_g, file"),
        ("pga_g,file\n0.08,a,b\n", "line 2: 3 cells; expected pga_g, file"),
        ('pga_g,file\n0.08,"at_0.08.csv\n', "line 2: a quotation mark"),
        (f"pga_g,file\n0.08,{'a' * 200_000}\n", "by_pga.csv"),
        ("pga_g,file\n" + "0.08,at_0.08.csv\n" * 2000, "2000 rows; expected at most 999"),
    ],
)
def test_what_a_table_cannot_be_is_named(tabled, text, named):
    path, *_ = tabled
    path.write_text(text)
    with pytest.raises(RecordError, match=named) as caught:
        Motion.read_floor_table(path)
    assert str(caught.value).isprintable()


def test_a_table_may_have_semicolons_a_mark_of_its_encoding_and_more_columns(tabled):
    path, *_ = tabled
    levels = Motion.read_floor_table(path).floors[1].sizes
    text = path.read_text().replace("pga_g,file", "\ufeffpga_g;file;remark")
    path.write_text("\n".join(line.replace(",", ";") for line in text.splitlines()), "utf-8")
    assert Motion.read_floor_table(path).floors[1].sizes.tolist() == levels.tolist()


def test_what_is_no_file_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    for path in (tmp_path / "pipe.csv", "/dev/zero", tmp_path):
        with pytest.raises(RecordError, match="not a regular file"):
            Motion.read_floor_table(path)


def test_another_ground_motion_is_refused(tabled):
    path, _, _ = tabled
    second = path.with_name("at_0.096.csv")
    time_s, columns = floor_motions.read(second)
    peak = np.abs(columns["ground"]).max()
    columns = {name: np.roll(values, 40) for name, values in columns.items()}
    assert peak == pytest.approx(0.096 * STANDARD_GRAVITY_M_S2, rel=1e-6)
    floor_motions.write_columns(second, time_s, columns)
    with pytest.raises(RecordError, match="not that of the lowest intensity"):
        Motion.read_floor_table(path)
