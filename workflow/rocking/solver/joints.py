"""Contact of one block: the nodes of a joint that stand on one line, group by group.

Penetration, its rate and the slip rate are linear in the place s along the line, so the range of
nodes that touch follows from its ends: open ones are not visited. A group that touches with all
its nodes, none sliding, is summed in closed form (`groups`).

One text for one history and for `vectors.WIDTH` of them: of many, joints that are open in all are
passed over, closed forms are summed where one needs them, and nodes visited where one touches.
"""

from rocking.runtime.compiled import inlined

from .groups import close, in_closed_form, let_go, spread, touched
from .law import bond_breaks, node, released
from .vectors import alone, choose, cos_sin, like, lone, put, put_where, some, take


@inlined
def _line(p, g, pose, supports, j, turning):
    """Where a group is: side of the block, normal, its line from the block's centre, penetration.

    The last is d0 + d1·s. A support's rotation is small, as in the modes that give it.
    """
    y, z, cos, sin = pose
    by, bz = take(supports.y, j), take(supports.z, j)
    ny, nz, ey, ez = p.normal[g, 0], p.normal[g, 1], p.along[g, 0], p.along[g, 1]
    ry, rz = p.origin_m[g, 0], p.origin_m[g, 1]
    if p.carried[g]:
        sign = 1.0
        ry, rz = cos * ry - sin * rz, sin * ry + cos * rz
        ey, ez = cos * ey - sin * ez, sin * ey + cos * ez
        d0 = p.level_m[g] - ny * (y + ry - by) - nz * (z + rz - bz)
    else:
        sign = -1.0
        ny, nz = cos * ny - sin * nz, sin * ny + cos * nz
        ry, rz = ry + by - y, rz + bz - z
        if turning:
            roll = take(supports.turn, j)
            ry, rz = ry - roll * p.arm_m[g, 1], rz + roll * p.arm_m[g, 0]
            ey, ez = ey - roll * ez, ez + roll * ey
        d0 = p.level_m[g] - ny * ry - nz * rz
    return sign, ny, nz, ry, rz, ey, ez, d0, -(ny * ey + nz * ez)


