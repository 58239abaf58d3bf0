"""Freeze the tables of a small run of every target, and tell what differs between two states.

    .venv/bin/python tests/trials/freeze.py run --output new            # the tree this file is in
    .venv/bin/python tests/trials/freeze.py run --revision v1.0 --output old
    .venv/bin/python tests/trials/freeze.py compare old new

`run` works through the trials of freeze.yaml, and one more for each target that none of them names,
in a folder of its own, one after the other, and leaves there `manifest.csv` (trial, file, SHA-256)
and the tables themselves in `tables/`. What measures the run and not the façade (wall time,
memory, rates per second) is left out of both, and numbers of JSON files are kept to 10 digits:
the last of a building's periods and mass follow the processor, for which BLAS has its own order
of sums.
`compare` prints every file that is not the same with its first row that differs, and ends with
status 1 if there is one; `--renamed` names a table (old, new; tab-separated) of the columns, words
of paths and words of cells that were renamed on purpose.
"""

import argparse
import csv
import hashlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "workflow")]

from rocking.configuration.targets import targets  # noqa: E402

PLAN = "tests/trials/freeze.yaml"
SNAKEMAKE = Path(sys.executable).with_name("snakemake")
KINDS = {".csv", ".json", ".yaml", ".txt", ".xml", ".md", ".tsv"}
LEFT_OUT = {"logs", "benchmarks", "cache", "figures", "report", "evidence"}  # folders of a run
LEFT_OUT |= {"config.yaml", "yade.txt"}  # a new key or another YADE changes no result
# columns and keys that are measured on the machine; others that hold one of these words as well
MEASURED = re.compile(
    r"(^|_)(wall|cpu|runs?|build|factorise|modes)_s($|_)|(memory|rss)(_at_start)?_mb$|realtime"
    r"|per_simulated_s|(wall|cpu)_time|^(cpu|memory)_growth$"
    r"|^(cost|cost_exponent|started|version|python|platform|commit|code)$"
)
DIGITS = 10  # of numbers in JSON files; tables have fewer
LIMIT_S = 1800.0  # of one trial
HAZARD = "pga_g,annual_rate\n" + "".join(
    f"{0.02 * 2**i:.4g},{0.1 * 4.0**-i:.6g}\n" for i in range(9)
)


def merged(below, above):
    """`above` laid over `below`, section by section."""
    if not (isinstance(below, dict) and isinstance(above, dict)):
        return above
    return {k: merged(below.get(k), above.get(k, below.get(k))) for k in {**below, **above}}


def run(tree, output, only=(), cores=2, plan=None):
    """Run the trials of a checkout; return the names of those that failed.

    Parameters
    ----------
    tree : Path
        Checkout whose Snakefile, packages and configuration are used.
    output : Path
        Folder of the manifest and the tables; `work/` in it is where Snakemake runs.
    only : sequence of str
        Names of trials; all where there are none.
    cores : int
        Jobs at a time; no table depends on it.
    plan : Path, optional
        The trials; those of the checkout, whose names of keys they have, or else of this one, and
        one for each target of the checkout that they do not name.
    """
    plan = yaml.safe_load(plan.read_text()) if plan else planned(tree)
    if unknown := set(only) - set(plan["trials"]):
        sys.exit(f"error: {', '.join(sorted(unknown))}: expected of {', '.join(plan['trials'])}")
    work = output / "work"
    work.mkdir(parents=True, exist_ok=True)
    shutil.copytree(tree / "config", work / "config", dirs_exist_ok=True)
    (work / "hazard.csv").write_text(HAZARD)
    path = os.pathsep.join(map(str, (tree, tree / "workflow")))
    environment = {**os.environ, "PYTHONPATH": path, "MPLBACKEND": "Agg"}
    failed = []
    for name in only or plan["trials"]:
        trial, began = plan["trials"][name], time.monotonic()
        own = work / f"{name}.yaml"
        settings = merged(plan["common"], trial.get("config", {}))
        own.write_text(yaml.safe_dump({"run": name, **settings}, sort_keys=False))
        words = ["--snakefile", tree / "Snakefile", "--cores", cores, "--configfile", own.name]
        words += ["--nolock", "--keep-going", "--", *trial["targets"]]
        with open(work / f"{name}.log", "w") as log:
            done = subprocess.run(
                [str(word) for word in (SNAKEMAKE, *words)],
                cwd=work,
                env=environment,
                stdout=log,
                stderr=subprocess.STDOUT,
                timeout=LIMIT_S,
            )
        keep(work / "results", name, output)
        if done.returncode:
            failed.append(name)
        print(
            f"{name}: {'FAILED' if done.returncode else 'done'},"
            f" {time.monotonic() - began:.0f} s ({own.with_suffix('.log')})",
            flush=True,
        )
    return failed


def planned(tree):
    """Trials of a checkout: those of its freeze.yaml, then a target each that none of them names.

    Those have the common settings alone.
    """
    own = tree / PLAN
    plan = yaml.safe_load((own if own.exists() else ROOT / PLAN).read_text())
    named = {name for trial in plan["trials"].values() for name in trial["targets"]}
    rest = [name for name in targets(tree) if name not in named]
    if taken := set(rest) & set(plan["trials"]):
        sys.exit(f"error: {PLAN}: trial {', '.join(sorted(taken))} does not name its target")
    plan["trials"] |= {name: {"targets": [name]} for name in rest}
    return plan


