"""A part that is shaken against the mechanism of its hand calculation."""

import numpy as np
import pytest
from studies.assess.family import Family
from study_cases import UNEVEN, study_settings

from yade_scripts.model.part import part_of
from yade_scripts.model.shape import shape_of


@pytest.fixture(scope="module")
def resolved():
    return study_settings({"facade": UNEVEN})


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
