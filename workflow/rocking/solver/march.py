"""The loop over the steps of a history, or of many of one motion side by side, whatever marches.

    move the supports ─ predict rates ─ forces of nodes, ties and floors ─ accelerations ─ judge
          └──────────────── places and rates half a step on, masses that carry ───────────────┘

Leapfrog: places at whole steps, rates between. What a history remembers stands in the rows of one
array: those named here, then what `Parts` cuts out of it. Of many histories a chunk of `WIDTH` has
`WIDTH` numbers a row and marches as one; histories that ended leave their lanes idle until those
that last fit into fewer chunks. What marches, one block or several, gives three functions:

    contact(p, whole, parts, …)                forces and dashpots of the nodes, into `parts`
    accelerate(p, parts, half_s, ag, gravity)  accelerations by them
    monitor(p, parts)                          place and speed of the watched point
"""

from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled, inlined, taking_functions

from . import bars, carriers
from .inputs import COLUMNS, Supports, drive, standing, verdict
from .vectors import WIDTH, alone, choose, like, lone, put, put_where, rows_of_lanes, some, take

STRIDE = 256  # steps between two looks at which histories have ended
# Largest |d|, when it last moved, factor, end of the motion, quiet, failing speed; whether it goes
# on, its outcome and end
PEAK, MOVED, FACTOR, MOTION, QUIET, FASTEST, ALIVE, STATUS, END, HISTORY = range(10)
SCRATCH = 35  # rows a block


class Parts(NamedTuple):
    """What a history, or a chunk of them, remembers, in rows, and room for one step.

    Attributes
    ----------
    supports : Supports
    ride : carriers.Ride
    memory : bars.Memory
    place, rate, rise : three rows a block
        y, z and rotation about x; rates half a step back; accelerations of the last step.
    nodes : rows
        What the nodes remember.
    turn, now, force, own, push, between, inverse : 2, 3, 3, 6, 3, 9 and 9 rows a block
        Cosine and sine; rates at the whole step; forces and moment; dashpots by their entries 00,
        01, 02, 11, 12, 22; what ties and floors do; dashpots between a block and the next, and the
        inverse of its matrix.
    """

    supports: Supports
    ride: carriers.Ride
    memory: bars.Memory
    place: np.ndarray
    rate: np.ndarray
    rise: np.ndarray
    nodes: np.ndarray
    turn: np.ndarray
    now: np.ndarray
    force: np.ndarray
    own: np.ndarray
    push: np.ndarray
    between: np.ndarray
    inverse: np.ndarray


@inlined
def _shape(p, bodies, table):
    """Rows of the supports, of what carries them, and of ties and floors."""
    chained = bodies.mass_kg.size > 0
    supports = bodies.hang.shape[0] if chained else table.place_m.shape[1]
    barred = 2 * p.bars.tie_k_n_m.size + 4 * p.bars.floor_k_n_m.size
    return 12 * (supports + 1), 5 * bodies.mass_kg.size, barred


@inlined
def _parts(p, bodies, table, rows, scratch):
    """Cut the rows of a history into what they stand for."""
    supports, ride, barred = _shape(p, bodies, table)
    n = len(scratch) // SCRATCH
    carried = HISTORY + supports
    held = carried + ride
    first = held + barred
    return Parts(
        standing(rows[HISTORY:carried]),
        carriers.riding(rows[carried:held]),
        bars.remembered(p.bars, rows[held:first]),
        rows[first : first + 3 * n],
        rows[first + 3 * n : first + 6 * n],
        rows[first + 6 * n : first + 9 * n],
        rows[first + 9 * n :],
        scratch[: 2 * n],
        scratch[2 * n : 5 * n],
        scratch[5 * n : 8 * n],
        scratch[8 * n : 14 * n],
        scratch[14 * n : 17 * n],
        scratch[17 * n : 26 * n],
        scratch[26 * n :],
    )


