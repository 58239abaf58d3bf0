"""The workflow itself: dry run, refusals in one line, a small run end to end, nothing run twice."""

import csv
import shutil
from pathlib import Path

import pytest
from forked import snakemake

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Working folder with the project's config, so that results stay out of the tree."""
    path = tmp_path_factory.mktemp("work")
    shutil.copytree(ROOT / "config", path / "config")
    return path


@pytest.mark.slow
def test_dry_run_of_the_main_job(folder):
    """`snakemake -n` plans one curve a model in YADE on a fresh clone."""
    done = snakemake(folder, "-n")
    assert done.returncode == 0, done.stderr
    assert any(line.split() == ["ida", "3"] for line in (done.stdout + done.stderr).splitlines())


@pytest.mark.slow
def test_a_rule_s_code_is_found_in_a_new_folder(tmp_path):
    """Stamps are made while Snakemake plans, in whatever order it comes to the rules."""
    named = ("figures/record_GMN_NS.png", "smdof/GMN_NS_4dof.csv", "cases/W1.json")
    done = snakemake(tmp_path, "-n", "--", *(f"results/main/{name}" for name in named))
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["facade={hieght_m: 7}"], "unknown key 'facade.hieght_m'; did you mean 'facade.height_m'"),
        (["facade={height_m: -1}"], "facade.height_m = -1: expected"),
        (["facade={height_m: 0.5}"], "expected at least 2 × facade.thickness_m"),
        (["records=NOPE"], "'NOPE' is not in config/suites/two_stations.tsv"),
        (["records_table=none.tsv"], "none.tsv"),
        (["run=../up"], "run = '../up'"),
    ],
)
def test_bad_configuration_is_one_line(folder, words, told):
    """Each refusal is one line that names the key, before any job."""
    done = snakemake(folder, "-n", "--config", *words)
    lines = [line for line in done.stderr.splitlines() if line.startswith("error:")]
    assert done.returncode == 1
    assert len(lines) == 1
    assert told in lines[0]
    assert "Traceback" not in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("", "empty"),
        ("0.00 0.1\n0.01 nan\n0.02 0.1\n", "line 2"),
        ("0.00 100\n0.01 900\n0.02 400\n", "units"),
    ],
)
def test_bad_record_stops_before_yade(folder, content, told):
    """An empty, non-finite or wrongly scaled record ends in one line that names the file."""
    (folder / "bad.txt").write_text(content)
    (folder / "bad.tsv").write_text("record\tfile\tformat\tdt_s\tunits\nBAD\tbad.txt\t\t\tg\n")
    done = snakemake(folder, "--config", "run=bad", "records_table=bad.tsv")
    lines = [line for line in done.stderr.splitlines() if line.startswith("error:")]
    assert done.returncode == 1
    assert len(set(lines)) == 1
    assert "bad.txt" in lines[0]
    assert told in lines[0]
    assert not (folder / "results/bad/ida").exists()


def read(path):
    with open(path) as handle:
        return list(csv.DictReader(handle))


@pytest.mark.xdist_group("small study")
@pytest.mark.yade
@pytest.mark.slow
def test_small_study_end_to_end_and_again(small_study, small, targets):
    """A two-intensity study makes its tables and figures; an added intensity alone is run."""
    results = small_study / "results/small"
    rows = read(results / "ida/W1/RRS228_pos.csv")
    assert [row["status"] for row in rows] == ["ok", "overturned"]
    assert (results / "figures/fig09_ida.png").stat().st_size > 10_000
    collapse = {row["record"]: row for row in read(results / "tables/ida_collapse.csv")}["RRS228"]
    assert (collapse["pga_safe_g"], collapse["pga_collapse_g"]) == ("0.0200", "0.9000")

    # a second request of the same study has nothing to do
    again = snakemake(small_study, *small, "--", *targets)
    assert "Nothing to be done" in again.stderr + again.stdout

    # one more intensity: the two old rows come back byte for byte, only the new one is run
    more = [w.replace("[0.02, 0.9]", "[0.02, 0.03, 0.9]") for w in small]
    done = snakemake(small_study, *more, "--", "results/small/ida/W1/RRS228_pos.csv")
    assert done.returncode == 0, done.stderr[-3000:]
    said = (results / "logs/ida_W1_RRS228_pos.log").read_text()
    assert "2 of 3 runs taken from earlier work" in said
    assert [r for r in read(results / "ida/W1/RRS228_pos.csv") if r["pga_g"] != "0.0300"] == rows


@pytest.mark.xdist_group("small study")
@pytest.mark.yade
@pytest.mark.slow
def test_one_target_into_another_run(small_study, small):
    """A single file with overrides goes to another run and leaves the first alone."""
    first = small_study / "results/small/ida/W1/RRS228_pos.csv"
    before = first.read_bytes()
    words = [w.replace("run=small", "run=tall").replace("5.75", "8.0") for w in small]
    target = "results/tall/ida/W1/RRS228_pos.csv"
    done = snakemake(small_study, *words, "--", target)
    assert done.returncode == 0, done.stderr[-3000:]
    assert (small_study / target).exists()
    assert first.read_bytes() == before
    assert not (small_study / "results/tall/figures").exists()
