"""A wheel made from the tree has every module, and each imports outside the tree."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {"smdof": "smdof", "yade_scripts": "yade_scripts", "rocking": "workflow/rocking"}
IMPORT = """
import importlib, sys
for name in sys.argv[2:]:
    module = importlib.import_module(name)
    assert module.__file__.startswith(sys.argv[1]), module.__file__
"""


@pytest.mark.slow
def test_every_module_imports_from_a_wheel(tmp_path):
    source, modules, skip = tmp_path / "source", [], shutil.ignore_patterns("__pycache__", "*.nb*")
    for package, folder in PACKAGES.items():
        shutil.copytree(ROOT / folder, source / folder, ignore=skip)
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = (package, *path.relative_to(ROOT / folder).with_suffix("").parts)
            if parts[-1] != "__main__":
                modules.append(".".join(parts).removesuffix(".__init__"))
    shutil.copy(ROOT / "pyproject.toml", source)
    words = ["wheel", "--quiet", "--no-build-isolation", "--no-deps", "--no-index", "--wheel-dir"]
    run([sys.executable, "-m", "pip", *words, str(tmp_path), str(source)], tmp_path)
    (wheel,) = tmp_path.glob("*.whl")
    site = tmp_path / "site"
    zipfile.ZipFile(wheel).extractall(site)
    assert len(modules) > 200
    run([sys.executable, "-c", IMPORT, str(site), *modules], tmp_path, PYTHONPATH=str(site))


def run(words, folder, **more):
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | more
    done = subprocess.run(
        words, cwd=folder, env=environment, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr[-2000:]
