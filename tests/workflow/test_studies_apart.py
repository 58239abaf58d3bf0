"""A study is one folder: nothing else needs it, and it needs no other."""

import ast
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from rocking.configuration.targets import targets

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ROOT / "workflow" / "studies"
NAMES = sorted(path.parent.name for path in STUDIES.glob("*/rules.smk"))
CORE = ("smdof", "yade_scripts", "workflow/rocking", "workflow/scripts", "workflow/rules", "tests")
LIMIT_S = 300.0


def imported(path):
    """Studies that a file of Python imports by name, also within its functions."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        modules = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
        modules += [one.name for one in node.names] if isinstance(node, ast.Import) else []
        for module in modules:
            if module.partition(".")[0] == "studies":
                yield module.split(".")[1] if "." in module else node.names[0].name


def test_there_are_studies():
    assert len(NAMES) > 10


def test_nothing_else_imports_a_study():
    paths = [path for top in CORE for path in (ROOT / top).rglob("*.py")]
    assert len(paths) > 300
    assert [
        (str(path.relative_to(ROOT)), *imported(path)) for path in paths if [*imported(path)]
    ] == []


@pytest.mark.parametrize("name", NAMES)
def test_a_study_imports_no_other(name):
    for path in (STUDIES / name).rglob("*.py"):
        assert set(imported(path)) <= {name}, path.name


def planned(project, *words):
    """What a dry run in a copy of the project says, by the copy's own packages."""
    path = os.pathsep.join(map(str, (project, project / "workflow")))
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "--dry-run", "--cores", "1", *words],
        cwd=project,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.slow
def test_without_any_of_them_the_main_job_is_planned(tmp_path):
    """And with any one of them alone its targets are. Tests of the core need none of them."""
    left = shutil.ignore_patterns("__pycache__", ".*", "results", "build")
    shutil.copytree(ROOT, tmp_path, ignore=left, dirs_exist_ok=True, symlinks=True)
    for name in NAMES:
        shutil.move(tmp_path / "workflow" / "studies" / name, tmp_path / name)
    status, said = planned(tmp_path)
    assert status == 0, said
    status, said = planned(tmp_path, "--config", "models=W2m")  # no study finds its mass
    assert status == 1
    assert "return_wall.building_mass_kg: null; W2m takes the building's mass" in said
    assert targets(tmp_path) == targets(study=None)
    words = ["-m", "pytest", "--collect-only", "-q", "-n0", "tests"]
    done = subprocess.run(
        [sys.executable, *words], cwd=tmp_path, capture_output=True, text=True, timeout=LIMIT_S
    )
    assert done.returncode == 0, done.stdout[-2000:]
    for name in NAMES:
        shutil.move(tmp_path / name, tmp_path / "workflow" / "studies" / name)
        status, said = planned(tmp_path, "--list-target-rules")
        assert status == 0, (name, said)
        assert set(targets(study=name)) <= set(said.split()), name
        shutil.move(tmp_path / "workflow" / "studies" / name, tmp_path / name)
