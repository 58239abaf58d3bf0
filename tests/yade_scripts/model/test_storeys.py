"""Storeys that yield: loops with closed forms, energy, equal displacement, convergence."""

import math

import numpy as np
import pytest
from rocking import Case
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.signal import butter, sosfiltfilt

from smdof import floor_motions, shear_chain
from smdof.oscillator import refine_linear
from yade_scripts.model.chain import chain_matrices
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.storeys import (
    LAWS,
    MEMORY,
    SHEAR,
    WORK,
    Loops,
    chain_of,
    largest_drift,
    march,
    rules_of,
)

K, V_Y = 2.0e6, 4.0e3  # u_y = 2 mm
U_Y = V_Y / K
SECTIONS = Case.configured("W2").sections
STEPS_PER_PERIOD = 40  # of the shortest elastic period


def section(law, ratio, period_s=0.27, n_dof=4, **how):
    """Section smdof of a chain with 5 % of the critical damping in every mode."""
    chain = {"n_dof": n_dof, "period_s": period_s, "damping_ratio": 0.05, "damping_model": "modal"}
    loops = {"base_shear_ratio": ratio, "loops": law, "hardening": 0.02, "unloading": 0.0}
    falls = {"flag_share": 0.3, "loss_drift_ratio": None, "lost_drift_ratio": None, "residual": 0.2}
    return {**chain, **loops, **falls, **how}


def storey(law, **how):
    """`Loops` of one storey of K, V_Y and a metre's height, at rest."""
    mass_kg = 1000.0
    period_s = 2.0 * math.pi * math.sqrt(mass_kg / K)
    chain = section(law, V_Y / (mass_kg * STANDARD_GRAVITY_M_S2), period_s, 1, **how)
    return Loops(rules_of(chain, 1.0, mass_kg), np.zeros((1, MEMORY)))


def moved(loops, drift_m):
    """Shear force of a storey that is moved to a drift [N]."""
    return K * drift_m - loops.less(0, drift_m)


def cycled(law, peak_m, cycles=3, **how):
    """Spent energy of each cycle between ± a drift, of one storey [J], and the storey."""
    loops, spent = storey(law, **how), []
    quarter = np.linspace(0.0, peak_m, 400)
    path = np.concatenate([quarter, quarter[::-1], -quarter, -quarter[::-1]])
    for _ in range(cycles):
        before = loops.work[0]
        for u in path:
            loops.less(0, u)
        spent.append(loops.work[0] - before)
    return spent, loops


@pytest.mark.parametrize("hardening", [0.0, 0.1])
def test_a_bilinear_cycle_spends_its_parallelogram(hardening):
    """4 (1 − α) V_y (u_m − u_y) for u_m ≥ 2 u_y."""
    spent, _ = cycled("bilinear", 5.0 * U_Y, hardening=hardening)
    assert spent[-1] == pytest.approx(4.0 * (1.0 - hardening) * V_Y * 4.0 * U_Y, rel=1e-3)


def test_a_flag_spends_its_share_and_comes_back():
    share = 0.3
    spent, loops = cycled("flag", 5.0 * U_Y, hardening=0.02, flag_share=share)
    bilinear, _ = cycled("bilinear", 5.0 * U_Y, hardening=0.02)
    assert spent[-1] == pytest.approx(share * bilinear[-1], rel=1e-6)
    assert abs(loops.shear[0]) < V_Y


def test_the_origin_oriented_law_spends_nothing_in_a_cycle_again():
    spent, _ = cycled("origin_oriented", 5.0 * U_Y)
    assert spent[0] > V_Y * U_Y
    assert spent[-1] == pytest.approx(0.0, abs=1e-6 * spent[0])


@pytest.mark.parametrize("unloading", [0.0, 0.5])
def test_a_peak_oriented_cycle_spends_the_polygon_of_its_turns(unloading):
    """Corners (u_m, V_m), (u_m − V_m/k_u, 0) and their mirror: the shoelace formula."""
    peak = 5.0 * U_Y
    spent, _ = cycled("peak_oriented", peak, hardening=0.05, unloading=unloading)
    most = V_Y + 0.05 * K * (peak - U_Y)
    zero = peak - most / (K * (U_Y / peak) ** unloading)
    corners = np.array([(peak, most), (zero, 0.0), (-peak, -most), (-zero, 0.0)])
    x, y = corners.T
    area = 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
    assert spent[-1] == pytest.approx(area, rel=5e-3)


