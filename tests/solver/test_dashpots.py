"""Dashpots of blocks at the velocity of the step: what is solved in place, as dense matrices."""

from types import SimpleNamespace

import numpy as np
import pytest
from rocking.solver import dashpots, faces


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


@pytest.mark.parametrize(("a", "b"), [(1, 0), (0, 1), (0, -1), (-1, 1)])
def test_dashpots_along_a_line_by_their_sums(a, b):
    """Of many along it Σ c n nᵀ follows from Σ c (1, s, s²), across the joint and along it."""
    (ny, nz), (ey, ez), ratio = (0.6, 0.8), (0.82, -0.57), 0.4
    arms = np.array([(0.3, -0.2), (-0.1, 0.9)])
    places = np.linspace(-0.2, 0.3, 7)
    across, along = np.random.default_rng(3).random((2, places.size))
    plane = SimpleNamespace(in_row=True)
    one, other = (SimpleNamespace(own=np.zeros(12), between=np.zeros(9)) for _ in range(2))
    for s, c, d in zip(places, across, along, strict=True):
        for (y, z), dashpot in (((ny, nz), c), ((-nz, ny), ratio * d)):
            turns = [z * (ry + s * ey) - y * (rz + s * ez) for ry, rz in arms]
            dashpots.resist(plane, one, a, b, (((y, z), turns, dashpot),))
    sums = [[(c * places**n).sum() for n in range(3)] for c in (across, along)]
    joint = (a, b, 0), tuple(map(tuple, arms)), (ny, nz), (ey, ez)
    faces.resist(other, joint, (nz * ey - ny * ez, ny * ey + nz * ez), sums, (1.0, ratio))
    assert other.own == pytest.approx(one.own)
    assert other.between == pytest.approx(one.between)
    assert other.between.any() == (min(a, b) >= 0)


@pytest.mark.parametrize(("a", "b"), [(1, 0), (0, 1), (0, -1), (-1, 1)])
def test_what_withstands_one_direction_by_its_sums(a, b):
    """As node by node, and what rates of the block do to the force along y on a support."""
    (y, z), (ey, ez) = (0.6, 0.8), (0.82, -0.57)
    arms = np.array([(0.3, -0.2), (-0.1, 0.9)])
    places, plane = np.linspace(-0.2, 0.3, 7), SimpleNamespace(in_row=True)
    dashpot, back = np.random.default_rng(5).random(places.size), np.zeros(6)
    one, other = (SimpleNamespace(own=np.zeros(12), between=np.zeros(9)) for _ in range(2))
    for s, c in zip(places, dashpot, strict=True):
        turns = [z * (ry + s * ey) - y * (rz + s * ez) for ry, rz in arms]
        dashpots.resist(plane, one, a, b, (((y, z), turns, c),))
    sums = [(dashpot * places**n).sum() for n in range(3)]
    given = other, (a, b, 0), tuple(map(tuple, arms)), (y, z), z * ey - y * ez, sums, back, 3
    faces.withstand(*given)
    assert other.own == pytest.approx(one.own)
    assert other.between == pytest.approx(one.between)
    block = max(a, b)
    expected = one.own[6 * block : 6 * block + 3] * (min(a, b) < 0)
    assert back[3:] == pytest.approx(expected)
    before, back = other.own.copy(), back.copy()
    faces.withstand_slip(*given[:4], 0.7, back, 3)
    sums = 0.7, 0.0, 0.0
    again = SimpleNamespace(own=np.zeros(12), between=np.zeros(9))
    alone = np.zeros(6)
    faces.withstand(again, *given[1:5], sums, alone, 3)
    assert other.own - before == pytest.approx(again.own)
    assert back[3:] == pytest.approx(expected + alone[3:])
