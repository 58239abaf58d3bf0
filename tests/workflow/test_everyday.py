"""What everyday use meets first: faulty records, mistyped commands, runs side by side."""

import csv
import math
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from forked import PATHS
from forked import snakemake as started
from rocking.records import read_table
from rocking.records.check import check_records
from rocking.runtime import results_folder

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]
SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))
LIMIT_S = 120.0


COMMAND = [SNAKEMAKE, "--snakefile", str(ROOT / "Snakefile"), "--cores", "1"]


def snakemake(folder, *words):
    """Run Snakemake in a folder with the Snakefile at the top."""
    return started(folder, *words, snakefile="Snakefile")


def lines(done, word):
    """Lines of standard error that begin with a word."""
    return [line for line in done.stderr.splitlines() if line.startswith(word)]


def read(path):
    with open(path, newline="") as handle:
        return list(csv.DictReader(handle))


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    """Five records: sound, off its zero line, m/s² called g, not a number, without units."""
    folder = tmp_path_factory.mktemp("records")
    pulse = [
        math.exp(-((t / 100 - 4) ** 2) / 2) * math.sin(2 * math.pi * 1.2 * (t / 100 - 4))
        for t in range(1000)
    ]
    for name, offset, factor in (("good", 0, 0.3), ("off", 0.02, 0.3), ("ms2", 0, 3.3)):
        text = "\n".join(f"{offset + factor * value:.6f}" for value in pulse)
        (folder / f"{name}.txt").write_text(text)
    (folder / "nan.txt").write_text("0.1\nnan\n0.2\n")
    rows = [f"{name.upper()}\t{name}.txt\t0.01\tg" for name in ("good", "off", "ms2", "nan")]
    table = ["record\tfile\tdt_s\tunits", *rows, "NOUNITS\tgood.txt\t0.01\t"]
    (folder / "mine.tsv").write_text("\n".join(table) + "\n")
    return folder


MINE = ["--config", "run=mine", "records_table=mine.tsv"]


def test_a_faulty_record_stops_a_dry_run_in_one_line(records):
    done = snakemake(records, "-n", *MINE)
    assert done.returncode == 1
    (line,) = lines(done, "error:")
    assert "nan.txt, line 2" in line
    assert "1 more: see the target check" in line
    assert "Traceback" not in done.stderr
    assert not (records / "results").exists()


def test_doubts_are_printed_once_and_stop_nothing(records):
    done = snakemake(records, "-n", *MINE, "records=GOOD,OFF,MS2")
    assert done.returncode == 0, done.stderr[-2000:]
    assert [line.split(":")[1] for line in lines(done, "warning:")] == [
        " record OFF",
        " record MS2",
    ]
    assert "mean offset 6.4 % of the peak, by which the displacement drifts" in done.stderr
    assert "m/s² called g?" in done.stderr


def test_check_reports_on_all_records_at_once(records):
    done = snakemake(records, *MINE, "--", "check")
    assert done.returncode == 0, done.stderr[-2000:]
    found = {
        row["record"]: row["status"]
        for row in read(records / "results/mine/tables/records_check.csv")
    }
    assert found == {
        "GOOD": "ok",
        "OFF": "warning",
        "MS2": "warning",
        "NAN": "fault",
        "NOUNITS": "fault",
    }
    assert len(lines(done, "fault:")) == 2
    assert len(lines(done, "warning:")) == 2


def test_the_record_of_the_tutorial_is_no_doubtful_one(tmp_path):
    text = (ROOT / "docs/tutorial.md").read_text("utf-8")
    code = text.split('.venv/bin/python -c "')[1].split('"')[0]
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    (tmp_path / "my_record.txt").write_text(done.stdout)
    (tmp_path / "t.tsv").write_text("record\tfile\tdt_s\tunits\nMINE\tmy_record.txt\t0.01\tg\n")
    (finding,) = check_records(read_table(tmp_path / "t.tsv").values())
    assert finding.status == "ok", finding


@pytest.mark.parametrize(
    ("target", "told"),
    [
        ("boundry", "did you mean boundary?"),
        ("zzz", "targets: accuracy, all, "),
        ("results/main/ida/W1/NOPE_neg.csv", "is it a file of this run"),
    ],
)
def test_a_misspelt_target_is_told_the_nearest(tmp_path, target, told):
    done = snakemake(tmp_path, "-n", "--", target)
    assert done.returncode == 1
    said = [line for line in (done.stdout + done.stderr).splitlines() if target in line]
    assert any(told in line for line in said), said
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("name", ["results", "results/none", "results/.shared", ".snakemake"])
def test_a_file_where_a_folder_belongs_is_one_line(tmp_path, name):
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("")
    done = snakemake(tmp_path, "-n", "--config", "run=none", "models=W1", "--", "check")
    assert (done.returncode, len(lines(done, "error:"))) == (1, 1)
    assert f"{name} is no folder" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("lay", "told"),
    [
        (lambda path: path.write_text("run: [\n"), "line 2"),
        (lambda path: path.write_text("# run: mine\n"), "expected keys at the top level"),
        (lambda path: path.mkdir(), "Is a directory"),
        (lambda path: path.symlink_to(path.name), "Too many levels of symbolic links"),
        (lambda path: path.symlink_to("gone.yaml"), "No such file"),
    ],
)
def test_the_folder_s_own_configuration_is_named_where_it_is_none(tmp_path, lay, told):
    (tmp_path / "config").mkdir()
    lay(tmp_path / "config" / "config.yaml")
    done = snakemake(tmp_path, "-n", "--", "check")
    assert done.returncode == 1
    (said,) = lines(done, "error:")
    assert said.startswith("error: config: config/config.yaml")
    assert told in said
    assert "Traceback" not in done.stderr


