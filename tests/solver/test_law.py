"""The law of a node: its limits, and the work it takes beside the work that is done on it."""

import math

import numpy as np
import pytest
from rocking.solver import law

BETA, RATIO, MU, DT = 2.76e-3, 0.4, 0.6, 1e-5
JOINT = BETA, RATIO, MU


def driven(depth_m, way_m, beta_s=0.0, dt_s=DT):
    """A node along a path: work done on it, and stored and taken energy at the end, over kn."""
    rate, speed = np.gradient(depth_m, dt_s), np.gradient(way_m, dt_s)
    steps = np.diff(way_m, prepend=way_m[0])
    slip = taken = work = 0.0
    for k, depth in enumerate(depth_m):
        normal, shear, _, slip, _, _, stored, lost = law.dry(
            depth, rate[k], speed[k], slip, steps[k], False, (beta_s, RATIO, MU), dt_s
        )
        taken += lost
        work += dt_s * (normal * rate[k] + shear * speed[k])
    return work, stored, taken


@pytest.mark.parametrize("beta_s", [0.0, 0.02])
@pytest.mark.parametrize("share", [0.5, 3.0])
def test_what_is_put_in_is_stored_or_taken(beta_s, share):
    """Pressed and moved to and fro, below the limit of friction and three times past it."""
    t = np.linspace(0.0, 1.0, 20001)
    depth = 1e-3 * np.sin(np.pi * t) + 1e-4
    way = share * MU / RATIO * 1e-4 * np.sin(2.0 * np.pi * t)
    way = way * (1.0 if share < 1.0 else 10.0)
    work, stored, taken = driven(depth, way, beta_s, t[1])
    scale = 0.5 * 1e-3**2
    assert work == pytest.approx(stored - 0.5 * depth[0] ** 2 + taken, abs=2e-3 * scale)
    if share < 1.0 and beta_s == 0.0:
        assert abs(taken) < 1e-3 * scale
    else:
        assert taken > 0.01 * scale


def test_a_sliding_node_rubs_at_its_limit_and_its_dashpot_rests():
    """T = μN and no more, whatever its speed; N has its dashpot's part, and never pulls."""
    depth, rate, speed = 1e-4, 0.01, 3.0
    normal, shear, share, slip, pressed, sticks, *_ = law.dry(
        depth, rate, speed, 0.0, 1.0, False, JOINT, DT
    )
    assert normal == pytest.approx(depth + BETA * rate)
    assert shear == pytest.approx(MU * normal)
    assert slip == pytest.approx(MU * normal / RATIO)
    assert (share, pressed, sticks) == (1.0, True, False)
    back = law.dry(depth, rate, -speed, 0.0, -1.0, False, JOINT, DT)
    assert back[1] == -shear
    against = -0.5 * MU * normal / (RATIO * BETA)  # the dashpot would take half of the limit off
    turning = law.dry(depth, rate, against, 0.0, 1.0, False, JOINT, DT)
    assert turning[1] == shear
    assert not turning[5]
    leaving = law.dry(depth, -1.0, speed, 0.0, 1e-9, False, JOINT, DT)
    assert leaving[:2] == (0.0, 0.0)
    assert not leaving[4]


def test_a_node_that_sticks_has_spring_and_dashpot_along_the_joint():
    depth, rate, speed, before, step = 1e-3, -0.02, 0.03, 1e-4, 2e-5
    normal, shear, _, slip, _, sticks, stored, taken = law.dry(
        depth, rate, speed, before, step, False, JOINT, DT
    )
    assert sticks
    assert normal == pytest.approx(depth + BETA * rate)
    assert slip == pytest.approx(before + step)
    assert shear == pytest.approx(RATIO * (slip + BETA * speed))
    assert stored == pytest.approx(0.5 * (depth**2 + RATIO * slip**2))
    assert taken == pytest.approx(DT * BETA * (rate**2 + RATIO * speed**2))


@pytest.mark.parametrize("since", [0.1, 0.5, 0.9])
def test_a_node_that_closes_within_a_step_counts_for_the_time_it_touches(since):
    """Of its dashpot, whose force is constant, the impulse is exact: until half a step from now."""
    rate, dt = 0.2, 1e-3
    depth, step = since * dt * rate, 1e-6
    got = law.dry(depth, rate, 0.0, 0.0, step, True, (BETA, RATIO, 10.0), dt)
    impulse = got[2] * dt * BETA * rate
    assert impulse == pytest.approx(BETA * rate * (since + 0.5) * dt)
    assert got[3] == pytest.approx(since * step)  # it slips from then on
    late = law.since_closed(3.0 * rate * dt, rate, dt)
    assert late == (1.5, 1.0)


def test_a_bond_breaks_at_its_tension_or_on_coulombs_line():
    strength = pull, hold = 2e-5, 3e-5
    for depth, limit in ((1e-4, hold + MU * 1e-4), (0.0, hold), (-0.9 * pull, hold)):
        for sign in (1.0, -1.0):
            assert not law.bond_breaks(depth, sign * 0.99 * limit / RATIO, strength, JOINT)
            assert law.bond_breaks(depth, sign * 1.01 * limit / RATIO, strength, JOINT)
    assert law.bond_breaks(-1.01 * pull, 0.0, strength, JOINT)
    assert not law.bond_breaks(10.0 * pull, 0.0, strength, JOINT)


@pytest.mark.parametrize("depth", [-2e-5, 3e-5])
def test_what_a_bond_loses_is_what_the_dry_node_cannot_store(depth):
    """Pulled it loses all that it held; pressed, all but what the pressure keeps."""
    slip = 4e-5
    stored = law.bonded(depth, 0.0, 0.0, slip, JOINT, DT)[6]
    kept = 0.5 * max(depth, 0.0) ** 2
    assert law.released(depth, slip, RATIO) == pytest.approx(stored - kept)


def test_a_bond_is_a_spring_and_a_dashpot_both_ways():
    depth, rate, speed, slip = -1e-5, -0.01, 0.02, 3e-5
    normal, shear, share, kept, *acts, stored, taken = law.bonded(
        depth, rate, speed, slip, JOINT, DT
    )
    assert normal == pytest.approx(depth + BETA * rate)
    assert shear == pytest.approx(RATIO * (slip + BETA * speed))
    assert (share, kept, *acts) == (1.0, slip, True, True)
    assert stored == pytest.approx(0.5 * (depth**2 + RATIO * slip**2))
    work = normal * rate + shear * speed - (depth * rate + RATIO * slip * speed)
    assert taken == pytest.approx(DT * work)
    assert math.isclose(taken, DT * BETA * (rate**2 + RATIO * speed**2), rel_tol=1e-9)
