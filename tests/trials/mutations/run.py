"""Change one sign, factor or unit at a time and see whether the tests notice.

    python tests/trials/mutations/run.py [--only WORD] [--output survivors.csv]

Each change of `table.yaml` is made in a copy of the tracked files, never in the checkout, and the
tests named beside it run there until the first failure. A change that they do not notice survives:
it is listed, and the exit status is 1. The tests must pass in the unchanged copy first.
"""

import argparse
import csv
import multiprocessing
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import hypothesis  # noqa: F401
import pandas  # noqa: F401
import pytest
import scipy.integrate
import scipy.optimize
import scipy.signal
import scipy.sparse.linalg  # noqa: F401
import yaml

ROOT = Path(__file__).parents[3]
LIMIT_S = 900.0  # of one run of tests; a change that makes them hang is noticed


def copy_of_checkout(folder):
    """Copy the tracked and the new files of the checkout into `folder`."""
    listed = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, check=True).stdout
    for name in names.decode().split("\0"):
        if name and (ROOT / name).is_file():
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target)


def replaced(text, old, new, at=None):
    """Return `text` with one occurrence of `old` changed: the only one, or number `at`."""
    parts = text.split(old)
    if len(parts) < 2 or (at is None and len(parts) != 2) or (at is not None and len(parts) <= at):
        raise SystemExit(f"error: '{old}' occurs {len(parts) - 1} times: the table is out of date")
    at = at or 1
    return old.join(parts[:at]) + new + old.join(parts[at:])


def passes(folder, tests):
    """Whether the tests pass in the copy.

    A child that has the libraries but nothing of the project imports the copy's modules: most of
    the time of so short a run would be the libraries.
    """
    words = ["-q", "-x", "-n0", "-p", "no:cacheprovider", *shlex.split(tests)]
    child = multiprocessing.get_context("fork").Process(target=_run, args=(folder, words))
    child.start()
    child.join(LIMIT_S)
    if child.is_alive():
        child.kill()
        child.join()
        return False
    if child.exitcode not in (0, 1, 2):  # 2: not even collected, for a changed table is refused
        raise SystemExit(f"error: pytest {tests}: exit status {child.exitcode}")
    return child.exitcode == 0


def _run(folder, words):
    """In the child: the copy before the checkout, then pytest."""
    os.chdir(folder)
    own = [str(folder), str(folder / "workflow"), str(folder / "tests" / "cases")]
    installed = sys.prefix  # the virtual environment may lie in the checkout
    rest = [p for p in sys.path if p.startswith(installed) or not p.startswith(str(ROOT))]
    sys.path[:] = [*own, *rest]
    os.environ["PYTHONPATH"] = ":".join(own[:2])
    sys.dont_write_bytecode = (
        True  # a change within the same second would be taken for the old file
    )
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    os._exit(int(pytest.main(words)))


def main(arguments=None):
    """Try every change; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="groups whose name contains this")
    parser.add_argument("--output", help="CSV of every change and whether it was noticed")
    options = parser.parse_args(arguments)
    table = yaml.safe_load((Path(__file__).parent / "table.yaml").read_text(encoding="utf-8"))
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        copy_of_checkout(folder)
        for group, entry in table.items():
            if options.only not in group:
                continue
            if not passes(folder, entry["tests"]):
                raise SystemExit(f"error: {group}: the tests fail before anything is changed")
            for change in entry["changes"]:
                path = folder / change["file"]
                before = path.read_text(encoding="utf-8")
                path.write_text(
                    replaced(before, change["old"], change["new"], change.get("at")),
                    encoding="utf-8",
                )
                noticed = not passes(folder, entry["tests"])
                path.write_text(before, encoding="utf-8")
                rows.append((group, change["file"], change["old"], change["new"], noticed))
                print(f"{'noticed ' if noticed else 'SURVIVED'} {group}: {change['new']}")
                sys.stdout.flush()
    if options.output:
        with open(options.output, "w", encoding="utf-8", newline="") as handle:
            writer = csv.writer(handle, lineterminator="\n")
            writer.writerow(("group", "file", "old", "new", "noticed"))
            writer.writerows(rows)
    survived = sum(not row[-1] for row in rows)
    print(f"{len(rows)} changes, {survived} survived")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
