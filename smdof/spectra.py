"""Response and power spectra. The response spectrum uses the chain's own integrator with n = 1."""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from .oscillator import checked_motion, oscillator_response, refine_linear

POINTS_PER_PERIOD = 100  # a peak between two samples is missed by at most 1 − cos(π/100) = 0.05 %
SEGMENT_S = 10.0  # of Welch's method


@dataclass(frozen=True)
class ResponseSpectrum:
    """Peak responses of oscillators over their periods, each array of shape (n_periods,).

    Attributes
    ----------
    period_s : ndarray
    damping_ratio : float
    sd_m : ndarray
        Peak displacement relative to the ground.
    psa_m_s2 : ndarray
        Pseudo-acceleration ω²·Sd.
    sa_m_s2 : ndarray
        Peak absolute acceleration.
    """

    period_s: np.ndarray
    damping_ratio: float
    sd_m: np.ndarray
    psa_m_s2: np.ndarray
    sa_m_s2: np.ndarray


def response_spectrum(ground_m_s2, dt_s, periods_s, damping_ratio=0.05):
    """Elastic response spectrum of a piecewise-linear ground acceleration.

    The response is exact at its samples, which are at most T/100 apart; one more
    period of free vibration follows the record's end, where long-period peaks
    may lie.

    Parameters
    ----------
    ground_m_s2 : array_like, shape (nt,)
    dt_s : float
    periods_s : array_like, shape (n_periods,)
        At least 0; period 0 is the rigid limit (Sd = 0, Sa = PGA).
    damping_ratio : float
        0 ≤ ζ < 1.

    Returns
    -------
    ResponseSpectrum

    Raises
    ------
    ValueError
        If the motion is unusable, a period negative or ζ out of range.
    """
    ground = checked_motion(ground_m_s2, dt_s)
    periods = np.atleast_1d(np.asarray(periods_s, float))
    if periods.ndim != 1 or not np.all(np.isfinite(periods)) or np.any(periods < 0.0):
        raise ValueError("periods_s: expected one row of periods of at least 0 s")
    peaks = np.zeros((3, periods.size))
    for i, period in enumerate(periods):
        if period == 0.0:
            peaks[1:, i] = np.max(np.abs(ground))
            continue
        refine = max(1, math.ceil(dt_s * POINTS_PER_PERIOD / period - 1e-9))
        step = dt_s / refine
        omega = 2.0 * math.pi / period
        load = -refine_linear(ground, refine)
        q, v = oscillator_response(load, step, omega, damping_ratio)
        # the ground stops with the last sample: free vibration from the state reached
        free = np.zeros(math.ceil(period / step) + 1)
        q_free, v_free = oscillator_response(free, step, omega, damping_ratio, q[-1], v[-1])
        q, v = np.append(q, q_free), np.append(v, v_free)
        absolute = 2.0 * damping_ratio * omega * v + omega**2 * q
        sd = np.max(np.abs(q))
        peaks[:, i] = sd, omega**2 * sd, np.max(np.abs(absolute))
    return ResponseSpectrum(periods, damping_ratio, *peaks)


@dataclass(frozen=True)
class PowerSpectrum:
    """One-sided power spectral density.

    Attributes
    ----------
    frequency_hz : ndarray, shape (nf,)
    power_m2_s3 : ndarray, shape (nf,)
        Density [(m/s²)²/Hz]; its integral is the mean square of the acceleration.
    """

    frequency_hz: np.ndarray
    power_m2_s3: np.ndarray


def power_spectrum(acceleration_m_s2, dt_s, method="welch"):
    """One-sided power spectral density of an acceleration.

    "welch": Hann-windowed segments with half overlap, mean removed, averaged
    (Welch, 1967); segments of 10 s resolve 0.1 Hz, enough for building periods, and a
    shorter record is one segment.
    "periodogram": the whole record, rectangular window, mean kept, so that the
    sum over frequencies is the mean square exactly (Parseval).

    Parameters
    ----------
    acceleration_m_s2 : array_like, shape (nt,)
    dt_s : float
    method : {"welch", "periodogram"}

    Returns
    -------
    PowerSpectrum

    Raises
    ------
    ValueError
        If the motion is unusable, the method unknown or a segment shorter than 2 samples.
    """
    values = checked_motion(acceleration_m_s2, dt_s)
    if method == "periodogram":
        f, p = scipy.signal.periodogram(values, fs=1.0 / dt_s, detrend=False)
    elif method == "welch":
        samples = min(values.size, round(SEGMENT_S / dt_s))
        if samples < 2:
            raise ValueError(f"dt_s: {SEGMENT_S:g} s hold fewer than 2 samples of {dt_s} s")
        f, p = scipy.signal.welch(values, fs=1.0 / dt_s, window="hann", nperseg=samples)
    else:
        raise ValueError(f"method: expected 'welch' or 'periodogram', got '{method}'")
    return PowerSpectrum(f, p)
