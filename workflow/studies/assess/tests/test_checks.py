"""Checks of codes: worked examples by hand, and limits that the formulas must have."""

import math

import numpy as np
import pytest
from plain_facade import PlainFacade, courses, overturning, two_blocks
from rocking.mechanics.blocks import interlocking
from rocking.mechanics.closed_forms import Interlocked, block
from scipy.optimize import brentq
from studies.assess import checks
from studies.assess.demand import RecordDemand, TableDemand, floor_demand
from studies.assess.family import pulls_of
from study_cases import study_settings, three

WALL = overturning(PlainFacade(6.0, 0.6, 100e3))
SPECTRUM = TableDemand(np.array([0.0, 0.2, 0.5, 3.0]), np.array([0.2, 0.5, 0.5, 0.05]))
FLAT = TableDemand(np.array([0.0, 0.1, 9.0]), np.array([0.2, 0.5, 0.5]))
CHAIN = {"n_dof": 2, "period_s": 0.3, "damping_ratio": 0.05}


def numbers(check):
    """Steps of a check by symbol."""
    return {symbol: value for symbol, _, value, _ in check.steps}


def test_linear_check_by_hand():
    """2 · 0.1 g/(0.75 · 1.2) = 0.2222 g against 0.2 g: fails at 0.2222 g, onset at 0.1111 g."""
    found = checks.linear(WALL, SPECTRUM, "on the ground", confidence_factor=1.2)
    three(found.capacity, 0.2222)
    three(found.ratio, 1.111)
    three(found.failing_pga_g, 0.2222)
    three(numbers(found)["a_g,SLD"], 0.1111)


def test_confidence_is_that_of_level_one_unless_the_hinge_crushes():
    assert checks.confidence(1.0, 0.0) == 1.35
    assert checks.confidence(1.0, 0.02) == 1.0
    assert checks.confidence(1.2, 0.02) == 1.2


def test_nonlinear_slv_by_hand():
    """d0 = 0.597: d* = 0.4·0.597·2/3 = 0.1592; sin θ = 0.0398, α = tan(0.0997 − 0.0398) = 0.0599.

    a = 0.0599/0.75 g = 0.784 m/s², T = 1.68π√(0.1592/0.784) = 2.379 s; on a spectrum that stays at
    0.5 g, 0.5·√(10/13) = 0.4385 g at 8 %: S_De = 0.4385·9.807·(2.379/2π)² = 0.6164 m; it fails at
    0.2·0.1592/0.6164 = 0.0517 g, but not below the onset, 0.1/0.75 = 0.1333 g.
    """
    found = checks.nonlinear(WALL, FLAT, "on the ground")
    three(found.capacity, 0.1592)
    three(numbers(found)["a(d_SLV)"], 0.05993 / 0.75)
    assert numbers(found)["T_SLV"] == pytest.approx(2.379, abs=2e-3)
    assert found.demand == pytest.approx(0.6164, abs=1.5e-3)
    three(found.failing_pga_g, 0.1333)


def test_nonlinear_slv_with_confidence_by_hand():
    """FC = 1.35 lengthens T by √1.35: 2.379·1.1619 = 2.764 s, the demand by 1.35.

    At 2.764 s the table has 0.05 + 0.45·(3 − 2.764)/2.5 = 0.0925 g, ·0.8771 at 8 %: S_De =
    0.0811·9.807·(2.764/2π)² = 0.154 m. The largest lies before, at √3.28 s = 1.81 s, where S T² of
    the line 0.59 − 0.18T is greatest: T = 2/3·0.59/0.18 = 2.185 s, 0.1967·0.8771·9.807·(2.185/2π)²
    = 0.2046 m; it fails at 0.2·0.1592/0.2046 = 0.1556 g.
    """
    found = checks.nonlinear(WALL, SPECTRUM, "on the ground", confidence_factor=1.35)
    assert numbers(found)["T_SLV"] == pytest.approx(2.764, abs=2e-3)
    assert found.demand == pytest.approx(0.2046, abs=5e-4)
    assert numbers(found)["T_max"] == pytest.approx(2.185, rel=0.04)
    assert found.failing_pga_g == pytest.approx(0.1556, abs=5e-4)


def test_nonlinear_slc_by_hand():
    """d* = 0.6·0.597·2/3 = 0.2388; sin θ = 0.0597, α = tan(0.09967 − 0.05974) = 0.03995.

    a = 0.5225 m/s², T = 1.56π√(0.2388/0.5225) = 3.313 s, 10 %: 0.5·√(10/15) = 0.4082 g on the flat
    spectrum, S_De = 0.4082·9.807·(3.313/2π)² = 1.113 m.
    """
    found = checks.nonlinear(WALL, FLAT, "on the ground", "SLC")
    three(found.capacity, 0.2388)
    assert numbers(found)["T_SLC"] == pytest.approx(3.313, abs=3e-3)
    assert found.demand == pytest.approx(1.113, abs=3e-3)


