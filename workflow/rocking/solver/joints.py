"""Contact of one block: the nodes of a joint that stand on one line, group by group.

Penetration, its rate and the slip rate are linear in the place s along the line, so the range of
nodes that touch follows from its ends: open ones are not visited. A group that touches with all
its nodes, none sliding, is summed in closed form.
"""

from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled, inlined

from .law import bond_breaks, bonded, dry, released


class Touch(NamedTuple):
    """What the nodes of a block remember.

    Attributes
    ----------
    slip, intact : ndarray, shape (nodes,)
        Slip since a node closed [m]; whether its bond holds.
    start, stop, bonds : ndarray of int, shape (groups,)
        Nodes that touched at the last step, and bonds that are left.
    summed : ndarray of bool, shape (groups,)
        Whether the group is in closed form: its slips are the stored ones + more[0] + more[1]·s.
    most : ndarray, shape (groups,)
        Largest stored slip of a summed group.
    more, sums : ndarray, shape (groups, 2), (groups, 3)
        Σ kn·slip·(1, s, slip) of a summed group.
    inertia : ndarray, shape (groups, 4)
        Σ kn·(1, s, s²) of all nodes of a group, and its largest |s|.
    """

    slip: np.ndarray
    intact: np.ndarray
    start: np.ndarray
    stop: np.ndarray
    bonds: np.ndarray
    summed: np.ndarray
    most: np.ndarray
    more: np.ndarray
    sums: np.ndarray
    inertia: np.ndarray


@compiled
def untouched(p):
    """Memory of nodes that have not met their planes yet."""
    groups = p.level_m.size
    bonds, inertia = np.zeros(groups, np.int64), np.zeros((groups, 4))
    for g in range(groups):
        for i in range(p.first[g], p.first[g + 1]):
            s = p.place_m[i]
            bonds[g] += p.bonded[i]
            inertia[g, 0] += p.kn_n_m[i]
            inertia[g, 1] += p.kn_n_m[i] * s
            inertia[g, 2] += p.kn_n_m[i] * s * s
            inertia[g, 3] = max(inertia[g, 3], abs(s))
    return Touch(
        np.zeros(p.place_m.size),
        p.bonded.copy(),
        p.first[:-1].copy(),
        p.first[:-1].copy(),
        bonds,
        np.zeros(groups, np.bool_),
        np.zeros(groups),
        np.zeros((groups, 2)),
        np.zeros((groups, 3)),
        inertia,
    )


@inlined
def _line(p, g, pose, place, height, roll):
    """Where a group is: side of the block, normal, its line from the block's centre, penetration.

    The last is d0 + d1·s. A support's rotation `roll` is small, as in the modes that give it.
    """
    y, z, cos, sin = pose
    ny, nz, ey, ez = p.normal[g, 0], p.normal[g, 1], p.along[g, 0], p.along[g, 1]
    ry, rz = p.origin_m[g, 0], p.origin_m[g, 1]
    if p.carried[g]:
        sign = 1.0
        ry, rz = cos * ry - sin * rz, sin * ry + cos * rz
        ey, ez = cos * ey - sin * ez, sin * ey + cos * ez
        d0 = p.level_m[g] - ny * (y + ry - place) - nz * (z + rz - height)
    else:
        sign = -1.0
        ny, nz = cos * ny - sin * nz, sin * ny + cos * nz
        ry, rz = ry + place - y - roll * p.arm_m[g, 1], rz + height - z + roll * p.arm_m[g, 0]
        ey, ez = ey - roll * ez, ez + roll * ey
        d0 = p.level_m[g] - ny * ry - nz * rz
    return sign, ny, nz, ry, rz, ey, ez, d0, -(ny * ey + nz * ez)


