"""Peaks of many cases: amplitudes of one motion."""

from dataclasses import dataclass

import numpy as np

from .adaptive import checked, ended, run
from .integrate import COLUMNS, Control


@dataclass(frozen=True)
class BatchResult:
    """Peaks of every case, each array of shape (cases,).

    Largest |d/b| up to the end or the stop; whether it reached 1, outward or, without return walls,
    inward; "finished", "overturned" or "failed" (state not finite).
    """

    peak_d_over_b: np.ndarray
    overturned: np.ndarray
    status: list
    end_time_s: np.ndarray


def simulate_batch(
    wall,
    motion=None,
    scales=1.0,
    duration_s=None,
    theta0_over_alpha=0.0,
    tolerance=1e-6,
    stop_d_over_b=2.0,
):
    """Simulate one wall under one motion at many amplitudes.

    Amplitudes are factors on all accelerations, one number or one a case. The other parameters and
    errors are those of `simulate`.
    """
    motion, duration = checked(wall, motion, duration_s)
    control = Control(duration, tolerance, stop_d_over_b * wall.b_m)
    angle, rows = theta0_over_alpha * wall.alpha_rad, np.empty((0, COLUMNS))
    outcomes = [
        run(wall, motion, scale, angle, control, rows)[2:]
        for scale in np.atleast_1d(np.asarray(scales, float))
    ]
    peak, last, end = (np.array(column) for column in zip(*outcomes, strict=True))
    return BatchResult(
        peak / wall.b_m,
        peak >= wall.b_m,
        [ended(d / wall.b_m, stop_d_over_b) for d in last],
        end,
    )
