"""A wheel made from the tree has every module, and each imports outside the tree."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {name: name for name in ("smdof", "yade_scripts")}
PACKAGES |= {name: f"workflow/{name}" for name in ("record_files", "reference_solver", "rocking")}
IMPORT = """
import importlib, sys
sys.path[:0] = [sys.argv[1], *sys.argv[2].split(":")]
for name in sys.argv[3:]:
    module = importlib.import_module(name)
    assert module.__file__.startswith(sys.argv[1]), module.__file__
"""
USE = """
import sys
sys.path[:0] = [sys.argv[1], *sys.argv[2].split(":")]
import rocking
from rocking import Case, Motion, collapse_curve
case = Case.configured("W2", {"facade.height_m": 6.0})
for name, table in (("RRS228", None), ("AQV_NS", "config/suites/recorded_suite.tsv")):
    motion = Motion.named(name, **({"table": table} if table else {}))
    found = collapse_curve(case, motion, "neg", search="list", settings={"pga_g": [0.05, 2.0]})
    assert found.table["status"].tolist() == ["ok", "overturned"], found.table
try:
    Case.configured("W2", {"facade.heigth_m": 6.0})
except ValueError as error:
    print(rocking.__file__, error)
"""
# what an environment has into which nothing but the wheel's dependencies was installed
OTHERS = ":".join({sysconfig.get_path("purelib"), sysconfig.get_path("platlib")})
COPIED = ("pyproject.toml", "setup.py", "README.md", "config", "workflow/schemas")


pytestmark = pytest.mark.xdist_group("wheel")  # which is made once


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A wheel of the tree, unpacked; modules that it must have."""
    top = tmp_path_factory.mktemp("wheel")
    source, skip = top / "source", shutil.ignore_patterns("__pycache__", "*.nb*", "build")
    for folder in (*PACKAGES.values(), *COPIED):
        if (ROOT / folder).is_dir():
            shutil.copytree(ROOT / folder, source / folder, ignore=skip)
        else:
            shutil.copy(ROOT / folder, source)
    words = ["wheel", "--quiet", "--no-build-isolation", "--no-deps", "--no-index", "--wheel-dir"]
    run([sys.executable, "-m", "pip", *words, str(top), str(source)], top)
    (wheel,) = top.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(top / "site")
    return top / "site"


def alone(site, code, folder, *words):
    """Run code that sees the wheel and other packages, and neither the tree nor its .pth file."""
    command = [sys.executable, "-I", "-S", "-c", code, str(site), OTHERS, *words]
    return run(command, folder)


@pytest.mark.slow
def test_every_module_imports_from_a_wheel(site, tmp_path):
    modules = []
    for package, folder in PACKAGES.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = (package, *path.relative_to(ROOT / folder).with_suffix("").parts)
            if parts[-1] != "__main__":
                modules.append(".".join(parts).removesuffix(".__init__"))
    assert len(modules) > 200
    alone(site, IMPORT, tmp_path, *modules)


@pytest.mark.slow
def test_a_wheel_finds_curves_by_itself(site, tmp_path):
    """Schemas, laws, convergence and both tables of motions are in it."""
    done = alone(site, USE, tmp_path)
    assert done.stdout.startswith(str(site))
    assert "did you mean 'facade.height_m'?" in done.stdout


def test_a_wheel_has_what_the_packages_import(site):
    """Its dependencies are those that public functions need; what draws and runs is extra."""
    (meta,) = site.glob("*.dist-info/METADATA")
    text = meta.read_text("utf-8")
    needed = set(re.findall(r"(?m)^Requires-Dist: ([\w-]+)[^;\n]*$", text))
    assert needed == {"jsonschema", "numba", "numpy", "pandas", "pyyaml", "scipy"}
    extras = set(re.findall(r"(?m)^Provides-Extra: (\w+)$", text))
    assert extras == {"workflow", "report", "notebook"}


def run(words, folder):
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    done = subprocess.run(
        words, cwd=folder, env=environment, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return done
