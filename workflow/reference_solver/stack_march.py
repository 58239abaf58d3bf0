"""Integration of a `stack_law.Assembly`: the classical Runge–Kutta scheme at a fixed step."""

import math
from typing import NamedTuple

import numpy as np
from rocking.runtime.compiled import compiled, inlined

from .stack_law import WORKS, at, derive, energies, yields

COLUMNS = 8  # of a row, before places and rates: time, d, works, kinetic, raised, stored


class Driving(NamedTuple):
    """Motions at their samples: accelerations of the ground, motions relative to it, (m, nt)."""

    time_s: np.ndarray
    ground_m_s2: np.ndarray
    vertical_m_s2: np.ndarray
    relative_m_s2: np.ndarray
    relative_m_s: np.ndarray
    relative_m: np.ndarray


@inlined
def _given(drive, factor, k, tau, u, w):
    """Accelerations of the ground at τ of interval k; motions relative to it into u and w."""
    dt = drive.time_s[k + 1] - drive.time_s[k]
    share = tau / dt
    for j in range(drive.relative_m.shape[0]):
        a = drive.relative_m_s2[j, k]
        jerk = (drive.relative_m_s2[j, k + 1] - a) / dt
        v = drive.relative_m_s[j, k]
        u[j] = factor * (drive.relative_m[j, k] + tau * (v + tau * (a / 2.0 + tau * jerk / 6.0)))
        w[j] = factor * (v + tau * (a + tau * jerk / 2.0))
    ag, az = drive.ground_m_s2[k], drive.vertical_m_s2[k]
    ag += share * (drive.ground_m_s2[k + 1] - ag)
    az += share * (drive.vertical_m_s2[k + 1] - az)
    return factor * ag, abs(factor) * az


@inlined
def top(p, state, turn):
    """Displacement of the watched point that is farthest from where it stood, past the foot [m]."""
    farthest = 0.0
    for i in range(p.watched.size):
        block = p.watched[i]
        y, _, _, _ = at(p, state, turn, block, p.watched_m[i, 0], p.watched_m[i, 1])
        d = y - p.centre_m[block, 0] - p.watched_m[i, 0] - state[3 * p.foot]
        if not abs(d) <= abs(farthest):
            farthest = d
    return farthest


@inlined
def _row(p, state, turn, time, d, row):
    """One row of a series."""
    works = 6 * p.mass_kg.size
    row[0], row[1] = time, d
    for k in range(WORKS):
        row[2 + k] = state[works + k]
    row[5], row[6], row[7] = energies(p, state, turn)
    for k in range(works):
        row[COLUMNS + k] = state[k]


@compiled
def march(p, drive, factor, state, control, rows):
    """Advance one history; the factor is on all accelerations, its sign on those along y.

    `control`: largest step [s], end [s], |d| at which it stops [m], steps between rows. Each
    interval of the motion has equal steps. Returns largest |d| [m], the time at the end, the last d
    and how many rows were written.
    """
    step_s, end_s, stop_m, every = control
    n, count = p.mass_kg.size, state.size
    state, other = state.copy(), np.empty(count)
    stages = np.zeros((4, count))
    force, turn, limit = np.empty(3 * n), np.empty((n, 2)), np.zeros(p.place_m.size)
    u, w = np.zeros(drive.relative_m.shape[0] + 1), np.zeros(drive.relative_m.shape[0] + 1)
    ag, az = _given(drive, factor, 0, 0.0, u, w)
    derive(p, (ag, az, u, w), state, stages[0], force, turn, limit)
    d = top(p, state, turn)
    peak, time, steps, written = abs(d), 0.0, 0, 0
    for k in range(drive.time_s.size - 1):
        begin = drive.time_s[k]
        dt = drive.time_s[k + 1] - begin
        if begin >= end_s or not abs(d) <= stop_m:
            break
        parts = int(math.ceil(dt / step_s - 1e-9))
        h = dt / parts
        for part in range(parts):
            tau = part * h
            ag, az = _given(drive, factor, k, tau, u, w)
            derive(p, (ag, az, u, w), state, stages[0], force, turn, limit)
            yields(p, state, turn, limit)
            time = begin + tau
            d = top(p, state, turn)
            if rows.shape[0] > 0 and steps % every == 0 and written < rows.shape[0]:
                _row(p, state, turn, time, d, rows[written])
                written += 1
            if not abs(d) <= peak:
                peak = abs(d)
            if not abs(d) <= stop_m:
                break
            for stage in range(1, 4):
                share = h if stage == 3 else 0.5 * h
                before = stages[stage - 1]
                for i in range(count):
                    other[i] = state[i] + share * before[i]
                ag, az = _given(drive, factor, k, tau + share, u, w)
                derive(p, (ag, az, u, w), other, stages[stage], force, turn, limit)
            for i in range(count):
                gain = stages[0, i] + 2.0 * (stages[1, i] + stages[2, i]) + stages[3, i]
                state[i] += h / 6.0 * gain
            steps += 1
    return peak, time, d, written
