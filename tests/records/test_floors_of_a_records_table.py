"""Floors that a records table names: read with the record, written as one file, or refused."""

import numpy as np
import pytest
from rocking import Motion, collapse_curve
from rocking.configuration.schema import ConfigError
from rocking.records import RecordError, load, read_table
from rocking.records.check import check_records
from rocking.records.floor_table import files_of, floors_of
from rocking.runs.floors import refuse

from tests.cases import yielding_cases
from yade_scripts.model import floor_motions
from yade_scripts.model.yielding import TabulatedFloors

LEVELS_G = (0.08, 0.096, 0.115, 0.138)
HEAD = "record\tfile\tfloors\tfloors_building\n"


@pytest.fixture
def folder(tmp_path):
    """A record, its floors of a building that yields at some PGA, and tables that name them."""
    case, motion = yielding_cases.write_floors_by_pga(tmp_path, LEVELS_G)
    time_s, columns = motion.columns(case)
    floor_motions.write_columns(tmp_path / "given.csv", time_s, {"ground": columns["ground"]})
    (tmp_path / "records.tsv").write_text(f"{HEAD}mine\tgiven.csv\tby_pga.csv\t\n")
    return tmp_path


def row_of(folder, line):
    (folder / "records.tsv").write_text(HEAD + line + "\n")
    return read_table(folder / "records.tsv")["mine"]


def settings(folder, models=("W1", "W2"), ida=None, **smdof):
    """What a run says, as far as floors ask."""
    return {
        "records_table": str(folder / "records.tsv"),
        "models": list(models),
        "smdof": {"n_dof": 4, "base_shear_ratio": None, **smdof},
        "ida": {"mode": "adaptive", "max_pga_g": 0.1, "grid_g": [0.1], **(ida or {})},
    }


def test_floors_by_pga_are_one_file_of_the_workflow(folder):
    """W2 driven by what is written has the peaks of W2 driven by the table itself."""
    row = read_table(folder / "records.tsv")["mine"]
    time_s, floors = floors_of(row, load("mine", folder / "records.tsv"))
    path = folder / "mine_4dof.csv"
    floor_motions.write_tabulated(path, time_s, floors)
    found = Motion.of_workflow(path, "mine")
    assert isinstance(found.floors[1], TabulatedFloors)
    assert found.floors[1].sizes == pytest.approx(floors.sizes, rel=1e-9)
    case = yielding_cases.case("W2", None)
    how = {"search": "list", "settings": {"pga_g": [0.07, 0.09, 0.12, 0.138]}}
    table = Motion.read_floor_table(folder / "by_pga.csv")
    peaks = [collapse_curve(case, m, "neg", **how).table["d_over_b"] for m in (found, table)]
    assert peaks[0].to_numpy() == pytest.approx(peaks[1].to_numpy(), rel=1e-5)


def test_walls_that_no_floor_drives_need_the_ground_alone(folder):
    """W1 falls where it does under the record, also beyond the table."""
    table, record = Motion.read_floor_table(folder / "by_pga.csv"), Motion.named("RRS228")
    how = {"search": "list", "settings": {"pga_g": [0.1, 0.3]}}
    case = yielding_cases.case("W1", None)
    peaks = [collapse_curve(case, m, "neg", **how).table["d_over_b"] for m in (table, record)]
    assert peaks[0].to_numpy() == pytest.approx(peaks[1].to_numpy(), rel=1e-5)


def test_files_are_those_of_every_intensity(folder):
    row = read_table(folder / "records.tsv")["mine"]
    names = [file.rpartition("/")[2] for file in files_of(row)]
    assert names == ["by_pga.csv", *(f"at_{level:g}.csv" for level in LEVELS_G)]
    (one,) = check_records([row])
    assert one.status == "ok", one.message
    (folder / "at_0.096.csv").write_text("time_s,ground_m_s2\n0,0\n")
    (one,) = check_records([row])
    assert one.status == "fault"
    assert "at_0.096.csv" in one.message


def test_floors_of_one_intensity_are_scaled_only_where_that_is_stated(folder):
    row = row_of(folder, "mine\tgiven.csv\tat_0.08.csv\t")
    record = load("mine", folder / "records.tsv")
    with pytest.raises(RecordError, match="at_0.08.csv: floors of one intensity hold at that"):
        floors_of(row, record)
    row = row_of(folder, "mine\tgiven.csv\tat_0.08.csv\telastic")
    _, columns = floors_of(row, record)
    assert list(columns) == ["ground", "floor1", "floor2", "floor3", "floor4"]


def test_floors_of_another_motion_are_refused(folder):
    time_s, columns = floor_motions.read(folder / "given.csv")
    floor_motions.write_columns(folder / "given.csv", time_s, {"ground": columns["ground"][::-1]})
    row = row_of(folder, "mine\tgiven.csv\tby_pga.csv\t")
    (one,) = check_records([row])
    assert one.status == "fault"


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ("mine\tgiven.csv\tnone.csv\t", "line 2: record mine: no file 'none.csv'"),
        ("mine\t\tby_pga.csv\t", "floors without a file; expected in the column file the motion"),
        ("mine\tgiven.csv\tby_pga.csv\tstrong", "floors_building = 'strong'; expected elastic"),
        ("mine\tgiven.csv\t\telastic", "floors_building = 'elastic' without floors"),
    ],
)
def test_what_a_row_cannot_say_is_named(folder, line, named):
    with pytest.raises(RecordError, match=named):
        row_of(folder, line)


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"models": ["W2", "W2m"]}, "line 2: record mine has floors: models = W2m: expected"),
        ({"base_shear_ratio": 0.2}, "smdof.base_shear_ratio = 0.2: expected null"),
        ({"n_dof": 3}, "smdof.n_dof = 3: expected 4, as many as there are floors"),
        ({"ida": {"max_pga_g": 3.0}}, r"ida.max_pga_g = 3: expected at most 0.1062 \(g\)"),
        ({"ida": {"mode": "grid", "grid_g": [0.1, 0.2]}}, "ida.grid_g = 0.2: expected at most"),
    ],
)
def test_what_a_run_cannot_have_of_them_is_named(folder, given, named):
    row = read_table(folder / "records.tsv")["mine"]
    refuse(settings(folder), row)
    refuse(settings(folder, models=["W1"], ida={"max_pga_g": 3.0}), row)
    with pytest.raises(ConfigError, match=named):
        refuse(settings(folder, **given), row)


def test_a_file_of_several_intensities_that_is_damaged_is_named(folder):
    path = folder / "damaged.csv"
    np.savetxt(
        path,
        np.arange(12.0).reshape(3, 4),
        delimiter=",",
        header="time_s,ground_m_s2,floor1_m_s2,floor2_m_s2@1.2",
        comments="",
    )
    with pytest.raises(ValueError, match="damaged.csv: floors at several intensities"):
        floor_motions.read(path)
