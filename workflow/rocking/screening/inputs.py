"""What the compiled loop is given beside the plane: motions, carried masses, stop rules."""

from typing import NamedTuple

import numpy as np


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
    """Masses that carry the supports: M ü + C u̇ + K u = −M a_g + contact forces.

    Attributes
    ----------
    mass_kg : ndarray, shape (n,)
        Without masses the supports are driven.
    k_n_m, c_n_s_m : ndarray, shape (n, n)
    upper : ndarray of int, shape (supports,)
        A support hangs between this mass and the one before it (before mass 0 the ground).
    weight : ndarray, shape (supports,)
        Share of the upper one, in the support's motion and of its force.
    """

    mass_kg: np.ndarray
    k_n_m: np.ndarray
    c_n_s_m: np.ndarray
    upper: np.ndarray
    weight: np.ndarray


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