@inlined
def _reach(p, touch, g, d0, d1):
    """Range of the nodes that touch now; what those that opened have lost [J]."""
    low, high = p.first[g], p.first[g + 1]
    start, stop, ratio, spent = touch.start[g], touch.stop[g], p.shear_ratio[g], 0.0
    while start < stop and d0 + d1 * p.place_m[start] <= 0.0:
        if not touch.intact[start]:
            spent += 0.5 * p.kn_n_m[start] * ratio * touch.slip[start] ** 2
            touch.slip[start] = 0.0
        start += 1
    while stop > start and d0 + d1 * p.place_m[stop - 1] <= 0.0:
        stop -= 1
        if not touch.intact[stop]:
            spent += 0.5 * p.kn_n_m[stop] * ratio * touch.slip[stop] ** 2
            touch.slip[stop] = 0.0
    if start == stop:
        if d0 + d1 * p.place_m[low] > 0.0:
            start = stop = low
        elif d0 + d1 * p.place_m[high - 1] > 0.0:
            start = stop = high
    while start > low and d0 + d1 * p.place_m[start - 1] > 0.0:
        start -= 1
    while stop < high and d0 + d1 * p.place_m[stop] > 0.0:
        stop += 1
    return start, stop, spent


@inlined
def _spread(p, touch, g):
    """Give the nodes of a summed group their slips back."""
    touch.summed[g] = False
    for i in range(p.first[g], p.first[g + 1]):
        touch.slip[i] += touch.more[g, 0] + touch.more[g, 1] * p.place_m[i]


@inlined
def _sum(p, touch, g, most):
    """Bring a group into closed form if all its slips are less than `most`."""
    low, high, top = p.first[g], p.first[g + 1], 0.0
    for i in range(low, high):
        top = max(top, abs(touch.slip[i]))
    if not top < most:
        return
    touch.summed[g], touch.most[g] = True, top
    touch.more[g, 0] = touch.more[g, 1] = 0.0
    touch.sums[g, 0] = touch.sums[g, 1] = touch.sums[g, 2] = 0.0
    for i in range(low, high):
        stored = p.kn_n_m[i] * touch.slip[i]
        touch.sums[g, 0] += stored
        touch.sums[g, 1] += stored * p.place_m[i]
        touch.sums[g, 2] += stored * touch.slip[i]


@inlined
def _whole(p, touch, g, lines, dt, all_losses):
    """Resultants of a summed group, as `_each` has them; `lines` are those of `_each`."""
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    beta, ratio = p.beta_s[g], p.shear_ratio[g]
    k0, k1, k2 = touch.inertia[g, 0], touch.inertia[g, 1], touch.inertia[g, 2]
    gain = g0 * (2.0 * touch.sums[g, 0] + g0 * k0 + 2.0 * g1 * k1)
    touch.sums[g, 2] += gain + g1 * (2.0 * touch.sums[g, 1] + g1 * k2)
    touch.sums[g, 0] += g0 * k0 + g1 * k1
    touch.sums[g, 1] += g0 * k1 + g1 * k2
    touch.more[g, 0] += g0
    touch.more[g, 1] += g1
    h0, h1 = d0 + beta * q0, d1 + beta * q1
    normal = h0 * k0 + h1 * k1, h0 * k1 + h1 * k2
    shear = (
        ratio * (touch.sums[g, 0] + beta * (s0 * k0 + s1 * k1)),
        ratio * (touch.sums[g, 1] + beta * (s0 * k1 + s1 * k2)),
    )
    stored = d0 * (d0 * k0 + 2.0 * d1 * k1) + d1 * d1 * k2
    taken = 0.0
    if all_losses:
        drag = q0 * (q0 * k0 + 2.0 * q1 * k1) + q1 * q1 * k2
        drag += ratio * (s0 * (s0 * k0 + 2.0 * s1 * k1) + s1 * s1 * k2)
        taken = dt * beta * drag
    energy = 0.5 * (stored + ratio * touch.sums[g, 2]), taken
    return normal, shear, (k0, k1, k2), (k0, k1, k2), energy, 0


