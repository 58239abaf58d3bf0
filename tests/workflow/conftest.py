"""A small study and its report, run once for the tests that look at them."""

import shutil
from pathlib import Path

import pytest
from forked import snakemake

ROOT = Path(__file__).resolve().parents[2]
TARGETS = ["all", *(["fragility"] if (ROOT / "workflow/studies/risk").is_dir() else [])]
SMALL = [
    "--config",
    "run=small",
    "records_table=config/records.tsv",
    "records=RRS228,HVSC1",
    "directions=pos",
    "models=W1",
    "facade={height_m: 5.75, courses: 0}",
    "ida={mode: grid, grid_g: [0.02, 0.9]}",
    "numerics={step_fraction: 0.5, after_motion_s: 0}",
    "ensemble={enabled: off}",
    "pushover={nodes_thickness: 5, step_fraction: 0.4}",
]


@pytest.fixture(scope="session")
def small():
    """Words that name the small study."""
    return SMALL


@pytest.fixture(scope="session")
def targets():
    """What of the small study is asked for."""
    return TARGETS


@pytest.fixture(scope="session")
def small_study(tmp_path_factory):
    """Working folder with the project's config, the study's results and `report.html`."""
    folder = tmp_path_factory.mktemp("study")
    shutil.copytree(ROOT / "config", folder / "config")
    for words in ([], ["--report", "report.html"]):
        done = snakemake(folder, *SMALL, *words, "--", *TARGETS)
        assert done.returncode == 0, done.stderr[-3000:]
    return folder
