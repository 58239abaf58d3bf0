"""Run a function of a test-case module inside YADE's own Python, and bring its result back."""

import json
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = os.environ.get("YADE_PYTHON", "/usr/bin/python3")

LIMIT_S = 600.0

CALL = """
import importlib, json, sys
sys.path[:0] = [{root!r}, {tests!r}]
from yade_scripts.engine import lifeline
lifeline.follow()
case = importlib.import_module({module!r})
print("RESULT" + json.dumps(getattr(case, {function!r})(**json.load(sys.stdin))))
"""


def in_yade(module, function, **arguments):
    """Call a function of a module in tests/cases inside a YADE process; return its result."""
    code = CALL.format(
        root=str(ROOT), tests=str(ROOT / "tests" / "cases"), module=module, function=function
    )
    done = subprocess.run(
        [PYTHON, "-c", code],
        input=json.dumps(arguments),
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.rpartition("RESULT")[2])


NODES = {"nodes_thickness": 17, "nodes_height": 9, "nodes_per_block": 9, "step_fraction": 0.05}


def run_study(*words, folder=None):
    """Run a study as the workflow does, `run_study("ida", "--scene", …)`; return how it ended."""
    return subprocess.run(
        [PYTHON, ROOT / "yade_scripts", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )


def resolved(**sections):
    """Default configuration with some keys of some sections replaced; nodes and step stated."""
    from rocking.configuration import config

    numerics = {**NODES, **sections.pop("numerics", {})}
    return config.resolve({**sections, "numerics": numerics})