def test_an_inset_takes_capacity_and_displacement():
    """A hinge 0.05 m inside: α0 = 0.25/3 = 0.0833, d0 = 6 sin(atan(0.0833)) = 0.4983.

    d* = 0.4·0.4983·2/3·(how the mass moves) stays 2/3 as the weights' heights do; T grows not with
    b: a(0.4 d0)/d is α0(1 − 0.4)/(0.4 d0), the same but for the second order.
    """
    inset = overturning(PlainFacade(6.0, 0.6, 100e3, hinge_inset_m=0.05))
    three(inset.multiplier(), 0.08333)
    three(inset.ultimate()[1], 0.4983)
    found = checks.nonlinear(inset, FLAT, "on the ground")
    three(found.capacity, 0.1329)


def test_a_pull_that_fades_is_gone_at_its_reach():
    """12 kN at 2 m that fade over 0.1 m add 12·2/300 = 0.08 at rest and half at 0.05 m of slip."""
    fading = overturning(PlainFacade(6.0, 0.6, 100e3), [(12e3, 2.0, 0.1, True)])
    three(fading.multiplier(), 0.1800)
    theta = math.asin(0.05 / 2.0)
    gain = fading.multiplier(theta) - WALL.multiplier(theta)
    expected = 0.5 * 12e3 * 2.0 * math.cos(theta)
    expected /= 100e3 * (3.0 * math.cos(theta) + 0.3 * math.sin(theta))
    assert gain == pytest.approx(expected, rel=1e-9)
    assert fading.ultimate()[1] == pytest.approx(WALL.ultimate()[1], rel=1e-12)


def test_interlocking_by_hand():
    """h = 6 m in courses of 0.3 m: n = 20, 0.4·20·21·(0.3/0.15)·0.577·0.15²·0.4·18 kN = 31.41 kN.

    Two walls: 62.8 kN at 2 m: α0 = 0.1 + 62.8·2/300 = 0.5188. Courses summed have 1/0.8 of it for
    many courses, and the same height: μ γ t v h n(n − 1)/2 = 0.577·18·0.4·0.15·0.3·190 = 35.52 kN.
    """
    given = (6.0, Interlocked(0.3, 0.15, 0.4, 0.577), 18e3)
    force, height, reach, fades, _ = interlocking(*given)
    three(force, 62.82e3)
    three(height, 2.0)
    assert (reach, fades) == (0.15, True)
    tied = overturning(PlainFacade(6.0, 0.6, 100e3), [(force, height, reach, fades)])
    three(tied.multiplier(), 0.5188)
    summed = courses(*given)
    total = sum(row[0] for row in summed)
    three(total, 71.04e3)
    assert sum(f * z for f, z, *_ in summed) / total == pytest.approx(7 * 0.3, rel=1e-9)


def test_a_broken_tie_is_a_limit_before_a_share_of_d0():
    """30 kN at 5 m that break at 0.1 m: α falls from 0.58 to 0.08, more than half of 0.6.

    There the top has moved by 0.12 m, less than 0.4·0.597; 3 kN take less than half and do not
    count.
    """
    wall = PlainFacade(6.0, 0.6, 100e3)
    strong = overturning(wall, [(30e3, 5.0, 0.1, False)])
    found, broken = strong.limit(0.4)
    assert broken
    three(found, 0.1200)
    weak, broken = overturning(wall, [(3e3, 5.0, 0.1, False)]).limit(0.4)
    assert not broken
    three(weak, 0.4 * 0.5970)


def test_a_held_load_lowers_only_the_letters_mass_ratio():
    """100 kN held on the top of 100 kN: e* without it 0.75, with it 0.375; the onset doubles."""
    held = two_blocks(PlainFacade(6.0, 0.6, 100e3, roof_n=100e3, roof_arm_m=0.3), 3.0)
    mechanics, letter = held.participation()[1], held.participation(letter=True)[1]
    three(letter, 0.5 * mechanics)
    three(mechanics, 0.7500)


def test_what_pushes_and_does_not_bear_counts_horizontally():
    """Q = 20 kN at the top: α0 = 100·0.3/(100·3 + 20·6) = 0.0714; e* = 420²/(120·(1200 + 720))."""
    pushed = overturning(PlainFacade(6.0, 0.6, 100e3, pushing_n=20e3))
    three(pushed.multiplier(), 30.0 / 420.0)
    three(pushed.participation()[1], 420.0**2 / (120.0 * 1920.0))


