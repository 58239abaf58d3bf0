"""Eq. 1 by hand on known histories, what is compared with what, and the study's own numbers."""

import numpy as np
import pytest
from rocking.records import Record
from studies.building.case import PAPER_PERIODS_S
from studies.building.comparison import N_DOF, TopMotion, chain_top, top_motion
from studies.building.history import PointHistory, mass_damping_rate, modal_history
from studies.building.modes import Modes
from studies.building.readings import Reading, errors, readings, strong_part

import smdof

PERIOD_S = 0.27  # the study's, which one of the readings takes whatever the building's


def one_mode():
    """A building of one block that sways along y with one period."""
    ratio = np.zeros((1, 6))
    ratio[0, 1] = 1.0
    return Modes(
        np.array([2.0 * np.pi / PERIOD_S]),
        np.ones((1, 1)),
        ratio.copy(),
        ratio,
        np.array([[0, 1]]),
        np.ones(1),
    )


def test_eq_1_of_a_modal_history_worked_by_hand():
    """Undamped, ground acceleration 1 held for one period, against a constant 1/2.

    The absolute acceleration is 1 − cos ωt, its integral T. The difference is |1/2 − cos ωt|,
    whose integral over a turn is (4√3 + 2π/3)/ω: 0.7180 of T. Over the constant's own
    integral, T/2, it would be twice that.
    """
    time = np.linspace(0.0, PERIOD_S, 2001)
    history = modal_history(one_mode(), [0], np.ones(2001), time[1], 0.0)
    top = history.acceleration_m_s2[0]
    assert top == pytest.approx(1.0 - np.cos(2.0 * np.pi * history.time_s / PERIOD_S), abs=1e-5)
    building = TopMotion({"acceleration": (history.time_s, top)})
    other = TopMotion({"acceleration": (history.time_s, np.full(top.size, 0.5))})
    assert building.wme(other)["acceleration"] == pytest.approx(0.7180, abs=1e-4)


def test_the_damping_of_the_building_limits_its_resonance():
    """Steady state at resonance with ratio ζ: relative acceleration 1/(2ζ) of the ground's."""
    omega = 2.0 * np.pi / PERIOD_S
    time = np.arange(0.0, 40 * PERIOD_S, PERIOD_S / 200)
    rate = mass_damping_rate(omega, 0.05)
    history = modal_history(one_mode(), [0], np.sin(omega * time), time[1], rate)
    late = history.time_s > 35 * PERIOD_S
    relative = history.acceleration_m_s2[0] - history.ground_m_s2
    assert np.abs(relative[late]).max() == pytest.approx(10.0, rel=0.005)


def test_the_chain_is_compared_at_its_roof():
    """At resonance the roof of four masses moves 1.241/(2ζ), the first floor 0.431/(2ζ)."""
    omega = 2.0 * np.pi / PERIOD_S
    ground = np.sin(omega * np.arange(0.0, 30 * PERIOD_S, PERIOD_S / 100))
    time, top = chain_top(ground, PERIOD_S / 100, 4, PERIOD_S, 0.05)
    assert np.abs(top[time > 26 * PERIOD_S]).max() == pytest.approx(12.41, rel=0.02)


def noise(seed=3):
    rng = np.random.default_rng(seed)
    return np.convolve(rng.normal(size=800), np.hanning(9), "same")


@pytest.mark.parametrize("absolute", [False, True])
def test_spectra_begin_at_the_peak_acceleration(absolute):
    """A stiff oscillator moves with its ground: ω²S_d → max|a|; S_d alone is 1e5 times less."""
    rows = np.full(400, 0.01).cumsum()
    slow = np.sin(3.0 * rows)
    for motion in (
        top_motion(rows, slow, 2.0, 25.0),
        top_motion(rows, slow, 2.0, 25.0, absolute_spectrum=absolute),
    ):
        periods, values = motion.curves["response_spectrum"]
        assert periods[0] == 0.02
        assert values[0] == pytest.approx(1.0, rel=0.02)


