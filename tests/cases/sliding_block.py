"""A block that slides on a shaken base: closed forms and an event-exact integration.

Coulomb friction with one coefficient μ at rest and in motion, no rocking; the
relative displacement is block minus base, positive along +y.
"""

import math

import numpy as np
from rocking.mechanics.closed_forms import GRAVITY_M_S2, _positive


def slip_rectangular_pulse(acceleration_m_s2, duration_s, friction, gravity_m_s2=GRAVITY_M_S2):
    """Largest slip behind a base pulse of constant acceleration, a·t1²(a − μg)/(2μg) [m].

    Newmark (1965): the base keeps its velocity V = a·t1 after the pulse, the
    block gains on it at μg. Zero for a ≤ μg.
    """
    _positive(duration_s=duration_s, friction=friction)
    limit, a = friction * gravity_m_s2, abs(acceleration_m_s2)
    return a * duration_s**2 * max(a - limit, 0.0) / (2.0 * limit)


def slip_harmonic(acceleration_m_s2, omega_rad_s, friction, gravity_m_s2=GRAVITY_M_S2):
    """Amplitude of the steady slip under a·sin ωt that never sticks [m].

    Half the swing, (a/ω²)√(1 − (πη/2)²) with η = μg/a. The velocity reverses at
    cos ωt0 = −πη/2, where the base must exceed the friction limit: η ≤
    1/√(1 + π²/4) = 0.537.

    Raises
    ------
    ValueError
        If the block would stick for part of the cycle.
    """
    _positive(acceleration_m_s2=acceleration_m_s2, omega_rad_s=omega_rad_s, friction=friction)
    eta = friction * gravity_m_s2 / acceleration_m_s2
    if eta > 1.0 / math.sqrt(1.0 + math.pi**2 / 4.0):
        raise ValueError(f"slip_harmonic: sliding is not permanent at μg/a = {eta:.3g} > 0.537")
    return acceleration_m_s2 / omega_rad_s**2 * math.sqrt(1.0 - (0.5 * math.pi * eta) ** 2)


def _next_stop(v, c1, c2, limit):
    """Smallest t in (0, limit] at which v + c1·t + c2·t² is zero again, or None."""
    if v == 0.0:
        roots = [-c1 / c2] if c2 else []  # t = 0 itself is the start of the slide
    elif c2 == 0.0:
        roots = [-v / c1] if c1 else []
    else:
        discriminant = c1 * c1 - 4.0 * c2 * v
        if discriminant < 0.0:
            return None
        q = -0.5 * (c1 + math.copysign(math.sqrt(discriminant), c1))  # does not cancel
        roots = [q / c2, v / q]
    return min((t for t in roots if 0.0 < t <= limit), default=None)


def sliding_response(ground_m_s2, dt_s, friction, gravity_m_s2=GRAVITY_M_S2):
    """Slip of a block under a piecewise-linear ground acceleration, exact between events.

    Within a segment the relative acceleration −a_g − μg·sgn(v) is linear, so the
    velocity is a parabola and the slip a cubic; stops (v = 0) and starts
    (|a_g| = μg) are roots, not steps.

    Parameters
    ----------
    ground_m_s2 : array_like, shape (nt,)
    dt_s : float
    friction : float
        μ, positive.

    Returns
    -------
    slip_m, velocity_m_s : ndarray, shape (nt,)
        Relative to the base, at the samples.
    """
    ground = np.asarray(ground_m_s2, float)
    if ground.ndim != 1 or ground.size < 2 or not np.all(np.isfinite(ground)):
        raise ValueError("ground motion: expected one row of at least 2 finite samples")
    _positive(dt_s=dt_s, friction=friction)
    limit = friction * gravity_m_s2
    slip, velocity = np.zeros(ground.size), np.zeros(ground.size)
    s = v = 0.0
    sign = 0  # of the sliding velocity; 0: stuck
    for k, (left, right) in enumerate(zip(ground[:-1].tolist(), ground[1:].tolist(), strict=True)):
        jerk, t, a = (right - left) / dt_s, 0.0, left
        while t < dt_s:
            rest = dt_s - t
            if sign == 0 and (abs(a) > limit or (abs(a) == limit and a * jerk > 0.0)):
                sign = -1 if a > 0.0 else 1  # the block lags behind the ground
            elif sign == 0:
                start = (math.copysign(limit, jerk) - a) / jerk if jerk else math.inf
                if not 0.0 < start < rest:
                    break
                t, a, sign = t + start, math.copysign(limit, jerk), -1 if jerk > 0.0 else 1
                continue
            c1, c2 = -a - sign * limit, -0.5 * jerk
            stop = _next_stop(v, c1, c2, rest)
            tau = rest if stop is None else stop
            s += v * tau + c1 * tau**2 / 2.0 + c2 * tau**3 / 3.0
            v = v + c1 * tau + c2 * tau**2 if stop is None else 0.0
            sign = sign if stop is None else 0
            if stop is not None and t + tau == t:  # a stop below rounding: stuck to the end
                break
            t += tau
            a = left + jerk * t
        slip[k + 1], velocity[k + 1] = s, v
    return slip, velocity
