"""Which parts can turn follows from what holds where: against hand calculation, dense searches."""

import math

import numpy as np
import pytest
from drawn_facades import several
from plain_facade import PlainFacade, overturning
from rocking.mechanics.blocks import Held
from rocking.mechanics.closed_forms import GRAVITY_M_S2
from studies.assess import weakest
from studies.assess.code_checks import governing
from studies.assess.code_spectrum import CodeDemand
from studies.assess.family import Family
from studies.assess.sites import LEAST_PART_M
from studies.assess.slv import Slv
from study_cases import study_case, study_settings
from weakest_cases import dense_mechanisms, least_by_kind

from yade_scripts.model.base import course_tops

WALL = {"height_m": 8.0, "thickness_m": 0.42, "width_m": 7.5, "density_kg_m3": 1800.0}
DEMAND = CodeDemand(0.22, 2.45, 0.32, "C")


def settings(facade, **others):
    own = {"smdof": {"n_dof": 3, "period_s": 0.3}, **others}
    return study_settings({"facade": {**WALL, **facade}, **own})


def tie(height_m, **row):
    return {"height_m": height_m, "count": 4, "diameter_mm": 24.0, "length_m": 5.0, **row}


def plane(facade):
    """Feet and multipliers of overturning, and of bending, by hand-calculated mechanisms."""
    family = Family(settings(facade))
    found = [one for one in family.all() if one.plane]
    parts = {one.foot_m: one.mechanism.multiplier() for one in found if one.held_m is None}
    return parts, {(c.foot_m, c.held_m): c.mechanism.multiplier() for c in found if c.held_m}


def test_what_stands_above_a_row_of_ties_fails_though_the_whole_facade_holds():
    """4 m of a wall 0.42 m thick above the row: α0 = 0.42/4 = 0.105, onset 0.105/0.75 = 0.14 g.

    Its d0 is b; d* = 2/3 of the top's: d_SLV = 0.4·0.42·2/3.
    """
    resolved = settings({"ties": [tie(4.0)]})
    ranked = governing(Family(resolved).all(), resolved, DEMAND)
    (pga_g, least, checks), demand_g = ranked[0], DEMAND.pga_g
    assert (least.foot_m, least.held_m) == (4.0, None)
    assert least.mechanism.multiplier() == pytest.approx(0.105, rel=1e-9)
    assert pga_g < 0.65 * demand_g
    whole = next(row for row in ranked if row[1].whole)
    assert whole[0] > 1.8 * demand_g
    steps = {symbol: value for symbol, _, value, _ in checks["slv_height"].steps}
    assert steps["d_SLV"] == pytest.approx(0.4 * 0.42 * 2.0 / 3.0, rel=6e-3)  # of sines


def test_two_rows_a_tie_at_the_eaves_a_setback_and_an_anchored_floor():
    """Each by its own hand calculation of what lies above the hold."""
    parts, bends = plane({"ties": [tie(2.5), tie(5.0)]})
    assert parts[5.0] == pytest.approx(0.42 / 3.0)
    assert set(parts) == {0.0, 2.5, 5.0}
    assert set(bends) == {(0.0, 2.5), (2.5, 5.0), (0.0, 5.0)}
    parts, _ = plane({"ties": [tie(8.0)], "gable_height_m": 2.0})
    assert parts[8.0] == pytest.approx(0.21 / (2.0 / 3.0))
    parts, _ = plane({"ties": [tie(3.0)], "thickness_steps": [{"z_m": 5.0, "thickness_m": 0.3}]})
    assert parts[5.0] == pytest.approx(0.3 / 3.0)
    below, above = 2.0 * 0.42, 3.0 * 0.3  # areas above the tie; outer faces flush: levers b/2
    arm = (below * 0.21 + above * 0.15) / (below * 1.0 + above * 3.5)
    assert parts[3.0] == pytest.approx(arm)
    third = {"floors": [{"height_m": 8.0 / 3.0, "load_kn": 30.0, "anchor_kn": 80.0}]}
    parts, bends = plane(third)
    assert parts[round(8.0 / 3.0, 6)] == pytest.approx(0.42 / (16.0 / 3.0), rel=1e-6)
    assert len(bends) == 1


