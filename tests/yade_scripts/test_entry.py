"""The entry to what runs inside YADE."""

import os
import subprocess

from forked import ROOT, YADE_PYTHON


def test_by_hand_too_the_linear_algebra_has_one_thread():
    environment = {k: v for k, v in os.environ.items() if "NUM_THREADS" not in k}
    words = "import os, yade_scripts.__main__; print(os.environ['OPENBLAS_NUM_THREADS'])"
    told = subprocess.run(
        [YADE_PYTHON, "-c", words],
        cwd=ROOT,
        env={**environment, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert told.stdout.strip() == "1"


def test_another_python_is_one_line():
    """`python3` may be somebody's own, without what YADE comes with."""
    words = "import sys; sys.modules['numpy'] = None; from yade_scripts.__main__ import main"
    done = subprocess.run(
        [YADE_PYTHON, "-c", f"{words}; sys.exit(main(['view']))"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert line.startswith("error: ")
    assert line.endswith("has no numpy: expected the system's Python, /usr/bin/python3")
