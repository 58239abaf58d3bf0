"""Storeys of a chain that yield, and the chain by itself, of histories side by side.

The laws and the scheme are those of `yade_scripts.model.storeys`, which says them.
"""

import math

import numpy as np

from rocking.runtime.compiled import inlined, looped
from yade_scripts.model.storeys import (
    DRIFT,
    INWARD,
    LEAST_SPAN,
    MEMORY,
    ORIGIN_ORIENTED,
    OUT,
    PEAK_ORIENTED,
    PLACE,
    SHEAR,
    WORK,
    at_rest,
)

from .vectors import WIDTH, choose, like, put, rows_of_lanes, some, take


@inlined
def _left(storeys, drift):
    """Share of the strength that is left once a drift has been reached."""
    gone = min(max((drift - storeys.loss_m) * storeys.fade_1_m, 0.0), 1.0)
    return 1.0 - (1.0 - storeys.residual) * gone


@inlined
def _backbone(storeys, k, u_y, drift):
    """Shear of the first loading to a drift ≥ 0."""
    beyond = k * (u_y + storeys.hardening * (drift - u_y))
    return choose(drift < u_y, k * drift, beyond) * _left(storeys, drift)


@inlined
def _peak_oriented(storeys, k, u_y, rows, at, u, ends):
    """Shear of the peak-oriented law; `ends`: largest drift so far outward and inward."""
    was, before = take(rows, at + SHEAR), take(rows, at + DRIFT)
    out, inward = max(ends[0], u_y), max(ends[1], u_y)
    unload = like(k, u)
    if storeys.unloading > 0.0:
        held = choose(was >= 0.0, out, inward)
        unload = k * math.pow(u_y / held, storeys.unloading)
    trial = was + unload * (u - before)
    still = ~(abs(was) > 0.0)
    crosses = (trial * was < 0.0) | (still & (abs(trial) > 0.0))
    place = choose(crosses, before - was / unload, take(rows, at + PLACE))
    put(rows, at + PLACE, place)
    side = choose(trial >= 0.0, like(1.0, u), like(-1.0, u))
    along, start = side * u, side * place
    peak = choose(trial >= 0.0, out, inward)
    share = min(max((along - start) / max(peak - start, LEAST_SPAN * u_y), 0.0), 1.0)
    line = _backbone(storeys, k, u_y, peak) * share
    most = choose(along >= peak, _backbone(storeys, k, u_y, max(along, 0.0)), line)
    return side * min(abs(trial), most)


@inlined
def _remember(rows, at, u, shear, ends):
    """Put down drift, shear, largest drifts and work of a storey that has moved to a drift."""
    work = 0.5 * (take(rows, at + SHEAR) + shear) * (u - take(rows, at + DRIFT))
    put(rows, at + WORK, take(rows, at + WORK) + work)
    put(rows, at + OUT, ends[0])
    put(rows, at + INWARD, ends[1])
    put(rows, at + DRIFT, u)
    put(rows, at + SHEAR, shear)


@inlined
def less(storeys, i, rows, at, u):
    """What yielding takes off the elastic force of storey i at a drift, r = k u − V [N].

    `rows` from `at` on: `MEMORY` that the storey remembers.
    """
    k, u_y, soft = storeys.k_n_m[i], storeys.yield_m[i], 1.0 - storeys.hardening
    ends = max(take(rows, at + OUT), u), max(take(rows, at + INWARD), -u)
    worst = max(ends[0], ends[1])
    if not some(worst > u_y):  # every history is elastic yet: nothing is taken, nothing spent
        _remember(rows, at, u, k * u, ends)
        return like(0.0, u)
    if storeys.law == PEAK_ORIENTED:
        taken_n = k * u - _peak_oriented(storeys, k, u_y, rows, at, u, ends)
    elif storeys.law == ORIGIN_ORIENTED:
        peak = max(choose(u >= 0.0, ends[0], ends[1]), u_y)
        taken_n = k * u * (1.0 - _left(storeys, peak) * (1.0 - soft * (1.0 - u_y / peak)))
    else:
        plastic = u - min(max(u - take(rows, at + PLACE), -u_y), u_y)
        put(rows, at + PLACE, plastic)
        beyond = math.copysign(max(abs(u) - u_y, 0.0), u)
        left = _left(storeys, worst)
        slid = storeys.share * plastic + (1.0 - storeys.share) * beyond
        taken_n = (1.0 - left) * k * u + left * soft * k * slid
    taken_n = choose(worst <= u_y, like(0.0, u), taken_n)
    _remember(rows, at, u, k * u - taken_n, ends)
    return taken_n


