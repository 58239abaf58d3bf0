"""Horizontal bending: by hand, as rigid bodies, and the weakest of all places."""

import math
from dataclasses import replace

import numpy as np
import pytest
from repertory_cases import BRICKS, DEMAND, GAMMA, PLAIN, SHAPED, family, resolved
from studies.assess.family import Family
from studies.assess.hanging import Wedge
from studies.assess.names import kind_of
from studies.assess.repertory import (
    _follow,
    _valleys,
    horizontal,
    horizontals,
    supports,
)
from studies.assess.sites import site_of
from studies.assess.slv import Slv


def test_horizontal_bending_by_hand():
    """Rods 4 m apart at 6 m, foot 1 m: α0 = 3 b/(2 D) + 3 H b(1/L1 + 1/L2)/W, see `hanging`.

    W = γ b 4·5/2 = 88.29 kN; 0.15 without thrust; 20 kN adds 3·20·0.5·(1/2 + 1/2)/88.29 = 0.3398.
    """
    for thrust, alpha in ((None, 0.15), (20.0, 0.15 + 30.0 / (GAMMA * 5e-3))):
        known = family(arch_thrust_kn=thrust)
        one = horizontal(known, 1.0, 6.0, (-2.0, 0.0, 2.0))
        assert one.mechanism.multiplier() == pytest.approx(alpha, rel=1e-9)
        weight = sum(p for p, _ in one.mechanism.weights)
        assert weight == pytest.approx(GAMMA * 5.0, rel=1e-9)
        assert one.mechanism.falls()
    uneven = horizontal(family(arch_thrust_kn=20.0), 1.0, 6.0, (-2.0, -1.0, 2.0)).mechanism
    assert uneven.multiplier() == pytest.approx(
        0.15 + 3 * 20e3 * 0.5 * (1.0 + 1.0 / 3.0) / (GAMMA * 5.0), rel=1e-9
    )


def test_the_bodies_of_horizontal_bending_are_rigid():
    """Distances between points of one body stay, and a point on its crack at the face too."""
    own = Wedge(-2.0, 0.5, 2.0, 1.0, 6.0, 0.5, 0.0)
    theta, long, deep = 0.08, 2.5, 5.0
    normal = np.array([deep, long]) / math.hypot(long, deep)

    def at(x, y, z):
        out, up = (v.real for v in own.move(x, y, z)(theta + 0j))
        away = (up - z) / normal[1]
        return np.array([x + away * normal[0], out, z + away * normal[1]])

    points = [(-1.0, 0.1, 5.0), (0.2, 0.4, 2.0), (0.0, 0.0, 5.5), (-1.5, 0.5, 5.9)]
    for a in points:
        for b in points:
            apart = math.dist(a, b)
            assert np.linalg.norm(at(*a) - at(*b)) == pytest.approx(apart, abs=1e-12)
    assert at(-2.0, 0.5, 6.0) == pytest.approx((-2.0, 0.5, 6.0), abs=1e-12)
    meet = own.move(0.5 - 1e-9, 0.5, 6.0)(theta)[0], own.move(0.5, 0.5, 6.0)(theta)[0]
    assert meet[0].real == pytest.approx(meet[1].real, abs=1e-6)


@pytest.mark.parametrize("theta", [0.02, 0.08, 0.15])
def test_bodies_press_each_other_apart_as_far_as_they_overlap(theta):
    """Points of both on the inner face where they meet: what the one is past the other in x.

    A body moves along the normal of its crack: its way up tells its way along the wall.
    """
    own, height = Wedge(-2.0, 0.5, 2.0, 1.0, 6.0, 0.5, 0.0), 5.0
    past = 0.0
    for x, long in ((0.5 - 1e-12, 2.5), (0.5, 1.5)):
        up = own.move(x, 0.0, height)(theta)[1].real - height
        past += up * own.depth_m / long
    assert own.apart(height)(theta)[0].real == pytest.approx(past, rel=1e-9)
    late = [own.apart(6.0)(t)[0].real for t in (0.0, 0.01, 0.1, 0.19)]
    assert late[1] > late[0] == 0.0
    assert late[3] < late[2]  # beyond the arch's rise the thrust pushes outward


