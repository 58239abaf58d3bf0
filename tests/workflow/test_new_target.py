"""A study is one folder and no line elsewhere: docs/examples/friction, laid where it goes."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "docs" / "examples" / "friction"
STUDY = Path("workflow") / "studies" / "friction"
FILES = [STUDY / path.name for path in sorted(EXAMPLE.iterdir()) if path.is_file()]
PARTS = ("Snakefile", "config", "docs", "profiles", "pyproject.toml", "smdof", "tests", "workflow")
PARTS += ("yade_scripts",)
COARSE = "numerics={nodes_thickness: 5, nodes_height: 5, step_fraction: 0.4, after_motion_s: 0.5}"
LIMIT_S = 300.0


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """A copy of the project, compiled loops and all, with the example among its studies."""
    top = tmp_path_factory.mktemp("new")
    for name in PARTS:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, top / name)
    assert not (top / STUDY).exists()
    shutil.copytree(EXAMPLE, top / STUDY, ignore=shutil.ignore_patterns("__pycache__"))
    return top


def called(project, *words):
    """Run a module of Python in the project, with its own packages."""
    path = os.pathsep.join(map(str, (project, project / "workflow")))
    environment = {**os.environ, "PYTHONPATH": path, "MPLBACKEND": "Agg"}
    return subprocess.run(
        [sys.executable, "-m", *words],
        cwd=project,
        env=environment,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )


def test_it_is_what_the_recipe_lists():
    """CONTRIBUTING.md names every file of the folder."""
    recipe = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    recipe = recipe.partition("**A study**")[2].partition("**A search")[0]
    assert {path.name for path in FILES} - {"__init__.py"} == set(
        re.findall(r"(?m)^\d\. `([\w.]+)`", recipe)
    )


def test_they_are_in_order_where_they_are_laid(project):
    """The linters judge imports by the folder that a module stands in."""
    for words in (("check",), ("format", "--check")):
        done = called(project, "ruff", *words, *(str(p) for p in FILES if p.suffix == ".py"))
        assert done.returncode == 0, done.stdout


@pytest.mark.slow
def test_the_study_runs_and_its_page_of_keys_is_written(project):
    """Its keys are checked, its rows and its figure are made, and its test passes."""
    given = ["--config", "run=new", "records=GMN_NS", "directions=neg", "models=W1", COARSE]
    wrong = called(
        project, "snakemake", "-n", *given, "friction={angles_deg: [2, 30]}", "--", "friction"
    )
    assert "friction.angles_deg" in wrong.stderr + wrong.stdout
    made = called(project, "snakemake", "--cores", "1", *given, "--", "friction")
    assert made.returncode == 0, made.stderr
    table = pd.read_csv(project / "results/new/tables/friction.csv")
    assert table["friction_deg"].tolist() == [30, 35, 40]
    assert table["ratio"].iloc[0] == 1.0
    assert (project / "results/new/figures/friction.png").stat().st_size > 5000
    assert called(project, "docs.write_keys", "--check").returncode == 1
    assert called(project, "docs.write_keys").returncode == 0
    keys = (project / STUDY / "keys.md").read_text("utf-8")
    assert "| `angles_deg` |" in keys
    assert "| `friction` | What friction is worth | a minute |" in keys


@pytest.mark.slow
def test_the_example_s_own_test_passes(project):
    done = called(project, "pytest", "-n0", f"{STUDY}/test_friction.py")
    assert done.returncode == 0, done.stdout
