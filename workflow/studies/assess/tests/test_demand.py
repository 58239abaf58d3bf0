"""What checks are held against: spectra of codes, records and floors, by hand."""

import math

import numpy as np
import pytest
from rocking.configuration import config
from rocking.records import Record, measures
from studies.assess.code_spectrum import CodeDemand, EurocodeDemand, soil_factors
from studies.assess.demand import (
    FloorDemand,
    RecordDemand,
    TableDemand,
    displacement,
    eta,
    floor_demand,
    largest_displacement,
)
from studies.assess.inputs import check_demand
from study_cases import three
from test_checks import CHAIN, SPECTRUM

from smdof.spectra import response_spectrum

NARROW = TableDemand(np.array([0.0, 0.29, 0.31, 0.4, 3.0]), np.array([0.2, 0.5, 0.5, 1e-3, 1e-3]))


def test_floor_spectrum_by_hand():
    """T = 0.3 s, γψ = 0.6, S_e = 0.5 g: a = 0.3·√1.01 = 0.3015 g.

    R = 1.1/√0.05 = 4.919. At T = 0: a; at 0.3 s: R a = 1.483; at 0.12 s: 1 − 0.5 = 0.5,
    4.919·0.3015/(1 + 3.919·0.5^1.6 = 2.293) = 0.6468; at 0.66 s: 1.483/(1 + 3.919) = 0.3015, less
    than the ground's 0.4712, which is the bound beyond T1.
    """
    floor = FloorDemand(SPECTRUM, 0.3, 0.6)
    three(floor.peak_g, 0.3015)
    three(floor.acceleration(0.0), 0.3015)
    three(floor.acceleration(0.3), 1.483)
    three(floor.acceleration(0.12), 0.6468)
    three(floor.acceleration(0.66), 0.4712)
    three(FloorDemand(NARROW, 0.3, 0.6).acceleration(0.66), 0.3015)
    low = FloorDemand(SPECTRUM, 0.3, 0.12)  # below T1 the ground's 0.38 g is no bound
    three(low.acceleration(0.12), 0.6468 / 5.0)


def test_floor_displacements_do_not_fall_with_the_period():
    """C8.7.1.12: beyond 1.1·0.3 s not less than 1.483 g·(0.33/2π)² = 0.04012 m at 5 %.

    At 0.8 s the formula alone has 1.483/(1 + 3.919(0.8/0.33 − 1)^1.2) g = 0.2122 g: 0.03374 m.
    """
    floor = FloorDemand(NARROW, 0.3, 0.6)
    three(displacement(floor, 0.8, 0.05), 0.04012)
    three(floor.acceleration(0.8), 0.2122)
    found, at = largest_displacement(floor, 0.0, 0.8, 0.05)
    assert found >= 0.0398  # the same, sought over the periods
    assert at < 0.42


def test_the_largest_displacement_lies_where_a_record_has_its_peak():
    """Of a sine of 1 s: the spectral displacement at 1 s is far above that at 2 s."""
    t = 0.01 * np.arange(1000)
    sine = RecordDemand(np.sin(2.0 * np.pi * t), 0.01)
    found, at = largest_displacement(sine, 0.0, 2.0, 0.08)
    assert at == pytest.approx(1.0, rel=0.06)
    assert found > 1.9 * displacement(sine, 2.0, 0.08)
    assert largest_displacement(sine, 1.5, 2.0, 0.08)[0] < 0.7 * found


def test_where_the_displacement_is_flat_its_period_is_that_at_which_it_begins():
    """T_D of NTC 2018, or the last period of a table, on the ground and low on a building."""
    code = CodeDemand(0.26, 2.4, 0.32, "B")
    periods = np.array([0.2, 0.4, 0.8, 1.6, 2.5])
    table = TableDemand(np.array([0.0, *periods]), np.array([0.3, *(0.14 / periods)]))
    for ground, begins in ((code, 4.0 * 0.26 + 1.6), (table, 2.5)):
        for demand in (ground, FloorDemand(ground, 0.3, 0.2)):
            found, at = largest_displacement(demand, 0.0, 3.7, 0.08)
            assert at == pytest.approx(begins)
            assert found == pytest.approx(displacement(ground, 3.3, 0.08))
            assert largest_displacement(demand, 0.0, 2.2, 0.08)[1] == 2.2


def test_damage_lengthens_the_buildings_period_in_the_floor_spectrum():
    """T1 = 0.3·1.5 = 0.45 s, 10 %: a over γψ is 0.5·√(10/15)·√1.04 = 0.4163 g.

    γψ is that of the building as it is; R = 1.1/√0.1 = 3.479.
    """
    floor = floor_demand(SPECTRUM, 0.5, CHAIN, damaged=(1.5, 0.10))
    assert floor.period_s == pytest.approx(0.45)
    three(floor.peak_g, 0.4163 * floor.share)
    three(floor.acceleration(0.45), 3.479 * 0.4163 * floor.share)


def test_the_first_modes_share_of_the_ground_s_motion_by_height():
    """None at the ground and 1.171 at the roof of two floors, φ = (1, 1.618): Σφ/Σφ²·1.618.

    Between two floors it lies on the line, a quarter of the height up at half of the first floor's.
    """
    roof = floor_demand(SPECTRUM, 1.0, CHAIN).share
    three(roof, 1.171)
    first = floor_demand(SPECTRUM, 0.5, CHAIN).share
    assert first == pytest.approx(roof / 1.618, rel=1e-3)
    assert floor_demand(SPECTRUM, 0.25, CHAIN).share == pytest.approx(0.5 * first)
    assert floor_demand(SPECTRUM, 0.0, CHAIN).share == 0.0


