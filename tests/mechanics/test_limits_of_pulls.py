"""Which pulls end a mechanism before a share of d0, and where."""

import math

import pytest
from plain_facade import PlainFacade, overturning
from rocking.mechanics.blocks import Held

WALL = PlainFacade(6.0, 0.6, 100e3)
STRONG = 40e3  # takes far more than half of the multiplier with it


def test_a_pull_that_breaks_is_a_limit_and_one_that_fades_or_never_ends_is_none():
    """At 5.5 m the point moves by 5.5 sin θ; the top by 6 sin θ."""
    free_m = 0.4 * 6.0 * math.sin(math.atan(0.1))
    found, broken = overturning(WALL, [Held(STRONG, 5.5, 0.05)]).limit(0.4)
    assert broken
    assert found == pytest.approx(0.05 * 6.0 / 5.5, rel=0.02)
    fading = overturning(WALL, [Held(STRONG, 5.5, 0.05, True)])
    assert fading.limit(0.4) == (pytest.approx(free_m, rel=1e-6), False)
    endless = overturning(WALL, [Held(1e3, 5.5, math.inf)])
    assert endless.limit(0.4) == (pytest.approx(0.4 * endless.ultimate()[1]), False)


def test_a_weak_pull_that_breaks_is_no_limit():
    """It is one where it takes more than half of the largest multiplier: T z > W b/2, about."""
    half = 100e3 * 0.3 / 5.5
    for share, broken in ((1.3, True), (0.7, False)):
        assert overturning(WALL, [Held(share * half, 5.5, 0.05)]).limit(0.4)[1] is broken


def test_a_pull_behind_a_slack_acts_from_there_to_its_end():
    """Loose for 20 mm of its point, gone after 60."""
    tied = overturning(WALL, [Held(10e3, 5.5, 0.06, False, 0.02)])
    bare = overturning(WALL)
    more = {mm: tied.multiplier(t) - bare.multiplier(t) for mm, t in turned(10, 19, 21, 59, 61)}
    assert {mm for mm, one in more.items() if one > 1e-6} == {21, 59}
    theta = dict(turned(21))[21]
    moved = 100e3 * (3.0 * math.cos(theta) + 0.3 * math.sin(theta))
    assert more[21] == pytest.approx(10e3 * 5.5 * math.cos(theta) / moved, rel=1e-9)


def turned(*millimetres):
    """Rotations at which the point at 5.5 m has moved so far."""
    return [(mm, math.asin(1e-3 * mm / 5.5)) for mm in millimetres]
