"""Run a function of a test-case module inside YADE's own Python, and bring its result back."""

import json
import os
from pathlib import Path

from forked import LIMIT_S, run
from forked import YADE_PYTHON as PYTHON

__all__ = ["LIMIT_S", "PYTHON", "ROOT", "in_yade", "resolved", "run_study"]

ROOT = Path(__file__).resolve().parents[2]


def in_yade(module, function, **arguments):
    """Call a function of a module in tests/cases inside a YADE process; return its result."""
    words = ("call", module, function)
    done = run(os.getcwd(), *words, python=PYTHON, given=json.dumps(arguments))
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.rpartition("RESULT")[2])


NODES = {"nodes_thickness": 17, "nodes_height": 9, "nodes_per_block": 9, "step_fraction": 0.05}


def run_study(*words, folder=None):
    """Run a study as the workflow does, `run_study("ida", "--scene", …)`; return how it ended."""
    return run(folder or os.getcwd(), "yade_scripts", *map(str, words), python=PYTHON)


def resolved(**sections):
    """The study's configuration with some keys of some sections replaced; nodes and step stated."""
    from study_cases import study_settings  # loads what examples run without

    numerics = {**NODES, **sections.pop("numerics", {})}
    return study_settings({**sections, "numerics": numerics})
