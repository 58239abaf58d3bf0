"""Histories and peaks: motions on the grid of steps, stop rules, step, and the compiled loop."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.linalg import block_diag

from . import march
from .block import BLOCK
from .inputs import COLUMNS, FAILED, OVERTURNED, REST_RATIO, Rules, SteppedMotion
from .plane import matrices
from .stack import Stack, stack_matrices
from .stack_kernel import STACK
from .substructure import NO_BODIES

STATUS = ("ok", "overturned", "failed")
STEP_FRACTION = 0.08  # of the stable step: 0.39 ms for the default façade
FEW = 2  # histories that are marched one after the other: eight side by side take twice one's time
FARTHER = 1e3  # than the explicit stable step, where springs are taken ahead
AT_ONCE = 64  # side by side, between two chances to stop; their memory fits into the cache
KEPT = 12_000_000  # numbers in the tables of one motion that are kept, 100 MB: of a dense scan all


@dataclass(frozen=True)
class Motions:
    """Accelerations that drive a planar scene, linear between samples, at rest before them.

    Parameters
    ----------
    time_s : array_like, shape (nt,)
    ground_m_s2 : array_like, shape (nt,)
        Of the reference support, positive outward.
    supports_m_s2 : array_like, shape (m, nt)
        Absolute, in the order of `moving_supports(scene)`.
    vertical_m_s2 : array_like, shape (nt,), or None
        Of ground and walls alike, positive upward; scaled by the size of the others' factor.

    Raises
    ------
    ValueError
        If shapes differ, times do not ascend or a value is not finite.
    """

    time_s: np.ndarray
    ground_m_s2: np.ndarray
    supports_m_s2: Any = ()
    vertical_m_s2: Any = None
    _tables: dict = field(default_factory=dict, init=False, repr=False, compare=False)
    _speed: list = field(default_factory=list, init=False, repr=False, compare=False)

    def __post_init__(self):
        """Check, and let every acceleration end at zero."""
        time = np.asarray(self.time_s, float)
        ground = np.asarray(self.ground_m_s2, float)
        vertical = 0.0 * ground if self.vertical_m_s2 is None else self.vertical_m_s2
        rows = [ground, np.asarray(vertical, float), *np.asarray(self.supports_m_s2, float)]
        if time.ndim != 1 or time.size < 2 or any(row.shape != time.shape for row in rows):
            raise ValueError("motions: expected accelerations of the length of time_s, at least 2")
        if not (np.all(np.isfinite(rows)) and np.all(np.diff(time) > 0.0)):
            raise ValueError("motions: expected finite accelerations at ascending times")
        end = 2.0 * time[-1] - time[-2]
        rows = [np.append(row, 0.0) for row in rows]
        for name, value in (
            ("time_s", np.append(time, end)),
            ("ground_m_s2", rows[0]),
            ("vertical_m_s2", rows[1]),
            ("supports_m_s2", np.array(rows[2:]).reshape(-1, time.size + 1)),
        ):
            object.__setattr__(self, name, value)

    def peak_speed(self):
        """Largest |velocity| of ground and supports at a factor of one [m/s]; kept."""
        if not self._speed:
            rows = np.vstack([self.ground_m_s2, self.supports_m_s2])
            gain = 0.5 * np.diff(self.time_s) * (rows[:, 1:] + rows[:, :-1])
            self._speed.append(float(np.abs(np.cumsum(gain, axis=1)).max()))
        return self._speed[0]

    def table(self, step_s, supports=True):
        """Motions at the whole steps; those of the supports relative to the ground, exact.

        The last are kept up to `KEPT` numbers: a scan asks for some amplitudes at a time, in each
        of its layouts and steps again.

        Returns
        -------
        SteppedMotion
        """
        kept = self._tables
        if (step_s, supports) not in kept:
            kept[step_s, supports] = self._tabulate(step_s, supports)
            while len(kept) > 1 and sum(_numbers(table) for table in kept.values()) > KEPT:
                kept.pop(next(iter(kept)))
        return kept[step_s, supports]

    def _tabulate(self, step_s, supports):
        t = self.time_s
        grid = step_s * np.arange(math.ceil(t[-1] / step_s) + 1)
        i = np.clip(np.searchsorted(t, grid, side="right") - 1, 0, t.size - 2)
        s, width = np.minimum(grid, t[-1]) - t[i], np.diff(t)[i]
        late = np.maximum(grid - t[-1], 0.0)
        place, speed = [], []
        for row in self.supports_m_s2 if supports else ():
            a, dt = row - self.ground_m_s2, np.diff(t)
            v = np.concatenate(([0.0], np.cumsum(0.5 * dt * (a[1:] + a[:-1]))))
            u = v[:-1] * dt + dt**2 * (2.0 * a[:-1] + a[1:]) / 6.0
            u = np.concatenate(([0.0], np.cumsum(u)))
            slope = (a[i + 1] - a[i]) / width
            now = v[i] + a[i] * s + 0.5 * slope * s**2
            place.append(u[i] + v[i] * s + 0.5 * a[i] * s**2 + slope * s**3 / 6.0 + now * late)
            speed.append(now)
        shape = (len(place), grid.size)
        return SteppedMotion(
            float(step_s),
            np.interp(grid, t, self.ground_m_s2),
            np.interp(grid, t, self.vertical_m_s2),
            np.ascontiguousarray(np.reshape(place, shape).T),
            np.ascontiguousarray(np.reshape(speed, shape).T),
        )


def _numbers(table):
    return 2 * table.ground_m_s2.size + 2 * table.place_m.size


@dataclass(frozen=True)
class Series:
    """One history; every array has a row a sample.

    Attributes
    ----------
    time_s : ndarray, shape (n,)
    d_m, d_m_s : ndarray
        Top displacement relative to the ground, outward, and its rate.
    pose, rates : ndarray, shape (n, 3)
        y, z [m] of the centroid from its reference place in the ground's frame, rotation about
        x [rad] (outward is negative), and their rates.
    elastic_j, spent_j : ndarray
        Energy stored in nodes, ties and floors, raised loads included; taken by dashpots,
        friction, yielding and what broke so far.
    contact : ndarray, shape (n, 3)
        Force along y, z [N] and moment about x [N·m] of the nodes on the block.
    supports_m, supports_m_s : ndarray, shape (n, m)
        Of the supports, or of the masses that carry them, relative to the ground.
    peak_d_over_b : float
    status : str
        "ok", "overturned" or "failed".
    end_s, step_s : float
    broken : int
        Bonds that broke.
    """

    time_s: np.ndarray
    d_m: np.ndarray
    d_m_s: np.ndarray
    pose: np.ndarray
    rates: np.ndarray
    elastic_j: np.ndarray
    spent_j: np.ndarray
    contact: np.ndarray
    supports_m: np.ndarray
    supports_m_s: np.ndarray
    peak_d_over_b: float
    status: str
    end_s: float
    step_s: float
    broken: int


def stable_step(planar, carried=NO_BODIES, lead=0.0):
    """Largest step [s] at which the scheme is stable with every node closed, by bisection.

    The scheme is (M + ½hC₁ + ½·lead·h²K₁)a = F − Kx − Cv − ½h(C − C₁)a⁻, v⁺ = v + ha, x⁺ = x + hv⁺,
    with C₁ and K₁ the parts of C and K that belong to each block alone, of pieces in a row to all
    of them; its amplification matrix acts on (x, v, a⁻). Without `lead` it is that of a scheme that
    takes springs as they are, which courses do not need to keep.
    """
    n, supports = carried.mass_kg.size, len(carried.hang)
    if isinstance(planar, Stack):
        mass, k, c, block = stack_matrices(planar, supports)
        pieces, free = block < len(planar.mass_kg), int(planar.free.sum())
        own = pieces[:, None] & pieces if planar.in_row else (block[:, None] == block) & pieces
        more = []
    else:
        mass, k, c = matrices(planar, supports)
        free, own = 3, np.arange(mass.size) < 3
        own = own[:, None] & own
        more = [rows if len(rows) else 0.0 * carried.hang for rows in (carried.lift, carried.roll)]
    floors = mass.size - free
    # rows: the blocks, supports along y, floors, supports along z, their rotations; columns:
    # blocks, masses, floors
    hang = block_diag(np.eye(free), carried.hang, np.eye(floors))
    hang = np.vstack([hang, *(np.pad(rows, ((0, 0), (free, floors))) for rows in more)])
    k, c = (hang.T @ whole @ hang for whole in (k, c))
    mass = np.diag(np.concatenate((mass[:free], carried.mass_kg, mass[free:])))
    k[free : free + n, free : free + n] += carried.k_n_m
    c[free : free + n, free : free + n] += carried.c_n_s_m
    alone = np.zeros(k.shape, bool)
    alone[:free, :free] = own[:free, :free]
    return _largest_step(mass, k, c, alone, lead)


def _largest_step(mass, k, c, alone, lead=0.0):
    """Stable step of `stable_step` by matrices; `alone` masks C₁ in C and K₁ in K."""
    own, one = np.where(alone, c, 0.0), np.eye(len(c))
    ahead = 0.5 * lead * np.where(alone, k, 0.0)

    def stable(h):
        a = np.hstack((-k, -c, -0.5 * h * (c - own)))
        a = np.linalg.solve(mass + 0.5 * h * own + h * h * ahead, a)
        v = np.hstack((0 * one, one, 0 * one)) + h * a
        x = np.hstack((one, 0 * one, 0 * one)) + h * v
        return np.abs(np.linalg.eigvals(np.vstack((x, v, a)))).max() <= 1.0 + 1e-9

    low, high = 0.0, 2.0 / math.sqrt(np.abs(np.linalg.eigvals(np.linalg.solve(mass, k))).max())
    high *= FARTHER if lead else 1.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


def limits(uplift_m_s2, thickness_m, motions, numerics, factors):
    """Stop rules, and per factor: end of motion [s], quiet [m/s²], largest speed [m/s]."""
    rows = np.vstack([motions.ground_m_s2, motions.supports_m_s2])
    envelope = np.abs(rows).max(axis=0)
    later = np.maximum.accumulate(envelope[::-1])[::-1]  # largest from each sample on
    size = np.abs(factors)
    quiet = numerics["quiet_ratio"] * np.minimum(uplift_m_s2, size * envelope.max())
    last = np.searchsorted(-later, -quiet / np.maximum(size, 1e-300), side="left") - 1
    motion = np.where(last < 0, 0.0, motions.time_s[np.maximum(last, 0)])
    speed = numerics["max_speed_ratio"] * (size * motions.peak_speed() + 1.0)
    rules = Rules(
        float(motions.time_s[-2] + numerics["after_motion_s"]),
        float(numerics["overturn_ratio"] * thickness_m),
        REST_RATIO * thickness_m,
        float(numerics["rest_velocity_m_s"]),
        float(numerics["rest_time_s"]),
    )
    return rules, motion, quiet, speed


def _set_up(planar, motions, numerics, factors, carried, step_s):
    carried = carried or NO_BODIES
    if isinstance(planar, Stack) and (len(carried.lift) or len(carried.roll)):
        raise ValueError("planar solver: supports of several blocks move along y alone")
    wanted = int(planar.support.max(initial=-1)) + 1
    if isinstance(planar, Stack):
        wanted = max(wanted, int(planar.guide.max()) + 1)
    given = len(carried.hang) or len(motions.supports_m_s2)
    if wanted > given:
        raise ValueError(f"planar solver: the scene has {wanted} moving supports, got {given}")
    if len(carried.roll) and np.any(planar.carried & (planar.support >= 0)):
        raise ValueError("planar solver: expected supports that turn to carry their own nodes")
    factors = np.ravel(np.asarray(factors, float))
    step = step_s or STEP_FRACTION * stable_step(planar, carried)
    table = motions.table(step, supports=not carried.mass_kg.size)
    uplift = planar.gravity_m_s2 * planar.thickness_m / planar.height_m
    rules, *own = limits(uplift, planar.thickness_m, motions, numerics, factors)
    return carried, table, rules, np.stack([factors, *own], axis=1)


def _loop(planar):
    return STACK if isinstance(planar, Stack) else BLOCK


def history(planar, motions, numerics, factor=1.0, *, carried=None, step_s=None, sample_s=0.005):
    """One history with its time series.

    Parameters
    ----------
    planar : Planar
    motions : Motions
    numerics : dict
        Section numerics of the configuration: quiet_ratio, after_motion_s, overturn_ratio,
        rest_velocity_m_s, rest_time_s, max_speed_ratio.
    factor : float
        On all accelerations; its sign is the direction.
    carried : Bodies or None
        Masses that carry the supports and feel the block; None drives the supports.
    step_s : float or None
        None takes `STEP_FRACTION` of the stable step.
    sample_s : float
        Interval between rows; 0 writes every step.

    Returns
    -------
    Series
    """
    carried, table, rules, cases = _set_up(planar, motions, numerics, factor, carried, step_s)
    every = max(1, round(sample_s / table.step_s))
    supports = carried.mass_kg.size or table.place_m.shape[1]
    count = math.ceil(rules.limit_s / table.step_s) // every + 1
    rows = np.zeros((count, COLUMNS + 2 * supports))
    (peak, status, end), written, broken = march.one(
        _loop(planar), planar, carried, table, rules, cases[0], every, rows
    )
    rows = rows[:written]
    return Series(
        rows[:, 0],
        rows[:, 1],
        rows[:, 2],
        rows[:, 3:6],
        rows[:, 6:9],
        rows[:, 9],
        rows[:, 10],
        rows[:, 11:14],
        rows[:, COLUMNS : COLUMNS + supports],
        rows[:, COLUMNS + supports :],
        math.nan if status == FAILED else peak / planar.thickness_m,
        STATUS[int(status)],
        float(end),
        table.step_s,
        int(broken),
    )


@dataclass(frozen=True)
class Peaks:
    """Outcomes by factor, each of shape (cases,).

    Attributes
    ----------
    factor : ndarray
    d_over_b : ndarray
        Largest |d|/b; NaN where a history failed.
    overturned : ndarray of bool
    failed : ndarray of bool
    end_s : ndarray
        Simulated time.
    step_s : float
    """

    factor: np.ndarray
    d_over_b: np.ndarray
    overturned: np.ndarray
    failed: np.ndarray
    end_s: np.ndarray
    step_s: float


def peaks(planar, motions, numerics, factors, *, carried=None, step_s=None):
    """Peak d/b of many amplitudes of one motion; parameters as `history`.

    Returns
    -------
    Peaks
    """
    carried, table, rules, cases = _set_up(planar, motions, numerics, factors, carried, step_s)
    given, rows = (_loop(planar), planar, carried, table, rules), np.zeros((0, COLUMNS))
    if len(cases) > FEW:
        parts = [cases[i : i + AT_ONCE] for i in range(0, len(cases), AT_ONCE)]
        found = np.concatenate([march.many(*given, part) for part in parts])
    else:
        outcomes = [march.one(*given, case, 1, rows)[0] for case in cases]
        found = np.reshape(outcomes, (-1, 3))
    peak, status, end = found.T
    failed = status == FAILED
    ratio = np.where(failed, np.nan, peak / planar.thickness_m)
    return Peaks(cases[:, 0], ratio, status == OVERTURNED, failed, end, table.step_s)
