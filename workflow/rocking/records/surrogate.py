"""Surrogate accelerograms: velocity pulses plus filtered noise, matched to given peaks.

Real records may not be shipped. A surrogate has the same PGA, PGV, PGD and duration as
the motion it stands for and a spectrum of the same character; it is not that record.

    a(t) = Σ d/dt v_j(t) + s·h(t)∗[e(t)·w(t)] + c1·φ1(t) + c2·φ2(t)

- v_j: velocity pulses of Mavroeidis & Papageorgiou (2003, BSSA 93(3));
- e·w: white Gaussian noise under the envelope of Jennings, Housner & Tsai (1968),
  parabolic rise, plateau, exponential decay; filtered after it is shaped, or the
  envelope would put long periods back;
- h: Kanai–Tajimi ground filter (Kanai 1957, Tajimi 1960) between a low and a high cut;
  causal, with four zeros at zero frequency, so that ground comes back to rest by itself;
- φ1 = sin²(πt/T), φ2 = φ1·(1 − 2t/T): a smooth correction, by which
  velocity and displacement end at zero exactly (for piecewise-linear acceleration).

Some parameters, three or more, named in the data (`solve`), are moved as little as
possible so that PGA, PGV and PGD agree; everything else is as given in
config/surrogates.yaml or by `default_spec`.
"""

import math
import zlib
from operator import itemgetter

import numpy as np
from record_files.errors import RecordError
from record_files.record import G_M_S2, MAX_PGA_G, MIN_PGA_G, Record

from .surrogate_model import SOLVED, Noise, Pulse, Spec, SurrogateModel

TOLERANCE = 0.01  # accepted relative error of PGA, PGV and PGD
DEFAULT_SEED = 1977
MAX_DRAWS = 16  # noise draws tried before giving up
MAX_DURATION_S = 600.0
MAX_SAMPLES = 60_000
MAX_STEPS = 15
MAX_LOG_CHANGE = 0.7  # solved parameters stay within a factor of 2 of the data's
GOAL = 1e-6


def default_spec(pga_g, pgv_cm_s, pgd_cm, duration_s):
    """Parameters derived from the peaks alone, for a record without an entry of its own.

    A pulse of period 2π·PGD/PGV, the period of a harmonic with those peaks, with a ninth of
    it at a third of the period (the first terms of a triangular wave) where PGA is small
    for PGV and PGD; noise whose frequency follows PGA/PGV.
    """
    pga, pgv, pgd = pga_g * G_M_S2, pgv_cm_s / 100, pgd_cm / 100
    ratio = pga * pgd / pgv**2  # 1 for a harmonic
    period = min(2 * math.pi * pgd / pgv, 0.3 * duration_s)
    time = max(0.25 * duration_s, 1.1 * period + 0.02 * duration_s)
    # The larger the ratio, the more of the velocity is noise.
    amplitude = 0.9 * pgv / max(ratio, 1.0) ** 0.25
    pulses = [Pulse(amplitude, period, 2.0, 0.0, time)]
    if ratio < 1.5:
        pulses.append(Pulse(amplitude / 9, period / 3, 4.0, 0.0, time))
    frequency = min(max(1.2 * pga / (2 * math.pi * pgv), 1.0), 8.0)
    noise = Noise(
        rms_m_s2=pga / 4 if ratio > 1.5 else pga / 8,
        frequency_hz=frequency,
        damping=0.6,
        low_cut_hz=max(0.8 / period, 2 / duration_s),
        high_cut_hz=20.0,
        rise_s=0.15 * duration_s,
        strong_end_s=0.4 * duration_s,
        decay_s=0.1 * duration_s,
    )
    return Spec(0.01, tuple(pulses), noise, SOLVED)


def _solve(model, spec, target):
    """Find the parameters nearest to the data's (in logarithm) that give the target peaks.

    Gauss–Newton steps of least norm (there may be more parameters than peaks), halved
    until the largest error falls; peaks are continuous in the parameters but have kinks.
    Returns the Spec and the largest error of the three log peaks.
    """
    start = np.array(spec.values())
    sign, x0 = np.sign(start), np.log(np.abs(start))

    def build(x):
        return spec.with_values(sign * np.exp(x0 + x))

    x = np.zeros(len(x0))
    r = model.log_peaks(build(x)) - target
    if not np.all(np.isfinite(r)):  # a filter that overflows
        return spec, math.inf
    for _ in range(MAX_STEPS):
        jacobian = np.empty((3, len(x)))
        for j in range(len(x)):
            shifted = x.copy()
            shifted[j] += 1e-5
            jacobian[:, j] = (model.log_peaks(build(shifted)) - target - r) / 1e-5
        step = -np.linalg.pinv(jacobian, rcond=1e-3) @ r
        step *= min(1.0, 0.3 / max(np.max(np.abs(step)), 1e-300))
        for _ in range(8):
            trial = np.clip(x + step, -MAX_LOG_CHANGE, MAX_LOG_CHANGE)
            r_trial = model.log_peaks(build(trial)) - target
            if np.max(np.abs(r_trial)) < np.max(np.abs(r)):
                break
            step = step / 2
        else:
            break
        x, r = trial, r_trial
        if np.max(np.abs(r)) < GOAL:
            break
    return build(x), float(np.max(np.abs(r)))


