"""Mechanisms of façades that few have: set back inside, overhanging, with a parapet, with ties."""

import math

import numpy as np
import pytest
from plain_facade import PlainFacade, overturning
from rocking.mechanics.blocks import Held, weakest_hinge
from rocking.mechanics.closed_forms import GRAVITY_M_S2
from studies.assess import checks
from studies.assess.demand import TableDemand
from studies.assess.family import Family, stretched
from studies.assess.masonry import Masonry
from study_cases import study_settings

PLAIN = {"height_m": 6.0, "thickness_m": 0.5, "width_m": 4.0, "density_kg_m3": 1800.0}
FLAT = TableDemand(np.array([0.0, 0.1, 9.0]), np.array([0.2, 0.5, 0.5]))


def family(facade):
    return Family(study_settings({"facade": facade}))


@pytest.mark.parametrize(
    ("flush", "above_m", "edge_m", "middle_m"),
    [
        ("inner", 0.3, 0.3, 0.15),
        ("outer", 0.3, 0.5, 0.35),
        ("inner", 0.7, 0.5, 0.35),
    ],
)
def test_a_part_turns_about_the_outer_edge_that_both_sides_of_a_step_have(
    flush, above_m, edge_m, middle_m
):
    """Above 3 m of 6 m: α0 = (edge − middle)/1.5 m."""
    steps = [{"z_m": 3.0, "thickness_m": above_m}]
    one = family({**PLAIN, "thickness_steps": steps, "flush_face": flush}).part(3.0, "part")
    assert one.mechanism.multiplier() == pytest.approx((edge_m - middle_m) / 1.5, rel=1e-9)


def test_a_step_low_down_has_that_edge_too():
    """Above 0.3 m, where the wall thickens outward from 0.4 to 0.5 m: it turns about 0.4 m."""
    own = {"thickness_m": 0.4, "thickness_steps": [{"z_m": 0.3, "thickness_m": 0.5}]}
    one = family({**PLAIN, **own, "flush_face": "inner"}).part(0.3, "part")
    assert one.mechanism.multiplier() == pytest.approx((0.4 - 0.25) / 2.85, rel=1e-9)


def test_a_floor_at_the_level_that_is_held_bears_on_the_part_that_bends():
    """α0 = [W₁ b/2 + (W₂ + N) b + r (W₂ b/2 + Σ N s)]/[(W₁ + W₂) h₁/2], r = h₁/h₂."""
    load_n, b, low, high = 2e4, 0.5, 2.5, 4.0
    floor = {"height_m": high, "load_kn": 1e-3 * load_n, "arm_m": 0.1}
    per_m = 1800.0 * GRAVITY_M_S2 * b * 4.0
    first, second, above = per_m * low, per_m * (high - low), per_m * (6.0 - high)
    for loads in ([(above, 0.5 * b)], [(above, 0.5 * b), (load_n, 0.1)]):
        held = sum(n for n, _ in loads)
        arms = second * 0.5 * b + sum(n * s for n, s in loads)
        numerator = first * 0.5 * b + (second + held) * b + low / (high - low) * arms
        expected = numerator / ((first + second) * 0.5 * low)
        own = family({**PLAIN, "floors": [floor] if len(loads) > 1 else []}).bent(0.0, low, high)
        assert own.multiplier() == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("top", ["gable_height_m", "parapet_height_m"])
def test_a_facade_stretched_in_height_turns_at_a_multiplier_lower_by_its_factor(top):
    """Weights grow with the factor, arms across stay and arms up grow: α0 falls by the factor."""
    facade = {
        **PLAIN,
        top: 1.0,
        "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.4}],
        "openings": [{"x_m": 0.5, "z_m": 1.0, "width_m": 1.0, "height_m": 1.4}],
    }
    section = study_settings({"facade": facade})["facade"]
    tall = stretched(section, 1.5)
    assert Masonry(tall).top_m == pytest.approx(1.5 * 7.0)
    low, high = (Family({**study_settings({}), "facade": own}) for own in (section, tall))
    for foot_m in (0.0, 1.0, 2.4, 3.0, 6.0):
        short, long = low.part(foot_m, "one"), high.part(1.5 * foot_m, "one")
        ratio = short.mechanism.multiplier() / long.mechanism.multiplier()
        assert ratio == pytest.approx(1.5, rel=1e-9), foot_m


def test_ties_of_a_stretched_facade_move_up_and_keep_what_they_are():
    section = study_settings({"facade": {**PLAIN, "ties": [{"height_m": 4.0}]}})["facade"]
    (tie,) = stretched(section, 1.5)["ties"]
    assert tie == {**section["ties"][0], "height_m": 6.0}


def test_a_parapet_s_period_is_that_of_its_own_thickness():
    """0.25 m on a wall of 0.5 m; a cantilever of half the modulus, 6.2 (h/b) h √(ρ/E)."""
    own = {"parapet_height_m": 1.0, "parapet_thickness_m": 0.25}
    found = family({**PLAIN, **own}).part(6.0, "parapet")
    expected = 6.2 * (1.0 / 0.25) * 1.0 * math.sqrt(1800.0 / (0.5 * 1800e6))
    assert found.t0_s == pytest.approx(expected, rel=1e-9)


