"""Killed, doubled and starved runs: the same command completes with the same results.

A handful of the trials of tests/trials/faults/trials.py, and the parts they rest on.
"""

import errno
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from rocking.runtime import results_folder, run_lock

from tests.trials.faults import inject, trials
from tests.trials.faults.workspace import comparable, wait_until
from yade_scripts.commands.journal import Journal
from yade_scripts.engine import memory
from yade_scripts.files import write_atomic

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.xdist_group("undisturbed")
@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "number"),
    [("SIGKILL run", 0), ("SIGKILL one YADE", 4), ("two runs at once", 12)],
)
def test_the_same_command_completes_after_a_fault(undisturbed, fault, number):
    row = undisturbed.trial(fault, number, seed=1)
    assert row["outcome"] == trials.HELD, row["detail"]


def test_every_fault_is_tried_and_a_seed_gives_the_same_trial():
    assert set(trials.inject.available()) <= set(inject.FAULTS)
    one, two = (inject.generator(1, 5).random() for _ in range(2))
    assert one == two
    assert one != inject.generator(1, 6).random()


def test_wall_times_are_the_only_column_left_out_of_comparisons(tmp_path):
    for name, wall, d in (("a", "1.0", "0.5"), ("b", "2.0", "0.5"), ("c", "1.0", "0.6")):
        (tmp_path / f"{name}.csv").write_text(f"pga_g,d_over_b,wall_s\n0.1,{d},{wall}\n")
    a, b, c = (comparable(tmp_path / f"{name}.csv") for name in "abc")
    assert a == b
    assert a != c


HOLD = "import sys, time; sys.path[:0] = {path!r}; from rocking.runtime import run_lock;"
HOLD += "run_lock.hold(['main'], folder={folder!r}); print('held', flush=True); time.sleep(60)"


def test_a_second_run_is_refused_until_the_first_is_gone_however_it_ended(tmp_path):
    code = HOLD.format(path=[str(ROOT), str(ROOT / "workflow")], folder=str(tmp_path))
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as first:
        assert first.stdout.readline() == b"held\n"
        with pytest.raises(run_lock.Busy) as caught:
            run_lock.hold(["main"], folder=tmp_path)
        assert f"process {first.pid}" in str(caught.value)
        assert "\n" not in str(caught.value)
        first.send_signal(signal.SIGKILL)
    run_lock.hold(["main"], folder=tmp_path)  # nothing to unlock by hand
    run_lock._held.pop().close()


@pytest.fixture
def released():
    """Give back what a test held."""
    yield
    while run_lock._held:
        run_lock._held.pop().close()


def test_runs_of_other_names_go_side_by_side_and_read_the_same_motions(tmp_path, released):
    """A second open file stands for a second process: locks of flock belong to open files."""
    run_lock.hold(["a"], reads=["m"], folder=tmp_path)
    run_lock.hold(["b"], reads=["m"], folder=tmp_path)
    with pytest.raises(run_lock.Busy, match="under the name a "):
        run_lock.hold(["c", "a"], folder=tmp_path)
    run_lock.hold(["c"], folder=tmp_path)  # what was refused holds nothing
    with pytest.raises(run_lock.Busy, match=r"works on the motions .* results/\.shared/m "):
        run_lock.hold(["d"], reads=["m"], makes=["m"], folder=tmp_path)


def test_motions_are_read_by_others_once_they_are_made(tmp_path, released):
    made = threading.Event()
    locks = run_lock.hold(["a"], reads=["m"], makes=["m"], folder=tmp_path)
    run_lock.share(locks, made.is_set, look_s=0.01)
    with pytest.raises(run_lock.Busy, match=f"makes motions.*process {os.getpid()}"):
        run_lock.hold(["b"], reads=["m"], folder=tmp_path)
    made.set()

    def reads():
        try:
            return run_lock.hold(["b"], reads=["m"], folder=tmp_path) == []
        except run_lock.Busy:
            return False

    assert wait_until(reads, 20.0)


def test_a_file_system_without_locks_is_said_once_and_the_run_goes_on(
    tmp_path, monkeypatch, capsys, released
):
    def none(handle, how):
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr(run_lock.fcntl, "flock", none)
    assert run_lock.hold(["a", "b"], reads=["m"], folder=tmp_path) == []
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"warning: the file system of {tmp_path} has no locks")


JOB = "import sys, time; sys.path.insert(0, {root!r});"
JOB += "from yade_scripts.engine import parent_process;"
JOB += "assert parent_process.follow(); print('on', flush=True); time.sleep(60)"


def test_a_job_ends_when_its_run_is_killed():
    with subprocess.Popen(["sleep", "60"]) as run:
        job = subprocess.Popen(
            [sys.executable, "-c", JOB.format(root=str(ROOT))],
            stdout=subprocess.PIPE,
            env={**os.environ, "ROCKING_RUN_PID": str(run.pid)},
        )
        assert job.stdout.readline() == b"on\n"
        assert job.poll() is None
        run.kill()
        run.wait()
        assert job.wait(20) == 143
        job.stdout.close()


def test_a_job_whose_run_is_gone_already_does_not_start():
    with subprocess.Popen(["true"]) as run:
        run.wait()
    done = subprocess.run(
        [sys.executable, "-c", JOB.format(root=str(ROOT))],
        capture_output=True,
        env={**os.environ, "ROCKING_RUN_PID": str(run.pid)},
    )
    assert (done.returncode, done.stdout) == (143, b"")


