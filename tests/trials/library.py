"""The project as a library: its wheel in an empty environment, where docs/python.md is run.

    .venv/bin/python tests/trials/library.py [--extras report notebook] [--index FOLDER]

Makes a wheel, an environment of its own and a folder without anything of the project, installs the
wheel with its dependencies there, runs every block of Python of the page from top to bottom, and
with the extra `notebook` the notebook. Needs what pip takes packages from: the internet, or
`--index`, a folder of wheels.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE, NOTEBOOK = ROOT / "docs" / "python.md", ROOT / "docs" / "first_facade.ipynb"
LIMIT_S = 1800


def run(words, folder):
    """Run a command that has nothing of this environment; end with its last lines if it fails."""
    own = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "VIRTUAL_ENV")}
    done = subprocess.run(
        list(map(str, words)),
        cwd=folder,
        env=own | {"MPLBACKEND": "agg"},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    if done.returncode:
        raise SystemExit(f"error: {' '.join(map(str, words))[:120]}\n{done.stderr[-2000:]}")
    return done.stdout


def main():
    """Install, run, print what the page's first lines print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--extras", nargs="*", default=["report"])
    parser.add_argument("--index", help="folder of wheels, in place of the internet")
    args = parser.parse_args()
    source = ["--no-index", "--find-links", args.index] if args.index else []
    with tempfile.TemporaryDirectory(prefix="rocking-library-") as top:
        pip = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation"]
        run([*pip, "--wheel-dir", top, ROOT], top)
        (wheel,) = Path(top).glob("*.whl")
        run([sys.executable, "-m", "venv", "env"], top)
        python = Path(top, "env", "bin", "python")
        wanted = f"{wheel}[{','.join(args.extras)}]"
        run([python, "-m", "pip", "install", "-q", *source, wanted], top)
        packages = run([python, "-m", "pip", "list", "--format=freeze"], top).split()
        print(f"{wheel.name} ({wheel.stat().st_size / 1e6:.1f} MB): {len(packages)} packages")
        empty = Path(top, "empty")
        empty.mkdir()
        blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)
        (empty / "page.py").write_text("\n".join(blocks), "utf-8")
        print(run([python, "page.py"], empty).strip())
        print(f"{PAGE.name}: {len(blocks)} blocks ran in {empty}")
        if "notebook" in args.extras:
            words = ["nbconvert", "--to", "notebook", "--execute", "--output-dir", empty]
            run([python, "-m", "jupyter", *words, NOTEBOOK], empty)
            print(f"{NOTEBOOK.name}: ran")


if __name__ == "__main__":
    main()