def test_faces_at_a_step_are_those_of_the_side_that_is_asked_for():
    steps = [{"z_m": 3.0, "thickness_m": 0.3}]
    masonry = Masonry(study_settings({"facade": {**PLAIN, "thickness_steps": steps}})["facade"])
    assert masonry.faces(3.0) == pytest.approx((0.2, 0.5))
    assert masonry.faces(3.0, above=False) == pytest.approx((0.0, 0.5))
    assert masonry.faces(0.0, above=False) == pytest.approx((0.0, 0.5))
    assert masonry.faces(6.0) == pytest.approx((0.2, 0.5))


def test_en_1998_3_takes_a_tie_that_has_given_way_out_of_the_line():
    """A tie whose reach ends before 0.4 d0: α there is that of the bare block, tan(α − θ)."""
    weight = 100e3
    bare = overturning(PlainFacade(6.0, 0.6, weight))
    tied = overturning(PlainFacade(6.0, 0.6, weight), [Held(5e3, 5.5, 0.02)])
    theta0, d0 = tied.ultimate()
    assert (theta0, d0) == pytest.approx(bare.ultimate(), rel=1e-9)
    steps = {row[0]: row[2] for row in checks.eurocode(tied, FLAT, "on the ground").steps}
    ratio = tied.participation()[1]
    left = bare.multiplier(math.asin(0.4 * d0 / 6.0))
    line = 0.6 * tied.multiplier()
    assert left < 0.8 * line
    assert steps["a*"] == pytest.approx(left / ratio, rel=1e-9)
    free = {row[0]: row[2] for row in checks.eurocode(bare, FLAT, "on the ground").steps}
    assert free["a*"] == pytest.approx(0.6 * bare.multiplier() / bare.participation()[1], rel=1e-9)


def test_what_pushes_takes_from_the_multiplier_and_nothing_from_d0():
    """It does not bear: the block still turns until its weight line passes the toe: h sin α."""
    free = overturning(PlainFacade(6.0, 0.6, 100e3))
    pushed = overturning(PlainFacade(6.0, 0.6, 100e3, pushing_n=40e3))
    assert pushed.ultimate()[1] == pytest.approx(6.0 * math.sin(math.atan(0.1)), rel=1e-9)
    assert pushed.ultimate()[1] == pytest.approx(free.ultimate()[1], rel=1e-9)
    # α (W h/2 + Q h) = W b/2
    assert pushed.multiplier() == pytest.approx(100e3 * 0.3 / (100e3 * 3.0 + 40e3 * 6.0), rel=1e-9)
    # turned by θ, its point stays above the hinge: it has moved by h sin θ
    cos, sin = math.cos(0.05), math.sin(0.05)
    lifted = 100e3 * (0.3 * cos - 3.0 * sin)
    moved = 100e3 * (3.0 * cos + 0.3 * sin) + 40e3 * 6.0 * cos
    assert pushed.multiplier(0.05) == pytest.approx(lifted / moved, rel=1e-9)


def test_the_weakest_hinge_below_several_loads_is_that_below_their_resultant():
    loaded = {"facade": {**PLAIN, "floors": [{"height_m": 6.0, "load_kn": 1.0}]}}
    section = study_settings(loaded)["facade"]
    (shipped,) = section["floors"]
    rows = [
        {**shipped, "load_kn": 10.0, "arm_m": 0.05},
        {**shipped, "load_kn": 30.0, "arm_m": 0.45},
    ]
    one = [{**shipped, "load_kn": 40.0, "arm_m": (10.0 * 0.05 + 30.0 * 0.45) / 40.0}]
    several, single = (weakest_hinge({**section, "floors": own}) for own in (rows, one))
    assert several == pytest.approx(single, abs=1e-6)
    at_middle = weakest_hinge({**section, "floors": [{**one[0], "arm_m": 0.05}]})
    assert abs(at_middle - single) > 0.05  # the arm matters
    weight = 1800.0 * GRAVITY_M_S2 * 6.0 * 0.5 * 4.0
    facade = PlainFacade(6.0, 0.5, weight, 0.0, 40e3, one[0]["arm_m"])
    assert single == pytest.approx(lowest_by_hand(facade), rel=1e-3)
    bare = weakest_hinge({**section, "floors": []})
    assert bare == pytest.approx(lowest_by_hand(PlainFacade(6.0, 0.5, weight)), rel=1e-3)


def lowest_by_hand(f):
    """Least of the closed form of `two_blocks` over a fine row of heights [m]."""
    h1 = np.linspace(0.02, 0.98, 9601) * f.height_m
    w1, w2 = f.weight_n * h1 / f.height_m, f.weight_n * (1.0 - h1 / f.height_m)
    b, n, s, r = f.thickness_m, f.roof_n, f.roof_arm_m, h1 / (f.height_m - h1)
    lifted = w1 * b / 2.0 + (w2 + n) * b + r * (w2 * b / 2.0 + n * s)
    return h1[np.argmin(lifted / (f.weight_n * h1 / 2.0))]
