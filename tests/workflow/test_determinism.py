"""Same inputs, same bytes: job counts, places, clocks and orders do not show in the results.

The column wall_s of the IDA tables is left out: it is a measurement of the run itself.
"""

import os

import matplotlib.image
import numpy as np
import pytest

from tests.trials.faults.workspace import FIGURES, RESULTS, Workspace, comparable


@pytest.fixture(scope="module")
def clones(undisturbed, tmp_path_factory):
    """The study in two fresh copies: in different places, two jobs at a time and one."""
    other = tmp_path_factory.mktemp("clones") / "a second place/two"
    two = Workspace(other).copy_of(undisturbed.kept["fresh"])
    process = two.start("--cores", "1", targets=FIGURES, extra={"TZ": "Asia/Tokyo"})
    assert process.wait() == 0, two.output()[-3000:]
    return undisturbed.kept["whole"], two


@pytest.mark.xdist_group("undisturbed")
@pytest.mark.yade
@pytest.mark.slow
def test_tables_and_records_are_the_same_bytes_in_two_clones_and_job_counts(clones):
    one, two = (space.digests() for space in clones)
    tables = [name for name in one if not name.endswith(".png")]
    assert len(tables) >= 8
    assert {name: one[name] for name in tables} == {
        name: digest for name, digest in two.items() if not name.endswith(".png")
    }


@pytest.mark.xdist_group("undisturbed")
@pytest.mark.yade
@pytest.mark.slow
def test_figures_are_the_same_pixels(clones):
    names = [name for name in clones[0].digests() if name.endswith(".png")]
    figures = ("fig09_ida", "floor_motions_BUCAR0", "record_BUCAR0")
    assert sorted(names) == [f"figures/{name}.png" for name in figures]
    for name in names:
        one, two = (matplotlib.image.imread(c.folder / RESULTS / name) for c in clones)
        assert np.array_equal(one, two), name


@pytest.mark.xdist_group("undisturbed")
@pytest.mark.yade
@pytest.mark.slow
def test_no_result_names_the_place_it_was_made_in(clones):
    for space in clones:
        for name in space.digests():
            assert os.fsencode(space.folder.parent) not in comparable(
                space.folder / RESULTS / name
            ), name


@pytest.mark.xdist_group("undisturbed")
@pytest.mark.yade
@pytest.mark.slow
def test_only_the_wall_time_differs_between_ida_tables(clones):
    path = f"{RESULTS}/ida/W1/BUCAR0_neg.csv"
    one, two = ((space.folder / path).read_text().splitlines() for space in clones)
    assert one[0] == two[0]
    wall = one[0].split(",").index("wall_s")
    for a, b in zip(one, two, strict=True):
        a, b = a.split(","), b.split(",")
        assert a[:wall] + a[wall + 1 :] == b[:wall] + b[wall + 1 :]
