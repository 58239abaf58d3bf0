"""The loop over the steps of a history, or of many side by side, whatever marches.

    move the supports ─ predict rates ─ forces of nodes, ties and floors ─ accelerations ─ judge
          └──────────────── places and rates half a step on, masses that carry ───────────────┘

Leapfrog: places at whole steps, rates between. What a history remembers stands in the rows of one
array: those named here, then what `Parts` cuts out of it. Of many histories a chunk of `WIDTH` has
`WIDTH` numbers a row and marches as one; histories that ended leave their lanes idle until those
that last fit into fewer chunks. What marches, one block or several, gives three functions:

    contact(p, whole, parts, turning, time, alive, counts, spent)
        Forces and dashpots of the nodes, into `parts`; gives energy stored, energy taken so far,
        and bonds that broke. `turning`: whether supports turn. `time`: half a step, the step since
        the last one, the step; the first two are 0 at the first, and what touches then has not just
        closed. `alive`: histories that go on. `counts`: whether energies are wanted, of one alone.
    accelerate(p, parts, half_s, ag, gravity)
        Accelerations by them.
    monitor(p, parts)
        Place and speed of the watched point.
    energies(p, parts, half, ag, gravity)
        Of one history, after its accelerations: kinetic energy, that of its weight, the power of
        the inertia forces, and what dashpots take that `contact` has not counted.
"""

from typing import Any, NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from . import bars, substructure
from .books import works_of, write
from .inputs import Supports, standing, steps_of, verdict
from .motions import STRIDE, SteppedMotions, columns, drive, samples_of, to_lanes
from .vectors import WIDTH, alone, choose, like, lone, put, put_where, rows_of_lanes, some, take

# When it last moved; factor, end of the motion that matters, quiet, failing speed,
# step at which the history ends and after which its motion has; whether it goes on, outcome, end
MOVED, FACTOR, MOTION, QUIET, FASTEST, LIMIT, LAST, ALIVE, STATUS, END, HISTORY = range(11)
TO_THE_END = 0, np.iinfo(np.int64).max
SCRATCH = 32  # rows a block


class Parts(NamedTuple):
    """What a history, or a chunk of them, remembers, in rows, and room for one step."""

    supports: Supports
    ride: substructure.Ride
    memory: bars.Memory
    place: np.ndarray  # three rows a block: y, z and rotation about x
    rate: np.ndarray  # the same of its rates half a step back
    rise: np.ndarray  # and of its accelerations in the last step
    nodes: np.ndarray  # what the nodes remember
    turn: np.ndarray  # two rows a block: cosine and sine
    now: np.ndarray  # three: rates at the whole step
    force: np.ndarray  # three: forces and moment
    own: np.ndarray  # six: its dashpots by their entries 00, 01, 02, 11, 12, 22
    push: np.ndarray  # three: what ties and floors do
    between: np.ndarray  # nine: dashpots between it and the next
    inverse: np.ndarray  # six: inverse of its matrix, by such entries
    most: np.ndarray  # largest |d| of each span


@inlined
def _shape(p, bodies, samples):
    """Rows of the supports, of what carries them, and of ties and floors."""
    chained = bodies.mass_kg.size > 0
    supports = bodies.hang.shape[0] if chained else samples.place_m.shape[1]
    barred = 2 * p.bars.tie_k_n_m.size + 4 * p.bars.floor_k_n_m.size
    return 12 * (supports + 1), substructure.rows_of(bodies), barred


@inlined
def _parts(p, bodies, samples, rows, scratch, spans):
    """Cut the rows of a history into what they stand for."""
    supports, ride, barred = _shape(p, bodies, samples)
    n = len(scratch) // SCRATCH
    carried = HISTORY + supports
    held = carried + ride
    first = held + barred
    return Parts(
        standing(rows[HISTORY:carried]),
        substructure.riding(bodies, rows[carried:held]),
        bars.remembered(p.bars, rows[held:first]),
        rows[first : first + 3 * n],
        rows[first + 3 * n : first + 6 * n],
        rows[first + 6 * n : first + 9 * n],
        rows[first + 9 * n : len(rows) - spans],
        scratch[: 2 * n],
        scratch[2 * n : 5 * n],
        scratch[5 * n : 8 * n],
        scratch[8 * n : 14 * n],
        scratch[14 * n : 17 * n],
        scratch[17 * n : 26 * n],
        scratch[26 * n :],
        rows[len(rows) - spans :],
    )