def test_an_element_free_to_vibrate_by_hand():
    """1.5 m high, 0.3 m thick, 18 kN/m³, E = 900 MPa: T0 = 6.2·5·1.5·√(18e3/(900e6·9.807)).

    = 0.0664 s; its onset is felt at S_e(T0), 0.2 + 0.3·0.0664/0.2 = 0.2996 g instead of 0.2 g: the
    linear check fails at q·0.2·(α0/0.75)/0.2996.
    """
    t0 = checks.initial_period(1.5, 0.3, 18e3, 900e6)
    three(t0, 0.06641)
    part = overturning(PlainFacade(1.5, 0.3, 20e3))
    found = checks.linear(part, SPECTRUM, "at a height", t0_s=t0)
    three(found.demand, 0.2996)
    three(found.failing_pga_g, 2.0 * 0.2 * (0.2 / 0.75) / 0.2996)
    stiff = (2.0 * math.pi / t0) ** 2 * part.participation()[2]  # of the elastic branch
    end = part.ultimate()[1] * (1.0 - 1e-9)
    d = brentq(lambda d: stiff * d - checks.capacity_at(part, d, 1.0), 0.0, end)
    three(checks.capacity_at(part, 0.5 * d, 1.0, t0) / checks.capacity_at(part, d, 1.0, t0), 0.5)
    assert checks.capacity_at(part, 2.0 * d, 1.0, t0) < checks.capacity_at(part, d, 1.0, t0)


def test_eurocode_at_second_hand_by_hand():
    """d0* = 0.597·2/3 = 0.398; d = 0.1592, a* = 0.1·0.6/0.75 g = 0.7845, T = 1.6π√(d/a) = 2.264 s.

    At 8 % on the flat spectrum 0.4385 g·9.807·(2.264/2π)² = 0.5585 m; γ_Rd = 1.55·1.2 = 1.86:
    0.1592/1.86 = 0.0856 m; on a floor without η. At level 3 with a hinge that crushes 1.30.
    """
    found = checks.eurocode(WALL, FLAT, "on the ground")
    three(found.capacity, 0.1592 / 1.86)
    assert numbers(found)["T_SD"] == pytest.approx(2.264, abs=2e-3)
    assert found.demand == pytest.approx(0.5585, abs=1.5e-3)
    best = checks.eurocode(WALL, FLAT, "on the ground", knowledge=3, crushes=True)
    three(best.capacity, 0.1592 / 1.30)
    floor = floor_demand(FLAT, 0.0, CHAIN)
    on_floor = checks.eurocode(WALL, floor, "at 0", "NC")
    three(on_floor.capacity, 0.2388 / 1.86)
    period = numbers(on_floor)["T_NC"]
    assert on_floor.demand == pytest.approx(0.5 * 9.80665 * (period / (2 * math.pi)) ** 2, rel=1e-6)


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


def test_parts_fail_at_the_same_pga_however_strong_the_shaking():
    """2 g ask for 2·1.5·2 = 6 W, cut off at 3.6 W; the PGA it fails at stays 0.1/3 g."""
    strong = TableDemand(SPECTRUM.period_s, 10.0 * SPECTRUM.acceleration_g)
    found = checks.parts(WALL, strong, 3.0, 9.0, 0.0)
    three(found.demand, 3.6)
    three(found.failing_pga_g, 0.03333)
    stubby = overturning(PlainFacade(1.0, 4.0, 100e3))  # α0 = 4 W: never
    assert math.isinf(checks.parts(stubby, strong, 3.0, 9.0, 0.0).failing_pga_g)


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
        lambda d: checks.eurocode(WALL, d, "on the ground"),
        lambda d: checks.housner(6.0, 0.6, d),
    ):
        once = check(RecordDemand(values, dt))
        factor = once.failing_pga_g / RecordDemand(values, dt).pga_g
        assert check(RecordDemand(factor * values, dt)).ratio == pytest.approx(1.0, rel=1e-9)


def test_rows_of_ties_enter_the_mechanism_with_their_capacity():
    """Two rods of 16 mm at 235 MPa: 94.5 kN at 5 m on 100 kN: (100·0.3 + 94.5·5)/300 = 1.675."""
    row = {"height_m": 5.0, "count": 2, "diameter_mm": 16.0, "length_m": 4.0, "e_mpa": 2e5}
    row |= {"yield_mpa": 235.0, "elongation": 0.05}
    facade = study_settings({"facade": {"height_m": 6.0, "ties": [row]}})["facade"]
    ((force, height, reach, fades, _),) = pulls_of(facade)
    three(force, 94.50e3)
    assert (height, reach, fades) == (5.0, pytest.approx(0.2), False)
    tied = overturning(PlainFacade(6.0, 0.6, 100e3), pulls_of(facade))
    three(tied.multiplier(), 1.675)
    assert pulls_of({**facade, "ties": []}) == []
