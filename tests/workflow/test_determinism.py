"""Same inputs, same bytes: job counts, places, clocks and orders do not show in the results.

The column wall_s of the IDA tables is left out: it is a measurement of the run itself.
"""

import os

import matplotlib.image
import numpy as np
import pytest

from tests.trials.faults.workspace import RESULTS, Workspace, comparable

TARGETS = (
    "tables/ida_collapse.csv",
    "tables/records.csv",
    "tables/shared.csv",
    "figures/fig09_ida.png",
    "figures/record_BUCAR0.png",
)


@pytest.fixture(scope="module")
def clones(tmp_path_factory):
    """The study in two fresh copies, in different places, one job at a time and two."""
    made, source = [], Workspace(tmp_path_factory.mktemp("source")).fill()
    for name, cores, zone in (("one", "1", "UTC"), ("a second place/two", "2", "Asia/Tokyo")):
        space = Workspace(tmp_path_factory.mktemp("clones") / name).copy_of(source)
        process = space.start("--cores", cores, targets=TARGETS, extra={"TZ": zone})
        assert process.wait() == 0, space.output()[-3000:]
        made.append(space)
    return made


@pytest.mark.xdist_group("clones")
@pytest.mark.yade
@pytest.mark.slow
def test_tables_and_records_are_the_same_bytes_in_two_clones_and_job_counts(clones):
    one, two = (space.digests() for space in clones)
    tables = [name for name in one if not name.endswith(".png")]
    assert len(tables) >= 8
    assert {name: one[name] for name in tables} == {
        name: digest for name, digest in two.items() if not name.endswith(".png")
    }


@pytest.mark.xdist_group("clones")
@pytest.mark.yade
@pytest.mark.slow
def test_figures_are_the_same_pixels(clones):
    names = [name for name in clones[0].digests() if name.endswith(".png")]
    figures = ("fig09_ida", "floor_motions_BUCAR0", "record_BUCAR0")
    assert sorted(names) == [f"figures/{name}.png" for name in figures]
    for name in names:
        one, two = (matplotlib.image.imread(c.folder / RESULTS / name) for c in clones)
        assert np.array_equal(one, two), name


@pytest.mark.xdist_group("clones")
@pytest.mark.yade
@pytest.mark.slow
def test_no_result_names_the_place_it_was_made_in(clones):
    for space in clones:
        for name in space.digests():
            assert os.fsencode(space.folder) not in comparable(space.folder / RESULTS / name), name


@pytest.mark.xdist_group("clones")
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
