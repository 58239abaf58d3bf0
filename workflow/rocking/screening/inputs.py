"""What the compiled loop is given beside the plane: motions, carried masses, stop rules."""

from typing import NamedTuple

import numpy as np

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
    limit_s, overturn_m, rest_velocity_m_s, rest_time_s : float
    """

    limit_s: float
    overturn_m: float
    rest_velocity_m_s: float
    rest_time_s: float
