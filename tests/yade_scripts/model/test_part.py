"""A part of a façade as a façade of its own: what it weighs, where it stands, what holds it."""

import pytest
from study_cases import UNEVEN, study_case, study_settings

from yade_scripts.model.part import part_of
from yade_scripts.model.shape import shape_of


@pytest.fixture(scope="module")
def resolved():
    return study_settings({"facade": UNEVEN})


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
    given = {**UNEVEN, "gable_height_m": 0.0, "parapet_height_m": 1.2, "parapet_thickness_m": 0.25}
    parapet = part_of(study_settings({"facade": given})["facade"], 8.0)
    assert (parapet["outline"], parapet["height_m"], parapet["thickness_m"]) == ("box", 1.2, 0.25)


def test_the_whole_facade_is_the_case_itself():
    case = study_case("W2", {"facade": {"height_m": 6.0}})
    assert case.part(0.0) is case
    assert study_case("W2", {"facade": {"height_m": 6.0}, "part": {"foot_m": 0.0}}) == case


def test_a_part_stated_in_a_configuration_is_that_of_the_case():
    given = {"facade": {"ties": [{"height_m": 3.0}]}}
    stated = study_case("W2", {**given, "part": {"foot_m": 3.0}})
    assert stated == study_case("W2", given).part(3.0)
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
        study_settings({"part": part})
    assert "\n" not in str(caught.value)