@inlined
def advance(what, given, state, scratch, span, base, every, series, weight):
    """March a history, or a chunk, from a step up to another, or until all have ended.

    Parameters
    ----------
    what : tuple of functions
        `contact`, `accelerate`, `monitor`, `energies`, see above.
    given : tuple
        The plane, what stays of its nodes, `Bodies`, `SteppedMotions`, `Rules`.
    state, scratch : ndarray, shape (rows,) or (rows, WIDTH)
        What is remembered, see `Parts`, and room for a step.
    span : tuple of 2 ints
        From which step, and before which.
    base : int
        Step with which the table begins.
    every, series : int, ndarray (n, COLUMNS + 2·supports)
        Of one history every so many steps a row is written while rows last; none: (0, …).
    weight : tuple of 3 floats
        Mass, mass and inertia, by which a row has the force of the contact.

    Returns
    -------
    int, number
        Rows written; bonds and ties that broke.
    """
    contact, accelerate, monitor, energies = what
    p, whole, bodies, table, rules = given
    dt, each = table.step_s, columns(table.samples)
    steps = len(table.rows) // each
    parts = _parts(p, bodies, table.samples, state, scratch, rules.spans)
    supports, ride, memory = parts.supports, parts.ride, parts.memory
    chained, barred = bodies.mass_kg.size > 0, len(memory.snapped) + len(memory.slid_m) > 0
    moved, factor = take(state, MOVED), take(state, FACTOR)
    alive, size = take(state, ALIVE) > 0.0, abs(factor)
    turning = bodies.roll.size > 0
    shaken, broken = like(False, moved), like(0.0, moved)
    spent = elastic = broken
    counts = alone(moved) and series.shape[0] > 0
    written, done = 0, 0.0
    many, here = steps_of(dt), min(span[0] // steps_of(dt), rules.spans - 1)
    most = take(parts.most, here)
    for k in range(span[0], span[1]):
        half, past, ahead = (0.5 * dt, dt, dt) if k > 0 else (0.0, 0.0, 0.5 * dt)
        at = each * min(k - base, steps - 1)
        ag = factor * take(table.rows, at)
        gravity = p.gravity_m_s2 + size * take(table.rows, at + 1)
        if chained or counts:
            for j in range(len(supports.fy)):
                put(supports.fy, j, 0.0)
                if bodies.lift.size > 0:
                    put(supports.fz, j, 0.0)
                    put(supports.moment, j, 0.0)
        if chained:
            substructure.carry(bodies, ride, half, past, supports)
        else:
            drive(table, at, factor, take(state, LAST) < float(k), k, past, supports)
        time = half, past, dt
        elastic, spent, lost = contact(p, whole, parts, turning, time, alive, counts, spent)
        broken += lost
        if barred:
            heavier = gravity / p.gravity_m_s2
            stored, taken, lost = bars.act(
                p.bars, memory, parts.place, parts.turn, half, supports, ag, heavier, parts.push
            )
            elastic, spent, broken = elastic + stored, spent + taken, broken + lost
        d, v = monitor(p, parts)
        if p.foot >= 0:
            d, v = d - take(supports.y, p.foot), v - take(supports.vy, p.foot)
        if k >= many * (here + 1) and here + 1 < rules.spans:
            put(parts.most, here, most)
            here += 1
            most = take(parts.most, here)
        most = choose(alive & (abs(d) > most), abs(d), most)
        accelerate(p, parts, half, ag, gravity)
        if chained:
            shaken = substructure.accelerate(bodies, ride, supports, ag, take(state, QUIET))
        if counts:
            kinetic, raised, power, taken = energies(p, parts, half, ag, gravity)
            works = works_of(bodies, parts, memory, p.bars, lone(ag), half)
            kinetic, raised = kinetic + works[0], raised + works[1]
            power, taken = power + works[2], taken + works[3]
            # a step's work counts half up to now, half from now on
            done, spent = done + half * power, spent + half * taken
            if k % every == 0 and written < series.shape[0]:
                field = ag, gravity, like(0.0, ag)
                energy = lone(elastic), lone(spent) + works[4], kinetic, raised, done
                out = series[written]
                write(out, k * dt, d, v, parts, half, energy, field, weight, chained)
                written += 1
            done, spent = done + 0.5 * dt * power, spent + 0.5 * dt * taken
        ends = take(state, MOTION), take(state, FASTEST), take(state, LIMIT)
        over, status, moved = verdict(rules, *ends, k, dt, d, v, shaken, moved)
        over = over & alive
        if some(over):
            put_where(state, END, over, k * dt)
            put_where(state, STATUS, over, status)
            alive = alive & ~over
            put(state, ALIVE, choose(alive, 1.0, like(0.0, moved)))
            if not some(alive):
                break
        for m in range(len(parts.place)):
            rate = take(parts.rate, m) + ahead * take(parts.rise, m)
            put(parts.rate, m, rate)
            put(parts.place, m, take(parts.place, m) + dt * rate)
        if barred:
            bars.advance(p.bars, memory, ahead, dt)
        substructure.travel(ride, ahead, dt)
    put(parts.most, here, most)
    put(state, MOVED, moved)
    return written, broken


@inlined
def _gathered(memory, case, chunks, outcomes):
    """Take over what ended, see `march_many`; fit what goes on into fewer chunks: how many."""
    left = 0
    for c in range(chunks):
        for lane in range(WIDTH):
            i = case[c, lane]
            if i >= 0 and memory[c, ALIVE, lane] == 0.0:
                outcomes[i, 0], outcomes[i, 1] = memory[c, STATUS, lane], memory[c, END, lane]
                spans = memory.shape[1] - outcomes.shape[1]
                for row in range(2, outcomes.shape[1]):
                    outcomes[i, row] = memory[c, spans + row, lane]
                case[c, lane] = -1
            left += case[c, lane] >= 0
    fewer = (left + WIDTH - 1) // WIDTH
    free = 0  # lanes before this one are taken
    for at in range(fewer * WIDTH, chunks * WIDTH):
        c, lane = at // WIDTH, at % WIDTH
        if case[c, lane] < 0:
            continue
        while case[free // WIDTH, free % WIDTH] >= 0:
            free += 1
        to, there = free // WIDTH, free % WIDTH
        case[to, there] = case[c, lane]
        for row in range(memory.shape[1]):
            memory[to, row, there] = memory[c, row, lane]
    return fewer


@inlined
def march_many(what, given, memory, scratch, case, motion, outcomes):
    """Advance histories side by side until rules have ended them all.

    Parameters
    ----------
    what, given : tuple
        See `advance`.
    memory, scratch : ndarray, shape (chunks, n, WIDTH), (n, WIDTH)
    case : ndarray of int, shape (chunks, WIDTH)
        Which history a lane has; −1: none.
    motion : ndarray of int, shape (histories,)
        Which of the samples drive each.
    outcomes : ndarray, shape (histories, 2 + spans)
        Gets status, end [s], and the largest |d| of each span [m].
    """
    table = given[3]
    several = table.samples.begin.size > 2
    k, chunks = 0, len(case)
    while chunks > 0:
        for c in range(chunks):
            if several:
                to_lanes(table, motion, case[c], k)
            span, base = (k, k + STRIDE), k if several else 0
            # of lanes no series is written
            advance(what, given, memory[c], scratch, span, base, 1, outcomes, (0.0, 0.0, 0.0))
        k += STRIDE
        chunks = _gathered(memory, case, chunks, outcomes)


class Loop(NamedTuple):
    """What marches a kind of plane.

    Attributes
    ----------
    one, many : compiled functions
        `advance` to the end of one history, and `march_many`, with its contact.
    start : callable
        From the plane: what its nodes remember at the start, in rows; what stays of them; weight.
    few : int
        Histories that are faster one after the other than in a vector.
    """

    one: Any
    many: Any
    start: Any
    few: int


def _begun(p, state, bodies, samples, spans):
    """Rows of a history before its first step, and room for a step; the case is still missing."""
    start = p.start.reshape(-1, 6)
    head = np.zeros(HISTORY + sum(_shape(p, bodies, samples)))
    head[ALIVE] = 1.0
    places, rates, rises = start[:, :3].ravel(), start[:, 3:].ravel(), np.zeros(3 * len(start))
    rows = np.concatenate((head, places, rates, rises, state, np.zeros(spans)))
    return rows, SCRATCH * len(start)


class Driven(NamedTuple):
    """Histories of a plane under motions.

    Attributes
    ----------
    bodies : Bodies
        What carries the supports.
    motions : list of Motions
    which : ndarray of int, shape (n,)
        The motion of each history.
    cases : ndarray, shape (n, 6)
        Of each its rows from FACTOR to LAST: factor on all horizontal motions, its size on the
        vertical one, which has no direction; then what `runs.limits` gives for it.
    rules : Rules
    step_s : float
    """

    bodies: substructure.Bodies
    motions: list
    which: np.ndarray
    cases: np.ndarray
    rules: Any
    step_s: float

    def some(self, these):
        """Return some of the histories, and the motions that these have."""
        places, which = np.unique(self.which[these], return_inverse=True)
        motions = [self.motions[place] for place in places]
        return self._replace(motions=motions, which=which, cases=self.cases[these])

    def table(self):
        """`SteppedMotions` of their motions, and of the supports' unless masses carry these."""
        driven = not self.bodies.mass_kg.size
        if len(self.motions) == 1:
            return self.motions[0].table(self.step_s, driven)
        samples = samples_of(self.motions, driven)
        count, motions = STRIDE * columns(samples), len(self.motions)
        rows, near, begin = rows_of_lanes(count), np.zeros((motions, count)), np.full(motions, -1)
        return SteppedMotions(samples, self.step_s, rows, rows.reshape(-1), near, begin)


def one(loop, p, shaken, i, every, series):
    """History i of a plane, as `Series` or `Peaks` are made of; `every`, `series`: `advance`.

    Returns
    -------
    ndarray of 2 + spans, int, float
        Status, end [s], largest |d| of each span [m]; rows written; bonds and ties that broke.
    """
    (state, whole, weight), table = loop.start(p), shaken.some([i]).table()
    rows, room = _begun(p, state, shaken.bodies, table.samples, shaken.rules.spans)
    rows[FACTOR : LAST + 1] = shaken.cases[i]
    given = p, whole, shaken.bodies, table, shaken.rules
    written, broken = loop.one(given, rows, np.zeros(room), every, series, weight)
    outcome = np.concatenate((rows[[STATUS, END]], rows[rows.size - shaken.rules.spans :]))
    return outcome, written, broken


def many(loop, p, shaken):
    """What `one` finds of all histories, shape (n, 2 + spans); they march side by side."""
    (state, whole, _), table = loop.start(p), shaken.table()
    rows, room = _begun(p, state, shaken.bodies, table.samples, shaken.rules.spans)
    cases = shaken.cases
    count, chunks = len(cases), -(-len(cases) // WIDTH)
    memory = rows_of_lanes(chunks * len(rows)).reshape(chunks, len(rows), WIDTH)
    memory[:] = rows[:, None]
    places = np.arange(chunks * WIDTH).reshape(chunks, WIDTH)
    memory[:, ALIVE] = places < count
    filled = np.concatenate((cases, np.zeros((chunks * WIDTH - count, cases.shape[1]))))
    filled = filled.reshape(chunks, WIDTH, -1)
    memory[:, FACTOR : LAST + 1] = filled.transpose(0, 2, 1)
    outcomes = np.zeros((count, 2 + shaken.rules.spans))
    case = np.where(places < count, places, -1)
    given = p, whole, shaken.bodies, table, shaken.rules
    loop.many(given, memory, rows_of_lanes(room), case, shaken.which, outcomes)
    return outcomes
