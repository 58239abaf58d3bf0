"""Factors on links, columns of nodes along piers, static multipliers of bonded and brick models."""

import math

import numpy as np
import pytest
from study_cases import study_case, study_settings

from yade_scripts.model import facade, models, stiffness
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.shape import shape_of

PLAIN = {"height_m": 6.0, "thickness_m": 0.5, "width_m": 4.0, "density_kg_m3": 1800.0}


@pytest.mark.parametrize("dt_s", [0.0, 1e-4, 2e-3])
def test_a_link_is_softened_by_what_its_lagged_dashpot_adds(dt_s):
    """Of one mass on a spring: 1/(1 + Δt c/2m)."""
    floor = {"height_m": 3.0, "load_kn": 10.0, "mass_t": 8.0, "period_s": 0.4, "friction": 0.3}
    scene = models.build_scene(study_case("W1", {"facade.floors": [floor]}).sections)
    (link,) = scene.links
    mass = next(b.mass_kg for b in scene.blocks if b.name == link.name)
    assert mass == 8000.0
    expected = 1.0 / (1.0 + 0.5 * dt_s * link.dashpot_ns_m / mass)
    assert stiffness.link_factor(scene, dt_s) == pytest.approx(expected, rel=1e-9)
    bare = models.build_scene(study_case("W1").sections)
    assert stiffness.link_factor(bare, dt_s) == 1.0


@pytest.mark.parametrize("count", [2, 3, 5])
def test_columns_along_piers_carry_their_length_and_its_moments(count):
    strips = [(-2.0, -1.0), (1.0, 1.5)]
    places, weights = facade._columns(strips, count)
    assert weights.sum() == pytest.approx(1.0)
    assert places @ weights == pytest.approx((-1.5 * 1.0 + 1.25 * 0.5) / 1.5)
    assert places.min() == -2.0
    assert places.max() == 1.5
    if count > 2:
        second = (8.0 - 1.0 + 1.5**3 - 1.0) / 3.0 / 1.5
        assert places**2 @ weights == pytest.approx(second)


def test_piers_of_a_base_stand_between_its_doors_and_not_below_windows():
    rows = [
        {"x_m": -1.0, "z_m": 0.0, "width_m": 1.0, "height_m": 2.0},
        {"x_m": 1.0, "z_m": 1.0, "width_m": 1.0, "height_m": 1.0},
    ]
    section = study_settings({"facade": {**PLAIN, "openings": rows}})["facade"]
    shape = shape_of(section)
    assert np.array(shape.base_strips) == pytest.approx(np.array([(-2.0, -1.5), (-0.5, 2.0)]))
    assert shape.base_lost_m == pytest.approx(1.0)


H = 6.48  # of whole courses


def case(model):
    wall = {"thickness_m": 0.3, "count": 2, "tension_mpa": 0.05}
    given = {"facade": {**PLAIN, "height_m": H}, "return_wall": wall, "models": [model]}
    return {**study_settings(given), "model": model}


def test_static_multipliers_of_free_bonded_and_brick_facades():
    """b/h; with the bond f t_s h²/3 a wall; with the friction of courses at h − i h_b."""
    assert models.static_multiplier(case("W1")) == pytest.approx(0.5 / H)
    bonded, bricks = case("W1c"), case("W3")
    weight = 1800.0 * GRAVITY_M_S2 * H * 0.5 * 4.0
    wall = bonded["return_wall"]
    bond = 2 * wall["tension_mpa"] * 1e6 * 0.3 * H**2 / 3.0
    assert models.static_multiplier(bonded) == pytest.approx(0.5 / H + bond / (0.5 * weight * H))
    w3 = bricks["w3"]
    course, friction = w3["course_height_m"], math.tan(math.radians(w3["friction_deg"]))
    each = friction * 1800.0 * GRAVITY_M_S2 * 0.3 * w3["overlap_m"] * course
    moment = 2 * sum(each * i * (H - i * course) for i in range(1, round(H / course)))
    assert models.static_multiplier(bricks) == pytest.approx(0.5 / H + moment / (0.5 * weight * H))
