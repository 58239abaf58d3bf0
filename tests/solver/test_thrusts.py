"""Static thrusts and stretched rods: statics, and YADE against the solver."""

import math

import numpy as np
import pytest
from both_solvers import FEW, agreed, same_matrices
from rocking.configuration.config import ConfigError
from rocking.solver.plane import matrices, to_plane
from rocking.solver.runs import Motions, history
from study_cases import study_settings
from test_floors import floored, slow
from yade_process import resolved

from yade_scripts.model.holds import holds

STIFF = {"e_mpa": 1e5}
WEIGHT_N = 1800.0 * 9.81 * 6.48 * 0.375 * 4.4
THRUST = {"height_m": 6.0, "force_kn": 2.0}
ROD = {"height_m": 6.0, "count": 2, "diameter_mm": 12.0, "length_m": 4.0, "pretension_kn": 8.0}


def test_a_thrust_takes_its_moment_from_the_static_multiplier():
    """λ = [W b/2 − F z]/(W h/2): stands at 0.98 of it under a slow push, falls at 1.02."""
    expected = (WEIGHT_N * 0.1875 - 2e3 * 6.0) / (WEIGHT_N * 3.24)
    config, scene = floored(facade={**STIFF, "thrusts": [THRUST]}, numerics=FEW, models=["W1"])
    for share, status in ((0.98, "ok"), (1.02, "overturned")):
        t, pull = slow(share * expected * 9.81)
        found = history(to_plane(scene), Motions(t, -pull), config["numerics"], sample_s=0.01)
        assert found.status == status


def test_a_facade_starts_where_its_base_carries_the_thrust():
    """Left alone it stays where it is, to a hundredth of what it leans."""
    config, scene = floored(facade={"thrusts": [THRUST]}, numerics=FEW, models=["W1"])
    _, upright = floored(facade={}, numerics=FEW, models=["W1"])
    leans = -scene.blocks[1].rotation_rad[0]
    assert leans > 0.0 == upright.blocks[1].rotation_rad[0]
    still = np.zeros(200)
    motions = Motions(0.01 * np.arange(200.0), still)
    found = history(to_plane(scene), motions, config["numerics"], sample_s=0.01)
    first = leans * 6.48 / scene.thickness_m
    assert found.peak_d_over_b == pytest.approx(first, rel=0.01)


def test_a_stretched_rod_pulls_from_the_start():
    """2 rods of 12 mm and 4 m: 11.31 MN/m in all; 16 kN are 1.415 mm of slack less than none."""
    (hold,) = holds(resolved(facade={"ties": [ROD]})["facade"])
    area = 2 * math.pi / 4 * 0.012**2
    k = 2e11 * area / 4.0
    assert hold.stiffness_n_m == pytest.approx(k)
    assert hold.slack_m == pytest.approx(-16e3 / k)
    assert hold.reach_m == pytest.approx(0.05 * 4.0 - 16e3 / k)


def test_matrices_of_the_plane_are_those_of_the_scene():
    config, scene = floored(
        facade={"thrusts": [THRUST], "ties": [{**ROD, "height_m": 5.0}]},
        numerics=FEW,
        models=["W2"],
        model="W2",
    )
    same_matrices(scene, *matrices(to_plane(scene)))
    assert config["facade"]["thrusts"] == [THRUST]


SHAKEN = {"thrust": {"thrusts": [THRUST]}, "stretched rod": {"ties": [ROD]}}


@pytest.mark.yade
@pytest.mark.parametrize("name", SHAKEN)
def test_yade_and_the_compiled_solver(name):
    """Peak d/b within 1 %, and energy closes."""
    amplitude = {"thrust": 0.5, "stretched rod": 3.0}[name]
    config, scene = floored(facade=SHAKEN[name], numerics=FEW, models=["W2"], model="W2")
    agreed(config, scene, "W2", amplitude, 0.05)


@pytest.mark.parametrize(
    ("facade", "words"),
    [
        ({"thrusts": [{"height_m": 7.0, "force_kn": 1.0}]}, "thrusts[1].height_m = 7"),
        ({"thrusts": [{"height_m": 6.0, "force_kn": 90.0}]}, "facade.thrusts: the façade falls by"),
        ({"ties": [{**ROD, "slack_mm": 2.0}]}, "ties[1].slack_mm = 2"),
        ({"ties": [{**ROD, "pretension_kn": 50.0}]}, "ties[1].pretension_kn = 50"),
        ({"ties": [{**ROD, "x_m": [0.0]}]}, "ties[1].x_m: found 1 places; expected as many"),
        ({"ties": [{**ROD, "x_m": [0.0, 2.3]}]}, "ties[1].x_m = 2.3: expected within half of"),
        (
            {"floors": [{"height_m": 3.0, "load_kn": 5.0, "joists": "along"}]},
            "floors[1].load_kn = 5",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(facade, words):
    with pytest.raises(ConfigError) as refused:
        study_settings({"facade": facade, "models": ["W1"]})
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_floor_whose_joists_run_along_holds_nothing():
    given = resolved(facade={"floors": [{"height_m": 3.0, "joists": "along"}]})
    assert not holds(given["facade"])
