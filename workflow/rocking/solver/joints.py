"""Nodes of a joint that stand on one line, group by group, whatever blocks they are between.

Penetration, its rate and the slip rate are linear in the place s along the line, so the range of
nodes that touch follows from its ends: open ones are not visited. A group that touches with all
its nodes, none sliding, is summed in closed form (`groups`). `block` and `pieces` say where the
line is, and what its resultants act on.

One text for one history and for `vectors.WIDTH` of them: of many, joints that are open in all are
passed over, closed forms are summed where one needs them, and nodes visited where one touches.
"""

from rocking.runtime.compiled import inlined

from .groups import close, in_closed_form, let_go, spread
from .law import bond_breaks, node, released
from .vectors import choose, like, lone, put, put_where, some, take


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
def added(damping, arms, directions, sums, dashpots):
    """Dashpots of a group added to those of the block, ∂(force)/∂(rates).

    Rows (direction, arm × direction), with the arm linear in s.
    """
    c00, c01, c02, c11, c12, c22 = damping
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
def reached(p, touch, g, alive, depths, counts):
    """Which lanes a group touches in; one that opens loses its closed form.

    Parameters
    ----------
    alive : mask
        Histories that go on.
    depths : tuple of 2 numbers
        Penetration along the line, a0 + a1·s.

    Returns
    -------
    reach : tuple
        Whether it touches somewhere, with all its nodes, has bonds left, is in closed form; and
        penetrations at the last step.
    lost : number
        Energy that nodes which open have lost, of one history [J].
    """
    d0, d1 = depths
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
    lost = like(0.0, d0)
    if counts and some(~full):
        was = lone(before[0]), lone(before[1])
        lost += let_go(p, touch, g, was, (lone(d0), lone(d1)))
    return (touches, full, bound, summed, before), lost


@inlined
def resultants(p, touch, g, whole, reach, lines, time, counts):
    """Resultants of a group: `sums` of `_each`; in closed form where that is allowed.

    Parameters
    ----------
    whole : ndarray
        A row a group, see `groups.untouched`.
    reach, lines, time
        See `reached`, `_each`, `march`.
    """
    _, past_s, dt = time
    touches, full, bound, summed, before = reach
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    none = like(0.0, d0)
    s_low, s_high = p.place_m[p.first[g]], p.place_m[p.first[g + 1] - 1]
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
    return sums
