"""Histories of one motion side by side: the loop over their steps, whatever marches.

A chunk of `WIDTH` histories marches as one. Its memory has rows of `WIDTH` numbers: those named
here, of every support its place, velocity and way since the last step, and the state of what
marches. Histories that ended leave their lanes idle until those that last fit into fewer chunks.
"""

import math

import numpy as np

from rocking.runtime.compiled import compiled, inlined, taking_functions

from .inputs import FAILED, OK, OVERTURNED
from .vectors import WIDTH, choose, put, put_where, rows_of_lanes, some, take, wide

STRIDE = 256  # steps between two looks at which histories have ended
# Largest |d|, when it last moved, factor, end of the motion, failing speed; whether it goes on, its
# outcome and end
PEAK, MOVED, FACTOR, MOTION, FASTEST, ALIVE, STATUS, END, SUPPORTS = range(9)


@compiled
def _begun(state, first, factors, motion_s, max_speed_m_s):
    """Memory of histories that begin, and which one each lane has (−1: none)."""
    chunks = (factors.size + WIDTH - 1) // WIDTH
    rows = first + state.size
    memory = rows_of_lanes(chunks * rows).reshape(chunks, rows, WIDTH)
    case = np.full((chunks, WIDTH), -1)
    for c in range(chunks):
        for row in range(state.size):
            memory[c, first + row] = state[row]
    for i in range(factors.size):
        c, lane = divmod(i, WIDTH)
        case[c, lane] = i
        memory[c, FACTOR, lane], memory[c, ALIVE, lane] = factors[i], 1.0
        memory[c, MOTION, lane], memory[c, FASTEST, lane] = motion_s[i], max_speed_m_s[i]
    return memory, case


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


@inlined
def _drive(table, factor, k, past_s, supports):
    """Move the supports to step k, as `inputs.drive`."""
    last = table.ground_m_s2.size - 1
    row = min(k, last)
    for j in range(table.place_m.shape[1]):
        speed, old = factor * table.speed_m_s[row, j], take(supports, 3 * j)
        place = factor * table.place_m[row, j]
        if k > last:
            place = old + past_s * speed
        put(supports, 3 * j, place)
        put(supports, 3 * j + 1, speed)
        put(supports, 3 * j + 2, place - old if k > 0 else 0.0 * place)


@inlined
def _judge(rules, chunk, k, dt, d, v, moved, alive):
    """Lanes that go on after step k, and when each last moved; as `inputs.verdict`.

    Outcome and end of those that do not go on are noted.
    """
    now = wide(k * dt)
    sound = (abs(v) <= take(chunk, FASTEST)) & (abs(d) < math.inf)
    fell = sound & (abs(d) >= rules.overturn_m)
    moves = (abs(v) > rules.rest_velocity_m_s) | (abs(d) > rules.rest_m)
    moved = choose(moves, now, moved)
    rests = ~moves & (now > take(chunk, MOTION)) & (now - moved > rules.rest_time_s)
    over = alive & (~sound | fell | rests)
    if k >= math.ceil(rules.limit_s / dt):
        over = alive
    if some(over):
        put_where(chunk, END, over, now)
        status = choose(sound, choose(fell, wide(OVERTURNED), OK * 1.0), FAILED * 1.0)
        put_where(chunk, STATUS, over, status)
        alive = alive & ~over
        put(chunk, ALIVE, choose(alive, wide(1.0), 0.0))
    return alive, moved


@inlined
def _advance(step, p, room, table, rules, chunk, first, begin):
    """March a chunk over `STRIDE` steps from `begin`, or until all its histories have ended."""
    dt, last = table.step_s, table.ground_m_s2.size - 1
    supports, state, goes_on = chunk[SUPPORTS:first], chunk[first:], chunk[ALIVE]
    peak, moved = take(chunk, PEAK), take(chunk, MOVED)
    factor, alive = take(chunk, FACTOR), take(chunk, ALIVE) > 0.0
    size = abs(factor)
    for k in range(begin, begin + STRIDE):
        half, past, ahead = (0.5 * dt, dt, dt) if k > 0 else (0.0, 0.0, 0.5 * dt)
        row = min(k, last)
        ag = factor * table.ground_m_s2[row]
        gravity = p.gravity_m_s2 + size * table.vertical_m_s2[row]
        _drive(table, factor, k, past, supports)
        time = half, past, ahead, dt
        d, v = step(p, room, supports, state, alive, goes_on, (ag, gravity), time)
        peak = choose(alive & (abs(d) > peak), abs(d), peak)
        alive, moved = _judge(rules, chunk, k, dt, d, v, moved, alive)
        if not some(alive):
            break
    put(chunk, PEAK, peak)
    put(chunk, MOVED, moved)


@taking_functions
def march(step, p, room, state, table, factors, rules, motion_s, max_speed_m_s):
    """Advance the histories of all factors until a rule ends each.

    Parameters
    ----------
    step : compiled function
        (p, room, supports, state, alive, goes_on, field, time): brings the state to the next
        step, and returns place and speed of the watched point at this one. `alive` and the row
        `goes_on` say which lanes still march; `field` is the acceleration of the ground, and
        gravity with the vertical one; `time` the half step by which rates lag, the time since
        the last step, that by which rates move on, and a step.
    p : NamedTuple
        The plane.
    room : tuple of ndarrays
        What all chunks share.
    state : ndarray, shape (rows,)
        At the start.
    table, rules
        As `kernel.march_block`.
    factors, motion_s, max_speed_m_s : ndarray, shape (cases,)

    Returns
    -------
    ndarray, shape (cases, 3)
        Peak [m], status, end [s].
    """
    first = SUPPORTS + 3 * (table.place_m.shape[1] + 1)
    memory, case = _begun(state, first, factors, motion_s, max_speed_m_s)
    found = np.zeros((factors.size, 3))
    k, chunks = 0, len(memory)
    while chunks > 0:
        for c in range(chunks):
            _advance(step, p, room, table, rules, memory[c], first, k)
        k += STRIDE
        chunks = _gathered(memory, case, chunks, found)
    return found
