"""The one time integrator of the package: a damped oscillator under piecewise-linear load."""

import math

import numpy as np
import scipy


def checked_motion(ground_m_s2, dt_s):
    """Return a ground motion as a float array after checking it.

    Parameters
    ----------
    ground_m_s2 : array_like, shape (nt,)
        Ground acceleration, equally spaced.
    dt_s : float
        Sampling step.

    Raises
    ------
    ValueError
        If it is not one row of at least two finite values, or the step is not
        positive and finite.
    """
    ground = np.asarray(ground_m_s2, float)
    if ground.ndim != 1 or ground.size < 2:
        raise ValueError(
            f"ground motion: expected one row of at least 2 samples, got shape {ground.shape}"
        )
    bad = np.flatnonzero(~np.isfinite(ground))
    if bad.size:
        raise ValueError(f"ground motion: sample {bad[0]} is {ground[bad[0]]}, expected a number")
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        raise ValueError(f"ground motion: the step must be positive, got {dt_s} s")
    return ground


def refine_linear(values, refine):
    """Subdivide every interval of a piecewise-linear function into `refine` equal parts.

    The function itself does not change, so a response that is exact for
    piecewise-linear input is the same at the original instants.

    Parameters
    ----------
    values : array_like, shape (nt,)
    refine : int
        Number of parts, at least 1.

    Returns
    -------
    ndarray, shape ((nt − 1)·refine + 1,)
    """
    values = np.asarray(values, float)
    if refine == 1:
        return values.copy()
    weight = np.arange(refine) / refine
    fine = values[:-1, None] * (1.0 - weight) + values[1:, None] * weight
    return np.append(fine.ravel(), values[-1])


def step_integrals(pole, dt_s):
    """Return ∫₀ʰ e^{λ(h−s)}(1 − s/h) ds and ∫₀ʰ e^{λ(h−s)}(s/h) ds for the pole λ and h = dt_s."""
    x = pole * dt_s
    if abs(x) > 0.1:
        phi1 = np.expm1(x) / x
        phi2 = (phi1 - 1.0) / x
    else:  # the closed forms cancel for small steps; 10 terms reach rounding
        terms = [x**k for k in range(12)]
        phi1 = sum(t / math.factorial(k + 1) for k, t in enumerate(terms))
        phi2 = sum(t / math.factorial(k + 2) for k, t in enumerate(terms))
    return dt_s * (phi1 - phi2), dt_s * phi2


def oscillator_response(load_m_s2, dt_s, omega_rad_s, damping_ratio, q0_m=0.0, v0_m_s=0.0):
    """Solve q̈ + 2ζω q̇ + ω² q = f(t) for piecewise-linear f, exactly at the samples.

    With λ = −ζω + iω√(1 − ζ²) the variable z = q̇ − λ̄q obeys ż = λz + f, a
    first-order recurrence whose coefficients are exact for linear f within a
    step (the method of Nigam and Jennings, 1969, in complex form). No error
    accumulates from the step, only rounding.

    Parameters
    ----------
    load_m_s2 : ndarray, shape (nt,)
        f at the samples; for a base-driven oscillator minus the ground acceleration.
    dt_s : float
        Sampling step.
    omega_rad_s : float
        Undamped circular frequency, positive.
    damping_ratio : float
        ζ, 0 ≤ ζ < 1.
    q0_m, v0_m_s : float
        Displacement and velocity at the first sample.

    Returns
    -------
    q_m, v_m_s : ndarray, shape (nt,)
        Displacement and velocity relative to the support.

    Raises
    ------
    ValueError
        If ω is not positive or ζ is outside [0, 1).
    """
    if not (math.isfinite(omega_rad_s) and omega_rad_s > 0.0):
        raise ValueError(f"oscillator: the frequency must be positive, got {omega_rad_s} rad/s")
    if not 0.0 <= damping_ratio < 1.0:
        raise ValueError(f"oscillator: damping ratio must be in [0, 1), got {damping_ratio}")
    omega_d = omega_rad_s * math.sqrt(1.0 - damping_ratio**2)
    pole = complex(-damping_ratio * omega_rad_s, omega_d)
    old, new = step_integrals(pole, dt_s)
    start = v0_m_s - pole.conjugate() * q0_m
    z, _ = scipy.signal.lfilter(
        [new, old], [1.0, -np.exp(pole * dt_s)], load_m_s2, zi=[start - new * load_m_s2[0]]
    )
    q = z.imag / omega_d
    return q, z.real - damping_ratio * omega_rad_s * q
