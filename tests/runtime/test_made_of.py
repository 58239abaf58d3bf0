"""What a result was made of decides whether it counts, whatever the times of files say."""

import os
import re
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml
from forked import snakemake
from rocking.records.check import _digest
from rocking.runtime import made_of

from yade_scripts.commands.journal import Journal

STUDY = {
    "records_table": "motions.tsv",
    "models": ["W1"],
    "directions": ["neg"],
    "ida": {"mode": "adaptive", "level_ratio": 0.1, "confirm": "collapse"},
    "numerics": {"step_fraction": 0.4, "after_motion_s": 0.5},
    "ensemble": {"enabled": "off"},
}
TABLE = "record\tfile\tformat\tdt_s\tunits\nA\ta.txt\tcolumns\t\tg\n"


class Path_(str):
    """A path as Snakemake's."""

    is_ancient = False


def job(inputs, outputs, shell=None, rule="r"):
    """A job as far as notes look at it."""
    kind = SimpleNamespace(name=rule, shellcmd=shell)
    return SimpleNamespace(rule=kind, input=[*map(Path_, inputs)], output=[*map(Path_, outputs)])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A working folder with an input and a result."""
    monkeypatch.chdir(tmp_path)
    Path("results/r").mkdir(parents=True)
    Path("a.txt").write_text("1\n2\n")
    Path("results/r/b.csv").write_text("x\n1\n2\n")
    return tmp_path


def notes(params=("p",)):
    """Notes as a new process reads them, and what they say."""
    said: list[str] = []
    return made_of.MadeOf("results", "/base", lambda job: params, say=said.append), said


def test_what_is_no_file_of_notes_is_neither_waited_for_nor_written_into(folder):
    path = Path("results/r/made_of.jsonl")
    Path("mine.txt").write_text("work of years\n")
    for make in (lambda: os.mkfifo(path), lambda: path.symlink_to(folder / "mine.txt"), path.mkdir):
        make()
        made, said = notes()
        made.note(ONE)
        assert said == [f"warning: {path}: {made_of.NO_FILE}; what is finished now is made again"]
        path.rmdir() if path.is_dir() else path.unlink()
    assert Path("mine.txt").read_text() == "work of years\n"
    made, said = notes()
    made.note(ONE)
    assert (said, path.is_file()) == ([], True)


ONE = job(["a.txt"], ["results/r/b.csv"])


def changed(path, text):
    """Other text in the same file, which is dated as before."""
    at = os.stat(path)
    with open(path, "r+") as handle:
        handle.write(text)
        handle.truncate()
    os.utime(path, ns=(at.st_atime_ns, at.st_mtime_ns))


def test_a_result_without_a_note_does_not_count(folder):
    made, _ = notes()
    assert made.unfit(ONE) == ["results/r/b.csv"]
    made.note(ONE)
    assert notes()[0].unfit(ONE) == []


@pytest.mark.parametrize(
    "change",
    [
        lambda: changed("a.txt", "1\n3\n"),
        lambda: changed("results/r/b.csv", "x\n1\n"),  # cut at a line end
        lambda: changed("results/r/b.csv", "x\n1\n7\n"),
        lambda: changed("results/r/made_of.jsonl", Path("results/r/made_of.jsonl").read_text()[:9]),
    ],
)
def test_what_was_changed_in_place_is_made_again_though_dated_as_before(folder, change):
    notes()[0].note(ONE)
    assert notes()[0].unfit(ONE) == []
    change()
    assert notes()[0].unfit(ONE) == ["results/r/b.csv"]


def test_a_result_that_is_no_file_any_more_does_not_fit(folder):
    notes()[0].note(ONE)
    Path("results/r/b.csv").unlink()
    os.mkfifo("results/r/b.csv")
    assert notes()[0].unfit(ONE) == ["results/r/b.csv"]


def test_the_line_names_the_file_that_was_changed(folder):
    notes()[0].note(ONE)
    changed("results/r/b.csv", "x\n1\n7\n")
    made, said = notes()
    made.unfit(ONE)
    made.unfit(ONE)
    assert said == ["warning: results/r/b.csv was changed after it was made: it is made again"]


def test_other_settings_commands_and_inputs_do_not_fit(folder):
    notes()[0].note(ONE)
    assert notes(params=("q",))[0].unfit(ONE)
    assert notes()[0].unfit(job(["a.txt"], ["results/r/b.csv"], shell="cp"))
    Path("c.txt").write_text("1\n2\n")
    assert notes()[0].unfit(job(["c.txt"], ["results/r/b.csv"]))
    assert notes()[0].unfit(job(["a.txt", "c.txt"], ["results/r/b.csv"]))


def test_a_deleted_input_counts_as_it_was_and_a_deleted_result_is_no_change(folder):
    """Snakemake decides what of both is needed."""
    made, _ = notes()
    two = job(["results/r/b.csv"], ["results/r/c.csv"])
    Path("results/r/c.csv").write_text("y\n")
    made.note(ONE)
    made.note(two)
    Path("results/r/b.csv").unlink()
    assert notes()[0].unfit(two) == []
    assert notes()[0].unfit(ONE) == []


def test_an_input_that_was_changed_since_is_refused_before_a_job_reads_it(folder):
    made, _ = notes()
    made.note(ONE)
    two = job(["results/r/b.csv"], ["results/r/c.csv"])
    made.begin(two)
    changed("results/r/b.csv", "x\n9\n")
    with pytest.raises(made_of.Changed, match=r"^results/r/b\.csv was changed while"):
        made.begin(two)


def test_an_input_that_changes_while_a_job_reads_it_makes_the_result_unfit(folder):
    """Whether the job read it before or after, nobody knows."""
    made, _ = notes()
    made.begin(ONE)
    changed("a.txt", "1\n3\n")
    made.note(ONE)
    assert notes()[0].unfit(ONE) == ["results/r/b.csv"]


def test_a_torn_line_harms_no_other_and_notes_stay_few(folder):
    made, _ = notes()
    path = Path("results/r/made_of.jsonl")
    made.note(ONE)
    with open(path, "a") as handle:
        handle.write('["c.csv", "12')
    two = job(["a.txt"], ["results/r/c.csv"])
    Path("results/r/c.csv").write_text("y\n")
    again, _ = notes()
    again.note(two)
    assert notes()[0].unfit(ONE) == notes()[0].unfit(two) == []
    for _ in range(200):
        again.note(two)
    assert len(path.read_text().splitlines()) < 60
    assert notes()[0].unfit(ONE) == notes()[0].unfit(two) == []


def test_a_copy_counts_by_what_it_is_a_copy_of(folder):
    Path("results/r/a.txt").write_text("1\n2\n")
    one = job(["a.txt"], ["results/r/a.txt"], shell="cp")
    made = made_of.MadeOf("results", "/base", lambda job: (), copies=lambda job: True)
    assert made.unfit(one) == []
    changed("results/r/a.txt", "1\n3\n")
    assert made.unfit(one) == ["results/r/a.txt"]


def test_every_changed_byte_of_a_journal_costs_its_line_alone(tmp_path):
    path = tmp_path / "j.jsonl"
    rows = {f"key{i}": {"pga_g": 0.1 * i, "status": "ok", "d_over_b": None} for i in range(4)}
    journal = Journal(path)
    for key, row in rows.items():
        journal.put(key, row)
    whole = path.read_bytes()
    begins = [0, *(k + 1 for k, byte in enumerate(whole) if byte == 10)]
    for place in range(begins[1], begins[2] - 1):  # the second line, without its end
        data = bytearray(whole)
        data[place] ^= 1
        path.write_bytes(data)
        kept = Journal(path).rows
        assert kept.items() <= rows.items(), (place, bytes([data[place]]))
        assert set(rows) - set(kept) <= {"key1"}


def test_a_record_of_gigabytes_is_not_read_whole(tmp_path):
    """And what is no file, such as a pipe that nobody writes to, not at all."""
    vast, same = tmp_path / "vast.txt", tmp_path / "same.txt"
    for path, size in ((vast, 400 * 2**30), (same, 300 * 2**30)):
        with open(path, "wb") as handle:
            handle.truncate(size)
    assert _digest(vast) == _digest(same) != ""
    os.mkfifo(tmp_path / "pipe")
    assert _digest(tmp_path / "pipe") == ""


def planned(folder, *words):
    """Rules that a dry run would start, and what it printed."""
    done = snakemake(folder, "-n", "--quiet", "host", "--configfile", "study.yaml", *words)
    assert done.returncode == 0, done.stderr[-3000:]
    printed = done.stdout + done.stderr
    return set(re.findall(r"(?m)^(?:local)?rule (\w+):", printed)), printed


@pytest.fixture(scope="module")
def scanned(tmp_path_factory):
    """A folder in which one scan was made of a record in a file."""
    folder = tmp_path_factory.mktemp("scanned")
    rows = [f"{0.02 * k:.2f} {0.3 * (-1) ** (k // 20) * (k < 160):.6f}" for k in range(200)]
    (folder / "a.txt").write_text("\n".join(rows) + "\n")
    (folder / "motions.tsv").write_text(TABLE)
    (folder / "study.yaml").write_text(yaml.safe_dump(STUDY))
    done = snakemake(folder, "--configfile", "study.yaml", "--", *TARGETS)
    assert done.returncode == 0, done.stderr[-3000:]
    return folder


TARGETS = ("results/main/planar/W1/A_neg.csv", "results/main/tables/shared.csv")
MADE = {"record", "floor_motions", "planar_ida"}


@pytest.fixture
def again(scanned, tmp_path):
    """A copy of that folder, links and dates included, without Snakemake's own notes."""
    subprocess.run(["cp", "-a", f"{scanned}/.", str(tmp_path)], check=True)
    shutil.rmtree(tmp_path / ".snakemake")
    return tmp_path


