"""Many cases at once: amplitudes of one motion or release angles, vectorised over cases."""

import math
from dataclasses import dataclass

import numpy as np

from .adaptive import checked, ended, march
from .contact import THETA, Equations


@dataclass(frozen=True)
class BatchResult:
    """Peaks of every case, each array of shape (cases,) unless noted.

    Attributes
    ----------
    scale, theta0_over_alpha : ndarray
        Factor on the accelerations and release angle.
    peak_d_over_b, peak_theta_over_alpha : ndarray
        Largest outward values up to the end or the stop.
    overturned : ndarray of bool
        |d/b| reached 1, outward or, without return walls, inward.
    status : list of str
        "finished", "overturned" or "failed" (state not finite).
    end_time_s : ndarray
    steps : int
        Steps of the batch.
    """

    scale: np.ndarray
    theta0_over_alpha: np.ndarray
    peak_d_over_b: np.ndarray
    peak_theta_over_alpha: np.ndarray
    overturned: np.ndarray
    status: list
    end_time_s: np.ndarray
    steps: int


def simulate_batch(
    wall,
    motion=None,
    scales=1.0,
    duration_s=None,
    theta0_over_alpha=0.0,
    tolerance=1e-6,
    dt_s=None,
    max_step_s=2e-3,
    min_step_s=1e-8,
    stop_d_over_b=2.0,
):
    """Simulate one wall under one motion at many amplitudes, or from many release angles.

    Parameters
    ----------
    wall : Wall
    motion : Motion or None
        None leaves the supports at rest.
    scales : float or array_like, shape (cases,)
        Factors on all accelerations of `motion`.
    duration_s : float or None
        As in `simulate`.
    theta0_over_alpha : float or array_like, shape (cases,)
    tolerance, max_step_s, min_step_s : float
        As in `simulate`; the common step follows the case that needs the smallest.
    dt_s : float or None
        A fixed step instead, with the classical Runge–Kutta scheme: the largest
        step; each interval of the motion is divided equally. First-order accurate
        across the jumps of the contact forces, otherwise fourth.
    stop_d_over_b : float
        A case leaves the batch when |d/b| exceeds it.

    Returns
    -------
    BatchResult

    Raises
    ------
    ValueError
        As `simulate`; also if `dt_s` is not positive.
    """
    motion, duration = checked(wall, motion, duration_s)
    scales, theta0 = np.broadcast_arrays(
        np.atleast_1d(np.asarray(scales, float)),
        np.atleast_1d(np.asarray(theta0_over_alpha, float)),
    )
    equations = Equations(wall)
    state = equations.initial(theta0 * wall.alpha_rad)
    count = scales.size
    active = np.arange(count)
    peak_d, peak_theta = np.full(count, -np.inf), np.full(count, -np.inf)
    end, overturned = np.zeros(count), np.zeros(count, bool)
    status = ["finished"] * count

    def observe(time, state, wall_u):
        nonlocal active
        d = equations.top_displacement(state) / wall.b_m
        peak_d[active] = np.fmax(peak_d[active], d)
        peak_theta[active] = np.fmax(peak_theta[active], state[:, THETA] / wall.alpha_rad)
        overturned[active] |= np.abs(d) >= 1.0
        end[active] = time
        going = np.abs(d) <= stop_d_over_b  # False for a state that is not finite
        for i, last in zip(active[~going], d[~going], strict=True):
            status[i] = ended(last, stop_d_over_b)
        active = active[going]
        return going

    if dt_s is None:
        steps, _ = march(
            equations,
            state,
            motion,
            scales.copy(),
            duration,
            tolerance,
            max_step_s,
            min_step_s,
            observe,
        )
    else:
        steps = _fixed(equations, state, motion, scales.copy(), duration, dt_s, observe)
    return BatchResult(
        scales.copy(), theta0.copy(), peak_d, peak_theta, overturned, status, end, steps
    )


def _fixed(equations, state, motion, factor, duration_s, dt_s, observe):
    """Advance with the classical Runge–Kutta scheme at a fixed step; returns the steps made."""
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        raise ValueError(f"dt_s: expected a positive step, got {dt_s}")
    segments = equations.wall.n_segments
    parts = math.ceil(motion.dt_s / dt_s - 1e-9)
    h = motion.dt_s / parts
    total = math.ceil(duration_s / h - 1e-9)
    raw = motion.interval(0, segments)

    def support(tau):
        base, u, v = raw(tau)
        if u is None:
            return factor * base, None, None
        return factor * base, factor[:, None] * u, factor[:, None] * v

    at = support(0.0)
    going = observe(0.0, state, at[1])
    for step in range(total):
        if not going.all():
            state, factor = state[going], factor[going]
            if not len(state):
                return step
        tau = (step % parts) * h
        at, middle = support(tau), support(tau + 0.5 * h)
        first, limit = equations.rates(state, *at)
        equations.return_map(state, limit)
        second, _ = equations.rates(state + 0.5 * h * first, *middle)
        third, _ = equations.rates(state + 0.5 * h * second, *middle)
        at = support(tau + h)
        fourth, _ = equations.rates(state + h * third, *at)
        state = state + h / 6.0 * (first + 2.0 * (second + third) + fourth)
        if (step + 1) % parts == 0:
            raw = motion.interval((step + 1) // parts, segments)
        going = observe((step + 1) * h, state, at[1])
    return total
