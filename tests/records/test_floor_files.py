"""Floor motions of other programs: read as printed, refused where no building has them."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from rocking import Motion
from rocking.records import RecordError, load, read_table
from rocking.records.floor_check import check_floors
from rocking.records.floors import floor_columns
from study_cases import study_case

from yade_scripts.model import floor_motions
from yade_scripts.model.storeys import chain_of, largest_drift, march

ROOT = Path(__file__).resolve().parents[2]
CHAIN = {
    **{"n_dof": 4, "period_s": 0.27, "damping_ratio": 0.05, "damping_model": "modal"},
    "tail_s": 2.0,
}
NAMES = ["ground", "floor1", "floor2", "floor3", "floor4"]
TOP_DOWN = ["ground", *NAMES[:0:-1]]


@pytest.fixture(scope="module")
def made():
    """Record, times and columns of a chain of four masses."""
    motion = Motion.named("RRS228")
    return motion, *floor_columns(motion.record, CHAIN)


def write(tmp_path, time_s, columns, digits=9):
    path = tmp_path / "floors.csv"
    floor_motions.write_columns(path, time_s, columns, digits=digits)
    return path


def changed(columns, **others):
    return {name: others.get(name, values) for name, values in columns.items()}


def quietly(path, **how):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return Motion.read_floors(path, **how)


def test_absolute_accelerations_come_back(tmp_path, made):
    motion, time_s, columns = made
    read = quietly(write(tmp_path, time_s, columns), record=motion)
    assert list(read.floors[1]) == NAMES
    for name in NAMES:
        np.testing.assert_allclose(read.floors[1][name], columns[name], rtol=1e-7, atol=1e-8)


def test_a_recorder_s_file_without_captions_from_one_step_on(tmp_path, made):
    """As OpenSees prints: time from the first step, blanks, no captions; the columns are stated."""
    motion, time_s, columns = made
    path = tmp_path / "absolute.out"
    np.savetxt(path, np.column_stack([time_s, *columns.values()])[1:], fmt="%.9g")
    with pytest.raises(RecordError, match="no captions ground, floor1"):
        Motion.read_floors(path, units="m/s2")
    with pytest.raises(RecordError, match="no units; state units"):
        Motion.read_floors(path, columns=NAMES)
    read = quietly(path, units="m/s2", columns=NAMES, record=motion)
    np.testing.assert_allclose(read.floors[1]["floor4"], columns["floor4"][1:], rtol=1e-7)
    assert read.name == "absolute"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda c: {n: a - c["ground"] * (n != "ground") for n, a in c.items()}, "relative to the"),
        (lambda c: changed(c, floor2=c["floor2"] + 0.01), "column floor2 drifts"),
        (lambda c: changed(c, floor3=0.0 * c["floor3"]), "floor3 is zero throughout"),
        (lambda c: changed(c, ground=0.0 * c["ground"]), "ground is zero throughout"),
        (lambda c: changed(c, floor1=4.0 * c["floor1"]), "floor1 has 4.* slow motion"),
        (lambda c: changed(c, floor1=-c["floor1"]), "floor1 moves against the ground"),
        (lambda c: {n: c[m] for n, m in zip(NAMES, TOP_DOWN, strict=True)}, "top down"),
        (lambda c: dict(zip(NAMES, [*c.values()][::-1], strict=True)), "from the roof down"),
        (lambda c: dict(zip(NAMES, np.roll([*c.values()], -1, 0), strict=True)), "state record"),
        (lambda c: {n: a for n, a in c.items() if n != "floor2"}, "floors 1, 3, 4; expected"),
    ],
)  # fmt: skip
def test_what_no_building_makes_of_its_ground_is_refused(tmp_path, made, change, words):
    _, time_s, columns = made
    with pytest.raises(RecordError, match=words) as caught:
        Motion.read_floors(write(tmp_path, time_s, change(columns)))
    assert "\n" not in str(caught.value)


BUILDINGS = {
    "stiff": {"n_dof": 2, "period_s": 0.12, "damping_ratio": 0.05, "damping_model": "modal"},
    "four": {"n_dof": 4, "period_s": 0.27, "damping_ratio": 0.05, "damping_model": "modal"},
    "tall": {"n_dof": 6, "period_s": 0.8, "damping_ratio": 0.05, "damping_model": "rayleigh"},
}


def said_of(time_s, columns):
    """What is refused of columns, or else what is doubted, one line each."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            check_floors("floors.csv", time_s, columns)
        except RecordError as error:
            return [f"refused: {error}"]
    return [str(one.message) for one in caught]


@pytest.mark.slow
@pytest.mark.parametrize("name", BUILDINGS)
def test_recorded_motions_pass_in_order_and_not_from_the_roof_down(name):
    """What stands on the ground takes energy from it; the roof would give it."""
    table = ROOT / "config/suites/recorded_suite.tsv"
    for row in list(read_table(table).values())[::4]:
        record = load(row.record, table)
        time_s, columns = floor_columns(record, BUILDINGS[name] | {"tail_s": 1.0})
        columns.pop("vertical", None)
        assert not any("refused" in line for line in said_of(time_s, columns)), row.record
        (said,) = said_of(time_s, dict(zip(columns, [*columns.values()][::-1], strict=True)))
        assert said.startswith("refused"), row.record
        assert "roof down" in said or "state record" in said, (row.record, said)


