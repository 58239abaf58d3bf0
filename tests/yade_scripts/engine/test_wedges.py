"""Wedges of the return walls as part of a façade's block, in both solvers."""

import math

import numpy as np
import pytest
from rocking.configuration.config import ConfigError
from rocking.mechanics.blocks import toppling
from test_parts import by_both, part, two_routes
from yade_process import resolved

from yade_scripts.model.models import build_scene
from yade_scripts.model.scene import to_json
from yade_scripts.model.shape import shape_of

WEDGES = {  # façade, model, factors on the record at which histories repeat, YADE's step
    "gentle": ({"wedge_deg": 3.0}, "W2", [0.2, 0.3], 0.05),
    "steep": ({"wedge_deg": 8.0, "thickness_m": 0.6}, "W1", [0.8, 1.0], 0.05),
    "weight behind its base": ({"wedge_deg": 22.0, "thickness_m": 0.5}, "W2", [1.0, 1.3], 0.1),
    "part on its building": (
        {"wedge_deg": 12.0, "base_height_m": 2.5, "height_m": 4.0, "gable_height_m": 1.0},
        "W2m",
        [0.3, 0.5],
        0.1,
    ),
}


def case_of(name, model=None, **numerics):
    facade, own, _, step = WEDGES[name]
    given = {"wedge_thickness_m": 0.75, **facade}
    return part(model or own, given, **{"step_fraction": step, **numerics})


def test_mass_centroid_and_inertia_are_those_of_cells():
    """A setback whose outer face runs through: the wedge goes back from each storey's face."""
    facade = resolved(
        facade={
            "wedge_deg": 10.0,
            "wedge_thickness_m": 0.8,
            "thickness_m": 0.5,
            "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.3}],
        }
    )["facade"]
    shape, cell = shape_of(facade), 0.01
    y, z = np.meshgrid(np.arange(-1.3, 0.5, cell) + cell / 2, np.arange(0.0, 6.48, cell) + cell / 2)
    back = np.where(z < 3.0, 0.0, 0.2)
    wall = (y > back) * facade["width_m"]
    wedge = ((y < back) & (y > back - z * math.tan(math.radians(10.0)))) * 0.8
    m = facade["density_kg_m3"] * cell**2 * (wall + wedge)
    mass, cy, cz = m.sum(), (m * y).sum() / m.sum(), (m * z).sum() / m.sum()
    assert shape.mass_kg == pytest.approx(mass, rel=2e-3)
    assert shape.centre_m[1:] == pytest.approx((cy, cz), rel=5e-3)
    about_x = (m * ((y - cy) ** 2 + (z - cz) ** 2)).sum()
    assert shape.tensor_kg_m2[0, 0] == pytest.approx(about_x, rel=2e-3)


@pytest.mark.parametrize("model", ["W1", "W2", "W2m"])
def test_a_vertical_crack_is_the_facade_without_a_wedge_to_the_digit(model):
    whole, none = (
        build_scene(part(model, own)) for own in ({}, {"wedge_deg": 0.0, "wedge_thickness_m": 0.7})
    )
    assert to_json(none) == to_json(whole)


def test_its_lever_is_that_of_the_hand_calculation():
    """Static multiplier b_g/z_g of the block against virtual work over wall and triangle."""
    facade = case_of("steep")["facade"]
    h, b, slope = facade["height_m"], facade["thickness_m"], math.tan(math.radians(8.0))
    wall, wedge = facade["width_m"] * b * h, 0.5 * 0.75 * h**2 * slope
    masses = [(wall, 0.5 * b, 0.5 * h), (wedge, -h * slope / 3.0, 2.0 * h / 3.0)]
    found = toppling("wedge", masses, (b, 0.0), (b, h))
    assert shape_of(facade).static_multiplier == pytest.approx(found.multiplier(), rel=1e-12)


@pytest.mark.parametrize("name", WEDGES)
def test_it_leans_on_its_crack(name):
    """Nodes behind it stand on the line of the crack; their normal is across it, into the block.

    Their area is that of the crack before the walls.
    """
    case = case_of(name, "W1")
    scene, deg = build_scene(case), case["facade"]["wedge_deg"]
    wall = [i for i, joint in enumerate(scene.joints) if joint.startswith("return wall")]
    mine = np.isin(scene.nodes.joint, wall)
    y, z = scene.nodes.position_m[mine, 1:].T
    assert y == pytest.approx(-z * math.tan(math.radians(deg)), abs=1e-12)
    along = np.array([-math.sin(math.radians(deg)), math.cos(math.radians(deg))])
    normal = scene.nodes.normal[mine, 1:]
    assert normal @ along == pytest.approx(0.0, abs=1e-12)
    assert np.all(normal > 0.0)
    wide = case["return_wall"]["count"] * case["return_wall"]["thickness_m"]
    long = case["facade"]["height_m"] / along[1]
    assert scene.nodes.area_m2[mine].sum() == pytest.approx(wide * long, rel=1e-9)


def test_stiffness_and_damping_by_two_routes():
    two_routes(case_of("part on its building"), "top")


@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.parametrize("name", WEDGES)
def test_yade_and_the_compiled_solver(monkeypatch, name):
    """Peaks within 1 % of each other under a recorded motion, where they repeat."""
    by_both(monkeypatch, case_of(name), WEDGES[name][2])


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"courses": 4}, "facade.courses = 4"),
        ({"sides": "two"}, "facade.sides"),
        ({"wedge_thickness_m": None}, "facade.wedge_thickness_m"),
        ({"cornices": [{"z_m": 5.0, "height_m": 1.4, "projection_m": 4.0}]}, "facade.cornices"),
    ],
)
def test_a_wedge_that_no_model_takes_is_refused_in_one_line(more, words):
    given = {"wedge_deg": 10.0, "wedge_thickness_m": 0.75, **more}
    with pytest.raises((ConfigError, ValueError)) as refused:
        shape_of(resolved(facade=given, models=["W1"])["facade"])
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)
