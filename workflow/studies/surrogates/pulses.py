"""Velocity pulses of a recorded motion, and surrogates that keep their signs, order and periods.

One-sided rocking depends on which way a pulse goes and what follows it. Peaks and spectra do not
hold that. A few pulses do, and a few numbers describe them. They are found one after the other
(matching pursuit, Mallat & Zhang 1993): at each turn the Mavroeidis–Papageorgiou pulse that takes
the most of ∫u² of what the others left. Here u is the velocity as a rocking block keeps it,
u̇ + p u = a: what pushed it longer ago than 1/p no longer counts (a pulse overturns a block when
p∫(a/αg)e^{−pτ}dτ ≥ 1).
"""

from typing import NamedTuple

import numpy as np
from record_files.record import integrate
from rocking.records.surrogate_model import SOLVED, Noise, Pulse, Spec
from scipy.signal import correlate, lfilter

PERIODS_S = np.geomspace(0.2, 8.0, 28)
CYCLES = (1.2, 1.6, 2.0, 3.0)
TAIL = 2.0  # of 1/p, after a pulse
ROCKING_PER_S = 1.5  # p = √(3g/4R) of a façade 6.5 m high
NOISE_BOUNDS_HZ = (1.0, 8.0)  # of the ground filter, as for surrogates from peaks alone


def find_pulses(record, count):
    """Find so many pulses of a record, the one with the most ∫u² first.

    Its baseline is treated: a drift would be taken for a pulse.
    """
    dt = record.dt_s
    t = record.time_s
    left = record.acceleration_m_s2
    atoms = [
        atom
        for period in PERIODS_S
        for cycles in CYCLES
        if (atom := _atom(float(period), cycles, dt)).size <= t.size
    ]
    pulses: list[Pulse] = []
    while atoms and len(pulses) < count:
        kept = _keep(left, dt)
        fits = (_fit(atom, kept) for atom in atoms)
        _, atom, start, a, b = max(fits, key=lambda fit: fit[0])
        # a cos ωτ + b sin ωτ = A cos(ωτ + ν) with A cos ν = a, A sin ν = −b
        pulse = Pulse(
            float(np.hypot(a, b)),
            atom.period_s,
            atom.cycles,
            float(np.degrees(np.arctan2(-b, a))),
            float(dt * (start + atom.half)),
        )
        pulses.append(pulse)
        left = left - pulse.acceleration(t)
    return tuple(pulses)


def pulse_spec(record, count):
    """Parameters of a surrogate with the record's own pulses, and noise for the rest of it.

    The noise takes the rms of what the `count` pulses leave, its frequency from that rest's
    PGA/PGV, and its envelope from the rest's Arias intensity: rise to 5 %, plateau to 75 %, decay
    to 95 %.
    """
    pulses = find_pulses(record, count)
    t = record.time_s
    rest = record.acceleration_m_s2 - sum(pulse.acceleration(t) for pulse in pulses)
    arias = np.cumsum(rest**2)
    start, strong_end, end = np.interp([0.05, 0.75, 0.95], arias / arias[-1], t)
    strong = (t >= start) & (t <= strong_end)
    velocity, _ = integrate(rest, record.dt_s)
    low, high = NOISE_BOUNDS_HZ
    frequency = 1.2 * np.abs(rest).max() / (2 * np.pi * np.abs(velocity).max())
    noise = Noise(
        rms_m_s2=float(np.sqrt(np.mean(rest[strong] ** 2))),
        frequency_hz=float(np.clip(frequency, low, high)),
        damping=0.6,
        low_cut_hz=float(np.clip(0.8 / min(p.period_s for p in pulses), 0.3, 1.5)),
        high_cut_hz=20.0,
        rise_s=float(max(start, 0.1)),
        strong_end_s=float(strong_end),
        decay_s=float(max((end - strong_end) / 2.0, 0.1)),
    )
    return Spec(0.01, pulses, noise, SOLVED)


class _Atom(NamedTuple):
    """The even and the odd pulse of a period and length, as a block keeps them.

    period_s, cycles; half: samples to the centre; kept: shape (2, n); inverse of their Gram matrix.
    """

    period_s: float
    cycles: float
    half: int
    kept: np.ndarray
    inverse: np.ndarray

    @property
    def size(self):
        """Number of samples."""
        return self.kept.shape[1]


def _keep(acceleration, dt):
    """Return u of u̇ + p u = a by the trapezoidal rule, from rest."""
    half, p = 0.5 * dt, ROCKING_PER_S
    return lfilter([half, half], [1.0 + half * p, half * p - 1.0], acceleration, axis=-1)


def _atom(period, cycles, dt):
    half = int(np.ceil(0.5 * cycles * period / dt))
    tail = int(TAIL / ROCKING_PER_S / dt)
    tau = dt * np.arange(-half, half + 1 + tail)
    pair = [Pulse(1.0, period, cycles, phase, 0.0).acceleration(tau) for phase in (0.0, -90.0)]
    kept = _keep(np.array(pair), dt)
    return _Atom(period, cycles, half, kept, np.linalg.inv(kept @ kept.T))


def _fit(atom, signal):
    """Return the most ∫u² an atom can take, the atom, its first sample there and its weights."""
    dots = np.array([correlate(signal, row, mode="valid", method="fft") for row in atom.kept])
    weights = atom.inverse @ dots
    taken = np.sum(dots * weights, axis=0)
    i = int(np.argmax(taken))
    return float(taken[i]), atom, i, *weights[:, i]
