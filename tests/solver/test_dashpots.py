"""Dashpots of blocks at the velocity of the step: what is solved in place, as dense matrices."""

from types import SimpleNamespace

import numpy as np
import pytest
from rocking.solver import dashpots


def full(own):
    """The six entries of each block as a matrix."""
    c00, c01, c02, c11, c12, c22 = own
    return np.array([[c00, c01, c02], [c01, c11, c12], [c02, c12, c22]])


def placed(draw, count):
    """Direction, its place as a moment arm, and constant of some dashpots."""
    angle, arm, c = draw.uniform(0.0, 6.0, count), draw.normal(size=count), draw.random(count)
    return zip(np.cos(angle), np.sin(angle), arm, 5.0 * c, strict=True)


def test_a_dashpot_takes_the_square_of_the_speed_along_it():
    """Its matrix is c·n nᵀ with n = (y, z, arm): power c (n·v)², nothing across."""
    draw, own = np.random.default_rng(0), np.zeros(12)
    expected = np.zeros((3, 3))
    for y, z, arm, c in placed(draw, 4):
        dashpots.damp(own, 1, y, z, arm, c)
        n = np.array([y, z, arm])
        expected += c * np.outer(n, n)
    assert full(own[6:]) == pytest.approx(expected)
    assert not own[:6].any()


@pytest.mark.parametrize("freedoms", [(1, 1, 1), (1, 0, 1), (0, 1, 1), (1, 1, 0), (0, 1, 0)])
def test_accelerations_of_one_block(freedoms):
    draw, own, mass, inertia = np.random.default_rng(1), np.zeros(6), 2.0, 0.7
    for y, z, arm, c in placed(draw, 5):
        dashpots.damp(own, 0, y, z, arm, c)
    force, keep = draw.normal(size=3), np.flatnonzero(freedoms)
    whole = full(own) + np.diag([mass, mass, inertia])
    expected = np.zeros(3)
    expected[keep] = np.linalg.solve(whole[np.ix_(keep, keep)], force[keep])
    found = dashpots.solved(tuple(own), mass, inertia, tuple(map(bool, freedoms)), tuple(force))
    assert found == pytest.approx(expected)


def test_accelerations_of_blocks_in_a_row():
    """Dashpots between neighbours resist the difference of their speeds alone."""
    draw, n = np.random.default_rng(2), 4
    own, between, room = np.zeros(6 * n), np.zeros(9 * n), np.zeros(9 * n)
    mass, inertia, c = 1.0 + draw.random(n), 0.5 + draw.random(n), np.zeros((3 * n, 3 * n))
    for low in range(n - 1):
        for y, z, arm, k in placed(draw, 3):
            above = arm + draw.normal()
            dashpots.damp(own, low, y, z, arm, k)
            dashpots.damp(own, low + 1, y, z, above, k)
            dashpots.couple(between, low, y, z, arm, above, k)
            one = np.zeros(3 * n)
            one[3 * low : 3 * low + 6] = (y, z, arm, -y, -z, -above)
            c += k * np.outer(one, one)
    force = draw.normal(size=3 * n)
    diagonal = np.column_stack([mass, mass, inertia]).ravel()
    expected = np.linalg.solve(np.diag(diagonal) + c, force)
    dashpots.solve_row(own, between, room, mass, inertia, force)
    assert force == pytest.approx(expected)


def rows_of(count):
    """A plane of blocks in a row, and empty rows of their dashpots."""
    rows = {"own": np.zeros(6 * count), "between": np.zeros(9 * count)}
    return SimpleNamespace(in_row=True), SimpleNamespace(**rows)


@pytest.mark.parametrize(("a", "b"), [(1, 0), (0, 1), (0, -1)])
def test_dashpots_spread_along_a_line_act_in_its_middle_and_on_its_rotation(a, b):
    """Σ c (1, s, s²) = c L (1, m, m² + L²/12), of many along it."""
    normal, length, middle, c, n = (0.6, 0.8), 0.4, 0.11, 30.0, 2000
    arm_a, arm_b = 0.3, -0.7  # of the line's origin along the normal; s adds to both
    plane, spread = rows_of(2)
    for s in middle + length * ((np.arange(n) + 0.5) / n - 0.5):
        one = (normal, (arm_a + s, arm_b + s), c * length / n)
        dashpots.resist(plane, spread, a, b, (one,))
    _, whole = rows_of(2)
    one = (normal, (arm_a + middle, arm_b + middle), c * length)
    dashpots.resist(plane, whole, a, b, (one,))
    dashpots.resist_turning(plane, whole, a, b, c * length * length**2 / 12.0)
    assert whole.own == pytest.approx(spread.own, rel=1e-6)
    assert whole.between == pytest.approx(spread.between, rel=1e-6)
    assert whole.between.any() == (b >= 0)