@pytest.mark.slow
def test_results_alone_are_used_where_all_is_as_it_was(again):
    assert planned(again, "--", *TARGETS)[0] == set()


@pytest.mark.slow
def test_other_settings_without_snakemakes_notes(again):
    found, _ = planned(again, "--config", "facade={height_m: 5.0}", "--", *TARGETS)
    assert {"facade_case", "planar_ida"} <= found
    assert not found & {"record", "floor_motions"}


@pytest.mark.slow
def test_a_record_replaced_by_an_older_file(again):
    path = again / "a.txt"
    path.write_text(path.read_text().replace("0.300000", "0.400000"))
    os.utime(path, (1e9, 1e9))
    assert planned(again, "--", *TARGETS)[0] >= MADE


@pytest.mark.slow
def test_floor_motions_changed_in_place_under_a_run_s_own_name(again):
    """The name is a link to what other runs read: made again, and the run's own name with it."""
    (own,) = (again / "results/main/smdof").glob("*.csv")
    (kept,) = (again / "results/.shared").glob("*/*/smdof/*.csv")
    assert own.samefile(kept)
    whole = own.read_bytes()
    lines = own.read_text().splitlines(keepends=True)
    changed(own, "".join(lines[:-50]))
    found, printed = planned(again, "--", *TARGETS)
    assert {"floor_motions", "planar_ida"} <= found
    assert f"{kept.relative_to(again)} was changed after it was made" in printed
    done = snakemake(again, "--configfile", "study.yaml", "--", *TARGETS)
    assert done.returncode == 0, done.stderr[-3000:]
    assert kept.read_bytes() == whole
    assert own.read_bytes() == whole
