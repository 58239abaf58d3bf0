"""Planning is light: the Snakefile is read by every command, before a first line appears."""

import subprocess
import sys
from pathlib import Path

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