@pytest.mark.parametrize("law", ["bilinear", "origin_oriented"])
def test_a_yielding_building_takes_energy_too(law):
    """A storey that yielded stays displaced: that is no offset of the record."""
    motion = Motion.named("RRS228").record
    more = {"smdof.n_dof": 2, "smdof.base_shear_ratio": 0.1, "smdof.loops": law}
    chain = chain_of(study_case("W2", more), motion.dt_s)
    ground = 0.4 * motion.acceleration_m_s2
    ((first, second),), ends = march(chain, ground, [1.0])
    assert largest_drift(ends).max() > 3.0 * chain.storeys.yield_m.max()
    time_s = motion.dt_s * np.arange(ground.size)
    columns = {"ground": ground, "floor1": first, "floor2": second}
    assert not any("refused" in line for line in said_of(time_s, columns))
    turned = {"ground": second, "floor1": first, "floor2": ground}
    (said,) = said_of(time_s, turned)
    assert said.startswith("refused")


def test_samples_that_do_not_tell_the_ground_are_a_question(made, tmp_path):
    """Three samples a period of the building; with the record stated nothing is open."""
    motion, time_s, columns = made
    stiff = {"n_dof": 1, "period_s": 0.05, "damping_ratio": 0.05, "damping_model": "modal"}
    time_s, columns = floor_columns(motion.record, stiff | {"tail_s": 0.0})
    stride = round(0.02 / (time_s[1] - time_s[0]))
    few = {name: values[::stride] for name, values in columns.items()}
    path = write(tmp_path, time_s[::stride], few)
    with pytest.raises(RecordError, match="do not tell whether column ground is") as caught:
        Motion.read_floors(path)
    assert "state record" in str(caught.value)
    assert "\n" not in str(caught.value)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        Motion.read_floors(path, record=motion)


def test_two_floors_that_changed_places_are_named(made):
    _, time_s, columns = made
    swapped = changed(columns, floor3=columns["floor4"], floor4=columns["floor3"])
    assert any("are they in order" in line for line in said_of(time_s, swapped))


def test_an_offset_of_a_hundredth_is_refused_under_every_building(made):
    motion, *_ = made
    for chain in BUILDINGS.values():
        time_s, columns = floor_columns(motion.record, chain | {"tail_s": 1.0})
        top = list(columns)[-1]
        (said,) = said_of(time_s, changed(columns, **{top: columns[top] + 0.01}))
        assert said.startswith(f"refused: floors.csv: column {top} drifts")


def test_another_ground_other_units_and_no_file_are_one_line(tmp_path, made):
    _, time_s, columns = made
    path = write(tmp_path, time_s, columns)
    with pytest.raises(RecordError, match="differs from record 1ST280"):
        Motion.read_floors(path, record=Motion.named("1ST280"))
    with pytest.raises(RecordError, match="is in m/s2, but 'g' is stated"):
        Motion.read_floors(path, units="g")
    path.write_text(path.read_text().replace("floor2_m_s2", "floor2_g", 1))
    with pytest.raises(RecordError, match="columns in m/s2 and g; expected one"):
        Motion.read_floors(path)
    with pytest.raises(RecordError, match="does not exist"):
        Motion.read_floors(tmp_path / "none.csv")
    for floors in ((time_s, {"floor1": columns["ground"]}), columns):
        with pytest.raises(ValueError, match="expected .time_s, columns. with columns 'ground'"):
            Motion(floors=floors)


def test_two_decimals_are_named_with_their_drift(tmp_path, made):
    _, time_s, columns = made
    path = tmp_path / "floors.csv"
    rows = np.column_stack([time_s, *columns.values()])[:: round(0.01 / time_s[1])]
    head = ",".join(["time_s", *(f"{name}_m_s2" for name in NAMES)])
    np.savetxt(path, rows, fmt="%.2f", delimiter=",", header=head, comments="")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            Motion.read_floors(path)
            said = [str(one.message) for one in caught]
        except RecordError as error:
            said = [str(error)]
    assert any("drifts" in line or "in steps of 0.01" in line for line in said)


def test_floors_that_a_case_would_ignore_or_has_not_are_refused(tmp_path, made):
    _, time_s, columns = made
    motion = Motion.read_floors(write(tmp_path, time_s, columns))
    mass = {"return_wall.building_mass_kg": 66000.0}
    with pytest.raises(ValueError, match="W2m computes its floors itself"):
        motion.columns(study_case("W2m", mass))
    with pytest.raises(ValueError, match="4 floors, but smdof.n_dof = 3"):
        motion.columns(study_case("W2", {"smdof.n_dof": 3}))
    with pytest.warns(UserWarning, match="scale with the ground's peak"):
        motion.columns(study_case("W2"))
    own = Motion.of_workflow(write(tmp_path, time_s, columns), "RRS228")
    assert own.columns(study_case("W2m", mass))[1].keys() == columns.keys()
