"""Trials of faults: disturb a run, give the same command again, compare with an undisturbed run.

    .venv/bin/python tests/trials/faults/trials.py --trials 80 --seed 1 --output faults.csv

In pieces, `--trials 20` and then `--trials 40 --first 21` are the same trials; the table goes on.

Half of the trials start from an empty folder, half from one in which all but the incremental
dynamic analyses is done. A trial holds if the same command then completes, every file of the
results equals that of an undisturbed run (less the column wall_s, a measurement of the run
itself), no intensity that had been computed is computed again, and neither processes nor
temporary files are left. The table is written after every trial.
"""

import argparse
import csv
import io
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
if str(ROOT) not in sys.path:
    sys.path.insert(0, str(ROOT))

from tests.trials.faults import inject  # noqa: E402
from tests.trials.faults.workspace import OVERVIEW, RESULTS, Workspace, wait_until  # noqa: E402

COLUMNS = ("fault", "trial", "outcome", "detail")
HELD = "completed, results equal"


class Bench:
    """Reference results and prepared workspaces, made once.

    Parameters
    ----------
    folder : Path
    targets : tuple of str
        Of the second run, whose results are kept as "whole": those of the trials, and more.
    """

    def __init__(self, folder, targets=OVERVIEW):
        """Run the study undisturbed and keep what trials start from."""
        self.folder = Path(folder)
        self.kept = {}
        # always in the same place: Snakemake makes results again whose rules' files moved
        fresh = self._keep(Workspace(self.folder / "work").fill(), "fresh")
        self.seconds = {"fresh": self._timed(fresh, OVERVIEW)}
        self.reference = fresh.digests()
        for name in ("ida", "cache", "tables", "figures", "logs", "benchmarks"):
            shutil.rmtree(fresh.folder / RESULTS / name, ignore_errors=True)
        self._keep(fresh, "prepared")
        self.seconds["prepared"] = self._timed(fresh, targets)
        again = self._keep(fresh, "whole").digests()
        if targets != OVERVIEW:
            again = {name: digest for name, digest in again.items() if name in self.reference}
        if again != self.reference:
            raise SystemExit("error: two undisturbed runs differ")

    def _keep(self, space, name):
        self.kept[name] = Workspace(self.folder / name).copy_of(space)
        return space

    @staticmethod
    def _timed(space, targets):
        began = time.monotonic()
        status, text = space.run(targets=targets)
        if status:
            raise SystemExit(f"error: the undisturbed run failed\n{text[-3000:]}")
        return time.monotonic() - began

    def trial(self, fault, number, seed):
        """One trial: a row of the table."""
        rng = inject.generator(seed, number)
        start = rng.choice(["fresh", "prepared"])
        shutil.rmtree(self.folder / "work", ignore_errors=True)
        space = Workspace(self.folder / "work").copy_of(self.kept[start])
        try:
            detail = inject.FAULTS[fault](space, rng, self.seconds[start])
            outcome = self.aftermath(space, keep=fault not in inject.TAKES_ROWS)
            detail = f"{start}: {detail}"
        except (AssertionError, OSError, subprocess.SubprocessError) as error:
            outcome, detail = "FAILED", f"{start}: {type(error).__name__} {error}"
        finally:
            space.unmount()
        return dict(zip(COLUMNS, (fault, number, outcome, " ".join(detail.split())), strict=True))

    def aftermath(self, space, keep):
        """Give the same command again and compare; return what came out."""
        if not wait_until(lambda: not space.processes(), 20.0, 0.1):
            return f"FAILED: processes left: {list(space.processes().values())[0][:80]}"
        before = space.journal()
        status, text = space.run(log="again.log")
        if status:
            return f"FAILED: the same command ended with {status}: {text[-300:]}"
        digests = space.digests()
        if digests != self.reference:
            names = {
                n for n in {*digests, *self.reference} if digests.get(n) != self.reference.get(n)
            }
            kept = self.folder.parent / f"{self.folder.name}-failed-{len(names)}"
            shutil.copytree(space.folder / RESULTS, kept, dirs_exist_ok=True)
            return f"FAILED: differs in {', '.join(sorted(names))}; kept in {kept}"
        after = space.journal()
        lost = [key for key, row in before.items() if after.get(key) != row]
        if keep and lost:
            return f"FAILED: {len(lost)} finished runs were computed again"
        if space.leftovers():
            return f"FAILED: left behind {', '.join(space.leftovers()[:3])}"
        return HELD


def write_atomic_csv(rows, columns, path):
    """Write a table, whole or not at all."""
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.part")
    part.write_text(text.getvalue())
    os.replace(part, path)


def earlier_rows(path, first):
    """Rows of a table of trials before the first of this piece."""
    if first == 1 or not path or not Path(path).is_file():
        return []
    with open(path, newline="") as file:
        return [row for row in csv.DictReader(file) if int(row["trial"]) < first]


def run_trials(count, seed, output, faults=None, folder=None, say=print, first=1):
    """Run trials first to count of all faults in turn; write the table; return the rows."""
    faults = faults or inject.available()
    rows = earlier_rows(output, first)
    with tempfile.TemporaryDirectory(prefix="rocking-faults-", dir=folder) as top:
        bench = Bench(top)
        say(f"undisturbed: {bench.seconds['fresh']:.0f} s, {len(bench.reference)} files")
        for number in range(first, count + 1):
            row = bench.trial(faults[(number - 1) % len(faults)], number, seed)
            rows.append(row)
            if output:
                write_atomic_csv(rows, COLUMNS, output)
            say(f"{number}/{count} {row['fault']}: {row['outcome']} ({row['detail']})")
    return rows


def main():
    """Run the trials; exit status 1 if one did not hold."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trials", type=int, default=80)
    parser.add_argument("--first", type=int, default=1, help="number of the first trial")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", help="table to write (CSV)")
    parser.add_argument("--faults", nargs="*", choices=list(inject.FAULTS), help="only these")
    parser.add_argument("--folder", help="where to work (default: the system's temporary folder)")
    args = parser.parse_args()
    # started in the background, interrupts would be ignored here and in every run
    signal.signal(signal.SIGINT, signal.default_int_handler)
    rows = run_trials(
        args.trials,
        args.seed,
        args.output,
        args.faults,
        args.folder,
        lambda text: print(text, file=sys.stderr, flush=True),
        args.first,
    )
    return int(any(row["outcome"] != HELD for row in rows))


if __name__ == "__main__":
    sys.exit(main())
