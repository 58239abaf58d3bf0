"""Checks of codes: worked examples by hand, and limits that the formulas must have."""

import math

import numpy as np
import pytest
from rocking.assessment import checks
from rocking.assessment.battery import ties_of
from rocking.assessment.demand import RecordDemand, TableDemand, eta, floor_demand
from rocking.assessment.mechanism import Facade, overturning
from rocking.mechanics.closed_forms import (
    amplitude_after_impacts,
    block,
    overturning_half_sine,
    restitution_one_sided,
)
from rocking.mechanics.rocking_block import overturning_pga, peak_rotation

WALL = overturning(Facade(6.0, 0.6, 100e3))
SPECTRUM = TableDemand(np.array([0.0, 0.2, 0.5, 3.0]), np.array([0.2, 0.5, 0.5, 0.05]))
CHAIN = {"n_dof": 2, "period_s": 0.3, "damping_ratio": 0.05}


def three(value, expected):
    """Equal to three figures."""
    assert value == pytest.approx(expected, rel=5e-4), (value, expected)


def test_linear_check_by_hand():
    """2 · 0.1 g/(0.75 · 1.2) = 0.2222 g against 0.2 g: fails at 0.2222 g."""
    found = checks.linear(WALL, SPECTRUM, "on the ground", confidence_factor=1.2)
    three(found.capacity, 0.2222)
    three(found.ratio, 1.111)
    three(found.failing_pga_g, 0.2222)


def test_nonlinear_slv_by_hand():
    """d0 = 0.597: d* = 0.4·0.597·2/3 = 0.1592; sin θ = 0.0398, α = tan(0.0997 − 0.0398) = 0.0599.

    a = 0.0599/0.75 g = 0.784 m/s², T = 1.68π√(0.1592/0.784) = 2.378 s; S_e = 0.5 − 0.45·1.878/2.5 =
    0.162 g at 5 %, ·√(10/13) = 0.1421 g at 8 %; S_De = 0.1421·9.81·(2.378/2π)² = 0.1997 m.
    """
    found = checks.nonlinear(WALL, SPECTRUM, "on the ground")
    steps = {symbol: value for symbol, _, value, _ in found.steps}
    three(found.capacity, 0.1592)
    three(steps["α(d_SLV)"], 0.05993)
    assert steps["T_SLV"] == pytest.approx(2.378, abs=2e-3)
    assert found.demand == pytest.approx(0.1997, abs=5e-4)
    assert found.failing_pga_g == pytest.approx(0.2 * 0.1592 / 0.1997, rel=3e-3)


def test_nonlinear_slc_by_hand():
    """d* = 0.6·0.597·2/3 = 0.2388; sin θ = 0.0597, α = tan(0.09967 − 0.05974) = 0.03995.

    a = 0.5225 m/s², T = 1.56π√(0.2388/0.5225) = 3.313 s; S_e = 0.05(3/3.313)²·√(10/15) = 0.03347 g;
    S_De = 0.03347·9.81·(3.313/2π)² = 0.0913 m.
    """
    found = checks.nonlinear(WALL, SPECTRUM, "on the ground", "SLC")
    three(found.capacity, 0.2388)
    assert found.demand == pytest.approx(0.0913, abs=3e-4)


def test_floor_spectrum_by_hand():
    """One mode, T = 0.3 s, γψ = 1.2·0.5 = 0.6 (n = 2), S_e = 0.5 g: a = 0.3·√1.01 = 0.3015 g.

    R = 1.1/√0.05 = 4.919. At T = 0: a; at 0.3 s: R a = 1.483; at 0.12 s: 1 − 0.5 = 0.5,
    4.919·0.3015/(1 + 3.919·0.5^1.6 = 2.293) = 0.6468; at 0.66 s: 1.483/(1 + 3.919) = 0.3015.
    """
    floor = floor_demand(SPECTRUM, 0.5, CHAIN, simplified=True)
    three(floor.peaks()[0], 0.3015)
    three(floor.acceleration(0.0), 0.3015)
    three(floor.acceleration(0.3), 1.483)
    three(floor.acceleration(0.12), 0.6468)
    three(floor.acceleration(0.66), 0.3015)


def test_a_grounded_floor_spectrum_is_the_larger_of_two_beyond_the_building():
    """At 3 s the ground has 0.05 g; the formula 1.483/(1 + 3.919(3/0.33 − 1)^1.2) = 0.0302 g."""
    plain = floor_demand(SPECTRUM, 0.5, CHAIN, simplified=True)
    grounded = floor_demand(SPECTRUM, 0.5, CHAIN, simplified=True, grounded=True)
    three(plain.acceleration(3.0), 0.03017)
    three(grounded.acceleration(3.0), 0.05)
    three(grounded.acceleration(0.2), plain.acceleration(0.2))


def test_floor_spectrum_of_all_modes_is_continuous_at_the_ground():
    """On the ground no mode has a share; at the roof Σ γψ = 1 and the first is 1.17 (n = 2)."""
    assert floor_demand(SPECTRUM, 0.0, CHAIN).acceleration(0.3) == 0.0
    shares = floor_demand(SPECTRUM, 1.0, CHAIN).share
    three(sum(shares), 1.0)
    three(shares[0], 1.171)


