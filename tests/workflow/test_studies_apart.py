"""A study is one folder: nothing else needs it, and it needs no other."""

import ast
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from code_rules import as_python, imports
from rocking.configuration.targets import targets

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ROOT / "workflow" / "studies"
NAMES = sorted(path.parent.name for path in STUDIES.glob("*/rules.smk"))
SHARED = "shared"  # what several studies stand on; no study
CORE = (
    "smdof",
    "workflow/record_files",
    "workflow/reference_solver",
    "yade_scripts",
    "workflow/rocking",
    "workflow/scripts",
)
CORE += ("tools", "tests")
LIMIT_S = 300.0


def imported(text, own=""):
    """Studies that a source imports by name: late, relative to its package `own`, or by a text."""
    return {one.split(".")[1] for one in imports(text, own) if re.match(r"studies\.[\w*]", one)}


def files_named(text):
    """Studies whose folder a source goes into: `STUDIES / "friction"`, "studies/friction/a.csv".

    A page may be pointed to.
    """
    found = set()
    for node in ast.walk(ast.parse(text)):
        said = getattr(node, "value", None) if isinstance(node, ast.Constant) else None
        if isinstance(said, str):
            found |= {name for name, _ in re.findall(r"studies/(\w+)/(?!page\.md)(.)", said)}
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
            right = getattr(node.right, "value", None)
            found |= {right.split("/")[0]} if isinstance(right, str) else set()
    return found & {*NAMES}


def within(path):
    """Package of a file of a study."""
    return ".".join(path.relative_to(STUDIES.parent).parent.parts)


@pytest.mark.skipif(not NAMES, reason="studies are deleted")
def test_there_are_studies():
    assert len(NAMES) > 10


def test_nothing_else_imports_a_study_or_goes_into_its_folder():
    paths = [path for top in CORE for path in (ROOT / top).rglob("*.py")]
    paths = [path for path in paths if "trials" not in path.parts]  # run by hand
    assert len(paths) > 300
    texts = {str(path.relative_to(ROOT)): path.read_text("utf-8") for path in paths}
    assert {name: found for name, text in texts.items() if (found := imported(text))} == {}
    core = {name: text for name, text in texts.items() if not name.startswith("tests/")}
    assert {name: found for name, text in core.items() if (found := files_named(text))} == {}


@pytest.mark.parametrize("name", NAMES)
def test_a_study_imports_no_other_and_goes_into_no_other_s_folder(name):
    for path in (STUDIES / name).rglob("*.py"):
        text = path.read_text("utf-8")
        assert imported(text, within(path)) <= {name, SHARED}, path.name
        assert path.name.startswith("test_") or files_named(text) <= {name}, path.name
    for path in (STUDIES / name).rglob("*.smk"):
        text = as_python(path.read_text("utf-8"))
        assert files_named(text) | imported(text) <= {name, SHARED}, path.name


def test_what_studies_share_imports_none_of_them():
    paths = [*(STUDIES / SHARED).rglob("*.py")]
    assert len(paths) > 5
    for path in paths:
        text = path.read_text("utf-8")
        assert imported(text, within(path)) <= {SHARED}, path.name
        assert files_named(text) == set(), path.name


@pytest.mark.parametrize(
    "text",
    [
        *(
            "import studies.b.study as s",
            "from studies.b.study import x",
            "from studies import a, b",
        ),
        *("from ..b import x", "from .. import b", "def late():\n    from ..b.study import x"),
        "from importlib import import_module as i\ni('studies.b.study')",
        "import importlib\nimportlib.import_module(name='studies.b')",
    ],
)
def test_the_check_of_imports_finds(text):
    assert imported(text, "studies.a") - {"a"} == {"b"}


@pytest.mark.parametrize(
    "text", ["from . import study", "from .study import x", "from studies.a import b"]
)
def test_the_check_of_imports_leaves(text):
    assert imported(text, "studies.a") <= {"a"}


@pytest.mark.skipif(not NAMES, reason="studies are deleted")
def test_the_check_of_folders_finds():
    name = NAMES[0]
    for text in (f"STUDIES / '{name}' / 'a'", f"a = 'workflow/studies/{name}/scenario.yaml'"):
        assert files_named(text) == {name}
    assert files_named(f"a = 'workflow/studies/{name}/page.md'") == set()


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


def passes(project, *words):
    """Run tests of a copy of the project, by the copy's own packages."""
    path = os.pathsep.join(map(str, (project, project / "workflow")))
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-n0", *words],
        cwd=project,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    assert done.returncode == 0, done.stdout[-2000:]


def looking_around(project):
    """Tests of the core that name studies or go through folders: others cannot miss one."""
    paths = [path for path in (project / "tests").rglob("test_*.py") if "trials" not in path.parts]
    around = re.compile(r'studies|rglob|"workflow"')
    named = [str(path) for path in paths if around.search(path.read_text("utf-8"))]
    assert len(named) > 20
    return [path for path in named if not path.endswith(("test_studies_apart.py", "test_wheel.py"))]


@pytest.mark.slow
def test_without_any_of_them_the_main_job_is_planned(tmp_path):
    """And with any one of them alone its targets are. Tests of the core pass without them."""
    left = shutil.ignore_patterns("__pycache__", ".git", ".venv", ".*cache", "results", "build")
    shutil.copytree(ROOT, tmp_path, ignore=left, dirs_exist_ok=True, symlinks=True)
    for name in NAMES:
        shutil.move(tmp_path / "workflow" / "studies" / name, tmp_path / name)
    status, said = planned(tmp_path)
    assert status == 0, said
    no_mass = "return_wall={building_mass_kg: null}"  # which no study finds
    status, said = planned(tmp_path, "--config", "models=W2m", no_mass)
    assert status == 1
    assert "return_wall.building_mass_kg: null; W2m takes the building's mass" in said
    assert targets(tmp_path) == targets(study=None)
    passes(tmp_path, "--collect-only", "tests")
    passes(tmp_path, "-m", "not slow and not yade", *looking_around(tmp_path))
    for name in NAMES:
        shutil.move(tmp_path / name, tmp_path / "workflow" / "studies" / name)
        status, said = planned(tmp_path, "--list-target-rules")
        assert status == 0, (name, said)
        assert set(targets(study=name)) <= set(said.split()), name
        shutil.move(tmp_path / "workflow" / "studies" / name, tmp_path / name)