def test_squat_parts_under_a_row_at_the_top_are_looked_at_where_the_list_ends():
    """The row's lever goes with the part's height: of them the lowest fails first, at the end."""
    drawn = several(39, 64)[38]
    resolved, own = study_settings(drawn), drawn["assessment"]
    demand = CodeDemand(own["ag_g"], own["f0"], own["tc_star_s"], own["soil"])
    family = Family(resolved, slv=Slv(resolved, demand))
    found = [site for site in family.sites() if site.held_m is None and not site.side]
    last = family.masonry.top_m - LEAST_PART_M
    dense = [family.slv(family.part(float(z), "part")) for z in np.linspace(last - 0.3, last, 16)]
    assert min(map(family.measure, found)) <= 1.01 * min(dense)


def test_a_new_kind_of_hold_brings_its_foot_along():
    """What pulls at a height that no list names is a foot and a level all the same."""
    family = Family(settings({}))
    assert set(family.feet()) == {0.0}
    family.pulls.append(Held(50e3, 3.7, 0.1))
    assert set(family.feet()) == {0.0, 3.7}
    assert family.levels() == [0.0, 3.7]
    assert [site.held_m for site in weakest.spans(family)] == [3.7]


def test_bending_past_a_weak_row_by_virtual_work():
    """A row of 5 kN at mid-height of a span that a strong one ends; hinge at h1 of h.

    Per unit rotation of the lower block the row's point moves by its height, so α0 gains
    F z/(W h1/2), all weight moving with h1/2 in the mean.
    """
    weak = {"diameter_mm": 5.2, "count": 1}
    family = Family(settings({"ties": [tie(2.0, **weak), tie(4.0)]}))
    bent, free = (
        family.bent(0.0, 3.0, 4.0),
        Family(settings({"ties": [tie(4.0)]})).bent(0.0, 3.0, 4.0),
    )
    weight = 1800.0 * GRAVITY_M_S2 * 0.42 * 7.5 * 4.0
    force = 235e6 * math.pi / 4.0 * 5.2e-3**2
    gain = bent.multiplier() - free.multiplier()
    assert gain == pytest.approx(force * 2.0 / (weight * 1.5), rel=1e-6)


@pytest.mark.parametrize("k", range(3))
def test_nothing_is_weaker_than_what_is_listed(k):
    """Dense searches of the PGA, feet every 20 cm and hinges every 20 cm, of drawn façades.

    By kind: overturning, bending up to each level, corners. `trials/weakest.py` does the same
    every 5 and 10 cm of many.
    """
    given = several(3, 7)[k]
    resolved = study_settings(given)
    own = resolved["assessment"]
    demand = CodeDemand(own["ag_g"], own["f0"], own["tc_star_s"], own["soil"])
    slv = Slv(resolved, demand)
    family = Family(resolved, slv=slv)
    listed = least_by_kind(family, [family.at(site) for site in family.sites()])
    dense = least_by_kind(family, dense_mechanisms(family, 0.2, 0.2, near=listed))
    for kind, pga_g in dense.items():
        assert pga_g > 0.98 * listed[kind], kind


def test_the_verdict_moves_with_the_length_of_a_rod_and_not_with_its_last_digit():
    """Rods of 3.00 to 3.60 m: no step of 1 cm moves the PGA of SLV by more than 1 %."""
    found = []
    for length in np.arange(3.0, 3.605, 0.01):
        row = {"height_m": 6.0, "count": 2, "diameter_mm": 16.0, "elongation": 0.03}
        resolved = settings({"ties": [{**row, "length_m": float(length)}]})
        whole = Family(resolved).part(0.0, "")
        found.append(governing([whole], resolved, DEMAND)[0][0])
    steps = np.abs(np.diff(found)) / found[:-1]
    assert steps.max() < 0.01
    assert np.all(np.diff(found) > 0.0)  # a longer rod yields further