@looped
def _march(chain, ground, factors, state, push, rows):
    """March `WIDTH` histories of a chain through a ground motion.

    Parameters
    ----------
    chain : SteppedChain
    ground : ndarray, shape (nt,)
    factors : ndarray, shape (1, WIDTH)
    state : ndarray, shape (2 n + MEMORY n, WIDTH)
        Place and speed of each mode, then what the storeys remember.
    push : ndarray, shape (3 n, WIDTH)
        Room.
    rows : ndarray, shape (nt n, WIDTH)
        Gets the floors' absolute accelerations; without rows nothing does.
    """
    n, factor = chain.square_1_s2.size, take(factors, 0)
    for k in range(ground.size):
        for i in range(n):
            u = like(0.0, factor)
            for j in range(n):
                u += chain.drift[i, j] * take(state, 2 * j)
            put(push, 2 * n + i, less(chain.storeys, i, state, 2 * n + MEMORY * i, u))
        for j in range(n):
            force = like(0.0, factor)
            for i in range(n):
                force += chain.drift[i, j] * take(push, 2 * n + i)
            put(push, n + j, take(push, j) if k > 0 else force)  # of the step before
            put(push, j, force)
        for i in range(n if rows.shape[0] > 0 else 0):
            rise = like(0.0, factor)
            for j in range(n):
                modal = chain.damping_1_s[j] * take(state, 2 * j + 1)
                modal += chain.square_1_s2[j] * take(state, 2 * j) - take(push, j)
                rise += chain.shape[i, j] * modal
            put(rows, k * n + i, -rise)
        if k + 1 == ground.size:
            return
        now, after = factor * ground[k], factor * ground[k + 1]
        for j in range(n):
            place, speed, force = take(state, 2 * j), take(state, 2 * j + 1), take(push, j)
            flow, load, mass = chain.flow[j], chain.load[j], chain.inertia[j]
            old, new = mass * now + force, mass * after + 2.0 * force - take(push, n + j)
            moved = flow[0] * place + flow[1] * speed + load[0] * old + load[2] * new
            put(state, 2 * j, moved)
            moved = flow[2] * place + flow[3] * speed + load[1] * old + load[3] * new
            put(state, 2 * j + 1, moved)


def march(chain, ground_m_s2, factors, start=None, floors=True):
    """Floors of a chain, and what it ends in, as `yade_scripts.model.storeys.march`, compiled."""
    wanted = bool(floors)
    factors, n = np.asarray(factors, float), chain.square_1_s2.size
    ground = np.ascontiguousarray(ground_m_s2, float)
    floors = np.zeros((factors.size, n, ground.size)) if wanted else None
    start = at_rest(chain) if start is None else start
    states = np.zeros((factors.size, start.size))
    room, rows = rows_of_lanes(3 * n), rows_of_lanes(wanted * ground.size * n)
    for first in range(0, factors.size, WIDTH):
        part = factors[first : first + WIDTH]
        lanes, state = rows_of_lanes(1), rows_of_lanes(start.size)
        state[:] = start[:, None]
        lanes[0, : part.size] = part
        _march(chain, ground, lanes, state, room, rows)
        batch = slice(first, first + part.size)
        if floors is not None:
            accelerations = rows.reshape(ground.size, n, WIDTH)[:, :, : part.size]
            floors[batch] = accelerations.transpose(2, 1, 0)
        states[batch] = state.T[: part.size]
    return floors, states
