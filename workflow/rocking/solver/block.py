"""One block in a step: its acceleration and its loops; `joints` has its contact, see `march`."""

from rocking.runtime.compiled import inlined, looped

from .groups import untouched
from .joints import contact
from .march import TO_THE_END, Loop, advance, march_many
from .vectors import put, take


@inlined
def monitor(p, parts):
    """Place and speed of the monitored point."""
    (my, mz), cos, sin = p.monitor_m, take(parts.turn, 0), take(parts.turn, 1)
    d = take(parts.place, 0) + cos * my - sin * mz - my
    return d, take(parts.now, 0) - take(parts.now, 2) * (sin * my + cos * mz)


@inlined
def accelerate(p, parts, half, ag, gravity):
    """Accelerations of the block with its dashpots at the velocity of this step.

    (M + ½h C) a = f − M·(field, 0) + ½h C a⁻, since `force` has them at the velocity that the
    last acceleration a⁻ predicts; C by its entries 00, 01, 02, 11, 12, 22.
    """
    own, rise, force, push, mass = parts.own, parts.rise, parts.force, parts.push, p.mass_kg
    c00, c01, c02 = take(own, 0), take(own, 1), take(own, 2)
    c11, c12, c22 = take(own, 3), take(own, 4), take(own, 5)
    ay, az, at = take(rise, 0), take(rise, 1), take(rise, 2)
    fy, fz = take(force, 0) + take(push, 0), take(force, 1) + take(push, 1)
    moment = take(force, 2) + take(push, 2)
    fy += half * (c00 * ay + c01 * az + c02 * at) - mass * ag
    fz += half * (c01 * ay + c11 * az + c12 * at) - mass * gravity
    moment += half * (c02 * ay + c12 * az + c22 * at)
    m0, m1, m2 = mass + half * c00, mass + half * c11, p.inertia_kg_m2 + half * c22
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
    put(rise, 0, (fy - o01 * az - o02 * at) * inverse)
    put(rise, 1, az)
    put(rise, 2, at)


@looped
def march_block(given, rows, scratch, every, series, weight):
    """One history of a `Planar`, see `march.advance`."""
    what = contact, accelerate, monitor
    return advance(what, given, rows, scratch, TO_THE_END, 0, every, series, weight)


@looped
def march_blocks(given, memory, scratch, case, motion, found):
    """Histories of a `Planar` side by side, see `march.march_many`."""
    march_many((contact, accelerate, monitor), given, memory, scratch, case, motion, found)


def _start(p):
    return *untouched(p), (p.mass_kg, p.mass_kg, p.inertia_kg_m2)


BLOCK = Loop(march_block, march_blocks, _start, 2)
