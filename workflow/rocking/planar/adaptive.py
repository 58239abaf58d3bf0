"""Integration with error control: Dormand–Prince 5(4), friction returned at every step."""

import math
from dataclasses import dataclass

import numpy as np

from .contact import SLIP, Equations
from .motion import Motion

# Dormand and Prince (1980): stages, weights of order 5, and order 5 minus order 4
_C = (0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0)
_A = [
    np.array(row)
    for row in (
        (1 / 5,),
        (3 / 40, 9 / 40),
        (44 / 45, -56 / 15, 32 / 9),
        (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
        (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
        (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
    )
]
_E = np.array((71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40))


@dataclass(frozen=True)
class History:
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
        Work of the interface forces and of the inertia forces −m·a_g, in the base's frame.
    kinetic_j, potential_j, elastic_j : ndarray
    overturned : bool
        |d/b| reached 1 at some time, outward or, without return walls, inward.
    status : str
        "finished", "overturned" (stopped beyond `stop_d_over_b`) or "failed".
    steps, rejected : int
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
    steps: int
    rejected: int

    def rebounds(self, smallest=1e-4):
        """Successive maxima of θ/α after the first return to the upright pose.

        A maximum counts between two passages of θ = 0; those below `smallest` are
        left out (the settling on the base).
        """
        theta = self.theta_over_alpha
        edges = np.flatnonzero((theta[:-1] > 0.0) & (theta[1:] <= 0.0)) + 1
        peaks = [part.max() for part in np.split(theta, edges)[1:]]
        return np.array([p for p in peaks if p >= smallest])


def _step(equations, state, rate, support, tau, h):
    """One Dormand–Prince step; returns the new state, its limits μN and the error estimate."""
    stages = np.empty((7,) + state.shape)
    stages[0] = rate
    flat = stages.reshape(7, -1)
    for i in range(1, 7):
        new = state + h * (_A[i - 1] @ flat[:i]).reshape(state.shape)
        stages[i], limit = equations.rates(new, *support(tau + h * (_C[i] if i < 6 else 1.0)))
    return new, limit, h * (_E @ flat).reshape(state.shape)


def march(equations, state, motion, factor, duration_s, tolerance, max_step_s, min_step_s, observe):
    """Advance a batch of cases with one common, error-controlled step.

    Parameters
    ----------
    equations : Equations
    state : ndarray, shape (cases, equations.size)
    motion : Motion
    factor : ndarray, shape (cases,)
        Factor on the accelerations of each case.
    duration_s, tolerance, max_step_s, min_step_s : float
        See `simulate`.
    observe : callable
        Called as observe(time, state, wall displacements) at the start and after
        every step; returns the mask of the cases to go on with.

    Returns
    -------
    steps, rejected : int
    """
    wall = equations.wall
    unit = np.array([wall.b_m, wall.b_m, wall.alpha_rad] * 2)
    unit[3:] *= wall.p_rad_s
    steps = rejected = k = 0
    time, h = 0.0, 1e-2 * max_step_s
    raw = motion.interval(0, wall.n_segments)

    def support(tau):
        base, u, v = raw(tau)
        if u is None:
            return factor * base, None, None
        return factor * base, factor[:, None] * u, factor[:, None] * v

    at = support(0.0)
    rate, limit = equations.rates(state, *at)
    going = observe(time, state, at[1])
    while going.any() and time < duration_s * (1.0 - 1e-12):
        if not going.all():
            state, factor = state[going], factor[going]
            rate = rate[going]
        start = k * motion.dt_s
        knot = (k + 1) * motion.dt_s if k < motion.intervals else math.inf
        left = min(knot, duration_s) - time
        trial = left if h >= left else min(h, max(0.5 * left, min_step_s))
        new, limit, error = _step(equations, state, rate, support, time - start, trial)
        size = np.max(np.abs(error[:, :6]) / unit) / tolerance
        if not size <= 1.0 and trial > min_step_s:
            shrink = max(0.2, 0.9 * size**-0.2) if math.isfinite(size) else 0.2
            h = max(trial * shrink, min_step_s)
            rejected += 1
            going = np.ones(len(state), bool)
            continue
        steps += 1
        growth = 5.0 if size <= 0.0 else 0.9 * size**-0.2 if math.isfinite(size) else 1.0
        h = min(max(trial * min(5.0, growth), min_step_s), max_step_s)
        equations.return_map(new, limit)
        state = new
        if trial == left and knot <= duration_s:
            k, time = k + 1, knot
            raw = motion.interval(k, wall.n_segments)
            at = support(0.0)
        else:
            time = duration_s if trial == left else time + trial
            at = support(time - start)
        # returned friction or a new interval change the rate at this instant
        rate, _ = equations.rates(state, *at)
        going = observe(time, state, at[1])
    return steps, rejected


def simulate(
    wall,
    motion=None,
    duration_s=None,
    theta0_over_alpha=0.0,
    tolerance=1e-6,
    max_step_s=2e-3,
    min_step_s=1e-8,
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
    motion : Motion or None
        None leaves the supports at rest (free rocking).
    duration_s : float or None
        Simulated time; None takes the motion's. Beyond the motion the supports rest.
    theta0_over_alpha : float
        Release angle about the front toe; 0 is the block at rest on its base.
    tolerance : float
        Local error a step, as above.
    max_step_s, min_step_s : float
        At the smallest step the estimate is ignored: friction and contact jumps
        have no smaller scale worth resolving.
    stop_d_over_b : float
        Stops the run when |d/b| exceeds it.
    scale : float
        Factor on all accelerations.

    Returns
    -------
    History

    Raises
    ------
    ValueError
        If neither a motion nor a duration is given, or the motion has another
        number of return-wall segments.
    """
    motion, duration = checked(wall, motion, duration_s)
    equations = Equations(wall)
    rows = []

    def observe(time, state, wall_u):
        energies = equations.energies(state, wall_u)
        d = equations.top_displacement(state)[0] / wall.b_m
        rows.append([time, *state[0, :SLIP], d, *(e[0] for e in energies)])
        return np.array([abs(d) <= stop_d_over_b])  # False if not finite

    steps, rejected = march(
        equations,
        equations.initial(theta0_over_alpha * wall.alpha_rad),
        motion,
        np.array([float(scale)]),
        duration,
        tolerance,
        max_step_s,
        min_step_s,
        observe,
    )
    columns = dict(zip(_COLUMNS, np.array(rows).T, strict=True))
    last = columns["d_over_b"][-1]
    return History(
        theta_over_alpha=columns["theta_rad"] / wall.alpha_rad,
        overturned=bool(np.nanmax(np.abs(columns["d_over_b"])) >= 1.0),
        status=ended(last, stop_d_over_b),
        steps=steps,
        rejected=rejected,
        **columns,
    )


def ended(d_over_b, stop_d_over_b):
    """Status of a case from its last d/b: "finished", "overturned" or "failed"."""
    if not math.isfinite(d_over_b):
        return "failed"
    return "overturned" if abs(d_over_b) > stop_d_over_b else "finished"


_COLUMNS = (
    "time_s",
    "y_m",
    "z_m",
    "theta_rad",
    "vy_m_s",
    "vz_m_s",
    "omega_rad_s",
    "contact_work_j",
    "input_work_j",
    "d_over_b",
    "kinetic_j",
    "potential_j",
    "elastic_j",
)


def checked(wall, motion, duration_s):
    """Return the motion (one at rest for None) and the duration after checking them."""
    if duration_s is not None and not (math.isfinite(duration_s) and duration_s > 0.0):
        raise ValueError(f"duration_s: expected a positive time, got {duration_s}")
    if motion is None:
        if duration_s is None:
            raise ValueError("simulate: expected a motion or a duration")
        return Motion(duration_s, np.zeros(2)), duration_s
    if motion.walls_m_s2 is not None and len(motion.walls_m_s2) != wall.n_segments:
        raise ValueError(
            f"simulate: the motion drives {len(motion.walls_m_s2)} return-wall segments, "
            f"the wall has {wall.n_segments}"
        )
    return motion, motion.duration_s if duration_s is None else duration_s
