"""Façades that are rare and real: what they are to be, each by a hand calculation."""

import math

import numpy as np
import pytest
from repertory_cases import DEMAND
from rocking.mechanics.blocks import turning
from rocking.mechanics.mechanism import rate
from studies.assess import byhand, inputs, weakest
from studies.assess.code_checks import family_of, governing
from studies.assess.demand import TableDemand, floor_demand, largest_displacement
from studies.assess.family import Family
from studies.assess.repertory import horizontal
from studies.assess.slv import Slv
from study_cases import study_settings

from yade_scripts.model.part import part_of
from yade_scripts.model.shape import shape_of

PLAIN = {"height_m": 6.0, "thickness_m": 0.5, "width_m": 6.0, "density_kg_m3": 1800.0}
ROOF = {"height_m": 6.0, "load_kn": 40.0, "anchor_kn": 30.0, "arm_m": 0.1}


def sections(facade, wall=None, **own):
    given = {"facade": {**PLAIN, **facade}, "return_wall": wall or {}, "assessment": own}
    return study_settings(given)


def corners(facade, wall=None, **own):
    known = sections(facade, wall, **own)
    return [one for one in family_of(known, DEMAND).all() if one.side]


def test_a_mechanism_has_its_place_in_the_whole_building():
    """3 m of wall at the foot of a building of 12 m: its middle is at 1.5 m of 12."""
    low = Family(sections({"height_m": 3.0, "building_height_m": 12.0}))
    assert low.part(0.0).place == pytest.approx(0.125)
    assert low.part(2.0).place == pytest.approx(2.5 / 12.0)
    raised = Family(sections({"height_m": 3.0, "base_height_m": 3.0, "building_height_m": 12.0}))
    assert raised.part(0.0).place == pytest.approx(4.5 / 12.0)
    ((_, whole, by_check), *_) = governing([low.part(0.0)], sections({}), DEMAND)
    assert whole.place == 0.125
    assert np.isfinite([check.failing_pga_g for check in by_check.values()]).all()


@pytest.mark.parametrize("place", [0.0, 0.01])
def test_no_floor_shakes_less_than_the_ground(place):
    """Where a wall stands on a floor: what sets it off is at least the ground's peak."""
    known = sections({"base_height_m": 3.0}, height_ratio=place)
    whole = Family(known).part(0.0)
    demand = Slv(known, DEMAND).places(whole)["height"][0]
    assert demand.acceleration(0.0) == pytest.approx(DEMAND.pga_g)
    assert math.isfinite(Slv(known, DEMAND)(whole))
    assert floor_demand(DEMAND, 1.0, known["smdof"]).acceleration(0.0) > 1.5 * DEMAND.pga_g


@pytest.mark.parametrize("facade", [{"sides": "two"}, {"sides": "two", "outline": "triangle"}])
def test_a_wall_that_nothing_leans_on_is_refused_in_one_line(facade):
    with pytest.raises(ValueError, match=r"facade\.sides = two: expected one; state the wall"):
        inputs.check_mechanisms(sections({**facade, "base_height_m": 3.0}))


def test_the_thrust_of_a_hip_turns_a_corner_from_the_base_or_above_a_level():
    """A thrust H at the eaves lowers α0 by H h/ΣPz. The dry top is no mechanism."""
    free, thrust = (corners({}, hip_thrust_kn=kn) for kn in (0.0, 5.0))
    assert [one.foot_m for one in thrust] == [0.0, 0.0]
    assert all(one.foot_m > 5.0 for one in free)
    family = Family(sections({}))
    alone = family.corner(1, 0.0).mechanism
    sideways = sum(w * rate(path, 0.0)[0] for w, path in alone.weights)
    expected = alone.multiplier() - 5e3 * 6.0 / sideways
    assert thrust[0].mechanism.multiplier() == pytest.approx(expected, rel=1e-9)
    level = {**ROOF, "height_m": 3.0}
    assert [one.foot_m for one in corners({"floors": [level]}, hip_thrust_kn=2.0)] == [3.0, 3.0]


def test_corners_want_masonry_and_a_return_wall_at_the_end():
    """An opening at the façade's end up to the eaves; a single return wall, in the middle."""
    window = {"x_m": -2.0, "z_m": 3.0, "width_m": 2.0, "height_m": 3.0}
    left, right = corners({"openings": [window]})
    assert left.foot_m < 5.2  # above, it would have no masonry
    assert right.foot_m == pytest.approx(5.67, abs=0.05)
    assert corners({}, {"count": 1}) == []


