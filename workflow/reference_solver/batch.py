"""Peaks of many cases: amplitudes of one motion or release angles."""

from dataclasses import dataclass

import numpy as np

from .adaptive import checked, ended, run
from .integrate import COLUMNS, Control


@dataclass(frozen=True)
class BatchResult:
    """Peaks of every case, each array of shape (cases,).

    Factor on the accelerations and release angle; largest |d/b| and largest outward rotation up to
    the end or the stop; whether |d/b| reached 1, outward or, without return walls, inward;
    "finished", "overturned" or "failed" (state not finite).
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
    stop_d_over_b=2.0,
):
    """Simulate one wall under one motion at many amplitudes, or from many release angles.

    Amplitudes, factors on all accelerations, and angles over α are one number or one a case. The
    other parameters and errors are those of `simulate`.
    """
    motion, duration = checked(wall, motion, duration_s)
    scales, theta0 = np.broadcast_arrays(
        np.atleast_1d(np.asarray(scales, float)),
        np.atleast_1d(np.asarray(theta0_over_alpha, float)),
    )
    control = Control(duration, tolerance, stop_d_over_b * wall.b_m)
    rows = np.empty((0, COLUMNS))
    found = [
        run(wall, motion, scale, angle * wall.alpha_rad, control, rows)[2:7]
        for scale, angle in zip(scales, theta0, strict=True)
    ]
    peak, turned, last, end, counts = (np.array(column) for column in zip(*found, strict=True))
    return BatchResult(
        scales.copy(),
        theta0.copy(),
        peak / wall.b_m,
        turned / wall.alpha_rad,
        peak >= wall.b_m,
        [ended(d / wall.b_m, stop_d_over_b) for d in last],
        end,
        counts,
    )
