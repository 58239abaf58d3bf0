"""What mechanisms are ranked by: the SLV check's PGA, and links that give way early."""

import math

import numpy as np
import pytest
from drawn_facades import several
from studies.assess import checks
from studies.assess.code_checks import code_checks, family_of, governing, least
from studies.assess.code_spectrum import CodeDemand
from studies.assess.dynamic_check import limits_of, limits_with
from studies.assess.family import Family
from studies.assess.sites import site_of
from studies.assess.slv import Slv, readings
from study_cases import study_settings

DEMAND = CodeDemand(0.16, 2.5, 0.31, "C")
WALL = {"height_m": 8.0, "thickness_m": 0.5, "width_m": 8.0, "density_kg_m3": 1800.0}


def resolved(**facade):
    return study_settings({"facade": {**WALL, **facade}, "smdof": {"n_dof": 2, "period_s": 0.3}})


def tied(anchor_kn, **facade):
    """A row of two old rods at half of the height, 9 m long, that yield at 68.4 kN each."""
    row = {"height_m": 4.0, "diameter_mm": 22.0, "length_m": 9.0, "yield_mpa": 180.0}
    return resolved(ties=[{**row, "anchor_kn": anchor_kn}], **facade)


def whole(settings):
    """`Counted` of the whole façade."""
    return Slv(settings, DEMAND).reading(Family(settings).part(0.0, "whole"))


def letter_g(settings):
    """PGA at which the whole façade fails with every link that it has [g]."""
    return Slv(settings, DEMAND).letter(Family(settings).part(0.0, "whole"))


def test_the_quick_check_is_the_one_that_is_printed():
    """Of every mechanism of drawn façades, ties and anchors among them, to 1e-9."""
    for given in several(3, 3):
        settings = study_settings(given)
        slv = Slv(settings, DEMAND)
        for one in family_of(settings, DEMAND).all():
            read = slv.reading(one)
            own = one._replace(mechanism=read.mechanism)
            assert read.pga_g == pytest.approx(least(code_checks(own, settings, DEMAND)), rel=1e-9)


def test_a_block_s_centroid_stands_for_its_weights():
    """The multiplier of the turned position from lumps and from every single weight."""
    for given in several(2, 3):
        for one in Family(study_settings(given)).all():
            m = one.mechanism
            every = m.__class__(m.name, m.weights, m.control, m.pulls, m.largest_rad)
            for theta in (0.0, 0.01, 0.05):
                assert m.multiplier(theta) == pytest.approx(every.multiplier(theta), rel=1e-10)


def test_a_brittle_tie_makes_no_facade_worse_and_both_numbers_are_known():
    """By the letter 40 kN are worse than no tie; with the tie left out it is the bare façade's."""
    bare = whole(resolved())
    brittle = whole(tied(40.0))
    assert letter_g(tied(40.0)) < 0.6 * bare.pga_g
    assert brittle.pga_g == pytest.approx(bare.pga_g, rel=1e-12)
    assert brittle.left_out == 1
    assert not brittle.mechanism.pulls
    ductile = whole(tied(70.0))  # the rods yield first
    assert ductile.left_out == 0
    assert ductile.pga_g == letter_g(tied(70.0)) > bare.pga_g


def test_a_brittle_anchor_sets_the_limit_of_the_dynamic_check_and_the_bare_walls_is_told():
    """C8.7.1.2.1.6 takes the least: the millimetres that an anchor takes, not 0.4 d0."""
    bare = Family(resolved()).part(0.0, "whole").mechanism
    brittle = Family(tied(40.0)).part(0.0, "whole").mechanism
    assert brittle.limit(0.4)[0] < 0.1 * bare.limit(0.4)[0]
    found = limits_of(brittle)
    assert found.slv_m == brittle.limit(0.4)[0]
    assert found.bare_m == pytest.approx(bare.limit(0.4)[0], rel=1e-9)
    ranked = whole(tied(40.0))  # without its link, as it counts by hand
    one = Family(tied(40.0)).part(0.0, "whole")
    assert limits_with(one._replace(mechanism=ranked.mechanism, letter=one.mechanism)) == found
    assert (found.d0_m, found.slc_m) == (brittle.ultimate()[1], 0.6 * brittle.ultimate()[1])
    assert limits_of(bare).slv_m == bare.limit(0.4)[0]
    assert math.isnan(limits_of(bare).bare_m)


def test_more_of_anything_that_helps_never_lowers_the_check():
    """Series of anchors, thickness and a_g: the PGA rises, and the ratio to the demand falls."""
    anchors = [whole(tied(kn)).pga_g for kn in (5.0, 20.0, 40.0, 60.0, 68.0, 69.0, 90.0)]
    assert np.all(np.diff(anchors) >= -1e-12)
    thick = [whole(tied(45.0, thickness_m=0.5 * f)).pga_g for f in (0.8, 0.9, 1.0, 1.1, 1.2)]
    assert np.all(np.diff(thick) > 0.0)
    settings, ratios = tied(45.0), []
    for ag_g in (0.05, 0.1, 0.15, 0.2, 0.3):
        demand = CodeDemand(ag_g, 2.5, 0.31, "C")
        one = Family(settings).part(0.0, "whole")
        ratios.append(Slv(settings, demand)(one) / demand.pga_g)
    assert np.all(np.diff(ratios) < 0.0)


def test_links_are_left_out_the_earliest_first():
    """Two brittle rows: every reading has one pull less, and the last no early one."""
    rows = [{"height_m": z, "length_m": 9.0, "anchor_kn": 30.0} for z in (4.0, 8.0)]
    found = readings(Family(resolved(ties=rows)).part(0.0, "whole").mechanism)
    assert [len(one.pulls) for one in found] == [2, 1, 0][: len(found)]
    assert found[-1].early(checks.LIMITS["SLV"][0]) is None


def test_a_mechanism_is_found_again_where_its_site_says():
    """Every candidate of a drawn façade from its site: the same name, label and check."""
    settings = study_settings(several(1, 5)[0])
    slv, family = Slv(settings, DEMAND), Family(settings)
    for one in family_of(settings, DEMAND).all():
        again = family.at(site_of(one))
        assert (again.part, again.foot_m, again.held_m) == (one.part, one.foot_m, one.held_m)
        assert slv(again) == pytest.approx(slv(one), rel=1e-12)


def test_the_list_is_ranked_by_the_check_and_not_by_the_multiplier():
    """The corner near the eaves has three times the multiplier of the one at the foot."""
    settings = resolved()
    ranked = governing(family_of(settings, DEMAND).all(), settings, DEMAND)
    (corner,) = (one for _, one, _ in ranked if one.side == 1)
    low = Family(settings).corner(1, 0.0)
    slv = Slv(settings, DEMAND)
    assert corner.mechanism.multiplier() > 2.0 * low.mechanism.multiplier()
    assert slv(corner) < 0.6 * slv(low)