@inlined
def _each(p, touch, g, nodes, before, lines, dt):
    """Resultants of a group's nodes, one by one.

    Parameters
    ----------
    nodes, before : tuple of 2 int
        Those to visit, and the range that touched at the last step.
    lines : tuple of 8 floats
        Penetration, its rate, rate of slip and slip of this step, each as a0 + a1·s.

    Returns
    -------
    normal, shear : tuple of 2 floats
        Σ force·(1, s).
    across, along : tuple of 3 floats
        Σ kn·(1, s, s²) of the nodes whose dashpots act across and along the joint.
    energy : tuple of 2 floats
        Stored and taken [J].
    broken : int
    """
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    beta, friction = p.beta_s[g], p.friction[g]
    n0 = n1 = t0 = t1 = 0.0
    u0 = u1 = u2 = w0 = w1 = w2 = 0.0
    elastic = spent = 0.0
    broken = 0
    for i in range(nodes[0], nodes[1]):
        s = p.place_m[i]
        kn, depth, rate = p.kn_n_m[i], d0 + d1 * s, q0 + q1 * s
        speed, step = s0 + s1 * s, g0 + g1 * s
        slip, holds = touch.slip[i], touch.intact[i]
        ratio = 0.0 if holds and p.tie[i] else p.shear_ratio[g]
        joint, strength = (beta, ratio, friction), (p.pull_m[i], p.hold_m[i])
        if holds and bond_breaks(depth, slip + step, strength, joint):
            spent += kn * released(depth, slip, ratio)
            holds, slip, step, ratio = False, 0.0, 0.0, p.shear_ratio[g]
            joint = beta, ratio, friction
            touch.intact[i], touch.slip[i] = False, 0.0
            touch.bonds[g] -= 1
            broken += 1
        if holds:
            found = bonded(depth, rate, speed, slip + step, joint, dt)
        elif depth > 0.0:
            fresh = i < before[0] or i >= before[1]
            found = dry(depth, rate, speed, slip, step, fresh, joint, dt)
        else:
            continue
        normal, shear, share, slip, pressed, sticks, stored, taken = found
        touch.slip[i] = slip
        elastic += kn * stored
        spent += kn * taken
        if pressed:
            u0 += kn
            u1 += kn * s
            u2 += kn * s * s
        if sticks and ratio > 0.0:
            w0 += kn
            w1 += kn * s
            w2 += kn * s * s
        weight = share * kn
        normal *= weight
        shear *= weight
        n0 += normal
        n1 += normal * s
        t0 += shear
        t1 += shear * s
    return (n0, n1), (t0, t1), (u0, u1, u2), (w0, w1, w2), (elastic, spent), broken


@inlined
def _added(own, arms, directions, sums, dashpots):
    """Dashpots of a group added to those of the block, ∂(force)/∂(rates).

    Rows (direction, arm × direction), with the arm linear in s.
    """
    c00, c01, c02, c11, c12, c22 = own
    ry, rz, ey, ez = arms
    ny, nz, ty, tz = directions
    (u0, u1, u2), (w0, w1, w2) = sums
    beta, ratio = dashpots
    na, ne = nz * ry - ny * rz, nz * ey - ny * ez
    ta, te = tz * ry - ty * rz, tz * ey - ty * ez
    um, wm = na * u0 + ne * u1, ta * w0 + te * w1
    c22 += beta * (na * na * u0 + 2.0 * na * ne * u1 + ne * ne * u2)
    return (
        c00 + beta * (ny * ny * u0 + ratio * ty * ty * w0),
        c01 + beta * (ny * nz * u0 + ratio * ty * tz * w0),
        c02 + beta * (ny * um + ratio * ty * wm),
        c11 + beta * (nz * nz * u0 + ratio * tz * tz * w0),
        c12 + beta * (nz * um + ratio * tz * wm),
        c22 + beta * ratio * (ta * ta * w0 + 2.0 * ta * te * w1 + te * te * w2),
    )