@inlined
def _write(out, time, d, v, parts, half, energy, field, weight, chained):
    """One row of a history's series, see `runs.Series`."""
    out[0], out[1], out[2], out[9], out[10] = time, lone(d), lone(v), energy[0], energy[1]
    for m in range(3):
        rise = take(parts.rise, m)
        out[3 + m], out[6 + m] = lone(take(parts.place, m)), lone(take(parts.rate, m) + half * rise)
        out[11 + m] = lone(weight[m] * (rise + field[m]))
    place, speed, count = parts.supports.y, parts.supports.vy, len(parts.supports.y) - 1
    if chained:
        place, speed, count = parts.ride.u, parts.ride.w, len(parts.ride.u)
    for j in range(count):
        out[COLUMNS + j], out[COLUMNS + count + j] = lone(take(place, j)), lone(take(speed, j))


@inlined
def _advance(contact, accelerate, monitor, given, state, scratch, span, every, samples, weight):
    """March a history, or a chunk, from a step up to another, or until all have ended.

    Returns how many samples were written, and how many bonds and ties broke.
    """
    p, whole, bodies, table, rules = given
    dt, last = table.step_s, table.ground_m_s2.size - 1
    parts = _parts(p, bodies, table, state, scratch)
    supports, ride, memory = parts.supports, parts.ride, parts.memory
    chained, barred = bodies.mass_kg.size > 0, len(memory.snapped) + len(memory.slid_m) > 0
    peak, moved, factor = take(state, PEAK), take(state, MOVED), take(state, FACTOR)
    alive, size = take(state, ALIVE) > 0.0, abs(factor)
    turning = bodies.roll.size > 0
    shaken, broken = like(False, peak), like(0.0, peak)
    spent = elastic = broken
    counts = alone(peak) and samples.shape[0] > 0
    written = 0
    for k in range(span[0], span[1]):
        half, past, ahead = (0.5 * dt, dt, dt) if k > 0 else (0.0, 0.0, 0.5 * dt)
        row = min(k, last)
        ag = factor * table.ground_m_s2[row]
        gravity = p.gravity_m_s2 + size * table.vertical_m_s2[row]
        if chained:
            for j in range(len(supports.fy)):
                put(supports.fy, j, 0.0)
                put(supports.fz, j, 0.0)
                put(supports.moment, j, 0.0)
            carriers.carry(bodies, ride, half, past, supports)
        else:
            drive(table, factor, k, past, supports.y, supports.vy, supports.dy)
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
        peak = choose(alive & (abs(d) > peak), abs(d), peak)
        accelerate(p, parts, half, ag, gravity)
        if chained:
            shaken = carriers.accelerate(bodies, ride, supports, ag, take(state, QUIET))
        if counts and k % every == 0 and written < samples.shape[0]:
            field, energy = (ag, gravity, like(0.0, ag)), (lone(elastic), lone(spent))
            out = samples[written]
            _write(out, k * dt, d, v, parts, half, energy, field, weight, chained)
            written += 1
        over, status, moved = verdict(
            rules, take(state, MOTION), take(state, FASTEST), k, dt, d, v, shaken, moved
        )
        over = over & alive
        if some(over):
            put_where(state, END, over, k * dt)
            put_where(state, STATUS, over, status)
            alive = alive & ~over
            put(state, ALIVE, choose(alive, 1.0, like(0.0, peak)))
            if not some(alive):
                break
        for m in range(len(parts.place)):
            rate = take(parts.rate, m) + ahead * take(parts.rise, m)
            put(parts.rate, m, rate)
            put(parts.place, m, take(parts.place, m) + dt * rate)
        if barred:
            bars.advance(p.bars, memory, ahead, dt)
        carriers.travel(ride, ahead, dt)
    put(state, PEAK, peak)
    put(state, MOVED, moved)
    return written, broken


@inlined
def _started(p, bodies, table, state):
    """Rows before those of the blocks, and all rows of a history."""
    supports, ride, barred = _shape(p, bodies, table)
    first = HISTORY + supports + ride + barred
    return first, first + p.start.size // 2 * 3 + state.size


@compiled
def _begin(rows, p, first, state, case):
    """Fill the rows of a history before its first step."""
    rows[FACTOR : FASTEST + 1], rows[ALIVE] = case, 1.0
    start, blocks = p.start.reshape((-1, 6)), p.start.size // 6
    for block in range(blocks):
        for m in range(3):
            rows[first + 3 * block + m] = start[block, m]
            rows[first + 3 * (blocks + block) + m] = start[block, 3 + m]
    rows[first + 9 * blocks :] = state


