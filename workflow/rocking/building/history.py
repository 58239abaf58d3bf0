"""Time histories of a building by superposition of its modes.

With u relative to the ground, M ü + a M u̇ + K u = −M r a_g (damping proportional
to mass with rate a = 2ζ₁ω₁), each mode obeys q̈ + a q̇ + ω²q = −Γ a_g and is
integrated exactly for a piecewise-linear a_g. Modes that are left out follow the
ground as if rigid, so the absolute acceleration keeps the whole of a_g.
"""

from dataclasses import dataclass

import numpy as np

from smdof.oscillator import checked_motion, oscillator_response, refine_linear
from yade_scripts.model.gravity import GRAVITY_M_S2

from .modes import DIRECTIONS

# what acts from the first instant of an explicit run besides the ground motion [m/s²]: a run that
# starts from the drawing rings under its own weight, one without it does not
LOADS = {"without dead load": 0.0, "sudden gravity": GRAVITY_M_S2}


@dataclass(frozen=True)
class PointHistory:
    """Absolute acceleration and relative displacement of some points.

    Attributes
    ----------
    time_s, ground_m_s2 : ndarray, shape (nt,)
    acceleration_m_s2, displacement_m : ndarray, shape (n_points, nt)
        Along the direction of the motion; displacement relative to the ground.
    """

    time_s: np.ndarray
    ground_m_s2: np.ndarray
    acceleration_m_s2: np.ndarray
    displacement_m: np.ndarray


def mass_damping_rate(omega_rad_s, damping_ratio):
    """Rate a = 2ζω [1/s] of mass-proportional damping that gives ζ at ω (eq. 2 with β = 0)."""
    return 2.0 * damping_ratio * omega_rad_s


def modal_history(
    modes,
    blocks,
    ground_m_s2,
    dt_s,
    rate_1_s,
    *,
    direction="y",
    points_per_period=20,
    smallest_ratio=1e-7,
    gravity_m_s2=0.0,
):
    """Response of the centroids of some blocks to a ground motion.

    Parameters
    ----------
    modes : Modes
    blocks : sequence of int
        Block indices.
    ground_m_s2 : array_like, shape (nt,)
        Ground acceleration along `direction`, linear between samples.
    dt_s : float
    rate_1_s : float
        Mass-proportional damping rate a; mode j has ζ_j = a/(2ω_j).
    direction : {"x", "y", "z"}
    points_per_period : int
        Output samples in the shortest period that takes part.
    smallest_ratio : float
        Modes with a smaller effective mass ratio are left out.
    gravity_m_s2 : float
        Downward acceleration that acts from the first instant on, as in an explicit
        run that starts without its dead load: the building rings vertically.

    Returns
    -------
    History

    Raises
    ------
    ValueError
        If the motion is unusable, a block is not free in that direction, or a mode
        would be overdamped.
    """
    ground = checked_motion(ground_m_s2, dt_s)
    axis = DIRECTIONS.index(direction)
    rows = []
    for block in blocks:
        found = np.flatnonzero((modes.dof[:, 0] == block) & (modes.dof[:, 1] == axis))
        if not len(found):
            raise ValueError(f"block {block} is not free along {direction}")
        rows.append(found[0])
    driven = modes.effective_ratio[:, axis] >= smallest_ratio
    if gravity_m_s2:
        driven |= modes.effective_ratio[:, 2] >= smallest_ratio
    use = np.flatnonzero(driven)
    if rate_1_s / 2.0 >= modes.omega[use].min():
        raise ValueError(f"a damping rate of {rate_1_s:g} 1/s overdamps the first mode")
    shortest = 2.0 * np.pi / modes.omega[use].max()
    refine = max(1, int(np.ceil(dt_s * points_per_period / shortest - 1e-9)))
    ground = refine_linear(ground, refine)
    step = dt_s / refine
    displacement = np.zeros((len(rows), ground.size))
    relative = np.zeros_like(displacement)
    for j in use:
        omega = modes.omega[j]
        load = -modes.participation[j, axis] * ground - modes.participation[j, 2] * gravity_m_s2
        q, v = oscillator_response(load, step, omega, rate_1_s / (2.0 * omega))
        shape = modes.phi[rows, j][:, None]
        displacement += shape * q
        relative += shape * (load - rate_1_s * v - omega**2 * q)
    time = np.arange(ground.size) * step
    return PointHistory(time, ground, ground + relative, displacement)
