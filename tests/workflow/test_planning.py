"""Planning is light: the Snakefile is read by every command, before a first line appears."""

import subprocess
import sys
from pathlib import Path

from forked import snakemake as started

ROOT = Path(__file__).resolve().parents[2]
HEAVY = ("numba", "matplotlib", "scipy.optimize")
PLAN = """
import sys
from rocking.start import main
sys.argv = ["snakemake", "-n", "--quiet", "all"]
try:
    status = main()
except SystemExit as end:
    status = end.code
print("loaded:", *(name for name in {heavy} if name in sys.modules), file=sys.stderr)
sys.exit(status)
"""


def test_a_plan_loads_no_solver_and_no_plotting():
    """A rule that imports a constant from a module of physics costs every plan half a second."""
    done = subprocess.run(
        [sys.executable, "-c", PLAN.format(heavy=HEAVY)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert done.stderr.splitlines()[-1].strip() == "loaded:"


def test_a_check_of_yade_that_is_made_again_takes_along_what_is_missing(tmp_path):
    """Snakemake forgets a missing target behind an `ancient` input that another job makes.

    `ancient(rules.x.output[0])` marks the output of that rule for every rule that reads it.
    """

    own = ["models=[W1]", "records=[GMN_NS]", "directions=[pos]"]

    def snakemake(*words):
        done = started(tmp_path, "--config", *own, *words, snakefile="Snakefile")
        assert done.returncode == 0, done.stderr[-2000:]
        return done.stdout + done.stderr

    snakemake("--until", "facade_case", "floor_motions")
    (tmp_path / "results" / "main" / "yade.txt").write_text("of another time\n")
    plan = snakemake("-n", "--", "results/main/tables/ida_collapse.csv")
    assert {"yade_check", "ida", "ida_collapse"} <= {
        line.split(" ")[0] for line in plan.splitlines()
    }


def test_until_takes_rules_of_which_one_lies_behind_the_other(tmp_path):
    """Snakemake alone stops behind the first, with "BUG: Out of jobs ready to be started"."""
    own = ["models=[W1]", "records=[GMN_NS]", "directions=[pos]"]
    words = ["--config", *own, "--until", "record", "floor_motions"]
    for more in (["-n"], []):
        done = started(tmp_path, *words, *more, snakefile="Snakefile")
        assert done.returncode == 0, done.stderr[-2000:]
    made = {path.parent.name for path in (tmp_path / "results").rglob("GMN_NS*.csv")}
    assert made == {"records", "smdof"}  # nothing behind them