def test_a_peak_oriented_storey_unloaded_in_part_goes_back_the_way_it_came():
    loops, forces = storey("peak_oriented"), {}
    for u in (*np.linspace(0, 4 * U_Y, 50), 3.8 * U_Y, 3.6 * U_Y, 3.8 * U_Y, 4 * U_Y, 5 * U_Y):
        forces.setdefault(round(u / U_Y, 6), []).append(moved(loops, u))
    assert forces[3.8][0] == pytest.approx(forces[3.8][1])
    assert forces[4.0][0] == pytest.approx(forces[4.0][1])


@pytest.mark.parametrize("law", LAWS)
def test_strength_falls_in_a_straight_line_and_stays_lost(law):
    """At 8 u_y half of what is between all and the residual is gone."""
    falls = {"loss_drift_ratio": 6 * U_Y, "lost_drift_ratio": 10 * U_Y, "residual": 0.4}
    loops = storey(law, hardening=0.0, **falls)
    for u in np.linspace(0.0, 8.0 * U_Y, 200):
        force = moved(loops, u)
    assert force == pytest.approx(0.7 * V_Y, rel=1e-6)
    for u in np.linspace(0.0, 20.0 * U_Y, 400):
        force = moved(loops, u)
    assert force == pytest.approx(0.4 * V_Y, rel=1e-6)


def test_strengths_are_those_of_forces_in_proportion_to_weight_and_height():
    """Three equal floors at 1, 2, 3: 6/6, 5/6 and 3/6 of the base shear."""
    found = rules_of(section("bilinear", 0.2, n_dof=3), 1.0, 30.0 / STANDARD_GRAVITY_M_S2)
    assert found.k_n_m * found.yield_m == pytest.approx((6.0, 5.0, 3.0))


def shaken(seconds=8.0, dt=0.01, seed=3, peak=3.0):
    """A smoothed noise under an envelope [m/s²]."""
    t = dt * np.arange(int(seconds / dt))
    noise = np.convolve(np.random.default_rng(seed).standard_normal(t.size), np.hanning(9), "same")
    a = noise * np.exp(-(((t - 0.4 * seconds) / (0.2 * seconds)) ** 2))
    return peak * a / np.abs(a).max(), dt


def marched(ground, dt_s, chain, factors, parts=None):
    """Step [s], ground, floors and end of histories of a case's chain, steps cut into parts."""
    if parts is None:
        shortest = shear_chain(chain["n_dof"], chain["period_s"]).periods_s()[-1]
        parts = max(1, math.ceil(dt_s * STEPS_PER_PERIOD / shortest))
    step_s, fine = dt_s / parts, refine_linear(ground, parts)
    return step_s, fine, *march(chain_of({**SECTIONS, "smdof": chain}, step_s), fine, factors)


@pytest.mark.parametrize("law", LAWS)
def test_so_strong_a_building_is_the_elastic_one(law):
    """V/W of 10, by two routes: both move the modes exactly."""
    a, dt = shaken(3.0)
    exact = floor_motions(a, dt, chain=shear_chain(4, 0.27))
    _, _, floors, _ = marched(a, dt, section(law, 10.0), [1.0, -1.0], exact.refine)
    for found, like in zip(floors[0], exact.floors_m_s2, strict=True):
        assert np.abs(found - like).max() < 1e-9 * np.abs(like).max()
    assert np.array_equal(floors[0], -floors[1])


