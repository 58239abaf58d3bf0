"""Pulses, noise and their parameters: the signal model of the surrogates (see surrogate)."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
from record_files.record import integrate

SOLVABLE_PULSE = ("amplitude_m_s", "period_s")
SOLVABLE_NOISE = ("rms_m_s2", "frequency_hz", "low_cut_hz")
# what is solved for where no data say: the first pulse and the noise
SOLVED = tuple(f"pulses.0.{key}" for key in SOLVABLE_PULSE)
SOLVED += tuple(f"noise.{key}" for key in SOLVABLE_NOISE)


@dataclass(frozen=True)
class Pulse:
    """A Mavroeidis–Papageorgiou velocity pulse.

    v(t) = A/2·[1 + cos(2π(t−t0)/(γ T))]·cos(2π(t−t0)/T + ν) for |t−t0| ≤ γT/2.

    amplitude_m_s (A; its sign is the polarity), period_s (T), cycles (γ > 1),
    phase_deg (ν), time_s (t0, centre).
    """

    amplitude_m_s: float
    period_s: float
    cycles: float
    phase_deg: float
    time_s: float

    def acceleration(self, t):
        """Return dv/dt at times t [m/s²]."""
        tau = t - self.time_s
        w, wg = 2 * math.pi / self.period_s, 2 * math.pi / (self.period_s * self.cycles)
        phase = w * tau + math.radians(self.phase_deg)
        a = -0.5 * (
            wg * np.sin(wg * tau) * np.cos(phase) + w * (1 + np.cos(wg * tau)) * np.sin(phase)
        )
        return np.where(
            np.abs(tau) <= 0.5 * self.cycles * self.period_s, self.amplitude_m_s * a, 0.0
        )


@dataclass(frozen=True)
class Noise:
    """Filtered noise: rms over the plateau, Kanai–Tajimi filter, cuts, envelope.

    rms_m_s2; frequency_hz and damping of the ground; low_cut_hz and high_cut_hz of
    Butterworth filters of order 4; envelope rise_s (start of the
    plateau), strong_end_s (its end), decay_s (time constant after it).
    """

    rms_m_s2: float
    frequency_hz: float
    damping: float
    low_cut_hz: float
    high_cut_hz: float
    rise_s: float
    strong_end_s: float
    decay_s: float

    def sections(self, dt_s):
        """Return the digital filter as second-order sections (bilinear transform).

        Kanai–Tajimi (2ζω s + ω²)/(s² + 2ζω s + ω²), Butterworth high- and low-pass of
        order 4 at the cuts.
        """
        w = 2 * math.pi * self.frequency_hz
        from scipy.signal import bilinear, butter  # slow to load, and most runs need none

        ground = bilinear([2 * self.damping * w, w**2], [1, 2 * self.damping * w, w**2], 1 / dt_s)
        return np.vstack(
            [
                np.concatenate(ground)[None, :],
                butter(4, self.low_cut_hz, "highpass", fs=1 / dt_s, output="sos"),
                butter(4, self.high_cut_hz, "lowpass", fs=1 / dt_s, output="sos"),
            ]
        )

    def envelope(self, t):
        """Return the envelope at times t, plateau 1."""
        rise = np.minimum(t / self.rise_s, 1.0) ** 2
        return rise * np.exp(-np.maximum(t - self.strong_end_s, 0.0) / self.decay_s)


@dataclass(frozen=True)
class Spec:
    """All parameters of a surrogate: step, pulses, noise, and which of them to solve for.

    solve holds three or more names, "noise.<field>" or "pulses.<index>.<field>"; their values
    in the data are where the search starts.
    """

    dt_s: float
    pulses: tuple
    noise: Noise
    solve: tuple
    notes: str = field(default="", compare=False)

    def values(self):
        """Values of the solved parameters."""
        return [getattr(self._owner(name)[0], name.split(".")[-1]) for name in self.solve]

    def with_values(self, values):
        """Return a copy with the solved parameters replaced."""
        spec = self
        for name, value in zip(self.solve, values, strict=True):
            owner, index = spec._owner(name)
            owner = replace(owner, **{name.split(".")[-1]: float(value)})
            if index is None:
                spec = replace(spec, noise=owner)
            else:
                pulses = (*spec.pulses[:index], owner, *spec.pulses[index + 1 :])
                spec = replace(spec, pulses=pulses)
        return spec

    def _owner(self, name):
        if name.startswith("noise."):
            return self.noise, None
        index = int(name.split(".")[1])
        return self.pulses[index], index


def _correction(t, dt_s):
    """φ1, φ2 and the matrix of their end velocities and displacements."""
    shape = np.sin(math.pi * t / t[-1]) ** 2
    basis = np.array([shape, shape * (1 - 2 * t / t[-1])])
    ends = np.array([[series[-1] for series in integrate(row, dt_s)] for row in basis]).T
    return basis, ends


class SurrogateModel:
    """Acceleration as a function of the parameters, for one noise draw."""

    def __init__(self, spec, count, white):
        """Prepare `count` samples; `white` is the draw, unit-variance noise of that length."""
        self.dt_s = spec.dt_s
        self.t = spec.dt_s * np.arange(count)
        # The shaped noise and, in the second row, an impulse that gives the filter's power.
        self.input = np.zeros((2, count))
        self.input[0] = white * spec.noise.envelope(self.t)
        self.input[1, 0] = 1.0
        self.basis, self.ends = _correction(self.t, spec.dt_s)
        # Samples at the ends are brought to zero over the first and last 2 % of the time.
        ramp = np.clip(np.minimum(self.t, self.t[-1] - self.t) / (0.02 * self.t[-1]), 0, 1)
        self.taper = np.sin(0.5 * math.pi * ramp) ** 2

    def acceleration(self, spec):
        """Return the acceleration for these parameters, shape (n,)."""
        from scipy.signal import sosfilt

        a, impulse = sosfilt(spec.noise.sections(self.dt_s), self.input)
        a *= spec.noise.rms_m_s2 / math.sqrt(np.sum(impulse**2))
        for pulse in spec.pulses:
            a = a + pulse.acceleration(self.t)
        a = a * self.taper
        v, d = integrate(a, self.dt_s)
        return a - np.linalg.solve(self.ends, [v[-1], d[-1]]) @ self.basis

    def log_peaks(self, spec):
        """Return the logarithms of PGA, PGV and PGD [m/s², m/s, m]."""
        a = self.acceleration(spec)
        return np.log([np.max(np.abs(x)) for x in (a, *integrate(a, self.dt_s))])