def _check_targets(name, pga_g, pgv_cm_s, pgd_cm, duration_s):
    for key, value, low, high in (
        ("pga_g", pga_g, MIN_PGA_G, MAX_PGA_G),
        ("pgv_cm_s", pgv_cm_s, 1e-3, 1000.0),
        ("pgd_cm", pgd_cm, 1e-4, 2000.0),
        ("duration_s", duration_s, 2.0, MAX_DURATION_S),
    ):
        if not low <= value <= high:
            raise RecordError(
                f"record {name}: {key} is {value:g}; expected {low:g} … {high:g} for a surrogate"
            )
    # Peak velocity V is reached and left with at most A, so displacement changes by V²/A
    # or more meanwhile, and half of that is its least peak.
    ratio = pga_g * G_M_S2 * pgd_cm / 100 / (pgv_cm_s / 100) ** 2
    if ratio < 0.5:
        raise RecordError(
            f"record {name}: PGA·PGD/PGV² = {ratio:.2g}; a motion that starts and ends at rest "
            "has 0.5 or more: are the units right?"
        )


def _check_spec(name, spec, duration_s):
    nyquist = 0.5 / spec.dt_s
    noise = spec.noise
    # The solved low cut may double.
    if not 2 * noise.low_cut_hz < noise.high_cut_hz < nyquist:
        raise RecordError(
            f"record {name}: noise from {noise.low_cut_hz:g} to {noise.high_cut_hz:g} Hz; expected "
            f"more than an octave, below {nyquist:g} Hz (half the sampling rate)"
        )
    if duration_s / spec.dt_s > MAX_SAMPLES:
        raise RecordError(
            f"record {name}: {duration_s:g} s in steps of {spec.dt_s:g} s; expected at most "
            f"{MAX_SAMPLES} steps"
        )
    for i, pulse in enumerate(spec.pulses):
        if not pulse.time_s < duration_s:
            raise RecordError(
                f"record {name}: pulse {i} is at {pulse.time_s:g} s, after the end at "
                f"{duration_s:g} s"
            )


def check_surrogate(name, pga_g, pgv_cm_s, pgd_cm, duration_s, spec=None):
    """Refuse what needs no drawing to be seen impossible; return the spec to draw from."""
    _check_targets(name, pga_g, pgv_cm_s, pgd_cm, duration_s)
    spec = spec or default_spec(pga_g, pgv_cm_s, pgd_cm, duration_s)
    _check_spec(name, spec, duration_s)
    return spec


def generate(name, pga_g, pgv_cm_s, pgd_cm, duration_s, *, spec=None, seed=DEFAULT_SEED):
    """Make the surrogate of a record.

    Parameters
    ----------
    name : str
        Record name.
    pga_g, pgv_cm_s, pgd_cm, duration_s : float
        Targets; the peaks are met within TOLERANCE, the duration within half a step.
    spec : Spec or None
        Parameters; `default_spec` when None.
    seed : int
        With the name it fixes the noise.

    Returns
    -------
    Record
        Source "surrogate"; acceleration, velocity and displacement are zero at both ends.

    Raises
    ------
    RecordError
        No noise draw meets the three peaks, as when PGA·PGD/PGV² is below what a motion
        that ends at rest can have.
    """
    spec = check_surrogate(name, pga_g, pgv_cm_s, pgd_cm, duration_s, spec)
    target = np.log([pga_g * G_M_S2, pgv_cm_s / 100, pgd_cm / 100])
    count = round(duration_s / spec.dt_s) + 1
    tried = []
    for draw in range(MAX_DRAWS):
        sequence = np.random.SeedSequence([seed, zlib.crc32(name.encode()), draw])
        white = np.random.Generator(np.random.PCG64(sequence)).standard_normal(count)
        model = SurrogateModel(spec, count, white)
        solved, error = _solve(model, spec, target)
        tried.append((error, draw + 1, model, solved))
        # Parameters that are far off for several draws are so for all.
        if error < GOAL or (draw == 5 and min(attempt[0] for attempt in tried) > 5 * TOLERANCE):
            break
    error, draw, model, solved = min(tried, key=itemgetter(0))
    if error > TOLERANCE:
        ratio = pga_g * G_M_S2 * pgd_cm / 100 / (pgv_cm_s / 100) ** 2
        raise RecordError(
            f"record {name}: no surrogate meets PGA, PGV and PGD within {TOLERANCE:.0%} "
            f"(nearest {error:.1%}; PGA·PGD/PGV² = {ratio:.2g}); check the table or give it "
            "parameters in the surrogates file"
        )
    details = {k: float(f"{v:.9g}") for k, v in zip(spec.solve, solved.values(), strict=True)}
    details.update(seed=seed, draw=draw, peak_error=float(f"{error:.1e}"))
    return Record(
        name,
        model.acceleration(solved),
        spec.dt_s,
        "surrogate",
        "m/s2",
        "none (surrogate, at rest at both ends)",
        details,
    )
