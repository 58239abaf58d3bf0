"""Loads and shapes that few façades have, against sums and integrals by hand."""

from dataclasses import replace

import numpy as np
import pytest
from study_cases import study_settings

from yade_scripts.model import models, part
from yade_scripts.model.facades import Facade
from yade_scripts.model.floors import lever_of
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.scene import Block
from yade_scripts.model.shape import shape_of
from yade_scripts.model.ties import anchor_ties

PLAIN = {"height_m": 6.0, "thickness_m": 0.5, "width_m": 4.0, "density_kg_m3": 1800.0}


def section(**own):
    models = ["W1"] if own.get("sides") == "two" else ["W1", "W2"]
    return study_settings({"facade": {**PLAIN, **own}, "models": models})["facade"]


@pytest.mark.parametrize(
    ("row", "arm_m"),
    [
        ({"bearing": "point", "arm_m": None}, 0.25),
        ({"bearing": "point", "arm_m": 0.1}, 0.1),
        ({"bearing": "flat", "arm_m": None}, 0.5),
    ],
)
def test_a_load_bears_on_the_middle_if_nothing_is_said_and_a_level_one_on_the_outer_edge(
    row, arm_m
):
    floor = {"height_m": 6.0, "load_kn": 10.0, **row}
    (given,) = Facade.of(section(floors=[floor])).floors
    assert lever_of(given, 0.5) == arm_m


def test_the_back_face_after_a_setback_is_that_of_the_storey_above():
    """Flush outside, 0.5 m to 3 m and 0.3 m above: the back lies at 0 and at 0.2 m."""
    shape = shape_of(section(thickness_steps=[{"z_m": 3.0, "thickness_m": 0.3}]))
    walls = [(-2.0, -1.7), (1.7, 2.0)]
    found = shape.back_parts(1.0, 5.0, walls)
    places = np.array([row[:3] for row in found])
    assert places == pytest.approx(np.array([(1.0, 2.0, 0.0), (3.0, 3.0, 0.2)]))
    assert [strips for *_, strips in found] == [walls, walls]


def test_an_opening_in_front_of_a_wall_takes_its_width_over_its_own_height_alone():
    door = {"x_m": 1.7, "z_m": 1.0, "width_m": 0.2, "height_m": 2.0}
    found = shape_of(section(openings=[door])).back_parts(0.0, 6.0, [(-2.0, -1.7), (1.7, 2.0)])
    expected = [(0.0, 1.0, 0.0, 0.0), (1.0, 2.0, 0.0, 0.1), (3.0, 3.0, 0.0, 0.0)]
    assert np.array([row[:4] for row in found]) == pytest.approx(np.array(expected))


def test_a_gable_has_the_moments_of_its_own_points():
    """A gable by itself against a sum over a fine grid of it."""
    width, height, thick, n = 3.0, 2.6, 1.2, 100
    own = {"width_m": width, "height_m": height, "thickness_m": thick}
    shape = shape_of(section(outline="triangle", sides="two", **own))
    middles = (np.arange(n) + 0.5) / n
    x, y, z = np.meshgrid(width * (middles - 0.5), thick * middles, height * middles)
    inside = np.abs(x) < 0.5 * width * (1.0 - z / height)
    points = np.stack([x[inside], y[inside], z[inside]])
    mass = 1800.0 * 0.5 * width * height * thick
    assert shape.mass_kg == pytest.approx(mass)
    centre = points.mean(axis=1)
    assert shape.centre_m == pytest.approx(centre, rel=1e-2, abs=1e-9)
    squares = mass * np.mean((points - centre[:, None]) ** 2, axis=1)
    moments = squares.sum() - squares
    assert np.diag(shape.tensor_kg_m2) == pytest.approx(moments, rel=1e-2)


NEAR = ((2.95, 3.0), (3.02, 5.0), (3.3, 7.0), (6.0, 11.0))


