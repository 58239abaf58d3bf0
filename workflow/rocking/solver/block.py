"""One block in a step: its contact, group by group (`joints`), its acceleration; see `march`."""

from rocking.runtime.compiled import inlined, looped

from .groups import touched, untouched
from .joints import added, reached, resultants
from .march import TO_THE_END, Loop, advance, march_many
from .sines import cos_sin
from .vectors import align_stack, alone, choose, like, lone, put, some, take


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
def contact(p, whole, parts, turning, time, alive, counts, spent):
    """Forces of all nodes on the block and on its supports, and dashpots; see `march`."""
    half, past_s, _ = time
    supports, touch = parts.supports, touched(p, parts.nodes)
    my, mz, mt = take(parts.rate, 0), take(parts.rate, 1), take(parts.rate, 2)
    py, pz = my + half * take(parts.rise, 0), mz + half * take(parts.rise, 1)
    pt = mt + half * take(parts.rise, 2)
    cos, sin = cos_sin(take(parts.place, 2), alive)
    pose = take(parts.place, 0), take(parts.place, 1), cos, sin
    none = like(0.0, py)
    fy = fz = moment = elastic = lost = broken = none
    damping = none, none, none, none, none, none
    for g in range(p.level_m.size):
        j = p.support[g] if p.support[g] >= 0 else len(supports.y) - 1
        sign, ny, nz, ry, rz, ey, ez, d0, d1 = _line(p, g, pose, supports, j, turning)
        if not alone(d0):
            d0, d1 = choose(alive, d0, -1.0), choose(alive, d1, 0.0)
        reach, gone = reached(p, touch, g, alive, (d0, d1), counts)
        lost += gone
        if not some(reach[0] | reach[2]):
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
        sums = resultants(p, touch, g, whole, reach, lines, time, counts)
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
        dashpots = p.beta_s[g], p.shear_ratio[g]
        damping = added(damping, (ry, rz, ey, ez), (ny, nz, ty, tz), (across, along), dashpots)
    put(parts.turn, 0, cos)
    put(parts.turn, 1, sin)
    for m, value in enumerate((py, pz, pt)):
        put(parts.now, m, value)
    for m, value in enumerate((fy, fz, moment)):
        put(parts.force, m, value)
    for m, value in enumerate(damping):
        put(parts.own, m, value)
    return elastic, spent + lost, broken


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
    damping, rise, force, push, mass = parts.own, parts.rise, parts.force, parts.push, p.mass_kg
    c00, c01, c02 = take(damping, 0), take(damping, 1), take(damping, 2)
    c11, c12, c22 = take(damping, 3), take(damping, 4), take(damping, 5)
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


@inlined
def energies(p, parts, half, ag, gravity):
    """Of one history, see `march`; dashpots have been counted with their forces."""
    y = lone(take(parts.rate, 0) + half * take(parts.rise, 0))
    z = lone(take(parts.rate, 1) + half * take(parts.rise, 1))
    turn = lone(take(parts.rate, 2) + half * take(parts.rise, 2))
    kinetic = 0.5 * p.mass_kg * (y * y + z * z) + 0.5 * p.inertia_kg_m2 * turn * turn
    raised = p.mass_kg * p.gravity_m_s2 * lone(take(parts.place, 1))
    return kinetic, raised, -p.mass_kg * (lone(ag) * y + (lone(gravity) - p.gravity_m_s2) * z), 0.0


@looped
def march_block(given, rows, scratch, every, series, weight):
    """One history of a `Planar`, see `march.advance`."""
    what = contact, accelerate, monitor, energies
    return advance(what, given, rows, scratch, TO_THE_END, 0, every, series, weight)


@looped
def march_blocks(given, memory, scratch, case, motion, outcomes):
    """Histories of a `Planar` side by side, see `march.march_many`."""
    align_stack()
    march_many(
        (contact, accelerate, monitor, energies), given, memory, scratch, case, motion, outcomes
    )


def _start(p):
    return *untouched(p), (p.mass_kg, p.mass_kg, p.inertia_kg_m2)


BLOCK = Loop(march_block, march_blocks, _start, 2)
