"""One block in a step: its contact, line by line, and its acceleration; see `march`."""

from rocking.runtime.compiled import inlined, looped

from .groups import touched, untouched
from .joints import block_contact
from .march import TO_THE_END, Loop, advance, march_many
from .vectors import cos_sin, put, take


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


@inlined
def contact(p, whole, parts, turning, time, alive, counts, spent):
    """Forces of the nodes on the block and on its supports; energy stored, taken, bonds lost."""
    half, past, dt = time
    vy, vz, spin = take(parts.rate, 0), take(parts.rate, 1), take(parts.rate, 2)
    rates = (
        vy + half * take(parts.rise, 0),
        vz + half * take(parts.rise, 1),
        spin + half * take(parts.rise, 2),
    )
    cos, sin = cos_sin(take(parts.place, 2), alive)
    put(parts.turn, 0, cos)
    put(parts.turn, 1, sin)
    pose = take(parts.place, 0), take(parts.place, 1), cos, sin
    touch = touched(p, parts.nodes)
    (fy, fz, moment), own, elastic, taken, lost = block_contact(
        p,
        whole,
        parts.supports,
        turning,
        touch,
        pose,
        rates,
        (vy, vz, spin),
        past,
        dt,
        alive,
        counts,
    )
    for m, value in enumerate(rates):
        put(parts.now, m, value)
    for m, value in enumerate((fy, fz, moment)):
        put(parts.force, m, value)
    for m, value in enumerate(own):
        put(parts.own, m, value)
    return elastic, spent + taken, lost


@inlined
def monitor(p, parts):
    """Place and speed of the monitored point."""
    (my, mz), cos, sin = p.monitor_m, take(parts.turn, 0), take(parts.turn, 1)
    d = take(parts.place, 0) + cos * my - sin * mz - my
    return d, take(parts.now, 0) - take(parts.now, 2) * (sin * my + cos * mz)


@inlined
def accelerate(p, parts, half, ag, gravity):
    """Accelerations of the block, its dashpots at the velocity of this step."""
    own = parts.own
    own = (
        *(take(own, 0), take(own, 1), take(own, 2)),
        *(take(own, 3), take(own, 4), take(own, 5)),
    )
    before = take(parts.rise, 0), take(parts.rise, 1), take(parts.rise, 2)
    force = (
        take(parts.force, 0) + take(parts.push, 0),
        take(parts.force, 1) + take(parts.push, 1),
        take(parts.force, 2) + take(parts.push, 2),
    )
    ay, az, at = _solve(p.mass_kg, p.inertia_kg_m2, half, own, before, force, (ag, gravity))
    put(parts.rise, 0, ay)
    put(parts.rise, 1, az)
    put(parts.rise, 2, at)


@looped
def march_block(given, rows, scratch, every, samples, weight):
    """One history of a `Planar`, see `march.advance`."""
    what = contact, accelerate, monitor
    return advance(what, given, rows, scratch, TO_THE_END, every, samples, weight)


@looped
def march_blocks(given, memory, scratch, case, found):
    """Histories of a `Planar` side by side, see `march.march_many`."""
    march_many((contact, accelerate, monitor), given, memory, scratch, case, found)


def _start(p):
    return *untouched(p), (p.mass_kg, p.mass_kg, p.inertia_kg_m2)


BLOCK = Loop(march_block, march_blocks, _start)