def test_the_italian_spectrum_by_hand():
    """a_g = 0.2 g, F0 = 2.5, T_C* = 0.3 s, C, T2: S_S = 1.7 − 0.6·2.5·0.2 = 1.4, S_T = 1.2.

    C_C = 1.05·0.3^−0.33 = 1.5622: T_C = 0.4687 s, T_B = 0.1562 s, T_D = 2.4 s. PGA 0.336 g, plateau
    0.84 g; at 1 s 0.84·0.4687 = 0.3937 g; at 3 s 0.84·0.4687·2.4/9 = 0.105 g; at T_B/2 halfway
    between PGA and plateau; at 8 % ·√(10/13).
    """
    found = CodeDemand(0.2, 2.5, 0.3, "C", "T2")
    three(found.pga_g, 0.336)
    three(found.acceleration(0.3), 0.840)
    three(found.acceleration(1.0), 0.3937)
    three(found.acceleration(3.0), 0.1050)
    three(found.acceleration(0.5 * 0.15622), 0.588)
    three(found.acceleration(1.0, 0.08), 0.3937 * math.sqrt(10.0 / 13.0))


@pytest.mark.parametrize(
    ("soil", "ss", "cc"),
    [
        ("A", 1.0, 1.0),
        ("B", 1.2, 1.3995),
        ("C", 1.5, 1.5623),
        ("D", 1.8, 2.2822),
        ("E", 1.6, 1.8615),
    ],
)
def test_soil_factors_of_weak_shaking(soil, ss, cc):
    """Table 3.2.IV at a_g = 0.05 g, F0 = 2.5, T_C* = 0.3 s: every S_S at its upper bound."""
    found = soil_factors(soil, 0.05, 2.5, 0.3)
    three(found[0], ss)
    three(found[1], cc)


@pytest.mark.parametrize(
    ("soil", "between", "least"),
    [("A", 1.0, 1.0), ("B", 1.1, 1.0), ("C", 1.25, 1.0), ("D", 1.275, 0.9), ("E", 1.175, 1.0)],
)
def test_soil_factors_of_stronger_shaking(soil, between, least):
    """The same table at a_g = 0.3 g, B: 1.40 − 0.40·2.5·0.3, and at 0.6 g: the lower bound."""
    three(soil_factors(soil, 0.3, 2.5, 0.3)[0], between)
    three(soil_factors(soil, 0.6, 2.5, 0.3)[0], least)


def test_a_record_has_one_pga_in_the_checks_and_in_its_own_table():
    """1 m/s² is 0.1020 g of 9.80665 m/s² there and here, and so is a stiff oscillator's peak."""
    record = Record("sine", np.sin(2.0 * np.pi * np.arange(0.0, 5.0, 0.01)), 0.01, "surrogate")
    demand = RecordDemand(record.acceleration_m_s2, record.dt_s)
    assert demand.pga_g == measures(record)["pga_g"]
    assert demand.pga_g == pytest.approx(1.0 / 9.80665, rel=1e-3)
    assert demand.acceleration(0.002) == pytest.approx(demand.pga_g, rel=1e-3)
    assert displacement(demand, 0.5, 0.05) == pytest.approx(
        response_spectrum(record.acceleration_m_s2, 0.01, [0.5], 0.05).sd_m[0], rel=1e-9
    )


def test_table_demand_follows_eta_and_a_constant_displacement():
    assert eta(0.05) == pytest.approx(1.0)
    assert eta(0.60) == 0.55
    long, longer = SPECTRUM.acceleration(4.0), SPECTRUM.acceleration(8.0)
    assert long == pytest.approx(4.0 * longer)


def test_the_spectrum_of_en_1998_by_its_parameters():
    """Ground C of type 1, S = 1.15, 0.2, 0.6 and 2 s: a_g S = 0.184 g, plateau 0.46 g at 5 %.

    At 0.1 s 0.184 (1 + 0.5·1.5), at 1.2 s 0.46/2, at 3 s 0.46·0.6·2/9; η(8 %) = √(10/13).
    """
    demand = EurocodeDemand(0.16, 1.15, 0.2, 0.6, 2.0)
    assert demand.pga_g == pytest.approx(0.184)
    found = [demand.acceleration(t) for t in (0.1, 0.3, 1.2, 3.0)]
    assert found == pytest.approx([0.322, 0.46, 0.23, 0.46 * 1.2 / 9.0])
    assert demand.acceleration(0.3, 0.08) == pytest.approx(0.46 * math.sqrt(10.0 / 13.0))
    assert demand.edges_s == (2.0,)


@pytest.mark.parametrize(
    "own",
    [{"en_spectrum": [1.15, 0.6, 0.2, 2.0], "ag_g": 0.16}, {"en_spectrum": [1.15, 0.2, 0.6, 2.0]}],
)
def test_parameters_that_are_no_spectrum_are_refused(own):
    with pytest.raises(ValueError, match=r"assessment\.en_spectrum.*expected S, T_B < T_C"):
        check_demand(config.resolve({"assessment": own}))
