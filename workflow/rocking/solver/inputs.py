"""What the compiled loops are given beside the plane and the motions: supports, stop rules."""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from .vectors import choose

OK, OVERTURNED, FAILED = 0.0, 1.0, 2.0
REST_RATIO = 0.5  # of d/b: a façade that lingers near its unstable balance is not at rest
COLUMNS = 17  # of a history before the supports' own
SPAN_S = 1.0  # of which each has its largest |d|: less than a swing that nearly falls takes


class Rules(NamedTuple):
    """When a history ends; the meaning is that of `simulate.StopRules`."""

    overturn_m: float
    rest_m: float
    rest_velocity_m_s: float
    rest_time_s: float
    spans: int  # of `SPAN_S`, as many as the longest history has


class Supports(NamedTuple):
    """Motion of the supports relative to the ground, and the forces on them.

    Rows of each have an entry a support and a last one, 0, for what stands still.
    """

    y: np.ndarray
    vy: np.ndarray
    dy: np.ndarray  # way since the last step
    z: np.ndarray
    vz: np.ndarray
    dz: np.ndarray
    turn: np.ndarray  # rotation about x
    spin: np.ndarray
    dturn: np.ndarray
    fy: np.ndarray
    fz: np.ndarray
    moment: np.ndarray


@inlined
def steps_of(dt_s):
    """Steps of a `SPAN_S`."""
    return max(1, int(SPAN_S / dt_s))


@inlined
def standing(rows):
    """`Supports` in so many rows, a twelfth of them each."""
    n = len(rows) // 12
    return Supports(
        *(rows[:n], rows[n : 2 * n], rows[2 * n : 3 * n]),
        *(rows[3 * n : 4 * n], rows[4 * n : 5 * n], rows[5 * n : 6 * n]),
        *(rows[6 * n : 7 * n], rows[7 * n : 8 * n], rows[8 * n : 9 * n]),
        *(rows[9 * n : 10 * n], rows[10 * n : 11 * n], rows[11 * n : 12 * n]),
    )


@inlined
def verdict(rules, motion_s, max_speed_m_s, limit, k, dt_s, d_m, speed_m_s, shaken, moving_until_s):
    """Whether a history ends at step k: it failed, overturned, is at rest, or the record ends.

    Parameters
    ----------
    rules : Rules
    motion_s, max_speed_m_s : number
        End of the motion that matters, and speed from which the run has failed.
    limit : number
        Step at which it ends whatever it does.
    k, dt_s : int, float
    d_m, speed_m_s : number
        Of the monitored point.
    shaken : bool
        Whether a mass that carries the supports still moves.
    moving_until_s : number
        When the façade was last not at rest.

    Returns
    -------
    over, status, moving_until_s : bool, number, number
    """
    now = k * dt_s
    sound = (abs(speed_m_s) <= max_speed_m_s) & (abs(d_m) < math.inf)
    fell = sound & (abs(d_m) >= rules.overturn_m)
    moves = (abs(speed_m_s) > rules.rest_velocity_m_s) | (abs(d_m) > rules.rest_m) | shaken
    moving_until_s = choose(moves, now, moving_until_s)
    rests = ~moves & (motion_s < now) & (now - moving_until_s > rules.rest_time_s)
    over = ~sound | fell | rests | (limit <= float(k))
    status = choose(fell, OVERTURNED, choose(sound, OK, FAILED))
    return over, status, moving_until_s
