"""The compiled step loop. Leapfrog: positions and forces at whole steps, velocities between."""

import math

import numpy as np

from rocking.runtime.compiled import compiled

from .bars import act, advance, at_rest
from .inputs import COLUMNS, drive, since_closed, verdict


@compiled
def march(p, bodies, table, factor, rules, motion_s, quiet_m_s2, max_speed_m_s, every, rows):
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
    dt = table.step_s
    groups, count = p.level_m.size, p.place_m.size
    chain = bodies.mass_kg.size
    supports = bodies.hang.shape[0] if chain > 0 else table.place_m.shape[1]
    hang, lift = np.ascontiguousarray(bodies.hang.T), np.ascontiguousarray(bodies.lift.T)
    su, sv, sdu = np.zeros(supports + 1), np.zeros(supports + 1), np.zeros(supports + 1)
    sf, sfz = np.zeros(supports + 1), np.zeros(supports + 1)
    sz, svz, sdz = np.zeros(supports + 1), np.zeros(supports + 1), np.zeros(supports + 1)
    lifted = lift.size > 0
    # of the masses
    cu, cv, cw, ca, cf = (
        np.zeros(chain),
        np.zeros(chain),
        np.zeros(chain),
        np.zeros(chain),
        np.zeros(chain),
    )
    reach = 0  # how far from the diagonal their matrices have entries: modes have none beside it
    for i in range(chain):
        for j in range(chain):
            if bodies.k_n_m[i, j] != 0.0 or bodies.c_n_s_m[i, j] != 0.0:
                reach = max(reach, abs(i - j))
    slip, intact = np.zeros(count), p.bonded.copy()
    # of each group: the nodes that touched at the last step, one range from either end; bonds
    starts, stops, left = p.first[:-1].copy(), p.first[:-1].copy(), np.zeros(groups, np.int64)
    # a group that touches with all its nodes, none sliding, is summed in closed form: the
    # slips are then stored + more[0] + more[1]·s, and `sums` holds Σ kn·slip·(1, s, slip)
    summed, most = np.zeros(groups, np.bool_), np.zeros(groups)
    more, sums, inertia = np.zeros((groups, 2)), np.zeros((groups, 3)), np.zeros((groups, 4))
    for g in range(groups):
        for i in range(p.first[g], p.first[g + 1]):
            left[g] += intact[i]
            s = p.place_m[i]
            inertia[g, 0] += p.kn_n_m[i]
            inertia[g, 1] += p.kn_n_m[i] * s
            inertia[g, 2] += p.kn_n_m[i] * s * s
            inertia[g, 3] = max(inertia[g, 3], abs(s))
    barred = p.bars.tie_k_n_m.size + p.bars.floor_k_n_m.size > 0
    memory, pose, push = at_rest(p.bars), np.zeros((1, 4)), np.zeros((1, 3))
    y, z, turn, vy, vz, spin = p.start  # rates half a step back, from the second step on
    ay = az = at = 0.0
    peak = moving_until = spent = 0.0
    written, broken, k = 0, 0, 0
    ledger = rows.shape[0] > 0
    last = table.ground_m_s2.size - 1
    time = 0.0
    while True:
        half, past = (0.5 * dt, dt) if k > 0 else (0.0, 0.0)
        row = min(k, last)
        ag = factor * table.ground_m_s2[row]
        # velocities at the whole step, from the acceleration of the step before
        py, pz, pt = vy + half * ay, vz + half * az, spin + half * at
        for i in range(chain):
            cw[i], cf[i] = cv[i] + half * ca[i], 0.0
        sf[:] = 0.0
        sfz[:] = 0.0
        if chain > 0:
            su[:] = 0.0
            sv[:] = 0.0
            sdu[:] = 0.0
            for i in range(
                chain
            ):  # the inner loop over supports, so that it runs in parallel lanes
                u, w, du = cu[i], cw[i], past * cv[i]
                for j in range(supports):
                    su[j] += hang[i, j] * u
                    sv[j] += hang[i, j] * w
                    sdu[j] += hang[i, j] * du
            if lifted:
                sz[:] = 0.0
                svz[:] = 0.0
                sdz[:] = 0.0
                for i in range(chain):
                    u, w, du = cu[i], cw[i], past * cv[i]
                    for j in range(supports):
                        sz[j] += lift[i, j] * u
                        svz[j] += lift[i, j] * w
                        sdz[j] += lift[i, j] * du
        else:
            drive(table, factor, k, past, su, sv, sdu)
        cos, sin = math.cos(turn), math.sin(turn)
        fy = fz = moment = elastic = 0.0
        c00 = c01 = c02 = c11 = c12 = c22 = 0.0  # dashpots that act now, ∂(force)/∂(rates)
        for g in range(groups):
            j = p.support[g]  # −1 is the last entry, which stands still
            ny, nz, ey, ez = p.normal[g, 0], p.normal[g, 1], p.along[g, 0], p.along[g, 1]
            ry, rz = p.origin_m[g, 0], p.origin_m[g, 1]
            if p.carried[g]:
                sign = 1.0
                ry, rz = cos * ry - sin * rz, sin * ry + cos * rz
                ey, ez = cos * ey - sin * ez, sin * ey + cos * ez
                d0 = p.level_m[g] - ny * (y + ry - su[j]) - nz * (z + rz - sz[j])
            else:
                sign = -1.0
                ny, nz = cos * ny - sin * nz, sin * ny + cos * nz
                ry, rz = ry + su[j] - y, rz + sz[j] - z
                d0 = p.level_m[g] - ny * ry - nz * rz
            d1 = -(ny * ey + nz * ez)
            low, high = p.first[g], p.first[g + 1]
            was, been = starts[g], stops[g]
            start, stop = was, been
            if summed[g] and (
                d0 + d1 * p.place_m[low] <= 0.0 or d0 + d1 * p.place_m[high - 1] <= 0.0
            ):
                summed[g] = False
                for i in range(low, high):
                    slip[i] += more[g, 0] + more[g, 1] * p.place_m[i]
            while start < stop and d0 + d1 * p.place_m[start] <= 0.0:
                if not intact[start]:
                    spent += 0.5 * p.kn_n_m[start] * p.shear_ratio[g] * slip[start] ** 2
                    slip[start] = 0.0
                start += 1
            while stop > start and d0 + d1 * p.place_m[stop - 1] <= 0.0:
                stop -= 1
                if not intact[stop]:
                    spent += 0.5 * p.kn_n_m[stop] * p.shear_ratio[g] * slip[stop] ** 2
                    slip[stop] = 0.0
            if start == stop:
                if d0 + d1 * p.place_m[low] > 0.0:
                    start = stop = low
                elif d0 + d1 * p.place_m[high - 1] > 0.0:
                    start = stop = high
            while start > low and d0 + d1 * p.place_m[start - 1] > 0.0:
                start -= 1
            while stop < high and d0 + d1 * p.place_m[stop] > 0.0:
                stop += 1
            starts[g], stops[g] = start, stop
            if left[g] > 0:  # bonds act wherever they are
                start, stop = low, high
            elif start == stop:
                continue
            ty, tz = -nz, ny
            q0 = -sign * (ny * (py - pt * rz - sv[j]) + nz * (pz + pt * ry - svz[j]))
            q1 = -sign * pt * (nz * ey - ny * ez)
            s0 = sign * (ty * (py - pt * rz - sv[j]) + tz * (pz + pt * ry - svz[j]))
            s1 = sign * pt * (tz * ey - ty * ez)
            g0 = ty * (past * (vy - spin * rz) - sdu[j])
            g0 = sign * (g0 + tz * (past * (vz + spin * ry) - sdz[j]))
            g1 = sign * past * spin * (tz * ey - ty * ez)
            beta, ratio, friction = p.beta_s[g], p.shear_ratio[g], p.friction[g]
            n0 = n1 = t0 = t1 = 0.0
            u0 = u1 = u2 = w0 = w1 = w2 = 0.0
            h0, h1 = d0 + beta * q0, d1 + beta * q1  # force over kn along the line
            least = min(h0 + h1 * p.place_m[low], h0 + h1 * p.place_m[high - 1])
            if summed[g]:
                a0, a1 = more[g, 0] + g0, more[g, 1] + g1
                most_now = most[g] + abs(a0) + abs(a1) * inertia[g, 3]
                if ratio * most_now > friction * least:
                    summed[g] = False
                    for i in range(low, high):
                        slip[i] += more[g, 0] + more[g, 1] * p.place_m[i]
                else:
                    k0, k1, k2 = inertia[g, 0], inertia[g, 1], inertia[g, 2]
                    gain = g0 * (2.0 * sums[g, 0] + g0 * k0 + 2.0 * g1 * k1)
                    sums[g, 2] += gain + g1 * (2.0 * sums[g, 1] + g1 * k2)
                    sums[g, 0] += g0 * k0 + g1 * k1
                    sums[g, 1] += g0 * k1 + g1 * k2
                    more[g, 0], more[g, 1] = a0, a1
                    n0, n1 = h0 * k0 + h1 * k1, h0 * k1 + h1 * k2
                    t0 = ratio * (sums[g, 0] + beta * (s0 * k0 + s1 * k1))
                    t1 = ratio * (sums[g, 1] + beta * (s0 * k1 + s1 * k2))
                    u0, u1, u2 = k0, k1, k2
                    w0, w1, w2 = k0, k1, k2
                    pressed = d0 * (d0 * k0 + 2.0 * d1 * k1) + d1 * d1 * k2
                    elastic += 0.5 * (pressed + ratio * sums[g, 2])
                    if ledger:
                        drag = q0 * (q0 * k0 + 2.0 * q1 * k1) + q1 * q1 * k2
                        drag += ratio * (s0 * (s0 * k0 + 2.0 * s1 * k1) + s1 * s1 * k2)
                        spent += dt * beta * drag
                    start = stop
            for i in range(start, stop):
                s = p.place_m[i]
                depth = d0 + d1 * s
                kn = p.kn_n_m[i]
                if intact[i]:
                    held, speed = slip[i] + g0 + g1 * s, s0 + s1 * s
                    if p.hold_m[i] == 0.0 and friction == 0.0:
                        held = speed = 0.0  # a tie transmits no shear
                    if -depth >= p.pull_m[i] or ratio * abs(held) > p.hold_m[i] + friction * max(
                        0.0, depth
                    ):
                        spent += 0.5 * kn * (ratio * slip[i] ** 2 + min(depth, 0.0) ** 2)
                        intact[i], slip[i] = False, 0.0
                        left[g] -= 1
                        broken += 1
                    else:
                        rate = q0 + q1 * s
                        slip[i] = held
                        spent += dt * kn * beta * (rate * rate + ratio * speed * speed)
                        normal = kn * (depth + beta * rate)
                        shear = kn * ratio * (held + beta * speed)
                        n0 += normal
                        n1 += normal * s
                        t0 += shear
                        t1 += shear * s
                        elastic += 0.5 * kn * (depth * depth + ratio * held * held)
                        u0 += kn
                        u1 += kn * s
                        u2 += kn * s * s
                        if speed != 0.0:
                            w0 += kn
                            w1 += kn * s
                            w2 += kn * s * s
                        continue
                if depth <= 0.0:
                    continue
                rate, step = q0 + q1 * s, g0 + g1 * s
                share = 1.0
                if (i < was or i >= been) and rate > 0.0 and k > 0:
                    share, part = since_closed(depth, rate, dt)
                    step *= part
                normal = max(depth + beta * rate, 0.0)
                if normal > 0.0:
                    u0 += kn
                    u1 += kn * s
                    u2 += kn * s * s
                limit = friction * normal
                held = ratio * (slip[i] + step)
                if abs(held) > limit:
                    shear = math.copysign(limit, held)
                    spent += kn * limit * abs(held - shear) / ratio
                    slip[i] = shear / ratio
                else:
                    slip[i] += step
                    speed = s0 + s1 * s
                    shear = held + ratio * beta * speed
                    spent += share * dt * kn * ratio * beta * speed * speed
                    w0 += kn
                    w1 += kn * s
                    w2 += kn * s * s
                elastic += 0.5 * kn * (depth * depth + ratio * slip[i] * slip[i])
                spent += share * dt * kn * (normal - depth) * rate
                normal *= share * kn
                shear *= share * kn
                n0 += normal
                n1 += normal * s
                t0 += shear
                t1 += shear * s
            if start == low and stop == high and left[g] == 0 and not summed[g]:
                top = 0.0
                for i in range(low, high):
                    top = max(top, abs(slip[i]))
                if 2.0 * ratio * top < friction * least:
                    summed[g], most[g] = True, top
                    more[g, 0] = more[g, 1] = 0.0
                    sums[g, 0] = sums[g, 1] = sums[g, 2] = 0.0
                    for i in range(low, high):
                        stored = p.kn_n_m[i] * slip[i]
                        sums[g, 0] += stored
                        sums[g, 1] += stored * p.place_m[i]
                        sums[g, 2] += stored * slip[i]
            gy, gz = sign * (ny * n0 - ty * t0), sign * (nz * n0 - tz * t0)
            fy += gy
            fz += gz
            moment += ry * gz - rz * gy
            moment += sign * (ey * (nz * n1 - tz * t1) - ez * (ny * n1 - ty * t1))
            sf[j] -= gy
            sfz[j] -= gz
            # rows (direction, arm × direction) with the arm linear in s
            na, ne = nz * ry - ny * rz, nz * ey - ny * ez
            ta, te = tz * ry - ty * rz, tz * ey - ty * ez
            c00 += beta * (ny * ny * u0 + ratio * ty * ty * w0)
            c01 += beta * (ny * nz * u0 + ratio * ty * tz * w0)
            c11 += beta * (nz * nz * u0 + ratio * tz * tz * w0)
            um, wm = na * u0 + ne * u1, ta * w0 + te * w1
            c02 += beta * (ny * um + ratio * ty * wm)
            c12 += beta * (nz * um + ratio * tz * wm)
            c22 += beta * (na * na * u0 + 2.0 * na * ne * u1 + ne * ne * u2)
            c22 += beta * ratio * (ta * ta * w0 + 2.0 * ta * te * w1 + te * te * w2)
        gravity = p.gravity_m_s2 + abs(factor) * table.vertical_m_s2[row]
        if barred:
            heavier = gravity / p.gravity_m_s2
            pose[0, 0], pose[0, 1], pose[0, 2], pose[0, 3] = y, z, cos, sin
            stored, taken, lost = act(p.bars, memory, pose, half, (su, sv, sf), ag, heavier, push)
            fy, fz, moment = fy + push[0, 0], fz + push[0, 1], moment + push[0, 2]
            elastic, spent, broken = elastic + stored, spent + taken, broken + lost

        d = y + cos * p.monitor_m[0] - sin * p.monitor_m[1] - p.monitor_m[0]
        v = py - pt * (sin * p.monitor_m[0] + cos * p.monitor_m[1])
        if abs(d) > peak:
            peak = abs(d)
        # the dashpots belong to the velocity of this step, v + ½h a, not to its prediction
        fy += half * (c00 * ay + c01 * az + c02 * at) - p.mass_kg * ag
        fz += half * (c01 * ay + c11 * az + c12 * at) - p.mass_kg * gravity
        moment += half * (c02 * ay + c12 * az + c22 * at)
        m0, m1, m2 = p.mass_kg + half * c00, p.mass_kg + half * c11, p.inertia_kg_m2 + half * c22
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
        ay = (fy - o01 * az - o02 * at) * inverse
        shaken = False
        for i in range(supports if chain > 0 else 0):
            if sf[i] != 0.0 or sfz[i] != 0.0:
                for j in range(chain):
                    cf[j] += bodies.hang[i, j] * sf[i]
                if lifted:
                    for j in range(chain):
                        cf[j] += bodies.lift[i, j] * sfz[i]
        for j in range(chain):
            pull = cf[j]
            for i in range(max(0, j - reach), min(chain, j + reach + 1)):
                pull -= bodies.k_n_m[j, i] * cu[i] + bodies.c_n_s_m[j, i] * cw[i]
            ca[j] = pull / bodies.mass_kg[j] - bodies.ground[j] * ag
            shaken = shaken or abs(ca[j] + bodies.ground[j] * ag) > quiet_m_s2
        if k % every == 0 and written < rows.shape[0]:
            rows[written, 0], rows[written, 1], rows[written, 2] = time, d, v
            rows[written, 3], rows[written, 4], rows[written, 5] = y, z, turn
            rows[written, 6], rows[written, 7] = vy + half * ay, vz + half * az
            rows[written, 8] = spin + half * at
            rows[written, 9], rows[written, 10] = elastic, spent
            rows[written, 11], rows[written, 12] = p.mass_kg * (ay + ag), p.mass_kg * (az + gravity)
            rows[written, 13] = p.inertia_kg_m2 * at
            if chain > 0:
                for j in range(chain):
                    rows[written, COLUMNS + j] = cu[j]
                    rows[written, COLUMNS + chain + j] = cw[j]
            else:
                for j in range(supports):
                    rows[written, COLUMNS + j] = su[j]
                    rows[written, COLUMNS + supports + j] = sv[j]
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
            advance(p.bars, memory, ahead, dt)
        for j in range(chain):
            cv[j] += ahead * ca[j]
            cu[j] += dt * cv[j]
        k += 1
        time = k * dt
    return peak, status, time, written, broken
