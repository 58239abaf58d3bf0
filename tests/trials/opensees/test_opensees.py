"""One short history in OpenSees, where a Python that has it is named; see `run.py`."""

import importlib.util
import os
import sys

import numpy as np
import pytest
from both_solvers import pulses
from reference_solver.stack import StackSolver

from tests.trials.opensees import run
from yade_scripts.model.models import build_scene

PYTHON = os.environ.get("OPENSEES_PYTHON") or (
    sys.executable if importlib.util.find_spec("openseespy") else None
)


@pytest.mark.slow
@pytest.mark.skipif(not PYTHON, reason="openseespy is not installed, OPENSEES_PYTHON not set")
def test_a_pulse_moves_a_block_as_the_reference_solver_says():
    """W1 in one block: spring, dashpot across, friction; peaks within 1 %."""
    scene = build_scene(run.case_of("W1", 0).sections)
    time_s, ground = pulses(0.8)
    how = {"factor": 1.0, "dt_s": 2.5e-4, "end_s": 2.4}
    found = run.in_opensees(PYTHON, scene, time_s, {"ground": ground}, **how)
    solver = StackSolver(run.without_drag(scene), time_s, {"ground": ground}, keeps=True)
    expected = solver.peaks([1.0], until_s=2.4).d_over_b[0]
    assert expected > 0.1
    assert found["d_over_b"] == pytest.approx(expected, rel=0.01)


def test_a_scene_without_drag_has_no_dashpot_along_its_joints():
    """And all else as before."""
    scene = build_scene(run.case_of("W2m", 0).sections)
    bare = run.without_drag(scene)
    assert scene.nodes.along.any()
    assert not bare.nodes.along.any()
    for name, column in vars(scene.nodes).items():
        same = np.array_equal(getattr(bare.nodes, name), column)
        assert same != (name == "drag")
