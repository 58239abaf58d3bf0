"""Change one sign, factor or unit at a time and see whether the tests notice.

    python tests/trials/mutations/run.py [--only WORD] [--change WORD] [--output changes.csv]

Each change of the tables here (`table.yaml` and those beside it) is made in a copy of the tracked
files, never in the checkout, and the tests named beside it, or beside its group, run there until
the first failure. A change that they do not notice survives: it is listed, and the exit status is 1
where the table gives no reason why it is left. The tests must pass in the unchanged copy first.
"""

import argparse
import csv
import multiprocessing
import os
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import hypothesis  # noqa: F401
import matplotlib  # noqa: F401
import pandas  # noqa: F401
import pytest
import scipy.integrate
import scipy.optimize
import scipy.signal
import scipy.sparse.linalg  # noqa: F401
import yaml
from numba.core import caching

ROOT = Path(__file__).parents[3]
TABLES = sorted(Path(__file__).parent.glob("*.yaml"))
LIMIT_S = 900.0  # of one run of tests; a change that makes them hang is noticed
COLUMNS = ("group", "file", "old", "new", "noticed", "left", "cpu_s")


def copy_of_checkout(folder):
    """Copy the tracked and the new files of the checkout, and what numba has compiled of them."""
    listed = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, check=True).stdout
    made = [p.relative_to(ROOT) for p in ROOT.glob("workflow/rocking/**/__pycache__/*.nb?")]
    for name in [*names.decode().split("\0"), *map(str, made)]:
        if name and (ROOT / name).is_file():
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target)


def whole_table():
    """Groups of all tables; two of one name are an error."""
    found: dict = {}
    for path in TABLES:
        for name, entry in yaml.safe_load(path.read_text(encoding="utf-8")).items():
            if name in found:
                raise SystemExit(f"error: {path.name}: group '{name}' stands in another table too")
            found[name] = entry
    return found


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
    # a change within the same second would be taken for the old file
    sys.dont_write_bytecode, os.environ["PYTHONDONTWRITEBYTECODE"] = True, "1"
    caching.IndexDataCacheFile.save = lambda *_: None  # what is compiled stays the unchanged code's
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    os._exit(int(pytest.main(words)))


def changed(folder, change):
    """Make a change, tell whether the tests notice it, and take it back."""
    path = folder / change["file"]
    before, times = path.read_text(encoding="utf-8"), path.stat()
    after = replaced(before, change["old"], change["new"], change.get("at"))
    path.write_text(after, encoding="utf-8")
    noticed = not passes(folder, change["tests"])
    path.write_text(before, encoding="utf-8")
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    return noticed


def spent_s():
    """Processor time of all children so far [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def rows_of(folder, group, entry, word):
    """Try every change of a group whose new text contains a word: its rows of the table."""
    changes = [{"tests": entry.get("tests"), **change} for change in entry["changes"]]
    changes = [change for change in changes if word in change["new"]]
    for tests in dict.fromkeys(change["tests"] for change in changes):
        if not passes(folder, tests):
            raise SystemExit(f"error: {group}: {tests} fails before anything is changed")
    for change in changes:
        began = spent_s()
        noticed, left = changed(folder, change), change.get("left", "")
        print(f"{'noticed ' if noticed else 'left    ' if left else 'SURVIVED'} {group}: ", end="")
        print(change["new"], flush=True)
        shown = (change[key] for key in COLUMNS[1:4])
        yield group, *shown, noticed, left, f"{spent_s() - began:.1f}"


def main(arguments=None):
    """Try every change; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="the group of this name, or all that contain it")
    parser.add_argument("--change", default="", help="changes whose new text contains this")
    parser.add_argument("--output", help="CSV of every change and whether it was noticed")
    options = parser.parse_args(arguments)
    table = whole_table()
    count = left = survived = 0
    with tempfile.TemporaryDirectory() as name, open(options.output or os.devnull, "w") as handle:
        folder, writer = Path(name), csv.writer(handle, lineterminator="\n")
        copy_of_checkout(folder)
        writer.writerow(COLUMNS)
        only = options.only
        for group in [only] if only in table else [group for group in table if only in group]:
            began = spent_s()
            rows = list(rows_of(folder, group, table[group], options.change))
            writer.writerows(rows)
            handle.flush()
            reasons = [row[5] for row in rows if not row[4]]
            print(f"{group}: {len(rows)} changes, {len(reasons)} not noticed, ", end="")
            print(f"{spent_s() - began:.0f} s", flush=True)
            count, left = count + len(rows), left + sum(map(bool, reasons))
            survived += sum(not reason for reason in reasons)
    print(f"{count} changes, {left} left with a reason, {survived} survived")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