def keep(results, name, output):
    """Copy a trial's tables without what is measured, and renew its rows of the manifest."""
    shutil.rmtree(output / "tables" / name, ignore_errors=True)
    rows = []
    for folder in sorted(p for p in results.glob(f"{name}*") if _of_trial(p.name, name)):
        for path in sorted(folder.rglob("*")):
            where = path.relative_to(folder)
            if path.suffix not in KINDS or not path.is_file() or LEFT_OUT & {*where.parts}:
                continue
            text = comparable(path)
            copy = output / "tables" / name / folder.name / where
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_text(text)
            digest = hashlib.sha256(text.encode()).hexdigest()
            rows.append([name, str(copy.relative_to(output / "tables" / name)), digest])
    manifest = output / "manifest.csv"
    if manifest.exists():
        rows += [row for row in list(csv.reader(manifest.open()))[1:] if row[0] != name]
    with open(manifest, "w", newline="") as handle:
        csv.writer(handle).writerows([["trial", "file", "sha256"], *sorted(rows)])


def _of_trial(folder, name):
    return folder == name or folder.startswith(f"{name}-")


def comparable(path):
    """Text of a table or of a JSON file, without what is measured on the machine."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".csv":
        rows = list(csv.reader(io.StringIO(text)))
        drop = {i for i, word in enumerate(rows[0] if rows else []) if MEASURED.search(word)}
        out = io.StringIO()
        csv.writer(out, lineterminator="\n").writerows(
            [cell for i, cell in enumerate(row) if i not in drop] for row in rows
        )
        return out.getvalue()
    if path.suffix == ".json":
        return json.dumps(_unmeasured(json.loads(text)), indent=1, sort_keys=True) + "\n"
    return text


def _unmeasured(value):
    if isinstance(value, dict):
        return {k: _unmeasured(v) for k, v in value.items() if not MEASURED.search(k)}
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    return [_unmeasured(v) for v in value] if isinstance(value, list) else value


def compare(old, new, renamed=None):
    """Lines that tell what differs between two frozen states; none where nothing does.

    Parameters
    ----------
    old, new : Path
        Folders that `run` filled. Trials that only one of them has are left out.
    renamed : Path, optional
        Tab-separated table of words: old, new. Replaced as whole words in the old state's paths
        and tables before they are held against the new ones.
    """
    words = []
    if renamed:
        words = [line.split("\t") for line in renamed.read_text().splitlines() if "\t" in line]

    def translated(text):
        for before, after in words:
            text = re.sub(rf"(?<![A-Za-z0-9]){re.escape(before)}(?![A-Za-z0-9])", after, text)
        return text

    both = {row[0] for row in _manifest(old)} & {row[0] for row in _manifest(new)}
    before = {
        (trial, translated(name)): (old / "tables" / trial / name, digest)
        for trial, name, digest in _manifest(old)
        if trial in both
    }
    after = {
        (trial, name): (new / "tables" / trial / name, digest)
        for trial, name, digest in _manifest(new)
        if trial in both
    }
    lines = []
    for key in sorted({*before, *after}):
        label = "/".join(key)
        if key not in after:
            lines.append(f"{label}: no longer made")
        elif key not in before:
            lines.append(f"{label}: new")
        elif before[key][1] != after[key][1]:
            texts = translated(before[key][0].read_text()), after[key][0].read_text()
            if texts[0] != texts[1]:
                lines.append(f"{label}: {first_difference(*texts)}")
    return lines


def _manifest(folder):
    with open(folder / "manifest.csv", newline="") as handle:
        return list(csv.reader(handle))[1:]


def first_difference(old, new):
    """Where two texts part: the line, what stood there and what stands there now."""
    old, new = old.splitlines(), new.splitlines()
    count = sum(a != b for a, b in zip(old, new, strict=False)) + abs(len(old) - len(new))
    at = next(
        (i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b),
        min(len(old), len(new)),
    )
    was, now = (part[at][:160] if at < len(part) else "(end)" for part in (old, new))
    return f"{count} of {len(new)} lines differ, first line {at + 1}\n    - {was}\n    + {now}"


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    commands = parser.add_subparsers(dest="command", required=True)
    runs = commands.add_parser("run", help="run the trials and write the manifest")
    runs.add_argument("--tree", type=Path, default=ROOT, help="checkout (default: this one)")
    runs.add_argument("--revision", help="git revision to check out and run in place of --tree")
    runs.add_argument("--output", type=Path, required=True)
    runs.add_argument("--only", nargs="+", default=[], help="names of trials")
    runs.add_argument("--cores", type=int, default=2)
    runs.add_argument("--plan", type=Path, help="trials (default: those of the checkout)")
    held = commands.add_parser("compare", help="print what differs")
    held.add_argument("old", type=Path)
    held.add_argument("new", type=Path)
    held.add_argument("--renamed", type=Path)
    given = parser.parse_args()
    if given.command == "compare":
        lines = compare(given.old, given.new, given.renamed)
        print("\n".join(lines) or "no table differs")
        sys.exit(1 if lines else 0)
    output = given.output.resolve()
    if given.revision is None:
        failed = run(given.tree.resolve(), output, given.only, given.cores, given.plan)
    else:
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder, "tree")
            git = ["git", "-C", str(ROOT), "worktree"]
            subprocess.run([*git, "add", "--detach", str(tree), given.revision], check=True)
            try:
                failed = run(tree, output, given.only, given.cores, given.plan)
            finally:
                subprocess.run([*git, "remove", "--force", str(tree)], check=True)
    sys.exit(f"failed: {', '.join(failed)}" if failed else 0)


if __name__ == "__main__":
    main()