def history_of_chain(n_dof, damping_ratio=0.05):
    record = Record("noise", noise(), 0.01, "file", "m/s2", "none")
    equal = smdof.shear_chain(n_dof, PERIOD_S)
    chain = smdof.floor_motions(record.acceleration_m_s2, 0.01, equal, damping_ratio)
    top = chain.floors_m_s2[-1:]
    return record, PointHistory(chain.time_s, chain.ground_m_s2, top, np.zeros_like(top))


@pytest.mark.parametrize("name", list(readings()))
def test_every_reading_finds_the_chain_that_it_is_given(name):
    """A building that is a chain of three masses: its own n has no error, the others have."""
    record, history = history_of_chain(3)
    way = readings()[name]
    found = errors(history, 0, record, PERIOD_S, 0.05, way)
    assert list(found) == list(N_DOF)
    for quantity in found[3]:
        values = {n: found[n][quantity] for n in N_DOF}
        assert values[1] > 0.01
        if way.period_factor != 1.0:  # 2 % of period cost more than a mass too many
            assert values[3] > 0.01
            continue
        assert min(values, key=values.get) == 3
        if not way.rayleigh:  # 5 % in the first two modes alone
            assert values[3] < 1e-9


def test_readings_change_what_they_name():
    record, history = history_of_chain(4, damping_ratio=0.02)
    own = errors(history, 0, record, PERIOD_S, 0.05, Reading())[4]
    relative = errors(history, 0, record, PERIOD_S, 0.05, Reading(relative=True))[4]
    # the difference is the same, the building's motion without the ground's is not
    time, top = history.time_s, history.acceleration_m_s2[0]
    ratio = np.trapezoid(np.abs(top), time) / np.trapezoid(np.abs(top - history.ground_m_s2), time)
    assert relative["acceleration"] / own["acceleration"] == pytest.approx(ratio, rel=1e-3)
    _, root = top_motion(time, top, 2.0, 25.0, power="amplitude").curves["power_spectrum"]
    _, whole = top_motion(time, top, 2.0, 25.0, power="periodogram").curves["power_spectrum"]
    assert root**2 == pytest.approx(whole)


def test_strong_part_of_a_block():
    time = np.linspace(0.0, 10.0, 1001)
    block = np.where((time >= 4.0) & (time < 6.0), 2.0, 0.0)
    assert strong_part(time, block) == pytest.approx((4.1, 5.9), abs=0.02)


def test_periods_agree_with_what_the_text_says_of_them():
    """T = 0.0625 h^0.75 for CBDEM, 0.01–0.02 s between the two buildings, and Figure 2."""
    periods = PAPER_PERIODS_S
    assert periods["CBDEM", "y"] == pytest.approx(0.0625 * 6.43**0.75, abs=0.005)
    apart = [periods["SBDEM", k] - periods["CBDEM", k] for k in ("y", "rz")]
    assert apart == pytest.approx([0.02, 0.01])
    assert periods["SBDEM", "y"] == 0.27  # "the value of 0.27 s that was obtained from the SBDEM"
    assert periods["CBDEM", "rz"] == 0.16


def test_what_ground_and_top_share_is_no_motion_relative_to_the_ground():
    """An oscillator of the chain's own period: no error, and none with a common motion on both."""
    record = Record("noise", noise(), 0.01, "file")
    chain = smdof.floor_motions(record.acceleration_m_s2, 0.01, smdof.shear_chain(1, PERIOD_S))
    common = 3.0 * np.sin(5.0 * chain.time_s)
    way = Reading(relative=True)
    for shared in (0.0, common):
        tops = (chain.floors_m_s2[-1] + shared)[None, :]
        history = PointHistory(chain.time_s, chain.ground_m_s2 + shared, tops, 0.0 * tops)
        found = errors(history, 0, record, PERIOD_S, 0.05, way)[1]
        assert max(found.values()) < 1e-9
