"""Integration of one case: Dormand–Prince 5(4) with error control."""

import math
from typing import NamedTuple

import numpy as np
from rocking.runtime.compiled import compiled

from .contact import (
    OMEGA,
    SLIP,
    VY,
    elastic_energy,
    rates,
    return_map,
    top_displacement,
)

# Dormand and Prince (1980): stages, weights of order 5, and order 5 minus order 4
_C = np.array((0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0))
_A = np.array(
    (
        (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        (1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0),
        (3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0),
        (44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0),
        (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0),
        (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0),
        (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
    )
)
_E = np.array((71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40))
COLUMNS = 11  # of a row: time, the state before the slips, d [m], elastic energy
# at the shortest step the estimate is ignored: friction and contact jumps have no smaller scale
# worth resolving
MAX_STEP_S, MIN_STEP_S = 2e-3, 1e-8


class Control(NamedTuple):
    """When and how finely to step, see `adaptive.simulate`; `stop_m` bounds |d|."""

    duration_s: float
    tolerance: float
    stop_m: float
    max_step_s: float = MAX_STEP_S
    min_step_s: float = MIN_STEP_S


class Drive(NamedTuple):
    """Support motions at their samples, see `SupportTable`; walls relative to the base, (m, nt)."""

    dt_s: float
    base_m_s2: np.ndarray
    vertical_m_s2: np.ndarray
    relative_m_s2: np.ndarray
    relative_m_s: np.ndarray
    relative_m: np.ndarray


@compiled
def _support(drive, factor, k, tau, u, v):
    """Base and vertical acceleration at τ of interval k; places and velocities of walls in u, v."""
    last = drive.base_m_s2.size - 1
    if k >= last:  # beyond the motion everything stands
        for j in range(drive.relative_m.shape[0]):
            u[j], v[j] = factor * drive.relative_m[j, last], 0.0
        return 0.0, 0.0
    for j in range(drive.relative_m.shape[0]):
        w = drive.relative_m_s2[j, k]
        jerk = (drive.relative_m_s2[j, k + 1] - w) / drive.dt_s
        v0 = drive.relative_m_s[j, k]
        u[j] = drive.relative_m[j, k] + tau * (v0 + tau * (w / 2.0 + tau * jerk / 6.0))
        v[j] = v0 + tau * (w + tau * jerk / 2.0)
        u[j] *= factor
        v[j] *= factor
    a, z, share = drive.base_m_s2[k], drive.vertical_m_s2[k], tau / drive.dt_s
    a += (drive.base_m_s2[k + 1] - a) * share
    z += (drive.vertical_m_s2[k + 1] - z) * share
    return factor * a, abs(factor) * z  # a mirror image along y leaves z as it is


@compiled
def _row(law, state, time, u, rows, written):
    """Write a row; twice the room where there is none left."""
    if written == rows.shape[0]:
        wider = np.empty((2 * written, COLUMNS))
        for i in range(written):
            for m in range(COLUMNS):
                wider[i, m] = rows[i, m]
        rows = wider
    rows[written, 0] = time
    for m in range(SLIP):  # a slice takes as long to compile as all the rest
        rows[written, 1 + m] = state[m]
    rows[written, SLIP + 1] = top_displacement(law, state)
    rows[written, SLIP + 2] = elastic_energy(law, state, u)
    return rows


@compiled
def march(law, drive, factor, state, unit, control, segments, rows):
    """Advance one case with error control, friction returned at every step.

    The factor is on all accelerations, its sign on the horizontal ones alone. `unit`, shape (6,),
    are those in which the errors of y, z, θ and their rates are measured. The march fills `rows`,
    shape (n, COLUMNS); n may be 0. Returns the rows, how many it filled, the largest |d| [m], the
    last d [m] and the time [s].
    """
    u, v = np.zeros(segments + 1), np.zeros(segments + 1)
    stages, limit = np.empty((7, state.size)), np.empty(law.eta_m.size)
    state, new = state.copy(), np.empty(state.size)
    k = written = 0
    time, h = 0.0, 1e-2 * control.max_step_s
    keep, intervals = rows.shape[0] > 0, drive.base_m_s2.size - 1
    d = top_displacement(law, state)
    peak, end = abs(d), control.duration_s
    a, z = _support(drive, factor, 0, 0.0, u, v)
    rates(law, state, a, z, u, v, stages[0], limit)
    if keep:
        rows, written = _row(law, state, time, u, rows, written), 1
    while abs(d) <= control.stop_m and time < end * (1.0 - 1e-12):
        start = k * drive.dt_s
        knot = (k + 1) * drive.dt_s if k < intervals else math.inf
        left = min(knot, end) - time
        trial = left if h >= left else min(h, max(0.5 * left, control.min_step_s))
        for i in range(1, 7):
            for j in range(state.size):
                gain = 0.0
                for m in range(i):
                    gain += _A[i, m] * stages[m, j]
                new[j] = state[j] + trial * gain
            a, z = _support(drive, factor, k, time - start + trial * _C[i], u, v)
            rates(law, new, a, z, u, v, stages[i], limit)
        size = 0.0
        for j in range(6):
            error = 0.0
            for m in range(7):
                error += _E[m] * stages[m, j]
            error = abs(trial * error) / unit[j] / control.tolerance
            if not error <= size:  # takes what is not a number too
                size = error
        if not size <= 1.0 and trial > control.min_step_s:
            shrink = max(0.2, 0.9 * size**-0.2) if math.isfinite(size) else 0.2
            h = max(trial * shrink, control.min_step_s)
            continue
        growth = 1.0
        if size <= 0.0:
            growth = 5.0
        elif math.isfinite(size):
            growth = min(0.9 * size**-0.2, 5.0)
        h = min(max(trial * growth, control.min_step_s), control.max_step_s)
        return_map(law, new, limit)
        state, new = new, state
        tau = 0.0
        if trial == left and knot <= end:
            k, time = k + 1, knot
        else:
            time = end if trial == left else time + trial
            tau = time - start
        # returned friction or a new interval change the rate at this instant
        a, z = _support(drive, factor, k, tau, u, v)
        rates(law, state, a, z, u, v, stages[0], limit)
        d = top_displacement(law, state)
        if abs(d) > peak:
            peak = abs(d)
        if keep:
            rows, written = _row(law, state, time, u, rows, written), written + 1
    return rows, written, peak, d, time


def units(wall):
    """Units of the errors of y, z, θ and their rates: b, b, α, and these times p."""
    unit = np.array([wall.b_m, wall.b_m, wall.alpha_rad] * 2)
    unit[VY : OMEGA + 1] *= wall.p_rad_s
    return unit
