"""Anchors that end: one description of what holds, its statics, and YADE against the solver."""

import math

import numpy as np
import pytest
from both_solvers import FEW, agreed, pulses, same_matrices
from rocking.configuration.config import ConfigError
from rocking.configuration.static_stability import restoring
from rocking.solver.plane import matrices, to_plane
from rocking.solver.runs import Motions, history
from study_cases import study_settings
from test_floors import floored
from yade_process import resolved

from yade_scripts.model.holds import holds
from yade_scripts.model.stiffness import assemble

ANCHORED = {"height_m": 6.48, "load_kn": 20.0, "friction": 0.2, "anchor_kn": 12.0}


def test_what_holds():
    """By hand: a row of rods, friction and anchors of a floor, and of one with a mass of its own.

    2φ16 of 4 m: 2·2e11·201.06e-6/4 = 20.106 MN/m, 94.50 kN, 5 mm slack and 0.2 m after it. A mass
    of 2 t with T = 0.2 s stands on 1.9739 MN/m, and behind 20 MN/m on 1.7966 MN/m, of which
    friction of 4 kN has a quarter, the anchors' 12 kN three.
    """
    tie = {"height_m": 6.0, "count": 2, "diameter_mm": 16.0, "length_m": 4.0, "slack_mm": 5.0}
    own = {"mass_t": 2.0, "period_s": 0.2, "height_m": 3.0}
    bare = {"height_m": 2.0, "load_kn": 20.0, "friction": 0.0}
    facade = {"ties": [tie], "floors": [{**ANCHORED, "anchor_reach_m": 0.1}]}
    facade["floors"] += [{**ANCHORED, **own}, bare]
    found = holds(resolved(facade=facade)["facade"])
    expected = [
        ("tie", 6.0, 20.106e6, 94.50e3, 0.005, 0.205),
        ("friction", 6.48, 20e6, 4e3, 0.0, math.inf),
        ("anchor", 6.48, 20e6, 12e3, 0.0, 0.1),
        ("friction", 3.0, 0.25 * 1.7966e6, 4e3, 0.0, math.inf),
        ("anchor", 3.0, 0.75 * 1.7966e6, 12e3, 0.0, math.inf),
    ]
    assert [hold[0] for hold in found] == [hold[0] for hold in expected]
    for one, other in zip(found, expected, strict=True):
        assert one[1:] == pytest.approx(other[1:], rel=1e-4)


ALONE = {"height_m": 6.0, "anchor_kn": 12.0}


@pytest.mark.parametrize("sides", ["one", "two"])
def test_anchors_that_hold_are_friction_that_holds(sides):
    """Before it slides either is the spring k, of a free-standing façade both ways."""
    t, ground = pulses(0.8)
    rows = {"friction": 10.0, "anchor_kn": 0.0}, {"friction": 0.0, "anchor_kn": 200.0}
    found = []
    for row in rows:
        floor = {"height_m": 6.48, "load_kn": 20.0, **row}
        given = {"sides": sides, "hinges_m": [3.6]}
        config, scene = floored(floor, facade=given, numerics=FEW, models=["W1"])
        motions = Motions(t, ground)
        found.append(history(to_plane(scene), motions, config["numerics"], sample_s=0.0))
    friction, anchors = found
    assert friction.peak_d_over_b > 0.01
    if sides == "two":  # friction holds inward too, where return walls do it else
        assert anchors.d_m == pytest.approx(friction.d_m, abs=1e-6 * np.abs(friction.d_m).max())
    assert anchors.peak_d_over_b == pytest.approx(friction.peak_d_over_b, rel=0.01)


@pytest.mark.parametrize(("sides", "model"), [("one", "W2"), ("two", "W1")])
def test_matrices_of_the_plane_are_those_of_the_scene(sides, model):
    """Anchors count once, with k at their height: of a pair one is taut."""
    config, scene = floored(ALONE, model=model, facade={"sides": sides}, models=[model])
    assert len(scene.ties) == {"one": 1, "two": 2}[sides]
    assert not scene.floors
    mass, k, c = matrices(to_plane(scene))
    same_matrices(scene, mass, k, c)
    row = np.array([1.0, 0.0, -(ALONE["height_m"] - 0.5 * config["facade"]["height_m"])])
    _, bare = floored(model=model, facade={"sides": sides}, models=[model])
    gain = k - assemble(bare).dense()[0]
    assert gain == pytest.approx(2e7 * np.outer(row, row), rel=1e-9, abs=20.0)


SHAKEN = {  # the anchors' reach, how many of them are lost
    "lost": ("one", "W2", 0.03, 1.6, 1),
    "kept": ("one", "W2", 0.2, 1.6, 0),
    "lost to one side": ("two", "W1", 0.03, 1.8, 1),
}


@pytest.mark.yade
@pytest.mark.parametrize("name", SHAKEN)
def test_yade_and_the_compiled_solver(name):
    """Peak d/b within 1 %, energy closes; a lost anchor took F r − F²/2k at least."""
    sides, model, reach, amplitude, lost = SHAKEN[name]
    floor = {**ALONE, "anchor_reach_m": reach}
    own = {"model": model, "facade": {"sides": sides}, "models": [model]}
    config, scene = floored(floor, numerics=FEW, **own)
    planar, got = agreed(config, scene, model, amplitude, 0.05)
    assert planar.broken == lost
    if lost:
        taken = 12e3 * reach - 0.5 * 12e3**2 / 2e7
        assert got["last"][7] == pytest.approx(taken, rel=5e-3) or sides == "two"
        assert got["last"][7] > 0.995 * taken


def test_anchors_that_end_too_soon():
    """One line; and what ends before a façade leans back holds nothing up."""
    floor = {**ALONE, "anchor_reach_m": 0.0005}
    with pytest.raises(
        ConfigError, match=r"floors\[1\].anchor_reach_m = 0.0005: expected at least"
    ):
        study_settings({"facade": {"floors": [floor]}, "models": ["W1"]})
    heights = {"height_m": 15.0, "floors": [{**ALONE, "height_m": 12.0, "anchor_kn": 100.0}]}
    config = resolved(facade=heights, models=["W1"])
    (row,) = config["facade"]["floors"]
    found = [
        restoring({**config, "facade": {**config["facade"], "floors": [{**row, **end}]}})
        for end in ({}, {"anchor_reach_m": 0.0051})
    ]
    assert found[0] > found[1] > 0.0
