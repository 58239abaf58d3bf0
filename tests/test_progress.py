"""Progress and time left of long studies."""

import io
import time

import pytest
from rocking.runtime.progress import USUAL_RUNS, Progress, count_lines, spoken


def grow(path, lines):
    with open(path, "a") as handle:
        handle.write("row\n" * lines)


@pytest.fixture
def curves(tmp_path):
    return [(tmp_path / f"{n}.csv", tmp_path / f"{n}.jsonl", 10) for n in "abcd"]


def test_the_estimate_is_rate_times_rest(curves):
    now = [0.0]
    grow(curves[0][1], 10)  # of an earlier run of the study: no part of its speed
    progress = Progress(curves, clock=lambda: now[0])
    assert progress.line() == ""
    grow(curves[0][0], 11)
    grow(curves[1][1], 5)
    now[0] = 300.0  # five runs in 300 s, 25 to go
    assert progress.line() == (
        "progress: 1 of 4 curves, 5 runs since the start, about 25 to go, about 25 min left"
    )


def test_adaptive_curves_are_taken_as_long_as_finished_ones(curves):
    now = [0.0]
    progress = Progress([(t, j, None) for t, j, _ in curves], clock=lambda: now[0])
    grow(curves[0][1], 4)
    now[0] = 60.0
    assert f"about {4 * USUAL_RUNS - 4} to go" in progress.line()
    grow(curves[0][0], 5)  # header and 4 rows
    assert "about 12 to go" in progress.line()


def test_nothing_is_said_when_all_is_done(curves):
    progress = Progress(curves)
    for table, journal, runs in curves:
        grow(table, runs + 1)
        grow(journal, runs)
    assert progress.line() == ""


def test_the_thread_prints_what_changed(curves):
    progress, said = Progress(curves), io.StringIO()
    progress.watch(0.01, said)
    grow(curves[1][1], 3)
    end = time.monotonic() + 5.0
    while "3 runs" not in said.getvalue() and time.monotonic() < end:
        time.sleep(0.01)
    assert "progress: 0 of 4 curves, 3 runs since the start, about 37 to go" in said.getvalue()


def test_durations_and_missing_files(tmp_path):
    assert [spoken(s) for s in (5, 90, 6000, 90_000)] == [
        "less than a minute",
        "2 min",
        "100 min",
        "25 h 0 min",
    ]
    assert count_lines(tmp_path / "none") == 0