def test_what_lies_above_a_held_level_bears_on_the_part_below_once():
    """Floors just below, just above (of that level), and above the level that holds.

    The sum of what bears on the part is the weight of the masonry above and every floor once.
    """
    whole = section(
        floors=[{"height_m": z, "load_kn": kn, "arm_m": 0.2} for z, kn in NEAR],
        openings=[{"x_m": 0.0, "z_m": 2.5, "width_m": 1.0, "height_m": 1.5}],
        gable_height_m=2.0,
    )
    below = part.part_of(whole, 0.0, 3.0, 1.5)
    masonry = 1800.0 * GRAVITY_M_S2 * 0.5 * (3.0 * 4.0 - 1.0 + 0.5 * 2.0 * 4.0)
    total = sum(row["load_kn"] for row in below["floors"])
    assert total == pytest.approx(26.0 + 1e-3 * masonry, rel=1e-9)
    # the resultant of masonry in the middle, 0.25 m, and 18 kN at 0.2 m
    (above,) = (row for row in below["floors"] if row["load_kn"] > 50.0)
    arm = (1e-3 * masonry * 0.25 + 18.0 * 0.2) / above["load_kn"]
    assert above["load_kn"] == pytest.approx(1e-3 * masonry + 18.0)
    assert above["arm_m"] == pytest.approx(arm, rel=1e-9)
    assert above["height_m"] == 3.0


def test_bricks_take_their_own_step_and_scenes_by_hand_the_stated_one():
    case = {"numerics": {"step_fraction": 0.3}, "w3": {"step_fraction": 0.1}}
    steps = [models.numerics({**case, "model": name})["step_fraction"] for name in ("W1", "W3")]
    assert steps == [0.3, 0.1]
    assert models.numerics({**case, "scene": {}})["step_fraction"] == 0.3


def test_openings_side_by_side_and_one_above_the_other_keep_apart():
    """Edges that touch are apart; a centimetre into another, along and up, is not."""
    first = {"x_m": -0.5, "z_m": 1.0, "width_m": 1.0, "height_m": 1.5}
    assert shape_of(section(openings=[first])).openings == ((-1.0, 0.0, 1.0, 2.5),)
    for second in ({"x_m": 0.5}, {"x_m": -1.5}, {"z_m": 2.5}, {"z_m": 2.5, "x_m": 0.3}):
        shape_of(section(openings=[first, {**first, **second}]))
        shape_of(section(openings=[{**first, **second}, first]))
    for second in ({"x_m": 0.49}, {"x_m": -1.49}, {"z_m": 2.49}):
        for rows in ([first, {**first, **second}], [{**first, **second}, first]):
            with pytest.raises(ValueError, match="apart from facade.openings"):
                shape_of({**section(), "openings": rows})


def test_anchors_of_a_floor_with_a_mass_are_no_ties_of_their_own():
    """They join the façade to that mass; without one they hold it to the wall behind, or the base.

    To the base each has a second tie, to the other side.
    """
    floor = {"height_m": 3.0, "load_kn": 10.0, "anchor_kn": 5.0, "arm_m": 0.1}
    (row,) = Facade.of(section(floors=[floor])).floors
    shape = shape_of(section())
    wall = Block("wall", (0.0, -1.0, 3.0), (1.0, 2.0, 6.0), 1.0, (1.0,) * 3)
    base = Block("base", (0.0, 0.0, -0.5), (1.0, 1.0, 1.0), 1.0, (1.0,) * 3)
    blocks = [base, wall, wall]  # of which the second stands for the façade
    names = [tie.name for tie in anchor_ties([row], [2], blocks, shape)]
    assert names == ["anchor 1"]
    names = [tie.name for tie in anchor_ties([row], [], blocks, shape)]
    assert names == ["anchor 1", "anchor 1 inward"]
    assert anchor_ties([replace(row, mass_t=5.0)], [2], blocks, shape) == []
    assert anchor_ties([replace(row, anchor_kn=0.0)], [2], blocks, shape) == []
