"""Loads that lie level or on a point, with vertical inertia or none; a bond of base and hinge."""

import numpy as np
import pytest
from rocking.configuration.config import ConfigError
from rocking.solver import Motions, history, to_plane
from study_cases import study_settings
from yade_process import in_yade, resolved

from yade_scripts.model.models import build_scene
from yade_scripts.model.stiffness import modes

TOP = {
    "height_m": 2.6,
    "load_kn": 10.0,
    "friction": 0.0,
    "anchor_kn": 1000.0,
    "stiffness_kn_m": 2e5,
}
WALL = {
    "height_m": 2.6,
    "thickness_m": 0.21,
    "width_m": 1.3,
    "e_mpa": 600.0,
    "sides": "two",
    "hinges_m": [1.6],
}
READINGS = {
    "level, with inertia": ({"bearing": "flat"}, {}),
    "level, without": ({"bearing": "flat", "load_inertia": False}, {}),
    "may turn, with inertia": ({"bearing": "point", "load_inertia": True}, {}),
    "may turn, without": ({"bearing": "point"}, {}),
    "level, bonded": ({"bearing": "flat"}, {"bond_tension_mpa": 0.02, "bond_cohesion_mpa": 0.2}),
}


def wall(floor, facade=()):
    """A case of the wall held at foot and top."""
    section = {**WALL, **dict(facade), "floors": [{**TOP, **floor}]}
    numerics = {"nodes_thickness": 9, "after_motion_s": 0.3}
    return {
        **resolved(models=["W1"], facade=section, numerics=numerics),
        "model": "W1",
        "beta_s": 1.5e-3,
    }


def shaken(peak_g, length_s=1.6):
    t = np.arange(0.0, length_s, 0.004)
    return t, peak_g * 9.81 * np.sin(2 * np.pi * 2.5 * t) * np.sin(np.pi * t / length_s)


def peak(case, peak_g):
    t, ground = shaken(peak_g)
    plane = to_plane(build_scene(case))
    return history(plane, Motions(t, ground), case["numerics"], sample_s=0.01).peak_d_over_b


@pytest.mark.yade
@pytest.mark.parametrize("name", READINGS)
def test_yade_and_the_compiled_solver(name):
    """Peak d/b of every reading within 1 %, each at the step of its own long runs."""
    case, (t, ground) = wall(*READINGS[name]), shaken(0.5)
    found = peak(case, 0.5)
    got = in_yade(
        "accuracy_cases", "shaken", config=case, model="W1", beta_s=case["beta_s"], fraction=0.2,
        time_s=t.tolist(), columns={"ground": ground.tolist()},
    )  # fmt: skip
    assert found > 0.01
    assert found == pytest.approx(got["peak"], rel=0.01)


def test_inertia_of_the_load_does_not_matter_where_nothing_lifts():
    """Weak shaking: the elastic answer of a wall does not raise its load; bearings differ."""
    found = {name: peak(wall(*READINGS[name]), 0.02) for name in READINGS}
    assert found["level, without"] == pytest.approx(found["level, with inertia"], rel=0.01)
    assert found["may turn, with inertia"] == pytest.approx(found["may turn, without"], rel=0.01)


def test_a_bond_holds_until_it_breaks():
    """Elastic as the dry wall while nothing opens; a strong one never opens, a weak one is dry."""
    dry = wall({"bearing": "flat"})
    strong = wall({"bearing": "flat"}, {"bond_tension_mpa": 10.0, "bond_cohesion_mpa": 10.0})
    weak = wall({"bearing": "flat"}, {"bond_tension_mpa": 1e-4, "bond_cohesion_mpa": 1e-4})
    first = modes(build_scene(dry))[0][0]
    assert modes(build_scene(strong))[0][0] == pytest.approx(first, rel=1e-9)
    open_dry, bound = peak(dry, 0.6), peak(strong, 0.6)
    assert bound < 0.5 * open_dry
    assert peak(weak, 0.6) == pytest.approx(open_dry, rel=0.1)


def test_a_bonded_base_is_refused_where_it_starts_open():
    with pytest.raises(ConfigError, match=r"facade.tilt_deg = 0.5: expected 0 \(°\) with a bond"):
        study_settings({"facade": {"tilt_deg": 0.5, "bond_tension_mpa": 0.1}})


def test_a_load_with_inertia_lies_on_the_top():
    with pytest.raises(ConfigError, match="load_inertia = true: expected height_m"):
        wall({"height_m": 2.0, "load_inertia": True})
