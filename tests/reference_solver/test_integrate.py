"""Integration of the reference solver: its scheme's conditions, and the motions it is given."""

import numpy as np
import pytest
from planar_cases import drive_of, facade
from reference_solver import SupportTable, integrate
from reference_solver.motion import integrate_linear


def test_the_scheme_is_of_fifth_order_with_a_fourth_beside_it():
    """Conditions of Dormand and Prince: rows sum to the nodes; Σ b cᵏ = 1/(k + 1), k < 5; and
    Σ b A cᵏ = 1/((k + 1)(k + 2)), k < 4; the fourth-order weights fulfil one fewer of each."""
    a, c, error = integrate._A, integrate._C, integrate._E
    assert a.sum(axis=1) == pytest.approx(c)
    b = np.append(a[6], 0.0)  # the last stage stands at the step's end
    stages = np.pad(a, ((0, 0), (0, 1)))
    for k in range(5):
        assert b @ c**k == pytest.approx(1.0 / (k + 1), abs=1e-14)
        assert (error @ c**k == pytest.approx(0.0, abs=1e-14)) == (k < 4)
    for k in range(4):
        assert b @ stages @ c**k == pytest.approx(1.0 / ((k + 1) * (k + 2)), abs=1e-14)
        assert (error @ stages @ c**k == pytest.approx(0.0, abs=1e-14)) == (k < 3)
    for k in range(3):
        whole = 1.0 / ((k + 1) * (k + 2) * (k + 3))
        assert b @ stages @ stages @ c**k == pytest.approx(whole, abs=1e-14)


@pytest.mark.parametrize("factor", [1.0, -2.0])
def test_supports_between_samples_are_those_of_the_motion(factor):
    """On straight lines between samples; mirrored, what is vertical stays; after it all rest."""
    draw = np.random.default_rng(4)
    motion = SupportTable(0.01, draw.normal(size=6), draw.normal(size=(2, 6)), draw.normal(size=6))
    drive = drive_of(motion)
    u, v = np.zeros(3), np.zeros(3)
    for k, tau in ((0, 0.0), (2, 0.004), (4, 0.01)):
        base, lift = integrate._support(drive, factor, k, tau, u, v)
        at_s, samples_s = 0.01 * k + tau, 0.01 * np.arange(6)
        assert base == pytest.approx(factor * np.interp(at_s, samples_s, motion.base_m_s2))
        assert lift == pytest.approx(abs(factor) * np.interp(at_s, samples_s, motion.vertical_m_s2))
        fine_s = 0.001 * np.arange(round(1e3 * at_s) + 1)  # from the start to there
        for row, place, speed in zip(motion.relative_m_s2, u, v, strict=False):
            velocity, displacement = integrate_linear(np.interp(fine_s, samples_s, row), 0.001)
            assert place == pytest.approx(factor * displacement[-1])
            assert speed == pytest.approx(factor * velocity[-1])
    assert integrate._support(drive, factor, 5, 0.02, u, v) == (0.0, 0.0)
    assert u[:2] == pytest.approx(factor * motion.relative_m[:, -1])
    assert not v.any()


def test_errors_are_measured_in_sizes_of_the_block():
    """y and z in b, rotations in α, and their rates in p times these."""
    wall = facade()
    b, alpha, p = wall.b_m, wall.alpha_rad, wall.p_rad_s
    assert integrate.units(wall) == pytest.approx([b, b, alpha, p * b, p * b, p * alpha])