@pytest.mark.parametrize("ratio", [0.15, 10.0])
@pytest.mark.parametrize("law", LAWS)
def test_energy_closes(law, ratio):
    """Input = stored + viscous + hysteretic; V/W of 10 is the elastic chain."""
    a, dt = shaken(3.0)
    chain, factors = section(law, ratio), np.array([0.5, 1.0, 2.0])
    step, ground, floors, ends = marched(a, dt, chain, factors)
    mass, stiffness, damping = chain_matrices(chain, 1.0)
    shaking = factors[:, None, None] * ground
    speed = cumulative_trapezoid(floors - shaking, dx=step, initial=0.0)
    given = -np.trapezoid((shaking * np.diag(mass)[:, None] * speed).sum(axis=1), dx=step)
    viscous = np.trapezoid(np.einsum("hit,ij,hjt->ht", speed, damping, speed), dx=step)
    n = chain["n_dof"]
    modes = ends[:, : 2 * n].reshape(-1, n, 2)
    memory = ends[:, 2 * n :].reshape(-1, n, MEMORY)
    elastic = memory[..., SHEAR] ** 2 / (2.0 * stiffness[-1, -1])
    hysteretic = (memory[..., WORK] - elastic).sum(axis=1)
    stored = 0.5 * (modes[..., 1] ** 2).sum(axis=1) + elastic.sum(axis=1)
    assert np.all(np.abs(given - viscous - hysteretic - stored) < 5e-3 * given)
    if ratio < 1.0:
        assert hysteretic[2] > 0.1 * given[2]


def test_an_elastoplastic_oscillator_follows_its_equation():
    """Against an adaptive solution of ü + 2ζωu̇ + V/m = −a_g with the elastic part as a state."""
    omega, zeta = 2.0 * np.pi / 0.5, 0.05
    u_y = 0.01
    pulse = lambda t: 6.0 * np.sin(2.0 * np.pi * t / 0.8) * (t < 0.8)  # noqa: E731

    def rate(t, y):
        u, v, w = y
        yields = (abs(w) >= u_y) & (w * v > 0.0)
        return [v, -pulse(t) - 2.0 * zeta * omega * v - omega**2 * w, 0.0 if yields else v]

    exact = solve_ivp(rate, (0.0, 2.0), [0.0, 0.0, 0.0], max_step=1e-3, rtol=1e-6, atol=1e-9)
    t = np.arange(0.0, 2.0, 0.001)
    ratio = omega**2 * u_y / STANDARD_GRAVITY_M_S2
    one = section("bilinear", ratio, 0.5, 1, damping_ratio=zeta, hardening=0.0)
    *_, ends = marched(pulse(t), 0.001, one, [1.0])
    drift = largest_drift(ends).item()
    assert drift == pytest.approx(np.abs(exact.y[0]).max(), rel=0.01)
    assert drift > 2.0 * u_y


def broad(seed, dt=0.02):
    """A noise of 0.2 to 10 Hz under an envelope: its velocity comes back to nothing."""
    t = dt * np.arange(900)
    noise = np.random.default_rng(seed).standard_normal(t.size) * np.exp(-(((t - 7.0) / 4.0) ** 2))
    return sosfiltfilt(butter(2, (0.2, 10.0), "bandpass", fs=1.0 / dt, output="sos"), noise), dt


def test_long_periods_have_equal_displacements():
    """Veletsos and Newmark (1960): 1.5 s, a third of the elastic force, in the mean of motions."""
    ratios = []
    for seed in range(8):
        a, dt = broad(seed)
        *_, ends = marched(a, dt, section("bilinear", 10.0, 1.5, 1), [1.0])
        elastic = largest_drift(ends).item()
        third = (2.0 * np.pi / 1.5) ** 2 * elastic / 3.0 / STANDARD_GRAVITY_M_S2
        *_, ends = marched(a, dt, section("bilinear", third, 1.5, 1), [1.0])
        ratios.append(largest_drift(ends).item() / elastic)
    assert 0.75 < np.exp(np.mean(np.log(ratios))) < 1.33


@pytest.mark.parametrize("law", LAWS)
def test_the_step_converges_with_its_square(law):
    """Of the floors of a chain that yields, against a much finer step at the same times."""
    a, dt = shaken(2.0, peak=3.0)
    chain, found = section(law, 0.15), {}
    for parts in (8, 16, 64):
        *_, floors, _ = marched(a, dt, chain, [1.0], parts)
        found[parts] = floors[0, :, ::parts]
    errors = [np.sqrt(np.mean((found[parts] - found[64]) ** 2)) for parts in (8, 16)]
    assert errors[0] / errors[1] > 3.0
    assert errors[1] < 2e-3 * np.abs(found[64]).max()
