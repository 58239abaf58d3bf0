"""What the compiled loops are given beside the plane: motions, carried masses, stop rules."""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled, inlined

OK, OVERTURNED, FAILED = 0, 1, 2
REST_RATIO = 0.5  # of d/b: a façade that lingers near its unstable balance is not at rest
COLUMNS = 14  # of a history before the supports' own


class Table(NamedTuple):
    """Motions at the whole steps, for a factor of one.

    Attributes
    ----------
    step_s : float
    ground_m_s2, vertical_m_s2 : ndarray, shape (steps + 1,)
    place_m, speed_m_s : ndarray, shape (steps + 1, supports)
        Of the supports relative to the ground; no rows when a chain carries them.
    """

    step_s: float
    ground_m_s2: np.ndarray
    vertical_m_s2: np.ndarray
    place_m: np.ndarray
    speed_m_s: np.ndarray


class Rules(NamedTuple):
    """When a history ends; the meaning is that of `simulate.StopRules`.

    Attributes
    ----------
    limit_s, overturn_m, rest_m, rest_velocity_m_s, rest_time_s : float
    """

    limit_s: float
    overturn_m: float
    rest_m: float
    rest_velocity_m_s: float
    rest_time_s: float


class Supports(NamedTuple):
    """Motion of the supports relative to the ground, and the forces on them.

    Each has an entry a support and a last one, 0, for what stands still.

    Attributes
    ----------
    y, vy, dy : ndarray
        Place [m], velocity [m/s] and way since the last step [m] along y.
    z, vz, dz : ndarray
    fy, fz : ndarray
        Forces [N].
    turn, spin, dturn, moment : ndarray
        Rotation about x [rad], its rate and change, and moment [N·m]; empty where none turns.
    """

    y: np.ndarray
    vy: np.ndarray
    dy: np.ndarray
    z: np.ndarray
    vz: np.ndarray
    dz: np.ndarray
    fy: np.ndarray
    fz: np.ndarray
    turn: np.ndarray
    spin: np.ndarray
    dturn: np.ndarray
    moment: np.ndarray


@compiled
def standing(supports, turning):
    """So many supports, at rest."""
    n = supports + 1
    m = n if turning else 0
    return Supports(
        *(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)),
        *(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)),
        *(np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m)),
    )


@inlined
def drive(table, factor, k, past_s, y, vy, dy):
    """Move the driven supports to step k: their place, velocity, and way since the step before.

    They coast after the table; `past_s` is the step, and zero at the first.
    """
    last = table.ground_m_s2.size - 1
    row = min(k, last)
    for j in range(table.place_m.shape[1]):
        vy[j] = factor * table.speed_m_s[row, j]
        place = factor * table.place_m[row, j]
        if k > last:
            place = y[j] + past_s * vy[j]
        dy[j] = place - y[j] if k > 0 else 0.0
        y[j] = place


@inlined
def verdict(rules, motion_s, max_speed_m_s, k, dt_s, d_m, speed_m_s, shaken, moving_until_s):
    """Whether a history ends at step k: it failed, overturned, is at rest, or the record ends.

    Parameters
    ----------
    rules : Rules
    motion_s, max_speed_m_s : float
        End of the motion that matters, and speed from which the run has failed.
    k, dt_s : int, float
    d_m, speed_m_s : float
        Of the monitored point.
    shaken : bool
        Whether a mass that carries the supports still moves.
    moving_until_s : float
        When the façade was last not at rest.

    Returns
    -------
    over, status, moving_until_s : bool, int, float
    """
    time = k * dt_s
    if not (abs(speed_m_s) <= max_speed_m_s and math.isfinite(d_m)):
        return True, FAILED, moving_until_s
    if abs(d_m) >= rules.overturn_m:
        return True, OVERTURNED, moving_until_s
    if shaken or abs(speed_m_s) > rules.rest_velocity_m_s or abs(d_m) > rules.rest_m:
        moving_until_s = time
    elif time > motion_s and time - moving_until_s > rules.rest_time_s:
        return True, OK, moving_until_s
    return k >= math.ceil(rules.limit_s / dt_s), OK, moving_until_s
