"""What a catalogue of workflows asks for: its file, a trial configuration, use as a module."""

import csv
import re
import shutil
from pathlib import Path

import pytest
import yaml
from forked import snakemake

ROOT = Path(__file__).resolve().parents[2]
SNAKEFILE = ROOT / "workflow" / "Snakefile"
COARSE = "pushover={nodes_thickness: 5, step_fraction: 0.4}"
REDUCED = ["ida={mode: grid, grid_g: [0.05, 0.6]}", "ensemble={enabled: off}", COARSE]
MODULE = f"""
configfile: "config/config.yaml"
module rocking_facades:
    snakefile: "{SNAKEFILE}"
    config: config
use rule * from rocking_facades
"""


@pytest.fixture
def folder(tmp_path):
    """A copy of the trial, so that nothing is written into the tree."""
    shutil.copytree(ROOT / ".test" / "config", tmp_path / "config")
    return tmp_path


def test_the_catalogue_finds_what_it_asks_for():
    usage = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text())["usage"]
    assert set(usage) == {"mandatory-flags", "software-stack-deployment"}
    assert set(usage["mandatory-flags"]) == {"desc", "flags"}
    deployed = usage["software-stack-deployment"]  # its README's keys
    assert set(deployed) == {"conda", "apptainer", "apptainer+conda", "report"}
    assert deployed["report"] is True
    rules = "".join(path.read_text("utf-8") for path in (ROOT / "workflow").rglob("*.smk"))
    conda, container = (bool(re.search(rf"(?m)^ +{one}:", rules)) for one in ("conda", "container"))
    said = [deployed[key] for key in ("conda", "apptainer", "apptainer+conda")]
    assert said == [conda, container, conda and container]
    assert (ROOT / "config" / "README.md").is_file()


@pytest.mark.yade
@pytest.mark.slow
def test_the_trial_configuration_runs(folder):
    """`snakemake --directory .test` with fewer intensities: floor motions, YADE, table, figure."""
    done = snakemake(folder, "--config", *REDUCED)
    assert done.returncode == 0, done.stderr
    with open(folder / "results/test/tables/ida_collapse.csv") as handle:
        rows = list(csv.DictReader(handle))
    assert [row["model"] for row in rows] == ["W1", "W2"]
    assert all(float(row["pga_safe_g"]) < float(row["pga_collapse_g"]) for row in rows)
    assert (folder / "results/test/figures/fig09_ida.png").stat().st_size > 10_000


@pytest.mark.slow
def test_the_whole_trial_plans_its_jobs(folder):
    done = snakemake(folder, "-n")
    assert done.returncode == 0, done.stderr
    assert "planar_ida" in done.stdout + done.stderr


@pytest.mark.slow
@pytest.mark.yade
def test_another_workflow_may_use_this_one_as_a_module(folder):
    """As a deployment does: own folder, own configuration, all rules, the main job as target."""
    (folder / "workflow").mkdir()
    (folder / "workflow" / "Snakefile").write_text(MODULE)
    done = snakemake(folder, "-n", snakefile=None)
    assert done.returncode == 0, done.stderr
    counts = [line.split() for line in (done.stdout + done.stderr).splitlines()]
    assert ["ida", "2"] in counts
    assert ["all", "1"] in counts
    targets = ["results/test/yade.txt", "results/test/tables/records.csv"]
    done = snakemake(folder, *targets, snakefile=None)
    assert done.returncode == 0, done.stderr
    assert all((folder / target).stat().st_size > 20 for target in targets)


@pytest.mark.slow
def test_a_module_s_prefix_stands_before_its_results_alone(folder):
    (folder / "workflow").mkdir()
    prefixed = MODULE.replace("    config: config\n", '    config: config\n    prefix: "deep"\n')
    (folder / "workflow" / "Snakefile").write_text(prefixed)
    table = "deep/results/test/tables/records.csv"
    done = snakemake(folder, table, snakefile=None)
    assert done.returncode == 0, done.stderr
    assert (folder / table).stat().st_size > 20
    assert (folder / "deep/results/test/made_of.jsonl").is_file()
    assert not (folder / "results").exists()
    assert not (folder / "deep/.snakemake").exists()
