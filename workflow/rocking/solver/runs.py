"""Histories and peaks: stop rules, step, and the compiled loop."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.linalg import block_diag

from . import march
from .block import BLOCK
from .inputs import COLUMNS, FAILED, OVERTURNED, REST_RATIO, Rules, steps_of
from .motions import Motions, last_step
from .plane import matrices
from .stack import LEAD, Stack, stack_matrices
from .stack_kernel import STACK
from .substructure import NO_BODIES

STATUS = ("ok", "overturned", "failed")
STEP_FRACTION = 0.08  # of the stable step: 0.39 ms for the default façade
FARTHER = 1e3  # than the explicit stable step, where springs are taken ahead
AS_THEY_ARE = (
    0.4  # of the explicit stable step: up to there no spring is taken ahead; at 0.46 states
)
# alternated from step to step for 60 ms in a squat façade that pushes its building
AT_ONCE = 64  # side by side, between two chances to stop; their memory fits into the cache


class Brief(NamedTuple):
    """When a brief history ends: its largest displacement is known before the motion is over.

    It ends `after_s` after all that is left of the motion, of supports and of what carries them
    stays below `uplift` of what begins to lift a block of the scene's size at rest, or below `peak`
    of the whole motion's largest acceleration. Two kinds are run again as a whole: those beyond
    `still` of |d|/b in their last two seconds, since a façade near its unstable balance falls late;
    and those beyond `swings` and half of their own peak, which a later swing may exceed.
    """

    uplift: float = 0.5
    peak: float = 0.2
    after_s: float = 3.0
    still: float = 0.25
    swings: float = 0.05


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
        Energy stored in nodes, ties and floors, raised loads included; taken by dashpots, those of
        masses that carry supports too, friction, yielding and what broke so far.
    contact : ndarray, shape (n, 3)
        Force along y, z [N] and moment about x [N·m] of the nodes on the block.
    kinetic_j, potential_j, input_j : ndarray
        Of blocks and of masses that carry supports; of the weight of blocks, from their reference
        places, and of the springs between these masses; work of the inertia forces and of driven
        supports so far. Kinetic + potential + elastic energy from the start, and what was spent,
        are the input but for the error of the step.
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
    kinetic_j: np.ndarray
    potential_j: np.ndarray
    input_j: np.ndarray
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
        of_blocks = (
            pieces[:, None] & pieces if planar.in_row else (block[:, None] == block) & pieces
        )
        more = []
    else:
        mass, k, c = matrices(planar, supports)
        free, of_blocks = 3, np.arange(mass.size) < 3
        of_blocks = of_blocks[:, None] & of_blocks
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
    alone[:free, :free] = of_blocks[:free, :free]
    return _largest_step(mass, k, c, alone, lead)


def fitted(planar, carried, step_s):
    """Plane of courses whose springs are taken ahead by no more than a step asks for.

    Newmark's scheme with γ = 1/2 and β = lead/2 is stable up to h₀/√(1 − 2·lead), with h₀ the
    stable step of springs that are taken as they are; of h₀ itself it takes `AS_THEY_ARE`.
    """
    if not isinstance(planar, Stack) or planar.lead <= 0.0:
        return planar
    ratio = AS_THEY_ARE * stable_step(planar, carried or NO_BODIES) / step_s
    return planar._replace(lead=LEAD * max(0.0, 1.0 - ratio * ratio))


def _largest_step(mass, k, c, alone, lead=0.0):
    """Stable step of `stable_step` by matrices; `alone` masks C₁ in C and K₁ in K."""
    c_alone, eye = np.where(alone, c, 0.0), np.eye(len(c))
    ahead = 0.5 * lead * np.where(alone, k, 0.0)

    def stable(h):
        a = np.hstack((-k, -c, -0.5 * h * (c - c_alone)))
        a = np.linalg.solve(mass + 0.5 * h * c_alone + h * h * ahead, a)
        v = np.hstack((0 * eye, eye, 0 * eye)) + h * a
        x = np.hstack((eye, 0 * eye, 0 * eye)) + h * v
        return np.abs(np.linalg.eigvals(np.vstack((x, v, a)))).max() <= 1.0 + 1e-9

    low, high = 0.0, 2.0 / math.sqrt(np.abs(np.linalg.eigvals(np.linalg.solve(mass, k))).max())
    high *= FARTHER if lead else 1.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


def limits(planar, motions, numerics, factors, step_s):
    """What ends histories under a motion, shape (n, 5): rows from MOTION to LAST of `march`.

    End of the motion that matters [s], quiet [m/s²], failing speed [m/s], step at which a history
    ends, and after which the motion has. `numerics` may have a `Brief` by the key brief.
    """
    later = motions.later_peak()
    size, uplift = np.abs(factors), planar.gravity_m_s2 * planar.thickness_m / planar.height_m
    quiet = numerics["quiet_ratio"] * np.minimum(uplift, size * later[0])
    motion = _last_above(motions.time_s, later, quiet, size)
    speed = numerics["max_speed_ratio"] * (size * motions.peak_speed() + 1.0)
    limit = math.ceil((motions.time_s[-2] + numerics["after_motion_s"]) / step_s)
    ends = [np.full(size.shape, float(step)) for step in (limit, last_step(motions, step_s))]
    if (brief := numerics.get("brief")) is not None:
        every = motions.later_peak(alone=True)
        calm = np.maximum(
            brief.uplift * np.minimum(uplift, size * every[0]), brief.peak * size * every[0]
        )
        over = _last_above(motions.time_s, every, calm, size)
        ends[0] = np.minimum(ends[0], np.ceil((over + brief.after_s) / step_s))
    return np.stack([motion, quiet, speed, *ends], axis=1)


def _last_above(time_s, later, level, size):
    """When a motion times `size` last exceeds a level [s], by its largest from each sample on."""
    last = np.searchsorted(-later, -level / np.maximum(size, 1e-300), side="left") - 1
    return np.where(last < 0, 0.0, time_s[np.maximum(last, 0)])


def _supports_of(planar):
    """How many moving supports its joints, ties and floors name."""
    columns = [planar.support, planar.bars.tie_support, planar.bars.floor_support]
    if isinstance(planar, Stack):
        columns += [planar.groups.support, planar.lines.support, planar.guide]
    return 1 + max(int(column.max(initial=-1)) for column in columns)


def _set_up(planar, motions, numerics, factors, carried, step_s):
    carried = carried or NO_BODIES
    if isinstance(planar, Stack) and (len(carried.lift) or len(carried.roll)):
        raise ValueError("planar solver: supports of several blocks move along y alone")
    factors = np.ravel(np.asarray(factors, float))
    if shared := isinstance(motions, Motions):
        motions = [motions]
    elif len(motions) != factors.size:
        raise ValueError(f"planar solver: {factors.size} factors, and {len(motions)} motions")
    known = {id(motion): motion for motion in motions}
    places = {key: place for place, key in enumerate(known)}
    which = np.array(
        [0] * factors.size if shared else [places[id(motion)] for motion in motions], int
    )
    wanted, counts = _supports_of(planar), {len(motion.supports_m_s2) for motion in motions}
    given = len(carried.hang) or min(counts, default=wanted)
    if wanted > given:
        raise ValueError(f"planar solver: the scene has {wanted} moving supports, got {given}")
    if len(counts) > 1 and not len(carried.hang):
        raise ValueError(f"planar solver: motions of {sorted(counts)} supports side by side")
    if len(carried.roll) and np.any(planar.carried & (planar.support >= 0)):
        raise ValueError("planar solver: expected supports that turn to carry their own nodes")
    step = float(step_s or STEP_FRACTION * stable_step(planar, carried))
    cases = np.zeros((factors.size, 6))
    cases[:, 0] = factors
    for place, motion in enumerate(known.values()):
        mine = which == place
        cases[mine, 1:] = limits(planar, motion, numerics, factors[mine], step)
    rules = Rules(
        float(numerics["overturn_ratio"] * planar.thickness_m),
        REST_RATIO * planar.thickness_m,
        float(numerics["rest_velocity_m_s"]),
        float(numerics["rest_time_s"]),
        1 + int(cases[:, march.LIMIT - march.FACTOR].max(initial=0.0)) // steps_of(step),
    )
    return march.Driven(carried, list(known.values()), which, cases, rules, step)


def _loop(planar):
    return STACK if isinstance(planar, Stack) else BLOCK


def _beside(loop, count):
    """Whether so many histories march side by side: eight take the time of some of one each."""
    return count > loop.few


def history(planar, motions, numerics, factor=1.0, *, carried=None, step_s=None, sample_s=0.005):
    """One history with its time series, to the end of its motion: a `Brief` is for `peaks` alone.

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
    whole = {**numerics, "brief": None}
    shaken = _set_up(planar, motions, whole, factor, carried, step_s)
    step = shaken.step_s
    every = max(1, round(sample_s / step))
    supports = shaken.bodies.mass_kg.size or len(motions.supports_m_s2)
    count = int(shaken.cases[0, march.LIMIT - march.FACTOR]) // every + 1
    rows = np.zeros((count, COLUMNS + 2 * supports))
    outcome, written, broken = march.one(_loop(planar), planar, shaken, 0, every, rows)
    (status, end), peak = outcome[:2], outcome[2:].max()
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
        rows[:, 14],
        rows[:, 15],
        rows[:, 16],
        rows[:, COLUMNS : COLUMNS + supports],
        rows[:, COLUMNS + supports :],
        math.nan if status == FAILED else peak / planar.thickness_m,
        STATUS[int(status)],
        float(end),
        step,
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
    spans : ndarray, shape (cases, n)
        Largest |d|/b of each second (`SPAN_S`).
    """

    factor: np.ndarray
    d_over_b: np.ndarray
    overturned: np.ndarray
    failed: np.ndarray
    end_s: np.ndarray
    step_s: float
    spans: np.ndarray

    def with_others(self, these, others):
        """`Peaks` in which some histories are others."""
        spans = [self.spans, others.spans]
        width = max(rows.shape[1] for rows in spans)
        spans = [np.pad(rows, ((0, 0), (0, width - rows.shape[1]))) for rows in spans]
        spans[0][these] = spans[1]
        changed = {"spans": spans[0]}
        for name in ("d_over_b", "overturned", "failed", "end_s"):
            changed[name] = getattr(self, name).copy()
            changed[name][these] = getattr(others, name)
        return replace(self, **changed)


def peaks(planar, motions, numerics, factors, *, carried=None, step_s=None):
    """Peak d/b of many histories; parameters as `history`.

    Parameters
    ----------
    motions : Motions, or sequence of Motions
        One for all, or one for each factor.

    Returns
    -------
    Peaks
    """
    shaken = _set_up(planar, motions, numerics, factors, carried, step_s)
    loop, count = _loop(planar), len(shaken.cases)
    outcomes = np.zeros((count, 2 + shaken.rules.spans))
    # those that last as long go together: a vector takes as long as its longest
    turns = np.argsort(shaken.cases[:, march.LIMIT - march.FACTOR], kind="stable")
    for first in range(0, count, AT_ONCE):
        some = turns[first : first + AT_ONCE]
        if _beside(loop, count):
            outcomes[some] = march.many(loop, planar, shaken.some(some))
        else:
            none = np.zeros((0, COLUMNS))
            outcomes[some] = [march.one(loop, planar, shaken, i, 1, none)[0] for i in some]
    status, end, spans = outcomes[:, 0], outcomes[:, 1], outcomes[:, 2:] / planar.thickness_m
    failed = status == FAILED
    ratio = np.where(failed, np.nan, spans.max(axis=1))
    fell, factors = status == OVERTURNED, shaken.cases[:, 0]
    seen = Peaks(factors, ratio, fell, failed, end, shaken.step_s, spans)
    if (brief := numerics.get("brief")) is None:
        return seen
    near = np.flatnonzero(_lingers(seen, brief))
    if not near.size:
        return seen
    theirs = motions if isinstance(motions, Motions) else [motions[k] for k in near]
    whole = {"carried": carried, "step_s": shaken.step_s}
    again = peaks(planar, theirs, {**numerics, "brief": None}, factors[near], **whole)
    return seen.with_others(near, again)


def _lingers(seen, brief):
    """Mask of histories that a `Brief` ended while they still moved."""
    last = np.rint(seen.end_s / seen.step_s).astype(int) // steps_of(seen.step_s)
    last, rows = np.minimum(last, seen.spans.shape[1] - 1), np.arange(len(last))
    late = np.maximum(seen.spans[rows, last], seen.spans[rows, np.maximum(last - 1, 0)])
    peak = seen.spans.max(axis=1)
    moves = (late > brief.still) | ((late > brief.swings) & (late > 0.5 * peak))
    return ~seen.overturned & ~seen.failed & moves
