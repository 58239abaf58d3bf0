"""Mechanisms by virtual work: worked examples by hand, and second routes to the same numbers."""

import math

import numpy as np
import pytest
from plain_facade import PlainFacade, courses, overturning, two_blocks
from rocking.mechanics.closed_forms import (
    GRAVITY_M_S2,
    Interlocked,
    capacity_interlocking,
    capacity_rigid,
)
from study_cases import three

WALL = PlainFacade(height_m=6.0, thickness_m=0.6, weight_n=100e3)


def test_free_facade_by_hand():
    """b/h = 0.1; e* = 3/4; d0 = h sin(atan 0.1) = 0.597; d* = 2/3 d_C."""
    found = overturning(WALL)
    mass, ratio, per_control = found.participation()
    three(found.multiplier(), 0.100)
    three(ratio, 0.750)
    three(mass, 7645.0)
    three(per_control, 0.6667)
    three(found.ultimate()[1], 0.5970)


def test_free_facade_follows_the_rigid_block_in_every_position():
    found = overturning(WALL)
    theta = np.linspace(0.0, 0.09, 7)
    alpha = [found.multiplier(t) for t in theta]
    assert alpha == pytest.approx(capacity_rigid(theta, 6.0, 0.6), abs=1e-12)


def test_roof_load_by_hand():
    """N = 20 kN at 0.2 m: (100·0.3 + 20·0.4)/(100·3 + 20·6) = 38/420; e* = 420²/(120·1920)."""
    found = overturning(WALL._replace(roof_n=20e3, roof_arm_m=0.2))
    three(found.multiplier(), 0.09048)
    three(found.participation()[1], 420.0**2 / (120.0 * (100.0 * 12.0 + 20.0 * 36.0)))


def test_tie_and_inset_by_hand():
    """T = 12 kN at 5 m: (100·0.3 + 12·5)/300 = 0.3; hinge 0.05 m inside: (100·0.25 + 60)/300."""
    tie = [(12e3, 5.0, math.inf, False)]
    three(overturning(WALL, tie).multiplier(), 0.3000)
    three(overturning(WALL._replace(hinge_inset_m=0.05), tie).multiplier(), 0.2833)


def test_a_tie_is_gone_beyond_its_reach():
    """A tie at 5 m with a reach of 0.1 m holds to θ = asin(0.1/5)."""
    found = overturning(WALL, [(12e3, 5.0, 0.1, False)])
    before, after = math.asin(0.1 / 5.0) - 1e-6, math.asin(0.1 / 5.0) + 1e-6
    assert found.multiplier(after) == pytest.approx(overturning(WALL).multiplier(after), rel=1e-12)
    work = 12e3 * 5.0 * math.cos(before)
    level = 100e3 * (3.0 * math.cos(before) + 0.3 * math.sin(before))
    gain = found.multiplier(before) - overturning(WALL).multiplier(before)
    assert gain == pytest.approx(work / level, rel=1e-9)


def test_interlocking_is_the_kinematic_curve_of_the_study():
    """Same curve as the moment equilibrium of `capacity_interlocking`, before and after slip."""
    h, b, w, rho = 6.48, 0.375, 4.4, 1800.0
    bricks = Interlocked(0.324, 0.125, 0.375, math.tan(math.radians(30)))
    pulls = courses(h, bricks, rho * 9.81)
    weight = rho * GRAVITY_M_S2 * h * b * w
    found = overturning(PlainFacade(h, b, weight), pulls)
    theta = np.array([0.0, 0.01, 0.0195, 0.03, 0.05])
    other = capacity_interlocking(theta, h, b, w, rho, bricks)
    assert [found.multiplier(t) for t in theta] == pytest.approx(other, rel=1e-3)
    three(found.multiplier(), 0.2760)
    # Σ F_i = μ γ t_s v h_b n(n − 1)/2 a wall, 20 courses
    total = 2.0 * math.tan(math.radians(30)) * rho * 9.81 * 0.375 * 0.125 * 0.324 * 190.0
    assert sum(force for force, *_ in pulls) == pytest.approx(total, rel=1e-12)


def test_two_blocks_by_hand():
    """Hinge at 4 m of 6: r = 2, W1 = 66.7, W2 = 33.3 kN, N = 20 kN at 0.3 m.

    [66.7·0.3 + (33.3 + 20)·0.6 + 2(33.3·0.3 + 20·0.3)]/(100·2) = (20 + 32 + 32)/200 = 0.42.
    """
    found = two_blocks(WALL._replace(roof_n=20e3, roof_arm_m=0.3), 4.0)
    three(found.multiplier(), 0.4200)


def test_an_inset_of_base_and_joint_by_hand():
    """Hinges 0.05 m inside: the lower block lifts 66.7 kN by 0.25, the joint by 0.5.

    The upper block turns back by r = 2 about the joint, 0.25 m from its middle: 0.5 + 2·0.25 = 1.
    (66.7·0.25 + 33.3·1.0)/(100·2) = 0.25; without inset (66.7·0.3 + 33.3·1.2)/200 = 0.3.
    """
    three(two_blocks(WALL, 4.0).multiplier(), 0.3000)
    three(two_blocks(WALL._replace(hinge_inset_m=0.05), 4.0).multiplier(), 0.2500)


def test_two_blocks_conserve_work_in_every_position():
    """Second route: lifted potential energy and horizontal work from positions alone."""
    found = two_blocks(WALL._replace(roof_n=20e3, roof_arm_m=0.3), 4.0)
    for theta, step in ((0.02, 1e-5), (0.08, 1e-5)):
        up = across = 0.0
        for weight, path in found.weights:
            (y0, z0), (y1, z1) = path(theta - step), path(theta + step)
            up += weight * (z1 - z0).real
            across += weight * (y1 - y0).real
        assert found.multiplier(theta) == pytest.approx(up / across, rel=1e-6)
    # the held top moves vertically only, whatever the rotation
    lower = found.control(0.08)
    assert lower[0].real > 0.3


def test_a_tie_above_the_wall_is_refused():
    with pytest.raises(ValueError, match="tie"):
        overturning(WALL, [(1e3, 7.0, 0.1, False)])
