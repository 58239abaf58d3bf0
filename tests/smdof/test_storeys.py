"""Storeys that yield: loops with closed forms, energy, equal displacement, convergence."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import butter, sosfiltfilt

from smdof import Chain, floor_motions, shear_chain
from smdof.storeys import LAWS, Response, Storeys, strengths, yielding_motions

K, V_Y = 2.0e6, 4.0e3  # u_y = 2 mm
U_Y = V_Y / K


def cycled(law, peak_m, cycles=3, **how):
    """Spent energy of each cycle between ± a drift, of one storey [J], and the response."""
    response = Response(Storeys(law, (V_Y,), **how), (K,), 1)
    spent = []
    quarter = np.linspace(0.0, peak_m, 400)
    path = np.concatenate([quarter, quarter[::-1], -quarter, -quarter[::-1]])
    for _ in range(cycles):
        before = response.work_j.sum()
        for u in path:
            response.move(np.array([[u]]))
        spent.append(float(response.work_j.sum() - before))
    return spent, response


@pytest.mark.parametrize("hardening", [0.0, 0.1])
def test_a_bilinear_cycle_spends_its_parallelogram(hardening):
    """4 (1 − α) V_y (u_m − u_y) for u_m ≥ 2 u_y."""
    spent, _ = cycled("bilinear", 5.0 * U_Y, hardening=hardening)
    assert spent[-1] == pytest.approx(4.0 * (1.0 - hardening) * V_Y * 4.0 * U_Y, rel=1e-3)


def test_a_flag_spends_its_share_and_comes_back():
    share = 0.3
    spent, response = cycled("flag", 5.0 * U_Y, hardening=0.02, flag_share=share)
    bilinear, _ = cycled("bilinear", 5.0 * U_Y, hardening=0.02)
    assert spent[-1] == pytest.approx(share * bilinear[-1], rel=1e-6)
    assert abs(response.shear_n[0, 0]) < V_Y


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
    response = Response(Storeys("peak_oriented", (V_Y,)), (K,), 1)
    forces = {}
    for u in (*np.linspace(0, 4 * U_Y, 50), 3.8 * U_Y, 3.6 * U_Y, 3.8 * U_Y, 4 * U_Y, 5 * U_Y):
        forces.setdefault(round(u / U_Y, 6), []).append(float(response.move(np.array([[u]]))[0, 0]))
    assert forces[3.8][0] == pytest.approx(forces[3.8][1])
    assert forces[4.0][0] == pytest.approx(forces[4.0][1])


@pytest.mark.parametrize("law", [law for law in LAWS if law != "elastic"])
def test_strength_falls_in_a_straight_line_and_stays_lost(law):
    """At 8 u_y half of what is between all and the residual is gone."""
    how = {"hardening": 0.0, "loss_drift_m": 6 * U_Y, "lost_drift_m": 10 * U_Y, "residual": 0.4}
    response = Response(Storeys(law, (V_Y,), **how), (K,), 1)
    for u in np.linspace(0.0, 8.0 * U_Y, 200):
        force = response.move(np.array([[u]]))
    assert force[0, 0] == pytest.approx(0.7 * V_Y, rel=1e-6)
    for u in np.linspace(0.0, 20.0 * U_Y, 400):
        force = response.move(np.array([[u]]))
    assert force[0, 0] == pytest.approx(0.4 * V_Y, rel=1e-6)


def test_strengths_are_those_of_forces_in_proportion_to_weight_and_height():
    """Three equal floors at 1, 2, 3: 6/6, 5/6 and 3/6 of the base shear."""
    found = strengths(0.2, (10.0, 10.0, 10.0), (1.0, 2.0, 3.0))
    assert found == pytest.approx((6.0, 5.0, 3.0))


def shaken(seconds=8.0, dt=0.01, seed=3, peak=3.0):
    """A smoothed noise under an envelope [m/s²]."""
    t = dt * np.arange(int(seconds / dt))
    noise = np.convolve(np.random.default_rng(seed).standard_normal(t.size), np.hanning(9), "same")
    a = noise * np.exp(-(((t - 0.4 * seconds) / (0.2 * seconds)) ** 2))
    return peak * a / np.abs(a).max(), dt


WEIGHT, HEIGHT = (1.5e5,) * 4, (1.6, 3.2, 4.9, 6.5)


def chain():
    return shear_chain(4, 0.27, 4 * 1.5e5 / 9.81)


@pytest.mark.parametrize("law", LAWS)
def test_so_strong_a_building_is_the_elastic_one(law):
    """V/W of 10, by two routes: both move the modes exactly."""
    a, dt = shaken(3.0)
    exact = floor_motions(a, dt, chain=chain())
    strong = Storeys(law, strengths(10.0, WEIGHT, HEIGHT))
    found = yielding_motions(a, dt, chain(), strong, [1.0, -1.0], steps_per_period=50)
    for i in range(4):
        like = np.interp(found.time_s, exact.time_s, exact.floors_m_s2[i])
        off = np.abs(found.floors_m_s2[0, i] - like).max()
        assert off < 1e-9 * np.abs(like).max()
    assert np.array_equal(found.floors_m_s2[0], -found.floors_m_s2[1])


@pytest.mark.parametrize("law", LAWS)
def test_energy_closes(law):
    a, dt = shaken(3.0)
    weak = Storeys(law, strengths(0.15, WEIGHT, HEIGHT))
    energy = yielding_motions(a, dt, chain(), weak, [0.5, 1.0, 2.0]).energy_j
    left = energy["input"] - energy["viscous"] - energy["hysteretic"] - energy["stored"]
    assert np.all(np.abs(left) < 5e-3 * energy["input"])
    if law != "elastic":
        assert energy["hysteretic"][2] > 0.1 * energy["input"][2]


def test_an_elastoplastic_oscillator_follows_its_equation():
    """Against an adaptive solution of ü + 2ζωu̇ + V/m = −a_g with the elastic part as a state."""
    omega, zeta, mass = 2.0 * np.pi / 0.5, 0.05, 1000.0
    k = omega**2 * mass
    u_y = 0.01
    pulse = lambda t: 6.0 * np.sin(2.0 * np.pi * t / 0.8) * (t < 0.8)  # noqa: E731

    def rate(t, y):
        u, v, w = y
        yields = (abs(w) >= u_y) & (w * v > 0.0)
        return [v, -pulse(t) - 2.0 * zeta * omega * v - omega**2 * w, 0.0 if yields else v]

    exact = solve_ivp(rate, (0.0, 2.0), [0.0, 0.0, 0.0], max_step=1e-3, rtol=1e-6, atol=1e-9)
    t = np.arange(0.0, 2.0, 0.001)
    one = Chain((mass,), (k,))
    found = yielding_motions(
        pulse(t), 0.001, one, Storeys("bilinear", (k * u_y,), hardening=0.0), [1.0], zeta
    )
    assert found.drift_m[0, 0] == pytest.approx(np.abs(exact.y[0]).max(), rel=0.01)
    assert found.drift_m[0, 0] > 2.0 * u_y


def broad(seed, dt=0.02):
    """A noise of 0.2 to 10 Hz under an envelope: its velocity comes back to nothing."""
    t = dt * np.arange(900)
    noise = np.random.default_rng(seed).standard_normal(t.size) * np.exp(-(((t - 7.0) / 4.0) ** 2))
    return sosfiltfilt(butter(2, (0.2, 10.0), "bandpass", fs=1.0 / dt, output="sos"), noise), dt


def test_long_periods_have_equal_displacements():
    """Veletsos and Newmark (1960): 1.5 s, a third of the elastic force, in the mean of motions."""
    one, ratios = shear_chain(1, 1.5, 1000.0), []
    for seed in range(8):
        a, dt = broad(seed)
        elastic = yielding_motions(a, dt, one, Storeys("elastic", (1.0,)), [1.0]).drift_m[0, 0]
        weak = Storeys("bilinear", (one.stiffness_n_m[0] * elastic / 3.0,))
        ratios.append(yielding_motions(a, dt, one, weak, [1.0]).drift_m[0, 0] / elastic)
    assert 0.75 < np.exp(np.mean(np.log(ratios))) < 1.33


@pytest.mark.parametrize("law", [law for law in LAWS if law != "elastic"])
def test_the_step_converges_with_its_square(law):
    """Of the floors of a chain that yields, against a much finer step at the same times."""
    a, dt = shaken(2.0, peak=3.0)
    storeys = Storeys(law, strengths(0.15, WEIGHT, HEIGHT))
    found = {}
    for parts in (8, 16, 64):
        steps = int(parts * chain().periods_s()[-1] / dt)
        one = yielding_motions(a, dt, chain(), storeys, [1.0], steps_per_period=steps, every=parts)
        found[parts] = one.floors_m_s2[0]
    errors = [np.sqrt(np.mean((found[parts] - found[64]) ** 2)) for parts in (8, 16)]
    assert errors[0] / errors[1] > 3.0
    assert errors[1] < 2e-3 * np.abs(found[64]).max()


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"law": "takeda"}, "law: expected one of elastic"),
        ({"yield_n": (0.0,)}, "yield_n: expected positive"),
        ({"hardening": -0.1}, "hardening: expected 0 to 1"),
        ({"flag_share": 0.6}, "flag_share: expected 0 to 0.5"),
        ({"loss_drift_m": 0.02, "lost_drift_m": 0.01}, "two ascending drifts"),
    ],
)
def test_what_is_not_physical_is_named(wrong, named):
    with pytest.raises(ValueError, match=named):
        Storeys(**{"law": "bilinear", "yield_n": (1.0,), **wrong})
