"""Runs side by side: a grid, and finished runs by name."""

import csv
import re
import shutil

import pytest
from forked import snakemake as started
from studies.compare.finished import curves_of, models_gone

pytestmark = pytest.mark.slow

TABLE = """model,record,direction,pga_safe_g,pga_collapse_g,pga_median_g
W1,A,pos,0.1,0.2,{}
W1,A,neg,0.1,,
"""


def snakemake(folder, *words):
    """Run Snakemake in a folder with the Snakefile at the top."""
    return started(folder, *words, snakefile="Snakefile")


def read(path):
    with open(path, newline="") as handle:
        return list(csv.DictReader(handle))


def test_a_run_of_a_model_that_is_gone_is_told_in_one_line(tmp_path):
    path = tmp_path / "ida_collapse.csv"
    path.write_text("model,record,pga_safe_g\nW1,A,0.2\nW9,A,0.1\nW8,B,0.1\n")
    said = models_gone(path)
    assert said.startswith(f"{path}: no model W8, W9 any more; expected W1, ")
    assert "\n" not in said
    path.write_text("model,record,pga_safe_g\nW1,A,0.2\n")
    assert models_gone(path) == ""
    assert curves_of(path) == [{"model": "W1", "record": "A", "pga_safe_g": "0.2"}]


@pytest.fixture
def finished(tmp_path):
    """Two finished runs in results/, whose façades differ in height."""
    for name, height, median in (("low", 5.0, 0.3), ("tall", 8.0, 0.15)):
        folder = tmp_path / "results" / name
        (folder / "tables").mkdir(parents=True)
        (folder / "tables/ida_collapse.csv").write_text(TABLE.format(median))
        text = f"run: {name}\nseed: 1\nmodels: [W1]\nfacade:\n  height_m: {height}\n"
        (folder / "config.yaml").write_text(text)
    (tmp_path / "results/tall/records").mkdir()
    facts = '{"name": "A", "source": "file", "details": {}}'
    (tmp_path / "results/tall/records/A.json").write_text(facts)
    return tmp_path


def test_records_of_a_finished_run_are_those_of_its_curves_that_it_still_has(finished):
    (finished / "results/tall/records/B.json").touch()  # of no curve
    words = ("--config", "compare=low,tall", "--", "compare")
    done = snakemake(finished, "-n", *words)
    assert done.returncode == 0, done.stderr[-3000:]
    told = done.stdout + done.stderr
    assert "results/tall/records/A.json" in told
    assert not re.search(r"records/B\.json|low/records", told)


def test_finished_runs_side_by_side_with_what_differs(finished):
    done = snakemake(finished, "--config", "run=both", "compare=low,tall", "--", "compare")
    assert done.returncode == 0, done.stderr[-3000:]
    table = read(finished / "results/both/compare/collapse.csv")
    assert [(row["run"], row["facade.height_m"]) for row in table] == [
        ("low", "5.0"),
        ("low", "5.0"),
        ("tall", "8.0"),
        ("tall", "8.0"),
    ]
    assert [row["pga_median_g"] for row in table] == ["0.3", "", "0.15", ""]
    assert "seed" not in table[0]  # the same in both
    assert (finished / "results/both/compare/collapse.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("named", "told"),
    [
        ("low,high", "no finished run 'high' (no file results/high/tables/ida_collapse.csv); "),
        ("low,bare", "no finished run 'bare' (no file results/bare/config.yaml); there are low,"),
        ("low", "one run only; give a grid"),
    ],
)
def test_what_cannot_be_compared_is_one_line(finished, named, told):
    bare = finished / "results/bare/tables"
    bare.mkdir(parents=True)
    shutil.copy(finished / "results/low/tables/ida_collapse.csv", bare)
    done = snakemake(finished, "-n", "--config", f"compare={named}", "--", "compare")
    assert done.returncode == 1
    (line,) = [line for line in done.stderr.splitlines() if line.startswith("error:")]
    assert told in line
    if "high" in named:
        assert "there are low, tall" in line


def test_a_grid_is_compared_by_running_it(tmp_path):
    words = ["--config", "run=g", "records=GMN_NS", "grid={facade.height_m: [5, 6]}"]
    done = snakemake(tmp_path, "-n", *words, "--", "compare")
    assert done.returncode == 0, done.stderr[-3000:]
    jobs = dict(line.split()[:2] for line in done.stdout.splitlines() if len(line.split()) == 2)
    assert jobs["ida_collapse"] == "2"
    assert jobs["compare_runs"] == "1"
