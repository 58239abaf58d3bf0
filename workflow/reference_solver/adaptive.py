"""Integration with error control: Dormand–Prince 5(4), friction returned at every step."""

import math
from dataclasses import dataclass

import numpy as np

from .contact import initial, law_of
from .integrate import COLUMNS, Control, Drive, march, units
from .motion import SupportTable

ROWS = 4096  # room for rows at the start


@dataclass(frozen=True)
class AdaptiveHistory:
    """One simulated history, sampled at the accepted steps (first row: the start).

    Attributes
    ----------
    time_s : ndarray, shape (n,)
    y_m, z_m, theta_rad : ndarray
        Centroid relative to the base's original position, rotation.
    vy_m_s, vz_m_s, omega_rad_s : ndarray
    d_over_b, theta_over_alpha : ndarray
        Top displacement relative to the base over thickness; rotation over α.
    contact_work_j, input_work_j : ndarray
        Work of the interface forces and of the inertia forces −m·a, in the base's frame.
    kinetic_j, potential_j, elastic_j : ndarray
    overturned : bool
        |d/b| reached 1 at some time, outward or, without return walls, inward.
    status : str
        "finished", "overturned" (stopped beyond `stop_d_over_b`) or "failed".
    """

    time_s: np.ndarray
    y_m: np.ndarray
    z_m: np.ndarray
    theta_rad: np.ndarray
    vy_m_s: np.ndarray
    vz_m_s: np.ndarray
    omega_rad_s: np.ndarray
    d_over_b: np.ndarray
    theta_over_alpha: np.ndarray
    contact_work_j: np.ndarray
    input_work_j: np.ndarray
    kinetic_j: np.ndarray
    potential_j: np.ndarray
    elastic_j: np.ndarray
    overturned: bool
    status: str

    def rebounds(self, smallest=1e-4):
        """Successive maxima of θ/α after the first return to the upright pose.

        A maximum counts between two passages of θ = 0; those below `smallest` are
        left out (the settling on the base).
        """
        theta = self.theta_over_alpha
        edges = np.flatnonzero((theta[:-1] > 0.0) & (theta[1:] <= 0.0)) + 1
        peaks = [part.max() for part in np.split(theta, edges)[1:]]
        return np.array([p for p in peaks if p >= smallest])


def simulate(
    wall,
    motion=None,
    duration_s=None,
    theta0_over_alpha=0.0,
    tolerance=1e-6,
    stop_d_over_b=2.0,
    scale=1.0,
):
    """Simulate one history with error control.

    The error of a step is measured in displacements over b, rotations over α and
    rates over p·b and p·α, and kept below `tolerance`. Steps end at the samples
    of the motion, where its slope jumps.

    Parameters
    ----------
    wall : Wall
    motion : SupportTable or None
        None leaves the supports at rest (free rocking).
    duration_s : float or None
        Simulated time; None takes the motion's. Beyond the motion the supports rest.
    theta0_over_alpha : float
        Release angle about the front toe; 0 is the block at rest on its base.
    tolerance : float
        Local error a step, as above.
    stop_d_over_b : float
        Stops the run when |d/b| exceeds it.
    scale : float
        Factor on all accelerations.

    Returns
    -------
    AdaptiveHistory

    Raises
    ------
    ValueError
        If neither a motion nor a duration is given, or the motion has another
        number of return-wall segments.
    """
    motion, duration = checked(wall, motion, duration_s)
    control = Control(duration, tolerance, stop_d_over_b * wall.b_m)
    angle = theta0_over_alpha * wall.alpha_rad
    marched = run(wall, motion, scale, angle, control, np.empty((ROWS, COLUMNS)))
    return _history(wall, marched, stop_d_over_b)


def _history(wall, marched, stop_d_over_b):
    """`AdaptiveHistory` of what `run` returns."""
    rows, written, peak, last, _ = marched
    time, y, z, theta, vy, vz, omega, contact, given, d, elastic = rows[:written].T
    kinetic = 0.5 * wall.mass_kg * (vy**2 + vz**2) + 0.5 * wall.inertia_kg_m2 * omega**2
    return AdaptiveHistory(
        time_s=time,
        y_m=y,
        z_m=z,
        theta_rad=theta,
        vy_m_s=vy,
        vz_m_s=vz,
        omega_rad_s=omega,
        d_over_b=d / wall.b_m,
        theta_over_alpha=theta / wall.alpha_rad,
        contact_work_j=contact,
        input_work_j=given,
        kinetic_j=kinetic,
        potential_j=wall.mass_kg * wall.gravity_m_s2 * (z - 0.5 * wall.h_m),
        elastic_j=elastic,
        overturned=bool(peak >= wall.b_m),
        status=ended(last / wall.b_m, stop_d_over_b),
    )


def run(wall, motion, scale, theta_rad, control, rows):
    """One case in the compiled loop; returns as `integrate.march`."""
    drive = Drive(
        float(motion.dt_s),
        motion.base_m_s2,
        motion.vertical_m_s2,
        motion.relative_m_s2,
        motion.relative_m_s,
        motion.relative_m,
    )
    if not wall.n_segments:  # nothing to push
        none = np.zeros((0, 2))
        drive = drive._replace(relative_m_s2=none, relative_m_s=none, relative_m=none)
    control = Control(*map(float, control))
    state = initial(wall, float(theta_rad))
    return march(
        law_of(wall), drive, float(scale), state, units(wall), control, wall.n_segments, rows
    )


def ended(d_over_b, stop_d_over_b):
    """Status of a case from its last d/b: "finished", "overturned" or "failed"."""
    if not math.isfinite(d_over_b):
        return "failed"
    return "overturned" if abs(d_over_b) > stop_d_over_b else "finished"


def checked(wall, motion, duration_s):
    """Return the motion (one at rest for None) and the duration after checking them."""
    if duration_s is not None and not (math.isfinite(duration_s) and duration_s > 0.0):
        raise ValueError(f"duration_s: expected a positive time, got {duration_s}")
    if motion is None:
        if duration_s is None:
            raise ValueError("simulate: expected a motion or a duration")
        return SupportTable(duration_s, np.zeros(2)), duration_s
    if motion.walls_m_s2 is not None and len(motion.walls_m_s2) != wall.n_segments:
        raise ValueError(
            f"simulate: the motion drives {len(motion.walls_m_s2)} return-wall segments, "
            f"the wall has {wall.n_segments}"
        )
    return motion, motion.duration_s if duration_s is None else duration_s