@taking_functions
def march_one(contact, accelerate, monitor, given):
    """Advance one history until a rule ends it.

    Parameters
    ----------
    contact, accelerate, monitor : compiled functions
        See above.
    given : tuple of what follows
    p : NamedTuple
        The plane.
    whole : ndarray
        What stays of its nodes.
    state : ndarray, shape (rows,)
        What they remember at the start.
    bodies : Bodies
    table : Table
    rules : Rules
    case : ndarray, shape (4,)
        Factor on all horizontal motions, its size on the vertical one, which has no direction; end
        of the motion that matters; absolute acceleration below which a mass of the chain is quiet;
        relative speed from which the run has failed.
    every, samples : int, ndarray (n, COLUMNS + 2·supports)
        Every so many steps a row is written while rows last; none: (0, …).
    weight : tuple of 3 floats
        Mass, mass and inertia, by which a row has the force of the contact.

    Returns
    -------
    ndarray of 3, int, float
        Peak [m], status, end [s]; rows written; bonds and ties that broke.
    """
    p, whole, state, bodies, table, rules, case, every, samples, weight = given
    first, size = _started(p, bodies, table, state)
    rows, scratch = np.zeros(size), np.zeros(SCRATCH * (p.start.size // 6))
    _begin(rows, p, first, state, case)
    span = 0, np.iinfo(np.int64).max
    parts = p, whole, bodies, table, rules
    written, broken = _advance(
        contact, accelerate, monitor, parts, rows, scratch, span, every, samples, weight
    )
    return np.array([rows[PEAK], rows[STATUS], rows[END]]), written, broken


@compiled
def _gathered(memory, case, chunks, found):
    """Take over what ended, peak, status and end; fit what goes on into fewer chunks: how many."""
    left = 0
    for c in range(chunks):
        for lane in range(WIDTH):
            i = case[c, lane]
            if i >= 0 and memory[c, ALIVE, lane] == 0.0:
                found[i, 0], found[i, 1] = memory[c, PEAK, lane], memory[c, STATUS, lane]
                found[i, 2] = memory[c, END, lane]
                case[c, lane] = -1
            left += case[c, lane] >= 0
    fewer = (left + WIDTH - 1) // WIDTH
    free = 0  # lanes before this one are taken
    for at in range(fewer * WIDTH, chunks * WIDTH):
        c, lane = divmod(at, WIDTH)
        if case[c, lane] < 0:
            continue
        while case[free // WIDTH, free % WIDTH] >= 0:
            free += 1
        to, there = divmod(free, WIDTH)
        case[to, there] = case[c, lane]
        memory[to, :, there] = memory[c, :, lane]
    return fewer


@taking_functions
def march_many(contact, accelerate, monitor, given):
    """Advance the histories of all cases, shape (n, 4), as `march_one`, side by side.

    Returns
    -------
    ndarray, shape (n, 3)
        Peak [m], status, end [s].
    """
    p, whole, state, bodies, table, rules, cases = given
    count, parts = len(cases), (p, whole, bodies, table, rules)
    first, size = _started(p, bodies, table, state)
    chunks = (count + WIDTH - 1) // WIDTH
    memory = rows_of_lanes(chunks * size).reshape(chunks, size, WIDTH)
    scratch = rows_of_lanes(SCRATCH * (p.start.size // 6))
    lanes, found = np.full((chunks, WIDTH), -1), np.zeros((count, 3))
    own = np.zeros(size)
    _begin(own, p, first, state, np.zeros(4))
    own[ALIVE] = 0.0
    for c in range(chunks):
        for lane in range(WIDTH):
            memory[c, :, lane] = own
    for i in range(count):
        c, lane = divmod(i, WIDTH)
        lanes[c, lane] = i
        memory[c, ALIVE, lane] = 1.0
        memory[c, FACTOR : FASTEST + 1, lane] = cases[i]
    k, none = 0, np.zeros((0, COLUMNS))
    while chunks > 0:
        for c in range(chunks):
            span, rows = (k, k + STRIDE), memory[c]
            _advance(
                contact, accelerate, monitor, parts, rows, scratch, span, 1, none, (0.0, 0.0, 0.0)
            )
        k += STRIDE
        chunks = _gathered(memory, lanes, chunks, found)
    return found
