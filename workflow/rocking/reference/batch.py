"""Peaks of many cases: amplitudes of one motion or release angles."""

import math
from dataclasses import dataclass

import numpy as np

from .adaptive import checked, ended, run
from .integrate import COLUMNS, Control


@dataclass(frozen=True)
class BatchResult:
    """Peaks of every case, each array of shape (cases,) unless noted.

    Attributes
    ----------
    scale, theta0_over_alpha : ndarray
        Factor on the accelerations and release angle.
    peak_d_over_b, peak_theta_over_alpha : ndarray
        Largest |d/b| and largest outward rotation up to the end or the stop.
    overturned : ndarray of bool
        |d/b| reached 1, outward or, without return walls, inward.
    status : list of str
        "finished", "overturned" or "failed" (state not finite).
    end_time_s : ndarray
    steps : ndarray of int
    """

    scale: np.ndarray
    theta0_over_alpha: np.ndarray
    peak_d_over_b: np.ndarray
    peak_theta_over_alpha: np.ndarray
    overturned: np.ndarray
    status: list
    end_time_s: np.ndarray
    steps: np.ndarray


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
    motion : SupportTable or None
        None leaves the supports at rest.
    scales : float or array_like, shape (cases,)
        Factors on all accelerations of `motion`.
    duration_s : float or None
        As in `simulate`.
    theta0_over_alpha : float or array_like, shape (cases,)
    tolerance, max_step_s, min_step_s : float
        As in `simulate`.
    dt_s : float or None
        A fixed step instead, with the classical Runge–Kutta scheme: the largest
        step; each interval of the motion is divided equally. First-order accurate
        across the jumps of the contact forces, otherwise fourth.
    stop_d_over_b : float
        A case ends when |d/b| exceeds it.

    Returns
    -------
    BatchResult

    Raises
    ------
    ValueError
        As `simulate`; also if `dt_s` is not positive.
    """
    motion, duration = checked(wall, motion, duration_s)
    if dt_s is not None and not (math.isfinite(dt_s) and dt_s > 0.0):
        raise ValueError(f"dt_s: expected a positive step, got {dt_s}")
    scales, theta0 = np.broadcast_arrays(
        np.atleast_1d(np.asarray(scales, float)),
        np.atleast_1d(np.asarray(theta0_over_alpha, float)),
    )
    control = Control(
        duration, tolerance, max_step_s, min_step_s, stop_d_over_b * wall.b_m, dt_s or 0.0
    )
    rows = np.empty((0, COLUMNS))
    found = [
        run(wall, motion, scale, angle * wall.alpha_rad, control, rows)[2:7]
        for scale, angle in zip(scales, theta0, strict=True)
    ]
    peak, turned, last, end, steps = (np.array(column) for column in zip(*found, strict=True))
    return BatchResult(
        scales.copy(),
        theta0.copy(),
        peak / wall.b_m,
        turned / wall.alpha_rad,
        peak >= wall.b_m,
        [ended(d / wall.b_m, stop_d_over_b) for d in last],
        end,
        steps,
    )
