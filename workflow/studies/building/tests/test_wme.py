"""Eq. 1 by hand on known histories, what is compared with what, and the study's own numbers."""

import numpy as np
import pytest
from rocking.records import Record
from studies.building.case import PAPER_PERIODS_S
from studies.building.comparison import N_DOF, TopMotion, against_chains, chain_top, top_motion
from studies.building.history import mass_damping_rate, modal_history
from studies.building.modes import Modes

PERIOD_S = 0.27  # the study's


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


def test_the_response_spectrum_begins_at_the_peak_acceleration():
    """A stiff oscillator moves with its ground: ω²S_d → max|a|; S_d alone is 1e5 times less."""
    rows = np.full(400, 0.01).cumsum()
    periods, values = top_motion(rows, np.sin(3.0 * rows), 2.0, 25.0).curves["response_spectrum"]
    assert periods[0] == 0.02
    assert values[0] == pytest.approx(1.0, rel=0.02)


def test_a_building_that_is_a_chain_is_that_chain(tmp_path):
    """A building that is a chain of three masses: its own n has no error, the others have."""
    noise = np.convolve(np.random.default_rng(3).normal(size=800), np.hanning(9), "same")
    time, top = chain_top(noise, 0.01, 3, PERIOD_S, 0.05)
    columns = np.column_stack([time, 0.0 * time, top])
    np.savetxt(tmp_path / "history.csv", columns, "%.17g", ",", header="time_s,ground,top")
    record = Record("noise", noise, 0.01, "file", "m/s2", "none")
    settings = {
        "wme_longest_period_s": 2.0,
        "wme_highest_frequency_hz": 25.0,
        "damping_ratio": 0.05,
    }
    _, chains = against_chains(tmp_path / "history.csv", record, PERIOD_S, settings)
    assert list(chains) == list(N_DOF)
    for quantity in chains[3][1]:
        values = {n: errors[quantity] for n, (_, errors) in chains.items()}
        assert values[1] > 0.01
        assert min(values, key=values.get) == 3
        assert values[3] < 1e-9


def test_periods_agree_with_what_the_text_says_of_them():
    """T = 0.0625 h^0.75 for CBDEM, 0.01–0.02 s between the two buildings, and Figure 2."""
    periods = PAPER_PERIODS_S
    assert periods["CBDEM", "y"] == pytest.approx(0.0625 * 6.43**0.75, abs=0.005)
    apart = [periods["SBDEM", k] - periods["CBDEM", k] for k in ("y", "rz")]
    assert apart == pytest.approx([0.02, 0.01])
    assert periods["SBDEM", "y"] == 0.27  # "the value of 0.27 s that was obtained from the SBDEM"
    assert periods["CBDEM", "rz"] == 0.16