@pytest.mark.parametrize("cut", [1, 5, 40, 41, 60])
def test_a_journal_cut_anywhere_keeps_its_whole_lines_and_goes_on(tmp_path, cut):
    path = tmp_path / "j.jsonl"
    journal = Journal(path)
    rows = {f"key{i}": {"status": "ok", "d_over_b": f"0.{i}"} for i in range(5)}
    for key, row in rows.items():
        journal.put(key, row, "at rest")
    os.truncate(path, path.stat().st_size - cut)
    again = Journal(path)
    assert again.rows.items() <= rows.items()
    assert len(again.rows) == (5 if cut == 1 else 4)  # a line without its end is whole
    for key, row in rows.items():
        if again.get(key) is None:
            again.put(key, row, "at rest")
    assert Journal(path).rows == rows
    assert [json.loads(line)["reason"] for line in path.read_text().splitlines()] == ["at rest"] * 5


def test_what_is_no_journal_in_its_place_is_one_line(tmp_path):
    path = tmp_path / "cache" / "j.jsonl"
    path.mkdir(parents=True)
    with pytest.raises(ValueError, match=r"j\.jsonl: expected a journal's file, not a folder"):
        Journal(path)
    path.rmdir()
    os.mkfifo(path)  # which nobody writes into: reading it would wait for ever
    with pytest.raises(ValueError, match=r"j\.jsonl: expected a journal's file"):
        Journal(path)
    path.unlink()
    path.parent.rmdir()
    path.parent.write_text("a file")
    with pytest.raises(ValueError, match=r"cache: expected a folder of journals") as caught:
        Journal(path)
    assert "\n" not in str(caught.value)


def test_stale_parts_of_killed_jobs_neither_matter_nor_pile_up(tmp_path):
    target = tmp_path / "table.csv"
    for pid in (11, 12):
        (tmp_path / f".table.csv.{pid}.part").write_text("half a ta")
    (tmp_path / ".other.csv.11.part").write_text("of another file")
    write_atomic(target, "whole\n")
    assert target.read_text() == "whole\n"
    assert sorted(p.name for p in tmp_path.iterdir()) == [".other.csv.11.part", "table.csv"]


def test_a_full_disk_is_reported_with_the_file_and_leaves_the_old_one(tmp_path, monkeypatch):
    target = tmp_path / "table.csv"
    write_atomic(target, "old\n")

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match=r"No space left on device.*table\.csv"):
        write_atomic(target, "new\n")
    assert target.read_text() == "old\n"
    assert [p.name for p in tmp_path.iterdir()] == ["table.csv"]
    with pytest.raises(OSError, match=r"No space left on device.*j\.jsonl"):
        Journal(tmp_path / "j.jsonl").put("key", {})


WRITES = """
import sys
sys.path[:0] = {path!r}
from pathlib import Path
from types import SimpleNamespace
from rocking.runtime.script import run
from rocking.tables import write_table
def main(job):
    write_table([{{"a": 1.0}}] * 9999, job.output[0])
snakemake = SimpleNamespace(output=["results/r/a.csv"], log="results/r/a.log")
run(main, globals())
"""


def test_a_script_without_room_for_its_log_either_says_so_in_one_line(tmp_path):
    (tmp_path / "results/r").mkdir(parents=True)
    done = subprocess.run(
        [sys.executable, "-c", WRITES.format(path=[str(ROOT), str(ROOT / "workflow")])],
        cwd=tmp_path,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20)),
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert line.startswith("error: ")
    assert "File too large: 'results/r/a.csv'" in line


def test_a_disk_without_room_is_said_before_anything_is_planned(tmp_path, monkeypatch):
    usage = shutil.disk_usage(tmp_path)
    assert results_folder.fault(tmp_path) == ""
    monkeypatch.setattr(shutil, "disk_usage", lambda path: usage._replace(free=147_000))
    said = results_folder.fault(tmp_path / "results")
    assert (
        said == f"the disk of {tmp_path} is full (147 kB left): make room, then repeat the command"
    )


def test_what_stands_where_a_result_belongs_is_said_before_any_job(tmp_path):
    path = tmp_path / "tables/a.csv"
    assert results_folder.misplaced([(path, False)]) == ""
    path.parent.write_text("a file")
    said = results_folder.misplaced([(path, False)])
    assert said == f"{path.parent} is no folder: {path} is to lie in it; move it away"
    path.parent.unlink()
    path.mkdir(parents=True)
    assert "a.csv is a folder: a result's file" in results_folder.misplaced([(path, False)])
    assert results_folder.misplaced([(path, True)]) == ""


def test_memory_is_bounded_by_starting_afresh():
    ceiling = memory.Ceiling(growth_mb=50.0)
    assert not ceiling.reached()
    ballast = b"x" * 80_000_000  # written to, so resident
    assert ceiling.reached()
    del ballast


def test_waiting_ends_when_the_condition_holds_or_time_is_up():
    began = time.monotonic()
    assert wait_until(lambda: time.monotonic() - began > 0.05, 5.0)
    assert not wait_until(lambda: False, 0.05)
