"""A part of a façade as a façade of its own: what it weighs, where it stands, what holds it."""

import numpy as np
import pytest
from rocking import Case
from rocking.assessment.family import Family
from rocking.configuration import config

from yade_scripts.model.part import part_of
from yade_scripts.model.shape import shape_of

FACADE = {
    "height_m": 8.0,
    "thickness_m": 0.6,
    "width_m": 7.5,
    "gable_height_m": 2.0,
    "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.5}, {"z_m": 5.5, "thickness_m": 0.4}],
    "openings": [
        {"x_m": -2.0, "z_m": 1.0, "width_m": 1.0, "height_m": 1.6},
        {"x_m": 1.5, "z_m": 4.0, "width_m": 1.2, "height_m": 2.0},
    ],
    "ties": [{"height_m": 6.0}, {"height_m": 7.8}],
    "floors": [{"height_m": 4.0, "load_kn": 20.0, "anchor_kn": 10.0, "arm_m": 0.1}],
}


@pytest.fixture(scope="module")
def resolved():
    return config.resolve({"facade": FACADE})


@pytest.mark.parametrize("foot_m", [1.0, 3.0, 4.5, 6.0])
def test_a_part_has_the_static_multiplier_of_its_mechanism(resolved, foot_m):
    """Boxes and prism of the part's shape against Gauss points over the façade's masonry."""
    bare = {**resolved["facade"], "ties": [], "floors": []}
    part = part_of(bare, foot_m)
    hand = Family({**resolved, "facade": bare}).part(foot_m, "").mechanism
    assert shape_of(part).static_multiplier == pytest.approx(hand.multiplier(), rel=1e-9)
    assert shape_of(part).top_m == pytest.approx(10.0 - foot_m)
    assert part["base_height_m"] == foot_m
    assert part["building_height_m"] == 8.0


def test_holds_loads_and_openings_count_from_the_foot(resolved):
    part = part_of(resolved["facade"], 5.0)
    assert [row["height_m"] for row in part["ties"]] == [1.0, 2.8]
    assert part["floors"] == []
    assert part["thickness_m"] == 0.5
    assert part["thickness_steps"] == [{"z_m": 0.5, "thickness_m": 0.4}]
    (window,) = part["openings"]
    assert (window["z_m"], window["height_m"]) == (0.0, 1.0)  # what the foot leaves of it
    at_tie = part_of(resolved["facade"], 6.0)
    assert [row["height_m"] for row in at_tie["ties"]] == [1.8]


def test_a_gable_and_a_parapet_rock_alone(resolved):
    gable = part_of(resolved["facade"], 8.0)
    assert (gable["outline"], gable["sides"], gable["height_m"]) == ("triangle", "two", 2.0)
    assert shape_of(gable).static_multiplier == pytest.approx(0.2 / (2.0 / 3.0))
    given = {**FACADE, "gable_height_m": 0.0, "parapet_height_m": 1.2, "parapet_thickness_m": 0.25}
    parapet = part_of(config.resolve({"facade": given})["facade"], 8.0)
    assert (parapet["outline"], parapet["height_m"], parapet["thickness_m"]) == ("box", 1.2, 0.25)


def test_what_lies_above_a_held_level_bears_on_the_part_below(resolved):
    """Weights and lever of all above 6 m against the masonry's own sums; the tie there holds."""
    part = part_of(resolved["facade"], 3.0, 6.0, 4.5)
    family = Family(resolved)
    rows = np.array(family.masonry.masses(6.0, 10.0))
    floor, load = part["floors"]
    assert floor["height_m"] == 1.0
    assert 1e3 * load["load_kn"] == pytest.approx(rows[:, 0].sum(), rel=1e-9)
    back = 0.2  # of the face that the part's top has, the outer one runs through
    lever = rows[:, 0] @ rows[:, 1] / rows[:, 0].sum() - back
    assert load["arm_m"] == pytest.approx(lever, rel=1e-9)
    assert (load["friction"], load["anchor_kn"]) == (0.0, 0.0)
    assert part["hinges_m"] == [1.5]
    assert [row["height_m"] for row in part["ties"]] == [3.0]  # and 7.8 m is above the level
    assert part["gable_height_m"] == 0.0


def test_the_whole_facade_is_the_case_itself():
    case = Case.configured("W2", {"facade": {"height_m": 6.0}})
    assert case.part(0.0) is case
    assert Case.configured("W2", {"facade": {"height_m": 6.0}, "part": {"foot_m": 0.0}}) == case


def test_a_part_stated_in_a_configuration_is_that_of_the_case():
    given = {"facade": {"ties": [{"height_m": 3.0}]}}
    stated = Case.configured("W2", {**given, "part": {"foot_m": 3.0}})
    assert stated == Case.configured("W2", given).part(3.0)
    assert stated["facade"]["base_height_m"] == 3.0


@pytest.mark.parametrize(
    ("part", "words"),
    [
        ({"foot_m": 9.0}, "part.foot_m = 9: expected 0 to less than 6.48"),
        ({"foot_m": 6.0}, "expected at least 2 × facade.thickness_m"),
        ({"foot_m": 1.0, "held_m": 4.0}, "expected both"),
        ({"foot_m": 1.0, "held_m": 4.0, "hinge_m": 0.5}, "part.hinge_m = 0.5: expected between"),
    ],
)
def test_parts_that_a_facade_has_not_end_in_one_line(part, words):
    with pytest.raises(ValueError, match=words) as caught:
        config.resolve({"part": part})
    assert "\n" not in str(caught.value)