@inlined
def _each(p, touch, g, touches, before, bound, lines, dt, sums):
    """Resultants of the nodes that touch or hold, one by one, added to `sums`.

    Parameters
    ----------
    touches, before : tuple of 2 numbers
        Penetrations along the line, a0 + a1·s: now, less than zero in histories to be left alone,
        and at the last step.
    bound : mask
        Where the group has bonds left.
    lines : tuple of 8 numbers
        Penetration, its rate, rate of slip and slip of this step, each as a0 + a1·s.
    sums : tuple
        Σ force·(1, s) across and along the joint, Σ kn·(1, s, s²) of the nodes whose dashpots act
        across and along it, energy stored and taken [J], bonds that broke.
    """
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    (n0, n1), (t0, t1), (u0, u1, u2), (w0, w1, w2), elastic, spent, broken = sums
    none, ratio = like(0.0, d0), p.shear_ratio[g]
    joint = p.beta_s[g], ratio, p.friction[g]
    low, high = p.first[g], p.first[g + 1]
    tied = some(bound)
    upper = low if tied else high  # from here on up to the end nodes touch somewhere
    while upper > low and some(touches[0] + touches[1] * take(p.place_m, upper - 1) > 0.0):
        upper -= 1
    i = low
    while i < high:
        s, kn = take(p.place_m, i), take(p.kn_n_m, i)
        touching = touches[0] + touches[1] * s > 0.0
        holds = touching & ~touching
        if tied:
            holds = bound & (take(touch.intact, i) > 0.0)
        acts = touching | holds
        if not some(acts):
            i = max(upper, i + 1)
            continue
        depth, rate, speed, step = d0 + d1 * s, q0 + q1 * s, s0 + s1 * s, g0 + g1 * s
        grip = joint  # of a bond: a tie transmits no shear
        if tied and some(holds):
            if p.tie[i]:
                grip = joint[0], 0.0, joint[2]
            strength = take(p.pull_m, i), take(p.hold_m, i)
            breaks = holds & bond_breaks(depth, take(touch.slip, i) + step, strength, grip)
            if some(breaks):
                spent += choose(breaks, kn * released(depth, take(touch.slip, i), grip[1]), 0.0)
                put_where(touch.intact, i, breaks, 0.0)
                put_where(touch.slip, i, breaks, 0.0)
                put_where(touch.bonds, g, breaks, take(touch.bonds, g) - 1.0)
                broken, step = choose(breaks, broken + 1.0, broken), choose(breaks, 0.0, step)
                holds = holds & ~breaks
                acts = touching | holds
            touching = touching & ~holds
        had, was = take(touch.slip, i), before[0] + before[1] * s > 0.0
        normal, shear, share, kept, pressed, drags, stored, taken = node(
            depth, rate, speed, had, step, (touching, holds, was), (joint, grip), dt
        )
        along = choose(drags, kn if ratio > 0.0 else 0.0, none)
        across = choose(pressed, kn, none)
        put(touch.slip, i, choose(acts, kept, had))
        elastic, spent = elastic + kn * stored, spent + kn * taken
        u0, u1, u2 = u0 + across, u1 + across * s, u2 + across * s * s
        w0, w1, w2 = w0 + along, w1 + along * s, w2 + along * s * s
        weight = choose(acts, share * kn, 0.0)
        normal, shear = normal * weight, shear * weight
        n0, n1 = n0 + normal, n1 + normal * s
        t0, t1 = t0 + shear, t1 + shear * s
        i += 1
    return (n0, n1), (t0, t1), (u0, u1, u2), (w0, w1, w2), elastic, spent, broken


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
def contact(p, whole, parts, turning, time, alive, counts, spent):
    """Forces of all nodes on the block and on its supports, and dashpots; see `march`."""
    half, past_s, dt = time
    supports, touch = parts.supports, touched(p, parts.nodes)
    my, mz, mt = take(parts.rate, 0), take(parts.rate, 1), take(parts.rate, 2)
    py, pz = my + half * take(parts.rise, 0), mz + half * take(parts.rise, 1)
    pt = mt + half * take(parts.rise, 2)
    cos, sin = cos_sin(take(parts.place, 2), alive)
    pose = take(parts.place, 0), take(parts.place, 1), cos, sin
    none = like(0.0, py)
    fy = fz = moment = elastic = lost = broken = none
    own = none, none, none, none, none, none
    for g in range(p.level_m.size):
        j = p.support[g] if p.support[g] >= 0 else len(supports.y) - 1
        sign, ny, nz, ry, rz, ey, ez, d0, d1 = _line(p, g, pose, supports, j, turning)
        if not alone(d0):
            d0, d1 = choose(alive, d0, -1.0), choose(alive, d1, 0.0)
        s_low, s_high = p.place_m[p.first[g]], p.place_m[p.first[g + 1] - 1]
        below, above = d0 + d1 * s_low > 0.0, d0 + d1 * s_high > 0.0
        touches, full = below | above, below & above
        bound = alive & (take(touch.bonds, g) > 0.0)  # bonds act wherever they are
        summed = take(touch.summed, g) > 0.0
        before = take(touch.depth0, g), take(touch.depth1, g)
        put(touch.depth0, g, d0)
        put(touch.depth1, g, d1)
        if some(summed & ~full):
            spread(p, touch, g, summed & ~full)
            summed = summed & full
        if counts and some(~full):
            was = lone(before[0]), lone(before[1])
            lost += let_go(p, touch, g, was, (lone(d0), lone(d1)))
        if not some(touches | bound):
            continue
        ty, tz = -nz, ny
        vy = py - pt * rz - take(supports.vy, j)
        vz = pz + pt * ry - take(supports.vz, j)
        uy = past_s * (my - mt * rz) - take(supports.dy, j)
        uz = past_s * (mz + mt * ry) - take(supports.dz, j)
        turn_n, turn_t = nz * ey - ny * ez, tz * ey - ty * ez
        arm_y, arm_z, spin, dturn = p.arm_m[g, 0], p.arm_m[g, 1], none, none
        if turning:
            spin, dturn = take(supports.spin, j), take(supports.dturn, j)
            vy, vz = vy + spin * arm_z, vz - spin * arm_y
            uy, uz = uy + dturn * arm_z, uz - dturn * arm_y
        q0, q1 = -sign * (ny * vy + nz * vz), -sign * pt * turn_n
        s0, s1 = sign * (ty * vy + tz * vz), sign * pt * turn_t
        g0, g1 = sign * (ty * uy + tz * uz), sign * past_s * mt * turn_t
        along_y, along_z = p.along[g, 0], p.along[g, 1]
        if turning:
            turn_t = sign * (tz * along_y - ty * along_z)
            q1 += spin * sign * (nz * along_y - ny * along_z)
            s1, g1 = s1 - spin * turn_t, g1 - dturn * turn_t
        lines = d0, d1, q0, q1, s0, s1, g0, g1
        beta, ratio, friction = p.beta_s[g], p.shear_ratio[g], p.friction[g]
        h0, h1 = d0 + beta * q0, d1 + beta * q1  # force over kn along the line
        least = min(h0 + h1 * s_low, h0 + h1 * s_high)
        if some(summed):
            most = take(touch.most, g) + abs(take(touch.more0, g) + g0)
            most += abs(take(touch.more1, g) + g1) * whole[g, 3]
            most += beta * (abs(s0) + abs(s1) * whole[g, 3])  # the dashpots' part
            slides = summed & (ratio * most > friction * least)
            if some(slides):
                spread(p, touch, g, slides)
                summed = summed & ~slides
        three = none, none, none
        sums = (none, none), (none, none), three, three, none, none, none
        if some(summed):
            sums = in_closed_form(p, touch, g, summed, whole, lines, dt, counts)
        each = (touches | bound) & ~summed
        if some(each):
            here = choose(each, d0, -1.0), choose(each, d1, 0.0)
            if past_s == 0.0:  # what touches at first has not just closed
                before = d0, d1
            sums = _each(p, touch, g, here, before, bound, lines, dt, sums)
            ready = each & (full | bound) & (take(touch.bonds, g) <= 0.0)
            if some(ready):
                close(p, touch, g, ready, 0.5 * friction * least / ratio)
        (n0, n1), (t0, t1), across, along, stored, taken, gone = sums
        elastic, lost, broken = elastic + stored, lost + taken, broken + gone
        gy, gz = sign * (ny * n0 - ty * t0), sign * (nz * n0 - tz * t0)
        fy += gy
        fz += gz
        moment += ry * gz - rz * gy
        far_y, far_z = ny * n1 - ty * t1, nz * n1 - tz * t1
        moment += sign * (ey * far_z - ez * far_y)
        put(supports.fy, j, take(supports.fy, j) - gy)
        put(supports.fz, j, take(supports.fz, j) - gz)
        if turning:
            back = arm_y * gz - arm_z * gy + along_y * (sign * far_z) - along_z * (sign * far_y)
            put(supports.moment, j, take(supports.moment, j) - back)
        own = _added(own, (ry, rz, ey, ez), (ny, nz, ty, tz), (across, along), (beta, ratio))
    put(parts.turn, 0, cos)
    put(parts.turn, 1, sin)
    for m, value in enumerate((py, pz, pt)):
        put(parts.now, m, value)
    for m, value in enumerate((fy, fz, moment)):
        put(parts.force, m, value)
    for m, value in enumerate(own):
        put(parts.own, m, value)
    return elastic, spent + lost, broken
