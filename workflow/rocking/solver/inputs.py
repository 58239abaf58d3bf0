"""What the compiled loops are given beside the plane: motions, carried masses, stop rules."""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled

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


class Bodies(NamedTuple):
    """Coordinates that carry the supports: M ü + C u̇ + K u = −M r a_g + Hᵀ·contact forces.

    They are the masses of a chain, or the modes of a building. Supports move by H u.

    Attributes
    ----------
    mass_kg : ndarray, shape (n,)
        Without masses the supports are driven.
    k_n_m, c_n_s_m : ndarray, shape (n, n)
    hang, lift : ndarray, shape (supports, n)
        H: what each coordinate adds to a support's motion along y, and along z; `lift` without
        rows where supports only move along y.
    ground : ndarray, shape (n,)
        r: motion of the coordinates when everything moves by one with the ground.
    """

    mass_kg: np.ndarray
    k_n_m: np.ndarray
    c_n_s_m: np.ndarray
    hang: np.ndarray
    lift: np.ndarray
    ground: np.ndarray


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


@compiled
def drive(table, factor, k, past_s, place_m, speed_m_s, gone_m):
    """Move the driven supports to step k: their place, velocity, and way since the step before.

    They coast after the table; `past_s` is the step, and zero at the first.
    """
    last = table.ground_m_s2.size - 1
    row = min(k, last)
    for j in range(table.place_m.shape[1]):
        speed_m_s[j] = factor * table.speed_m_s[row, j]
        place = factor * table.place_m[row, j]
        if k > last:
            place = place_m[j] + past_s * speed_m_s[j]
        gone_m[j] = place - place_m[j] if k > 0 else 0.0
        place_m[j] = place


@compiled
def since_closed(depth_m, rate_m_s, dt_s):
    """Of a node that closed within this step: the share of its force, and of its slip.

    The force stands for half a step on either side of now, of which the node, closed since
    depth/rate, has been in contact for that share.
    """
    since = depth_m / (rate_m_s * dt_s)
    return min(0.5 + since, 1.5), min(since, 1.0)


@compiled
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
