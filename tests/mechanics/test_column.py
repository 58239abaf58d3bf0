"""The elastic column: limits in closed form, SciPy's own solution, convergence, the base for it."""

import numpy as np
import pytest
from rocking.mechanics import column
from rocking.mechanics.closed_forms import capacity_compliant_base, capacity_rigid
from scipy.integrate import solve_bvp
from study_cases import study_settings

from yade_scripts.model import base

WALLS = {  # h, b [m], ρ [kg/m³], E [MPa]: the study's façade and walls of its calibration
    "façade": (6.48, 0.375, 1800.0, 1800.0),
    "soft": (6.48, 0.375, 1800.0, 900.0),
    "thick": (9.0, 0.60, 1900.0, 1500.0),
    "thin": (3.2, 0.12, 1800.0, 2500.0),
    "Shawa": (3.0, 0.25, 1810.0, 4050.0),
    "slender, soft": (4.5, 0.15, 1700.0, 800.0),
}
D = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8])


def group(wall):
    """Γ and b/h."""
    h, b, density, e_mpa = WALLS[wall]
    return column.compliance(h, b, density, 1e6 * e_mpa), b / h


def by_bvp(ds_over_b, gamma, ratio):
    """λ(d) by collocation of θ' = −κ, M' = N-weighted inclination, d' = sin θ over s from the top.

    Each displacement starts from the solution of the last.
    """

    def rates(s, y, parameters):
        theta, moment, _ = y
        (multiplier,) = parameters
        push = np.sin(theta) + multiplier * np.cos(theta)
        normal = np.maximum(s * (np.cos(theta) - multiplier * np.sin(theta)), 1e-12)
        off = np.clip(moment / normal, -0.49, 0.499999)
        width = np.minimum(1.0, 3.0 * (0.5 - off))
        cracked = off > 1.0 / 6.0
        bent = np.where(cracked, 2.0 / width**2, 12.0 * off)
        strain = np.where(cracked, bent * (0.5 - width), -1.0) * gamma * ratio**2 * normal
        return np.array(
            [
                -gamma * ratio * normal * bent,
                s * push * (1.0 + strain) / ratio,
                np.sin(theta) * (1.0 + strain) / ratio,
            ]
        )

    s, found, before, multipliers = column.graded(300), None, None, []
    for d in ds_over_b:

        def ends(top, foot, parameters, d=d):
            return np.array([top[1], top[2], foot[0], foot[2] - d])

        if found is None:
            theta = d * ratio * np.minimum(1.0, (1.0 - s) / 0.1)
            guess, start = np.array([theta, 0.4 * s**2, d * s]), 0.7 * ratio
        else:
            s, start = found.x, found.p[0]
            guess = found.y * np.array([[d / before], [1.0], [d / before]])
        before = d
        found = solve_bvp(rates, ends, s, guess, p=[start], tol=1e-6, max_nodes=20000)
        assert found.success
        multipliers.append(found.p[0])
    return multipliers


@pytest.mark.parametrize("wall", WALLS)
def test_against_collocation(wall):
    """The same equations by SciPy's boundary-value solver: λ within 0.05 %.

    If its axis did not lengthen where it opens, λ of the stiff wall were 1.4 % higher at d/b 0.8.
    """
    gamma, ratio = group(wall)
    d = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.65, 0.8])
    assert column.capacity(d, gamma, ratio) == pytest.approx(by_bvp(d, gamma, ratio), rel=5e-4)


@pytest.mark.parametrize("ratio", [0.04, 0.14])
def test_a_stiff_column_is_a_rigid_block(ratio):
    """Γ → 0: λ = tan(α − θ)."""
    theta = ratio * np.array([0.1, 0.5])
    d = np.sin(theta) / ratio + 0.5 * (1.0 - np.cos(theta))
    rigid = capacity_rigid(theta, 1.0, ratio)
    assert column.capacity(d, 1e-8, ratio) == pytest.approx(rigid, rel=2e-3)


def test_uncracked_and_buckling():
    """A short way, d/b = 1.5 Γ λ h/b without P-Δ; no stiffness is left at Greenhill's height."""
    stiff = column.capacity(1e-4, 1e-3, 0.05)[0] / 0.05 / 1e-4
    assert stiff == pytest.approx(1.0 / 1.5e-3, rel=0.003)
    left = [column.capacity(1e-3, share * column.BUCKLES, 0.05)[0] for share in (0.5, 0.99)]
    assert 0.0 < left[1] < 0.02 * left[0]
    with pytest.raises(ValueError, match="gamma = 0.7"):
        column.capacity(0.1, 0.7, 0.05)
    with pytest.raises(ValueError, match="d_over_b"):
        column.capacity(0.0, 0.01, 0.05)


