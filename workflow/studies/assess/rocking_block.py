"""One degree of freedom: Housner's equation of a rigid block that rocks on one side.

With θ outward from the return walls and the base's acceleration a positive outward,

    θ̈ = −p²[sin(α − θ) + (a/g) cos(α − θ)],   θ > 0,

and at θ = 0 the rate turns round and keeps the share |e_1SR| of the study's eq. 3. No contact
compliance, no sliding, no floors: what a solver of the whole scene is to be set beside.
"""

import math

import numpy as np
from rocking.mechanics.closed_forms import GRAVITY_M_S2, _positive, block, restitution_one_sided
from rocking.runtime.compiled import compiled

from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2 as G_M_S2

STEP_S = 5e-4


@compiled
def _march(acceleration, dt, alpha, p2, restitution, gravity, factor, fallen, theta, steps):
    """Largest θ of one history; velocity Verlet between samples, impacts where they happen."""
    rate = peak = 0.0
    n = acceleration.size
    h = dt / steps
    peak = theta
    for k in range((n - 1) * steps):
        i, part = k // steps, (k % steps) / steps
        a0 = factor * (acceleration[i] + part * (acceleration[i + 1] - acceleration[i]))
        a1 = a0 + factor * (acceleration[i + 1] - acceleration[i]) / steps
        if theta <= 0.0 and rate <= 0.0:
            if -a0 <= gravity * math.tan(alpha):
                continue
            theta, rate = 0.0, 0.0
        old = -p2 * (math.sin(alpha - theta) + a0 / gravity * math.cos(alpha - theta))
        moved = theta + h * rate + 0.5 * h * h * old
        new = -p2 * (math.sin(alpha - moved) + a1 / gravity * math.cos(alpha - moved))
        faster = rate + 0.5 * h * (old + new)
        if moved <= 0.0:
            # rate at the impact from the energy over the way to θ = 0
            speed = math.sqrt(max(rate * rate - 2.0 * old * theta, 0.0))
            moved, faster = 0.0, restitution * speed
            if faster < 1e-6:
                faster = 0.0
        theta, rate = moved, faster
        if theta > peak:
            peak = theta
        if theta >= fallen:
            break
    return peak


def peak_rotation(
    acceleration_m_s2, dt_s, height_m, thickness_m, factor=1.0, *, start_rad=0.0, restitution=None
):
    """Largest outward rotation over α of one-sided rocking on a shaken rigid base [-].

    Parameters
    ----------
    acceleration_m_s2 : array_like, shape (nt,)
        Of the base, positive outward, straight between samples.
    dt_s : float
    height_m, thickness_m : float
    factor : float
        On the acceleration; its sign is the direction.
    start_rad : float
        Rotation at rest at the first sample.
    restitution : float or None
        Share of the rate kept at an impact; None takes |e_1SR|.

    Returns
    -------
    float
        The march ends where the top has moved by the thickness, sin θ = b/h: overturned.
    """
    _positive(dt_s=dt_s)
    alpha, _, p = block(height_m, thickness_m)
    kept = abs(restitution_one_sided(alpha)) if restitution is None else restitution
    fallen = math.asin(min(thickness_m / height_m, 1.0))
    steps = max(1, math.ceil(dt_s / STEP_S))
    values = np.asarray(acceleration_m_s2, float)
    found = _march(
        values, dt_s, alpha, p * p, kept, GRAVITY_M_S2, float(factor), fallen, start_rad, steps
    )
    return found / alpha


def overturning_pga(acceleration_m_s2, dt_s, height_m, thickness_m, sign, max_pga_g, ratio=1.02):
    """Lowest PGA that overturns, on levels of `ratio` from b/h up [g]; NaN up to `max_pga_g`."""
    values = np.asarray(acceleration_m_s2, float)
    unit = sign * G_M_S2 / np.abs(values).max()
    fallen = math.asin(min(thickness_m / height_m, 1.0)) / block(height_m, thickness_m).alpha_rad
    level = thickness_m / height_m
    while level <= max_pga_g:
        if peak_rotation(values, dt_s, height_m, thickness_m, unit * level) >= fallen:
            return level
        level *= ratio
    return math.nan
