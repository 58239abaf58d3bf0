"""Base-shear coefficient from wall areas: by hand, by a plan, and its interval."""

import math

import pytest
from rocking.building import strength
from rocking.configuration.files import read_yaml

from yade_scripts.model.building.plan import plan_from_dict

TAU0 = 0.06e6


def test_one_storey_by_hand():
    """A τ0 √(1 + σ/(1.5 τ0)) over W."""
    one = strength.Storey(2.0, 400e3, 3.0, 0.1e6)
    found, storey = strength.base_shear_ratio([one], TAU0)
    assert found == pytest.approx(2.0 * TAU0 * math.sqrt(1.0 + 0.1 / 0.09) / 400e3)
    assert storey == 1


def test_the_upper_storey_carries_two_thirds_of_the_base_shear():
    """Of two equal floors: with half the wall it decides."""
    storeys = [strength.Storey(2.0, 300e3, z, 0.0) for z in (3.0, 6.0)]
    found, storey = strength.base_shear_ratio(storeys, TAU0)
    assert (found, storey) == (pytest.approx(2.0 * TAU0 / 600e3), 1)
    less = [storeys[0], strength.Storey(1.0, 300e3, 6.0, 0.0)]
    assert strength.base_shear_ratio(less, TAU0) == (pytest.approx(TAU0 / 400e3), 2)
    half, _ = strength.base_shear_ratio(storeys, TAU0, piers=0.8, spandrels=0.8)
    assert half == pytest.approx(0.64 * found)


def test_the_plan_of_the_case_study_has_its_piers():
    """Two walls of 6 m with two openings of 0.94 m each, 0.36 m thick."""
    path = "config/buildings/case_study.yaml"
    storeys = strength.storeys_of_plan(plan_from_dict(read_yaml(path), path), 3e3)
    assert [one.area_m2 for one in storeys] == pytest.approx([2 * 0.36 * (6.0 - 1.88)] * 2)
    middle, low, high = strength.with_interval(storeys, (0.05e6, 0.13e6))
    assert low < 0.25 < middle < high
    assert middle == pytest.approx(math.sqrt(low * high))


def test_few_numbers_agree_with_the_plan_they_are_of():
    """Wall shares of the case study's plan: V/W within a tenth."""
    path = "config/buildings/case_study.yaml"
    plan = plan_from_dict(read_yaml(path), path)
    exact = strength.base_shear_ratio(strength.storeys_of_plan(plan, 3e3), TAU0)[0]
    floor = 4.4 * 6.0
    walls = 2 * 0.36 * (4.4 + 6.0) / floor
    few = strength.storeys_of(2.97 / floor, 2, 3e3, 3.0, walls_share=walls)
    assert strength.base_shear_ratio(few, TAU0)[0] == pytest.approx(exact, rel=0.1)


@pytest.mark.parametrize("shape", [strength.SQUAT, 1.2, strength.SLENDER])
@pytest.mark.parametrize("compression", [0.0, 0.05e6, 0.4e6])
def test_a_pier_cracks_where_mohrs_circle_reaches_the_tensile_strength(shape, compression):
    """At its middle the shear stress is b times the mean one: principal tension of 1.5 τ0."""
    middle = shape * strength.tau(compression, TAU0, shape)
    tension = math.hypot(0.5 * compression, middle) - 0.5 * compression
    assert tension == pytest.approx(1.5 * TAU0)


def test_squat_piers_carry_half_as_much_again():
    one = strength.Storey(2.0, 400e3, 3.0, 0.1e6)
    slender, _ = strength.base_shear_ratio([one], TAU0)
    squat, _ = strength.base_shear_ratio([one], TAU0, shape=strength.SQUAT)
    assert squat == pytest.approx(1.5 * slender)


def test_a_shape_that_no_pier_has_ends_the_command_in_one_line(capsys):
    with pytest.raises(SystemExit):
        strength.main(["--pier-shape", "3"])
    assert capsys.readouterr().err.endswith("error: shape = 3.0: expected b from 1 to 1.5\n")


@pytest.mark.parametrize("wrong", [{"tau0_pa": 0.0}, {"shape": 2.0}])
def test_what_is_not_positive_is_named(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        strength.base_shear_ratio(
            [strength.Storey(1.0, 1.0, 1.0, 0.0)], **{"tau0_pa": TAU0, **wrong}
        )
