"""Parts of a surrogate in closed form: its pulses and the envelope of its noise."""

import numpy as np
import pytest
from rocking.records.surrogate_model import Noise, Pulse


@pytest.mark.parametrize("phase_deg", [0.0, 35.0, -90.0])
def test_a_pulse_is_that_of_mavroeidis_and_papageorgiou(phase_deg):
    """v = A/2 (1 + cos 2πτ/(γT)) cos(2πτ/T + ν) where |τ| ≤ γT/2, and nothing else."""
    amplitude, period, cycles, middle = 0.4, 1.2, 2.0, 3.0
    t = np.linspace(0.0, 6.0, 60001)
    acceleration = Pulse(amplitude, period, cycles, phase_deg, middle).acceleration(t)
    tau = t - middle
    v = 0.5 * amplitude * (1.0 + np.cos(2.0 * np.pi * tau / (cycles * period)))
    v *= np.cos(2.0 * np.pi * tau / period + np.radians(phase_deg))
    v[np.abs(tau) > 0.5 * cycles * period] = 0.0
    summed = np.cumsum(0.5 * (acceleration[1:] + acceleration[:-1])) * (t[1] - t[0])
    assert summed == pytest.approx(v[1:], abs=1e-5 * amplitude)


def test_the_envelope_of_the_noise():
    """Up with the square of time, even, then down by 1/e in the time of decay."""
    noise = Noise(1.0, 2.0, 0.6, 0.3, 20.0, rise_s=2.0, strong_end_s=5.0, decay_s=3.0)
    found = noise.envelope(np.array([0.0, 1.0, 2.0, 5.0, 8.0]))
    assert found == pytest.approx([0.0, 0.25, 1.0, 1.0, np.exp(-1.0)])