def test_a_return_wall_lies_as_far_behind_the_foot_s_edge_as_it_does():
    """0.8 m to 3 m, 0.4 m above, flush inside: at 4 m the wall begins 0.8 m behind the edge."""
    steps = [{"z_m": 3.0, "thickness_m": 0.4}]
    family = Family(sections({"thickness_m": 0.8, "thickness_steps": steps, "flush_face": "inner"}))
    slope = math.tan(math.radians(family.settings["corner_crack_deg"]))
    rows = family._return_wedge(0.0, slope, 0.3, math.sqrt(0.5))
    volume = np.sum([w for w, *_ in rows]) / (0.3 * family.masonry.unit_weight)
    low = 0.8 / slope
    assert volume == pytest.approx(0.5 * slope * (6.0 - low) ** 2, rel=2e-3)


def test_horizontal_bending_presses_on_masonry_that_every_height_has():
    """0.7 m, 0.35 m from 5 m up, flush inside: no jump where the middle of a span passes 5 m."""
    steps = [{"z_m": 5.0, "thickness_m": 0.35}]
    rods = {"height_m": 6.8, "count": 3, "diameter_mm": 16.0, "length_m": 5.0}
    wall = {"height_m": 7.0, "thickness_m": 0.7, "thickness_steps": steps, "flush_face": "inner"}
    family = Family(sections({**wall, "ties": [rods]}, mechanisms=["horizontal"]))
    below, above = (
        horizontal(family, foot, 6.8, (-2.0, 0.0, 2.0)).mechanism.multiplier()
        for foot in (3.19, 3.21)
    )
    assert below == pytest.approx(above, rel=0.02)


def test_what_stands_on_a_taper_is_as_thick_as_its_top():
    """0.8 m at the base, 0.2 m at 6 m: a gable and a parapet on it turn about 0.2 m."""
    taper = {"thickness_m": 0.8, "top_thickness_m": 0.2}
    for more, alpha in (({"parapet_height_m": 1.0}, 0.2), ({"gable_height_m": 1.0}, 0.3)):
        known = sections({**taper, **more})
        found = Family(known).part(6.0).mechanism.multiplier()
        assert found == pytest.approx(alpha, rel=1e-9)  # (t/2)/(h/2), and (t/2)/(h/3)
        part = part_of(known["facade"], 6.0)
        assert part["thickness_m"] == pytest.approx(0.2)
        assert shape_of(part).static_multiplier == pytest.approx(alpha, rel=1e-9)
    row = {**ROOF, "height_m": 3.3, "arm_m": None}
    known = Family(sections({**taper, "floors": [row]}))
    ((_, y, z),) = known.loads
    assert (y, z) == pytest.approx((0.8 - 0.5 * (0.8 - 0.6 * 0.55), 3.3))


def test_the_table_of_a_leaning_wall_that_bends_is_its_mechanism():
    """Parts, sums and α0 of the pocket calculator, against virtual work on the leaning wall."""
    family = Family(sections({"tilt_deg": 1.5, "floors": [ROOF]}))
    site = next(one for one in weakest.spans(family))
    one = family.at(site)
    rows = byhand.parts(family, one)
    assert [round(p.about.get("high_m", 6.0), 2) for p in rows][-2:] == [6.0, 6.0]
    found = byhand.sums(rows, byhand.pulled(one))
    multiplier = (found.up_n + found.pull_n) / found.out_n
    assert multiplier == pytest.approx(one.mechanism.multiplier(), rel=1e-6)
    assert found.weight_n == pytest.approx(1800.0 * 9.81 * 18.0 + 40e3, rel=1e-6)
    foot = family.leaned_point((0.5, 0.0))
    top = turning((0.5, 6.0), foot)(family.lean_rad)
    assert family.leaned_point((0.5, 6.0)) == pytest.approx([v.real for v in top])


def test_the_peak_of_a_stated_spectrum_between_samples_is_found():
    """A narrow peak at 0.9 s, where powers of 1.08 pass by: S_De = Sa T²/4π² there."""
    periods = np.array([0.0, 0.1, 0.5, 0.88, 0.9, 0.92, 1.2, 4.0])
    demand = TableDemand(periods, np.array([0.2, 0.5, 0.5, 0.28, 0.56, 0.28, 0.1, 0.01]))
    expected = 0.56 * 9.80665 * (0.9 / (2.0 * math.pi)) ** 2
    assert largest_displacement(demand, 0.0, 1.2, 0.05) == pytest.approx((expected, 0.9))
    assert Slv(sections({}), demand)._largest(demand, 0.0, 1.2, 0.05) == pytest.approx(expected)