def test_alpha_at_the_end_of_a_pull_is_that_of_the_branch_before():
    """30 kN at 5 m until 0.1 m: at d_SLV, its end, α still has F z/(W h/2 …) in it."""
    wall = PlainFacade(6.0, 0.6, 100e3)
    held, bare = overturning(wall, [Held(30e3, 5.0, 0.1)]), overturning(wall)
    end, broken = held.limit(0.4)
    assert broken
    theta = held.rotation(end)
    gain = held.multiplier(theta) - bare.multiplier(theta)
    # F y' over Σ P y', about the toe
    cos, sin = math.cos(theta), math.sin(theta)
    assert gain == pytest.approx(30e3 * 5.0 * cos / (100e3 * (3.0 * cos + 0.3 * sin)), rel=1e-9)
    assert held.multiplier(theta * (1.0 + 1e-5)) == pytest.approx(
        bare.multiplier(theta * (1.0 + 1e-5)), rel=1e-12
    )


def test_a_slack_row_pulls_from_its_slack_on():
    """Ten millimetres at 5 m: α0 is the bare wall's, past 10 mm the row's is in it."""
    wall = PlainFacade(6.0, 0.6, 100e3)
    slack = overturning(wall, [Held(30e3, 5.0, 0.1, False, 0.01)])
    taut = overturning(wall, [Held(30e3, 5.0, 0.1)])
    assert slack.multiplier() == pytest.approx(0.1, rel=1e-9)
    assert slack.multiplier(0.0019) == pytest.approx(overturning(wall).multiplier(0.0019))
    assert slack.multiplier(0.0021) == pytest.approx(taut.multiplier(0.0021), rel=1e-12)
    end, broken = slack.limit(0.4)
    assert broken
    assert end == pytest.approx(taut.limit(0.4)[0], rel=1e-9)


def test_a_pull_that_ends_beyond_the_share_of_d0_does_not_raise_the_limit():
    """30 kN at 5 m until 0.3 m, the top then at 0.36 m: d_SLV stays 0.4·0.597."""
    held = overturning(PlainFacade(6.0, 0.6, 100e3), [Held(30e3, 5.0, 0.3)])
    d0 = held.ultimate()[1]
    assert held.limit(0.4) == (pytest.approx(0.4 * d0), False)
    assert d0 == pytest.approx(6.0 * math.sin(math.atan(0.1)), rel=1e-3)


def test_a_facade_of_courses_is_one_body_by_hand_and_stacks_of_its_own_when_shaken():
    """No foot at a joint of courses; each part above a foot has as many, bending two pieces."""
    facade = {
        "gable_height_m": 1.6,
        "thickness_steps": [{"z_m": 4.0, "thickness_m": 0.36}],
        "openings": [{"x_m": 0.0, "z_m": 5.0, "width_m": 1.0, "height_m": 1.4}],
        "ties": [tie(3.0)],
        "floors": [{"height_m": 4.0, "load_kn": 20.0}, {"height_m": 8.0, "anchor_kn": 6.0}],
    }
    stack = {**facade, "courses": 4, "courses_growth": 1.5}
    of_block, of_stack = (Family(settings(f)).all() for f in (facade, stack))
    assert [one.name for one in of_stack] == [one.name for one in of_block]
    for one, other in zip(of_block, of_stack, strict=True):
        assert one.mechanism.multiplier() == pytest.approx(other.mechanism.multiplier(), rel=1e-12)
    case = study_case("W2m", settings(stack))
    seen = set()
    for one in of_stack:
        if not one.plane or one.at_foot == "sill":
            continue
        section = case.part(one.foot_m, one.held_m, one.hinge_m)["facade"]
        kind = "bends" if one.held_m else "gable" if one.foot_m == 8.0 else "stack"
        assert section["courses"] == {"bends": 0, "gable": 0, "stack": 4}[kind]
        assert len(section["hinges_m"]) == (kind == "bends")
        if kind == "stack":
            tops = course_tops(section)
            assert tops[-1] == pytest.approx(8.0 - one.foot_m)
            assert tops[1] - tops[0] == pytest.approx(1.5 * tops[0])
        seen.add(kind)
    assert seen == {"bends", "gable", "stack"}