def test_horizontal_bending_is_between_neighbouring_rods_and_is_listed_with_ties():
    row = {"height_m": 6.0, "count": 3, "diameter_mm": 16.0, "length_m": 5.0}
    asked = {"mechanisms": ["horizontal"]}
    known = family({**PLAIN, "ties": [row]}, **asked)
    assert supports(known) == [(-2.0, 0.0, 6.0), (0.0, 2.0, 6.0)]
    stated = family({**PLAIN, "ties": [{**row, "x_m": [-1.5, 0.5, 1.0]}]}, **asked)
    assert supports(stated)[0] == (-1.5, 0.5, 6.0)
    (one,) = [one for one in known.all() if one.middle_m is not None]
    assert kind_of(one) == "horizontal"
    assert not one.plane
    assert not one.mechanism.pulls  # its own rods hold it, and are not passed
    assert known.at(site_of(one)).mechanism.multiplier() == one.mechanism.multiplier()
    assert supports(family(**asked)) == []
    (bonded,) = supports(family(**asked, **BRICKS))
    assert bonded == pytest.approx((-2.1, 2.1, 6.0))


def test_bodies_of_horizontal_bending_weigh_at_their_centroids():
    """Paths are linear in their points: α(θ) of two weights is that of all of them, floors too."""
    loaded = {**SHAPED, "flush_face": "inner"}
    found = horizontal(family(loaded), 0.5, 5.0, (-1.5, -0.3, 1.5)).mechanism
    every = replace(found, lumped=())
    theta = np.linspace(0.0, 0.9 * found.largest_rad, 7)
    assert len(found.lumped) == 2
    assert len(found.weights) > 50
    assert found.multiplier(theta) == pytest.approx(every.multiplier(theta), rel=1e-11)


DOOR = {  # weakest in the middle of the span, or as near to a line as the wall is thick
    "height_m": 4.81,
    "thickness_m": 0.46,
    "width_m": 4.1,
    "density_kg_m3": 1900.0,
    "flush_face": "outer",
    "ties": [{"height_m": 4.81, "count": 2, "diameter_mm": 24.0, "anchor_kn": 40.0}],
    "openings": [{"x_m": 0.0, "z_m": 0.0, "width_m": 1.0, "height_m": 1.29}],
}


def test_horizontal_bending_is_the_weakest_of_several_valleys():
    """No foot every 20 cm and place every tenth of the span is weaker by more than 2 %."""
    given = resolved(DOOR, mechanisms=["horizontal"], **BRICKS | {"interlocking_overlap_m": 0.12})
    known = Family(given, slv=Slv(given, DEMAND))
    (site,) = horizontals(known)
    dense = [
        known.slv(horizontal(known, foot, top, (left, x, right)))
        for left, right, top in supports(known)
        for foot in np.arange(0.0, top - 0.3, 0.2).tolist()
        for x in np.linspace(left + 0.46, right - 0.46, 10).tolist()
    ]
    assert min(dense) >= 0.98 * known.measure(site)
    assert site.left_m + 0.46 <= site.middle_m <= site.right_m - 0.46


def test_the_weakest_is_followed_along_an_edge_askew_beyond_which_nothing_falls():
    """−x − 0.9 y where x + y is at most 1: least at (1, 0), no lower along an axis."""

    def measure(x, y):
        return -x - 0.9 * y if x + y <= 1.0 + 1e-9 else math.inf

    grid = [0.0, 0.5, 1.0]
    least, x, y = _follow(measure, (measure(0.5, 0.5), 0.5, 0.5), grid, grid, 1.0)
    assert (least, x, y) == pytest.approx((-1.0, 1.0, 0.0), abs=0.01)
    assert x > 0.98  # along an axis it stays at 0.5


def test_valleys_are_the_places_of_a_grid_that_no_neighbour_is_below():
    values = np.array([[3.0, 2.0, 3.0, 1.0], [2.5, 4.0, 4.0, 4.0], [math.inf, 4.0, 0.5, 4.0]])
    assert _valleys(values) == [(2, 2), (0, 3), (0, 1)]