READ_ONLY = """mount -t tmpfs -o ro none {folder} && {python} -c "
from rocking.runtime import results_folder as r
print(r.fault('{folder}/results'))" """


@pytest.mark.parametrize("words", [("0",), ("0", "-n"), ("-1", "-n")])
def test_no_core_is_one_line(tmp_path, words):
    """Snakemake would wait for ever for a core."""
    done = snakemake(tmp_path, "--cores", *words, "--config", "run=none")
    assert done.returncode == 1
    assert lines(done, "error") == [f"error: --cores {words[0]}: expected 1 or more"]


def test_no_folder_of_table_motions_is_one_line(tmp_path):
    given = "validation={motions_folder: nowhere}"
    done = snakemake(tmp_path, "-n", "--config", "run=none", given, "--", "validation")
    assert done.returncode == 1
    (said,) = lines(done, "error")
    assert said.startswith("error: validation.motions_folder = nowhere: expected a folder")


def test_no_right_to_write_is_one_line(tmp_path):
    """A file system mounted read-only binds root too."""
    assert results_folder.fault(tmp_path / "not" / "yet") == ""
    script = READ_ONLY.format(folder=tmp_path, python=sys.executable)
    done = subprocess.run(
        ["unshare", "--mount", "--map-root-user", "sh", "-c", script],
        env={**os.environ, "PYTHONPATH": PATHS},
        capture_output=True,
        text=True,
        timeout=60,
    )
    if "Operation not permitted" in done.stderr or "permission denied" in done.stderr.lower():
        pytest.skip("no right to mount here")
    assert done.stdout == (
        f"no right to write in {tmp_path}: give this run a folder of yours with --directory\n"
    )


def test_the_wrong_python_is_named_in_one_line(tmp_path):
    """Snakemake from elsewhere, without this project's package."""
    (tmp_path / "sitecustomize.py").write_text("import sys\nsys.modules['rocking'] = None\n")
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", *COMMAND[1:], "-n"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
    )
    assert done.returncode == 1
    (line,) = lines(done, "error:")
    assert "use this project's .venv/bin/snakemake" in line
    assert "Traceback" not in done.stderr


def test_targets_in_commands_of_the_pages_stand_behind_two_dashes():
    """What follows --config or --configfile would be taken for their value."""
    pages = ["README.md", "CONTRIBUTING.md", "config/README.md", *ROOT.glob("docs/**/*.md")]
    pages += [*ROOT.glob("config/scenarios/*.yaml"), *ROOT.glob("workflow/rules/*.smk")]
    pages += [
        p for kind in ("md", "smk", "yaml") for p in ROOT.glob(f"workflow/studies/*/*.{kind}")
    ]
    for page in pages:
        text = (ROOT / page).read_text("utf-8").replace("\\\n", " ")
        for line in text.splitlines():
            if not re.search(r"snakemake .*--config", line):
                continue
            words = shlex.split(line.split("snakemake ", 1)[1].split("`")[0].split("||")[0])
            taken = False  # by --config or --configfile, until the next option
            for word in words:
                if word == "--":
                    break
                if word.startswith("-"):
                    taken = word
                elif taken == "--config":
                    assert "=" in word, f"{page}: {line}"
                elif taken == "--configfile":
                    assert word.endswith(".yaml") or word.strip("<>;") in ("this", "file"), (
                        f"{page}: {line}"
                    )


def test_an_interrupted_run_says_what_is_kept(tmp_path):
    words = ["--config", "run=stopped", "records=GMN_NS", "models=W1", "directions=pos"]
    run = subprocess.Popen(
        [*COMMAND, *words],
        cwd=tmp_path,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": PATHS},
    )
    try:
        for line in run.stderr:
            if line.startswith("stopped: ") and "jobs" in line:  # the opening line, by run
                break
        time.sleep(1.0)
        run.send_signal(signal.SIGINT)
        said = run.communicate(timeout=LIMIT_S)[1]
    finally:
        run.kill()
    assert "finished runs are kept; repeat the command" in said