@inlined
def block_contact(p, touch, supports, pose, rates, last, past_s, dt, all_losses):
    """Forces of all nodes on the block and on its supports.

    Parameters
    ----------
    p : Planar
    touch : Touch
        Brought up to date.
    supports : Supports
        Their motion; gets the forces on them.
    pose : tuple
        y, z, cosine and sine of the rotation.
    rates, last : tuple of 3 floats
        Velocities predicted for now, and those half a step back.
    past_s, dt : float
        Since the last step, zero at the first: what touches then has not just closed.
    all_losses : bool
        Whether all losses are wanted.

    Returns
    -------
    force, own, energy : tuple
        Along y, z, moment about x; dashpots that act; energy stored and taken.
    broken : int
    """
    (py, pz, pt), (my, mz, mt) = rates, last
    fy = fz = moment = elastic = spent = 0.0
    own = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    broken, turning = 0, supports.turn.size > 0
    for g in range(p.level_m.size):
        j = p.support[g]  # −1 is the last entry, which stands still
        place, roll = (supports.y[j], supports.z[j]), supports.turn[j] if turning else 0.0
        sign, ny, nz, ry, rz, ey, ez, d0, d1 = _line(p, g, pose, *place, roll)
        low, high = p.first[g], p.first[g + 1]
        ends = d0 + d1 * p.place_m[low], d0 + d1 * p.place_m[high - 1]
        if touch.summed[g] and (ends[0] <= 0.0 or ends[1] <= 0.0):
            _spread(p, touch, g)
        before = touch.start[g], touch.stop[g]
        start, stop, lost = _reach(p, touch, g, d0, d1)
        touch.start[g], touch.stop[g] = start, stop
        spent += lost
        if touch.bonds[g] > 0:  # bonds act wherever they are
            start, stop = low, high
        elif start == stop:
            continue
        ty, tz = -nz, ny
        vy, vz = py - pt * rz - supports.vy[j], pz + pt * ry - supports.vz[j]
        uy = past_s * (my - mt * rz) - supports.dy[j]
        uz = past_s * (mz + mt * ry) - supports.dz[j]
        if turning:
            arm_y, arm_z = p.arm_m[g, 0], p.arm_m[g, 1]
            vy, vz = vy + supports.spin[j] * arm_z, vz - supports.spin[j] * arm_y
            uy, uz = uy + supports.dturn[j] * arm_z, uz - supports.dturn[j] * arm_y
        turn_n, turn_t = nz * ey - ny * ez, tz * ey - ty * ez
        q0, q1 = -sign * (ny * vy + nz * vz), -sign * pt * turn_n
        s0, s1 = sign * (ty * vy + tz * vz), sign * pt * turn_t
        g0, g1 = sign * (ty * uy + tz * uz), sign * past_s * mt * turn_t
        if turning:
            along_y, along_z = p.along[g, 0], p.along[g, 1]
            turn_t = sign * (tz * along_y - ty * along_z)
            q1 += supports.spin[j] * sign * (nz * along_y - ny * along_z)
            s1, g1 = s1 - supports.spin[j] * turn_t, g1 - supports.dturn[j] * turn_t
        lines = d0, d1, q0, q1, s0, s1, g0, g1
        beta, ratio, friction = p.beta_s[g], p.shear_ratio[g], p.friction[g]
        h0, h1 = d0 + beta * q0, d1 + beta * q1  # force over kn along the line
        least = min(h0 + h1 * p.place_m[low], h0 + h1 * p.place_m[high - 1])
        if touch.summed[g]:
            most = touch.most[g] + abs(touch.more[g, 0] + g0)
            most += abs(touch.more[g, 1] + g1) * touch.inertia[g, 3]
            if ratio * most > friction * least:
                _spread(p, touch, g)
        if touch.summed[g]:
            found = _whole(p, touch, g, lines, dt, all_losses)
        else:
            if past_s == 0.0:
                before = low, high
            found = _each(p, touch, g, (start, stop), before, lines, dt)
            if start == low and stop == high and touch.bonds[g] == 0:
                _sum(p, touch, g, 0.5 * friction * least / ratio)
        (n0, n1), (t0, t1), across, along, (stored, taken), lost_bonds = found
        elastic, spent, broken = elastic + stored, spent + taken, broken + lost_bonds
        gy, gz = sign * (ny * n0 - ty * t0), sign * (nz * n0 - tz * t0)
        fy += gy
        fz += gz
        moment += ry * gz - rz * gy
        moment += sign * (ey * (nz * n1 - tz * t1) - ez * (ny * n1 - ty * t1))
        supports.fy[j] -= gy
        supports.fz[j] -= gz
        if turning:
            far = sign * (nz * n1 - tz * t1), sign * (ny * n1 - ty * t1)
            supports.moment[j] -= arm_y * gz - arm_z * gy + along_y * far[0] - along_z * far[1]
        directions = ny, nz, ty, tz
        own = _added(own, (ry, rz, ey, ez), directions, (across, along), (beta, ratio))
    return (fy, fz, moment), own, (elastic, spent), broken