def test_parts_by_hand():
    """h_i = 3 of 9 m: C_Hi = 1.5; C_i = 2; 0.2·1.5·2 = 0.6 against 0.1: fails at 0.0333 g."""
    found = checks.parts(WALL, SPECTRUM, 3.0, 9.0, 0.0)
    three(found.demand, 0.600)
    three(found.failing_pga_g, 0.03333)
    three(checks.height_coefficient(2.0, 40.0), 1.333)
    three(checks.height_coefficient(5.0, 100.0), 1.500)
    three(checks.height_coefficient(13.0, 40.0), 3.000)
    three(checks.part_coefficient(1.0), 1.500)
    three(checks.part_coefficient(2.0), 0.500)


def test_housner_by_hand():
    """α = 0.09967, R = 3.015 m: V = √(8·9.81·3.015·0.004963/3)/0.99504 = 0.6286 m/s."""
    found = checks.housner(6.0, 0.6, SPECTRUM)
    three(found.capacity, 0.6286)
    alpha, _, p = block(6.0, 0.6)
    assert found.capacity == pytest.approx(alpha * 9.81 / p, rel=1e-2)


def test_scaling_a_demand_to_the_failing_pga_makes_each_check_just_fail():
    rng = np.random.default_rng(3)
    values, dt = np.cumsum(rng.standard_normal(1500)) * 0.05, 0.01
    values -= values.mean()
    for check in (
        lambda d: checks.linear(WALL, d, "on the ground"),
        lambda d: checks.nonlinear(WALL, d, "on the ground"),
        lambda d: checks.nonlinear(WALL, floor_demand(d, 0.5, CHAIN), "at 0.5 h", "SLC"),
        lambda d: checks.housner(6.0, 0.6, d),
    ):
        once = check(RecordDemand(values, dt))
        factor = once.failing_pga_g / RecordDemand(values, dt).pga_g
        assert check(RecordDemand(factor * values, dt)).ratio == pytest.approx(1.0, rel=1e-9)


def test_table_demand_follows_eta_and_a_constant_displacement():
    assert eta(0.05) == pytest.approx(1.0)
    assert eta(0.60) == 0.55
    long, longer = SPECTRUM.acceleration(4.0), SPECTRUM.acceleration(8.0)
    assert long == pytest.approx(4.0 * longer)


def test_one_degree_of_freedom_rebounds_as_the_closed_form():
    """Released at θ0/α = 0.5, no shaking: one impact later at 1 − √(1 − 1.21·0.75) = 0.696.

    A restitution above 1 makes the rebound the largest rotation; 4/p ends before the next impact.
    """
    h, b = 10.0, 0.1
    alpha, _, p = block(h, b)
    quiet = np.zeros(round(4.0 / p / 0.005))
    found = peak_rotation(quiet, 0.005, h, b, start_rad=0.5 * alpha, restitution=1.1)
    assert found == pytest.approx(amplitude_after_impacts(0.5, 1.1, 1), rel=2e-3)
    assert found == pytest.approx(0.6959, rel=2e-3)
    assert abs(restitution_one_sided(alpha)) == pytest.approx(0.5, abs=0.01)


def test_one_degree_of_freedom_overturns_where_the_closed_form_says():
    """Half sine with ω/p = 3 overturns a slender block without impact from x = 2.2939 on."""
    h, b = 10.0, 0.2
    alpha, _, p = block(h, b)
    omega = 3.0 * p
    dt = math.pi / omega / 2000
    pulse = np.concatenate([np.sin(omega * dt * np.arange(2001)), np.zeros(30000)])
    x = overturning_half_sine(3.0)
    found = overturning_pga(pulse, dt, h, b, -1.0, 3.0, ratio=1.002)
    assert found / math.tan(alpha) == pytest.approx(x, rel=6e-3)
    assert math.isnan(overturning_pga(pulse, dt, h, b, 1.0, 0.9 * x * alpha))


def test_rows_of_ties_enter_the_mechanism_with_their_capacity():
    """Two rods of 16 mm at 235 MPa: 94.5 kN at 5 m on 100 kN: (100·0.3 + 94.5·5)/300 = 1.675."""
    row = {"height_m": 5.0, "count": 2, "diameter_mm": 16.0, "length_m": 4.0, "e_mpa": 2e5}
    row |= {"yield_mpa": 235.0, "elongation": 0.05, "slack_mm": 0.0, "anchor_kn": None}
    ((force, height, reach, fades),) = ties_of({"ties": [row], "height_m": 6.0})
    three(force, 94.50e3)
    assert (height, reach, fades) == (5.0, pytest.approx(0.2), False)
    tied = overturning(Facade(6.0, 0.6, 100e3), ties_of({"ties": [row], "height_m": 6.0}))
    three(tied.multiplier(), 1.675)
    assert ties_of({"ties": [], "height_m": 6.0}, 5e3) == [(5e3, 6.0, 0.2, False)]