def rotation_law(moment):
    """G(m) of δ = Γ G(m): top displacement d/b of the column by its foot's moment m = M/(W b).

    For Γ → 0 the part that bends is so near the foot, or so slightly bent, that the moment grows
    as s² towards it, M/(W b) = m (s/h)². With σ = s/h, uncracked up to σ₁ = min(1, 1/(6 m)),

        G = ∫ σ f dσ,   f = 12 m σ² (uncracked), 2 σ/(9 (1/2 − m σ)²) (cracked),

    integrated in closed form; m is positive and below 1/2. Then λ h/b = 2 m − δ. At small m
    G = 3 m; at large rotation m = 1/2 − 4 Γ/(9 δ): the reaction walks to the toe as 1/δ, on a
    constant spring as δ^−1/2.
    """
    m = np.asarray(moment, float)
    first = np.minimum(1.0, 1.0 / (6.0 * m))

    def integral(sigma):  # of σ²/(1/2 − m σ)², by v = 1/2 − m σ
        v = 0.5 - m * sigma
        return (0.25 / v + np.log(v) - v) / m**3

    return 3.0 * m * first**4 + 2.0 / 9.0 * (integral(1.0) - integral(first))


def test_the_closed_form_of_the_rotation():
    """δ = Γ G(m) is the column's own for small Γ; at its ends 3 m and 4/(9 (1/2 − m))."""
    assert rotation_law(0.1) == pytest.approx(0.3)
    assert rotation_law(0.5 - 1e-6) == pytest.approx(4.0 / 9e-6, rel=1e-4)
    gamma, moment = 2e-3, np.array([0.3, 0.4, 0.45])
    d = gamma * rotation_law(moment)
    got = column.capacity(d, gamma, 0.01) / 0.01
    assert got == pytest.approx(2.0 * moment - d, rel=2e-3)


@pytest.mark.parametrize("wall", ["façade", "slender, soft"])
def test_courses_converge_to_the_column(wall):
    """With the square of their number; twenty are within 2 % up to d/b 0.7."""
    gamma, ratio = group(wall)
    d = D[D <= 0.2]
    exact = column.capacity(d, gamma, ratio)
    errors = [
        np.abs(column.capacity(d, gamma, ratio, column.courses(n)) / exact - 1.0).max()
        for n in (20, 40, 80)
    ]
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert rates == pytest.approx([2.0, 2.0], abs=0.4)
    whole = column.capacity(D[:-1], gamma, ratio)
    stack = column.capacity(D[:-1], gamma, ratio, column.courses(20))
    assert stack == pytest.approx(whole, rel=0.02)


@pytest.mark.parametrize("wall", WALLS)
def test_twenty_courses_beside_the_column(wall):
    """Within 1 % of the peak up to d/b 0.8; of λ itself 2 %, if the stiff wall's foot is cut."""
    gamma, ratio = group(wall)
    exact = column.capacity(D, gamma, ratio)
    error = column.capacity(D, gamma, ratio, column.courses(20)) - exact
    assert np.abs(error).max() < 0.01 * exact.max()
    if wall != "Shawa":
        assert np.abs(error / exact).max() < 0.02
    cut = np.append(column.courses(20)[:-1], np.linspace(0.95, 1.0, 5)[1:])  # the lowest in four
    assert column.capacity(D, gamma, ratio, cut) == pytest.approx(exact, rel=0.02)


def test_the_stiff_walls_hinge_is_thinner_than_a_course():
    """Twenty joints gathered at the foot follow it within 0.2 %, twenty equal ones within 4.2 %.

    So it is where the joints lie, not how many there are, nor the law of a joint.
    """
    gamma, ratio = group("Shawa")
    exact = column.capacity(D, gamma, ratio)
    equal = column.capacity(D, gamma, ratio, column.courses(20)) / exact - 1.0
    gathered = column.capacity(D, gamma, ratio, column.graded(20, 1e-2)) / exact - 1.0
    assert equal[-1] == pytest.approx(-0.041, abs=0.002)
    assert np.abs(gathered).max() < 0.002


def on_base(wall, law):
    """λ of the rigid block on its base over D."""
    h, b, density, e_mpa = WALLS[wall]
    own = {"height_m": h, "thickness_m": b, "density_kg_m3": density, "e_mpa": e_mpa, "base": law}
    facade = {**study_settings({})["facade"], **own}
    jkn, edge = base.parts(facade)
    theta = np.arcsin(D * b / h)
    return capacity_compliant_base(theta, h, b, density, jkn, edge_pa=edge)


@pytest.mark.parametrize("wall", WALLS)
def test_the_block_on_the_columns_base(wall):
    """λ within 3 % of the column's up to d/b 0.6, and within 2.2 % of its peak up to 0.8.

    On E/h it is below everywhere once the wall cracks.
    """
    gamma, ratio = group(wall)
    exact = column.capacity(D, gamma, ratio)
    error = on_base(wall, "column") - exact
    assert np.abs(error / exact)[D <= 0.6].max() < 0.03
    assert np.abs(error).max() < 0.022 * exact.max()
    study = on_base(wall, "study") - exact
    assert np.all(study[D >= 0.1] < 0.0)
