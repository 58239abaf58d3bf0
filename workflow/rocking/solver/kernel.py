"""The compiled step loop of one block. Leapfrog: positions at whole steps, velocities between."""

import math

import numpy as np

from rocking.runtime.compiled import compiled, inlined

from . import bars, carriers
from .inputs import COLUMNS, drive, standing, verdict
from .joints import block_contact, untouched


@inlined
def _solve(mass, inertia, half, own, acceleration, force, field):
    """Accelerations of the block with its dashpots at the velocity of this step.

    (M + ½h C) a = f − M·(field, 0) + ½h C a⁻, since `force` has them at the velocity that the
    last acceleration a⁻ predicts; C by its entries 00, 01, 02, 11, 12, 22.
    """
    c00, c01, c02, c11, c12, c22 = own
    ay, az, at = acceleration
    fy, fz, moment = force
    fy += half * (c00 * ay + c01 * az + c02 * at) - mass * field[0]
    fz += half * (c01 * ay + c11 * az + c12 * at) - mass * field[1]
    moment += half * (c02 * ay + c12 * az + c22 * at)
    m0, m1, m2 = mass + half * c00, mass + half * c11, inertia + half * c22
    o01, o02, o12 = half * c01, half * c02, half * c12
    inverse = 1.0 / m0
    l10, l20 = o01 * inverse, o02 * inverse
    m1 -= l10 * o01
    r12 = o12 - l10 * o02
    upper = 1.0 / m1
    l21 = r12 * upper
    m2 -= l20 * o02 + l21 * r12
    fz -= l10 * fy
    moment -= l20 * fy + l21 * fz
    at = moment / m2
    az = (fz - r12 * at) * upper
    return (fy - o01 * az - o02 * at) * inverse, az, at


@compiled
def march_block(p, bodies, table, factor, rules, motion_s, quiet_m_s2, max_speed_m_s, every, rows):
    """Advance one history until a rule ends it.

    Parameters
    ----------
    p : Planar
    bodies : Bodies
    table : Table
    factor : float
        On all horizontal motions; its size on the vertical one, which has no direction.
    rules : Rules
    motion_s, quiet_m_s2, max_speed_m_s : float
        End of the motion that matters; absolute acceleration below which a mass of the
        chain is quiet; relative speed from which the run has failed.
    every, rows : int, ndarray (n, COLUMNS + 2·supports)
        Every so many steps a row is written while rows last; none: (0, …).

    Returns
    -------
    peak_m, status, time_s, written, broken : float, int, float, int, int
    """
    dt, chained = table.step_s, bodies.mass_kg.size > 0
    count = bodies.hang.shape[0] if chained else table.place_m.shape[1]
    supports = standing(count, bodies.roll.size > 0)
    ride, touch = carriers.at_rest(bodies), untouched(p)
    barred = p.bars.tie_k_n_m.size + p.bars.floor_k_n_m.size > 0
    memory, where, push = bars.at_rest(p.bars), np.zeros((1, 4)), np.zeros((1, 3))
    held = (supports.y, supports.vy, supports.fy)
    y, z, turn, vy, vz, spin = p.start  # rates half a step back, from the second step on
    ay = az = at = 0.0
    peak = moving_until = spent = time = 0.0
    written, broken, k = 0, 0, 0
    last = table.ground_m_s2.size - 1
    while True:
        half, past = (0.5 * dt, dt) if k > 0 else (0.0, 0.0)
        row = min(k, last)
        ag = factor * table.ground_m_s2[row]
        gravity = p.gravity_m_s2 + abs(factor) * table.vertical_m_s2[row]
        supports.fy[:] = 0.0
        supports.fz[:] = 0.0
        supports.moment[:] = 0.0
        if chained:
            carriers.carry(ride, half, past, supports)
        else:
            drive(table, factor, k, past, supports.y, supports.vy, supports.dy)
        # velocities at the whole step, from the acceleration of the step before
        rates = vy + half * ay, vz + half * az, spin + half * at
        cos, sin = math.cos(turn), math.sin(turn)
        (fy, fz, moment), own, (elastic, taken), lost = block_contact(
            p,
            touch,
            supports,
            (y, z, cos, sin),
            rates,
            (vy, vz, spin),
            past,
            dt,
            rows.shape[0] > 0,
        )
        spent, broken = spent + taken, broken + lost
        if barred:
            where[0, 0], where[0, 1], where[0, 2], where[0, 3] = y, z, cos, sin
            heavier = gravity / p.gravity_m_s2
            stored, taken, lost = bars.act(p.bars, memory, where, half, held, ag, heavier, push)
            fy, fz, moment = fy + push[0, 0], fz + push[0, 1], moment + push[0, 2]
            elastic, spent, broken = elastic + stored, spent + taken, broken + lost
        d = y + cos * p.monitor_m[0] - sin * p.monitor_m[1] - p.monitor_m[0]
        v = rates[0] - rates[2] * (sin * p.monitor_m[0] + cos * p.monitor_m[1])
        if abs(d) > peak:
            peak = abs(d)
        force, before, field = (fy, fz, moment), (ay, az, at), (ag, gravity)
        ay, az, at = _solve(p.mass_kg, p.inertia_kg_m2, half, own, before, force, field)
        shaken = chained and carriers.accelerate(bodies, ride, supports, ag, quiet_m_s2)
        if k % every == 0 and written < rows.shape[0]:
            out = rows[written]
            out[0], out[1], out[2], out[3], out[4], out[5] = time, d, v, y, z, turn
            out[6], out[7], out[8] = vy + half * ay, vz + half * az, spin + half * at
            out[9], out[10] = elastic, spent
            out[11], out[12] = p.mass_kg * (ay + ag), p.mass_kg * (az + gravity)
            out[13] = p.inertia_kg_m2 * at
            place, speed = (ride.u, ride.w) if chained else (supports.y[:-1], supports.vy[:-1])
            out[COLUMNS : COLUMNS + place.size] = place
            out[COLUMNS + place.size : COLUMNS + 2 * place.size] = speed
            written += 1
        over, status, moving_until = verdict(
            rules, motion_s, max_speed_m_s, k, dt, d, v, shaken, moving_until
        )
        if over:
            break
        ahead = dt if k > 0 else 0.5 * dt
        vy, vz, spin = vy + ahead * ay, vz + ahead * az, spin + ahead * at
        y, z, turn = y + dt * vy, z + dt * vz, turn + dt * spin
        if barred:
            bars.advance(p.bars, memory, ahead, dt)
        carriers.travel(ride, ahead, dt)
        k += 1
        time = k * dt
    return peak, status, time, written, broken
