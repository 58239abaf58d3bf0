"""What everyday use meets first: faulty records, mistyped commands, runs side by side."""

import csv
import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))
PATHS = os.pathsep.join([str(ROOT), str(ROOT / "workflow")])
LIMIT_S = 120.0


def snakemake(folder, *words, limit_s=LIMIT_S):
    """Run Snakemake in a folder with the project's Snakefile."""
    return subprocess.run(
        [SNAKEMAKE, "--snakefile", str(ROOT / "Snakefile"), "--cores", "1", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=limit_s,
        env={**os.environ, "PYTHONPATH": PATHS},
    )


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
    assert "above 1 %" in done.stderr
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
