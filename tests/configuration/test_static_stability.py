"""A façade that cannot stand on its own base is refused when the configuration is read."""

from dataclasses import replace

import numpy as np
import pytest
from rocking.configuration.config import ConfigError
from rocking.configuration.static_stability import restoring, stands
from rocking.mechanics.closed_forms import tip_over_compliant_base
from rocking.solver import Motions, history, to_plane
from study_cases import study_settings

from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.models import build_scene
from yade_scripts.model.stiffness import assemble

NODES = {"nodes_thickness": 9, "nodes_height": 5, "nodes_per_block": 5}
SOFT = {"base_stiffness_pa_m": 3e7}  # a plain façade stands on it up to 6.31 m


def case(height_m, **facade):
    """A configuration of W1 that is not checked."""
    config = study_settings({"numerics": NODES, "models": ["W1"]})
    return {**config, "facade": {**config["facade"], "height_m": height_m, **facade}}


def highest(low, high, **facade):
    """Height up to which `stands` says that a façade stands [m]."""
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stands(case(middle, **facade)) else (low, middle)
    return low


@pytest.mark.parametrize(
    ("facade", "expected"),
    [
        ({}, (1.8e9 * 0.375**2 / (6 * 1800 * GRAVITY_M_S2)) ** (1 / 3)),
        ({"thickness_m": 0.12}, (1.8e9 * 0.12**2 / (6 * 1800 * GRAVITY_M_S2)) ** (1 / 3)),
        (SOFT, 0.375 * (3e7 / (6 * 1800 * GRAVITY_M_S2)) ** 0.5),
    ],
)
def test_height_that_a_plain_facade_stands_up_to(facade, expected):
    assert highest(1.0, 40.0, **facade) == pytest.approx(expected, rel=1e-4)


def test_margin_is_the_static_tip_over_on_a_compliant_base():
    _, multiplier = tip_over_compliant_base(6.48, 0.375, 1800.0, 1.8e9 / 6.48)
    assert restoring(case(6.48)) == pytest.approx(multiplier, rel=1e-3)


@pytest.mark.parametrize("height_m", [3.0, 6.0])
def test_a_tie_rights_by_its_force_times_its_height(height_m):
    """On a rigid base, turned by θ until its rods yield: [W (b/2 − θ h/2) + F z]/(W h/2)."""
    tie = {"height_m": height_m, "count": 2, "diameter_mm": 16.0, "length_m": 4.0}
    config = study_settings({"numerics": NODES, "models": ["W1"], "facade": {"ties": [tie]}})
    config = {**config, "facade": {**config["facade"], "base_stiffness_pa_m": 1e13}}
    f = config["facade"]
    (row,), b, h = f["ties"], f["thickness_m"], f["height_m"]
    weight = f["density_kg_m3"] * GRAVITY_M_S2 * h * b * f["width_m"]
    force = 2 * np.pi * 8.0**2 * row["yield_mpa"]
    strain = row["yield_mpa"] / row["e_mpa"]
    turn = (4.0 * strain + 1e-3 * row["slack_mm"]) / height_m
    expected = (weight * (0.5 * b - 0.5 * turn * h) + force * height_m) / (weight * 0.5 * h)
    assert restoring(config) == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("facade", [SOFT, {**SOFT, "gable_height_m": 1.5}])
def test_stiffness_less_that_of_gravity_changes_sign_where_the_facade_stops_standing(facade):
    limit = highest(1.0, 40.0, **facade)
    lowest = []
    for factor in (0.999, 1.001):
        scene = build_scene({**case(factor * limit, **facade), "model": "W1", "beta_s": 0.0})
        block = scene.blocks[1]
        base = scene.nodes.joint == scene.joints.index("base")  # the walls do not hold it
        nodes = type(scene.nodes)(*(column[base] for column in vars(scene.nodes).values()))
        stiffness, _ = assemble(replace(scene, nodes=nodes)).dense()
        turning = 2  # y, z and the rotation about x
        stiffness[turning, turning] -= block.mass_kg * GRAVITY_M_S2 * block.centre_m[2]
        lowest.append(np.linalg.eigvalsh(stiffness)[0])
    assert lowest[0] > 0.0 > lowest[1]


def left_alone(config, seconds=40.0):
    """Largest d/b after a push of a hundredth of a millimetre a second."""
    plane = to_plane(build_scene({**config, "model": "W1", "beta_s": 0.002}))
    time = np.linspace(0.0, 1.0, 101)
    push = Motions(time, -5e-4 * np.sin(np.pi * time) ** 2)
    numerics = {**config["numerics"], "after_motion_s": seconds, "rest_time_s": seconds}
    found = history(plane, push, numerics)
    return found.status, found.peak_d_over_b


@pytest.mark.slow
def whole(key, rows):
    """Rows of the façade with what they leave open."""
    return study_settings({"facade": {key: rows}})["facade"][key]


@pytest.mark.parametrize(
    "facade",
    [
        SOFT,
        {**SOFT, "floors": [{"height_m": 5.0, "load_kn": 30.0, "arm_m": None, "friction": 0.0}]},
        {**SOFT, "ties": [{"height_m": 5.0, "count": 1, "diameter_mm": 2.0}]},
        {**SOFT, "hinges_m": [3.0]},
    ],
)
def test_solver_agrees(facade):
    named = {
        key: study_settings({"facade": {key: value}})["facade"][key]
        if isinstance(value, list)
        else value
        for key, value in facade.items()
    }
    limit = highest(5.1, 40.0, **named)
    (low, calm), (high, far) = (left_alone(case(f * limit, **named)) for f in (0.97, 1.03))
    assert (low, high) == ("ok", "overturned")
    assert calm < 0.05 < far


def test_refused_in_one_line_with_the_height_that_stands():
    with pytest.raises(ConfigError, match=r"facade.height_m = 15: expected at most 13.36 \(m\)"):
        study_settings({"facade": {"height_m": 15.0}})
    with pytest.raises(ConfigError, match=r"facade.tilt_deg = 2: expected at most 1.7 \(°\)"):
        study_settings({"facade": {"tilt_deg": 2.0}})
    study_settings({"facade": {"height_m": 13.3}})
    study_settings({"facade": {"height_m": 15.0, "ties": [{"height_m": 12.0}]}, "models": ["W1"]})
    with pytest.raises(ConfigError, match="facade.height_m"):
        study_settings({"facade": {"height_m": 13.0, "gable_height_m": 3.0}})
    bent = {
        "hinges_m": "weakest",
        "floors": [{"height_m": 40.0, "load_kn": 50.0}],
        "thickness_m": 0.2,
    }
    with pytest.raises(ConfigError, match="facade.height_m"):
        study_settings({"facade": {"height_m": 40.0, **bent}, "models": ["W1"]})


def test_all_that_has_a_height_grows_with_the_facade_that_is_asked_for():
    """A cornice at the top stays below it: the refusal names the height that stands."""
    cornice = {"z_m": 6.8, "height_m": 0.2, "projection_m": 0.1}
    with pytest.raises(ConfigError, match=r"facade.height_m = 7: expected at most 6\.\d+ \(m\)"):
        study_settings(
            {"facade": {"height_m": 7.0, **SOFT, "cornices": [cornice]}, "models": ["W1"]}
        )
