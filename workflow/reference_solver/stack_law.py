"""Equations of motion of several rigid blocks in their plane, see `stack`.

Of a line of nodes that turns with block a before a plane that turns with block b, penetration, its
rate and the rate of slip are linear in the place along the line. A node then has the law of
`contact`: N = max(0, kn (δ + β δ̇)) while δ > 0; along the joint a spring that slides at μN, and
beside it a dashpot, both together at most μN where the law is bounded.

A state holds y, z and rotation about x of every block (outward is negative, as the scene has it),
their rates, three works (of the inertia forces, of all joints on all blocks, of driven supports on
the joints), the slip of every node, and what ties and floors have yielded.
"""

import functools
import math
from typing import NamedTuple

import numpy as np
from rocking.runtime.compiled import inlined, looped

summed = functools.partial(inlined, fastmath={"reassoc", "contract", "nsz"})  # sums as vectors
WORKS = 3  # of the inertia forces, of the joints, of the supports


class Assembly(NamedTuple):
    """Blocks, lines of nodes and bars as plain arrays; lengths from the centroid of their block."""

    mass_kg: np.ndarray  # (n,)
    inertia_kg_m2: np.ndarray
    centre_m: np.ndarray  # (n, 2) y and z in the reference position
    moves: np.ndarray  # (n, 3): 1 where free along y, z and about x, else 0
    column: np.ndarray  # (n,), int: the motion that drives it along y; −1: none
    first: np.ndarray  # (lines + 1,), int: line g has nodes first[g]:first[g + 1], in order
    body: np.ndarray  # (lines, 2), int: a and b
    origin_m: np.ndarray  # (lines, 2) a node stands at origin + place·along
    along: np.ndarray
    normal: np.ndarray  # from b into a
    level_m: np.ndarray  # (lines,) points of the plane have normal·r = level, r from b's centroid
    law: np.ndarray  # (lines, 3): β [s], tan φ, dashpot along the joint over β·ks
    place_m: np.ndarray  # (nodes,)
    kn_n_m: np.ndarray
    ks_n_m: np.ndarray
    link: np.ndarray  # (links, 2), int: blocks; b −1: the ground
    link_n_m: np.ndarray  # (links, 2): spring and dashpot along y
    tie: np.ndarray  # (ties, 2), int
    tie_end_m: np.ndarray  # (ties, 4) end on a, end on b
    tie_law: np.ndarray  # (ties, 4): stiffness, capacity, length at which it is taut, elongation
    floor: np.ndarray  # (floors, 2), int
    floor_end_m: np.ndarray  # (floors, 2)
    floor_law: np.ndarray  # (floors, 4): stiffness, capacity, load, from where
    watched: np.ndarray  # (points,), int
    watched_m: np.ndarray  # (points, 2)
    foot: int  # block from which d is measured
    gravity_m_s2: float
    bounded: bool
    keeps: bool  # a node keeps its slip while it is open, and does not close without any


@inlined
def at(p, place, turn, block, arm_y, arm_z):
    """Where a point of a block is, and its arm from the centroid, (y, z, arm y, arm z)."""
    cos, sin = turn[block, 0], turn[block, 1]
    ay, az = cos * arm_y - sin * arm_z, sin * arm_y + cos * arm_z
    y = p.centre_m[block, 0] + place[3 * block] + ay
    return y, p.centre_m[block, 1] + place[3 * block + 1] + az, ay, az


@inlined
def _push(force, block, fy, fz, ay, az):
    """Add a force at an arm from the centroid of a block."""
    force[3 * block] += fy
    force[3 * block + 1] += fz
    force[3 * block + 2] += ay * fz - az * fy


@summed
def _nodes(p, g, shift, depth, rate, slide, arrays):
    """Sums of N, s·N, T and s·T over the nodes of line g.

    `depth`, `rate` and `slide`: values at s = 0 and slopes; `arrays`: the state with the slips from
    `shift` on, its rates, and the limits of slips.
    """
    (d0, d1), (v0, v1), (state, rates, limit) = depth, slide, arrays
    beta, friction = p.law[g, 0], p.law[g, 1]
    h0, h1 = d0 + beta * rate[0], d1 + beta * rate[1]
    viscous, n, ns, t, ts = beta * p.law[g, 2], 0.0, 0.0, 0.0, 0.0
    for i in range(p.first[g], p.first[g + 1]):
        s, ks = p.place_m[i], p.ks_n_m[i]
        closed = d0 + d1 * s > 0.0
        normal = p.kn_n_m[i] * (h0 + h1 * s)
        normal = normal if closed and normal > 0.0 else 0.0
        most, v = friction * normal, v0 + v1 * s
        spring = ks * state[shift + i]
        shear = min(max(spring, -most), most)
        both = shear + (viscous * ks * v if abs(spring) < most else 0.0)
        shear = min(max(both, -most), most) if p.bounded else both
        rates[shift + i] = v if closed or p.keeps else 0.0
        limit[i] = most / ks if closed or not p.keeps else math.inf
        n += normal
        ns += s * normal
        t += shear
        ts += s * shear
    return n, ns, t, ts


@inlined
def _line(p, g, state, turn, rates, force, limit):
    """What line g does to its blocks."""
    a, b = p.body[g, 0], p.body[g, 1]
    v = 3 * p.mass_kg.size
    y, z, oy, oz = at(p, state, turn, a, p.origin_m[g, 0], p.origin_m[g, 1])
    ca, sa, cb, sb = turn[a, 0], turn[a, 1], turn[b, 0], turn[b, 1]
    ey, ez = ca * p.along[g, 0] - sa * p.along[g, 1], sa * p.along[g, 0] + ca * p.along[g, 1]
    ny, nz = cb * p.normal[g, 0] - sb * p.normal[g, 1], sb * p.normal[g, 0] + cb * p.normal[g, 1]
    ty, tz = -nz, ny
    qy = y - p.centre_m[b, 0] - state[3 * b]
    qz = z - p.centre_m[b, 1] - state[3 * b + 1]
    d0, d1 = p.level_m[g] - ny * qy - nz * qz, -(ny * ey + nz * ez)
    low, high, shift = p.first[g], p.first[g + 1], 2 * v + WORKS
    deepest = max(d0 + d1 * p.place_m[low], d0 + d1 * p.place_m[high - 1])
    if deepest <= 0.0 and not p.keeps:
        for i in range(low, high):
            rates[shift + i] = limit[i] = 0.0
        return
    # of a past b where they meet; b's own speed is that of its material there
    wa, wb = state[v + 3 * a + 2], state[v + 3 * b + 2]
    wy = state[v + 3 * a] - wa * oz - state[v + 3 * b] + wb * qz
    wz = state[v + 3 * a + 1] + wa * oy - state[v + 3 * b + 1] - wb * qy
    sy, sz = -(wa - wb) * ez, (wa - wb) * ey
    depth, rate = (d0, d1), (-(ny * wy + nz * wz), -(ny * sy + nz * sz))
    slide = ty * wy + tz * wz, ty * sy + tz * sz
    arrays = state, rates, limit
    n, ns, t, ts = _nodes(p, g, shift, depth, rate, slide, arrays)
    fy, fz, my, mz = ny * n - ty * t, nz * n - tz * t, ny * ns - ty * ts, nz * ns - tz * ts
    couple = ey * mz - ez * my
    _push(force, a, fy, fz, oy, oz)
    force[3 * a + 2] += couple
    _push(force, b, -fy, -fz, qy, qz)
    force[3 * b + 2] -= couple


@inlined
def _links(p, state, force):
    """Springs and dashpots along y between two blocks, or to the ground."""
    v = 3 * p.mass_kg.size
    for i in range(p.link.shape[0]):
        a, b = p.link[i, 0], p.link[i, 1]
        stretch, rate = state[3 * a], state[v + 3 * a]
        if b >= 0:
            stretch -= state[3 * b]
            rate -= state[v + 3 * b]
        pull = p.link_n_m[i, 0] * stretch + p.link_n_m[i, 1] * rate
        force[3 * a] -= pull
        if b >= 0:
            force[3 * b] += pull


@inlined
def tie_stretch(p, i, state, turn):
    """How far a tie is longer than taut; direction from b to a, and arms of its ends."""
    a, b = p.tie[i, 0], p.tie[i, 1]
    ya, za, ay, az = at(p, state, turn, a, p.tie_end_m[i, 0], p.tie_end_m[i, 1])
    yb, zb, by, bz = at(p, state, turn, b, p.tie_end_m[i, 2], p.tie_end_m[i, 3])
    length = math.hypot(ya - yb, za - zb)
    way = (ya - yb) / length, (za - zb) / length
    return length - p.tie_law[i, 2], way, (ay, az), (by, bz)


@inlined
def _ties(p, state, turn, force, yielded):
    """Rods that pull, with what they have yielded in the state from `yielded` on."""
    for i in range(p.tie.shape[0]):
        stretch, (ey, ez), (ay, az), (by, bz) = tie_stretch(p, i, state, turn)
        pull = p.tie_law[i, 0] * (stretch - state[yielded + i])
        pull = min(max(pull, 0.0), p.tie_law[i, 1])
        _push(force, p.tie[i, 0], -pull * ey, -pull * ez, ay, az)
        _push(force, p.tie[i, 1], pull * ey, pull * ez, by, bz)


@inlined
def floor_slip(p, i, state, turn):
    """Displacement along y of a floor's point past its carrier [m], and the point's arm."""
    a, b = p.floor[i, 0], p.floor[i, 1]
    y, _, ay, az = at(p, state, turn, a, p.floor_end_m[i, 0], p.floor_end_m[i, 1])
    past = y - p.centre_m[a, 0] - p.floor_end_m[i, 0] - state[3 * b]
    return past - p.floor_law[i, 3], ay, az


@inlined
def _floors(p, state, turn, force, yielded):
    """Loads on points of blocks, and the friction that holds these points to their carriers."""
    for i in range(p.floor.shape[0]):
        slip, ay, az = floor_slip(p, i, state, turn)
        stiffness, most = p.floor_law[i, 0], p.floor_law[i, 1]
        hold = min(max(stiffness * (slip - state[yielded + i]), -most), most)
        _push(force, p.floor[i, 0], -hold, -p.floor_law[i, 2], ay, az)
        force[3 * p.floor[i, 1]] += hold


@looped
def derive(p, given, state, rates, force, turn, limit):
    """Time derivative of a state, into `rates`; driven blocks are put where they are driven.

    `given`: acceleration of the ground along y and along z, displacements and velocities of the
    motions relative to it. `force` (3n,), `turn` (n, 2) and `limit` (nodes,) are filled on the way.
    """
    ag, az, u, w = given
    n = p.mass_kg.size
    v = 3 * n
    for i in range(n):
        if p.column[i] >= 0:
            state[3 * i], state[v + 3 * i] = u[p.column[i]], w[p.column[i]]
        turn[i, 0], turn[i, 1] = math.cos(state[3 * i + 2]), math.sin(state[3 * i + 2])
    for m in range(3 * n):
        force[m] = 0.0
    for g in range(p.level_m.size):
        _line(p, g, state, turn, rates, force, limit)
    _links(p, state, force)
    yielded = 2 * v + WORKS + p.place_m.size
    _ties(p, state, turn, force, yielded)
    _floors(p, state, turn, force, yielded + p.tie.shape[0])
    for i in range(yielded, state.size):
        rates[i] = 0.0
    inertia = joints = supports = 0.0
    for i in range(n):
        fallen = p.gravity_m_s2 + az
        for k in range(3):
            m = 3 * i + k
            speed = state[v + m]
            rates[m] = speed
            joints += force[m] * speed
            rates[v + m] = 0.0
            if p.moves[i, k] == 0.0:
                supports -= force[m] * speed
                continue
            mass = p.inertia_kg_m2[i] if k == 2 else p.mass_kg[i]
            field = -ag if k == 0 else (-fallen if k == 1 else 0.0)
            rates[v + m] = force[m] / mass + field
            if k < 2:
                inertia -= p.mass_kg[i] * (ag if k == 0 else az) * speed
    rates[2 * v], rates[2 * v + 1], rates[2 * v + 2] = inertia, joints, supports


@looped
def yields(p, state, turn, limit):
    """Slide, yield and snap what is past its limit, in place."""
    shift = 6 * p.mass_kg.size + WORKS
    for i in range(p.place_m.size):
        state[shift + i] = min(max(state[shift + i], -limit[i]), limit[i])
    shift += p.place_m.size
    for i in range(p.tie.shape[0]):
        stretch, _, _, _ = tie_stretch(p, i, state, turn)
        if stretch >= p.tie_law[i, 3]:
            state[shift + i] = math.inf
        least = stretch - p.tie_law[i, 1] / p.tie_law[i, 0]
        state[shift + i] = max(state[shift + i], least)
    shift += p.tie.shape[0]
    for i in range(p.floor.shape[0]):
        slip, _, _ = floor_slip(p, i, state, turn)
        most = p.floor_law[i, 1] / p.floor_law[i, 0]
        state[shift + i] = min(max(state[shift + i], slip - most), slip + most)


@looped
def energies(p, state, turn):
    """Kinetic energy; that of weight; that of nodes, links, ties, floors and their loads [J]."""
    n = p.mass_kg.size
    kinetic = raised = stored = 0.0
    for i in range(n):
        for k in range(3):
            mass = p.inertia_kg_m2[i] if k == 2 else p.mass_kg[i]
            kinetic += 0.5 * p.moves[i, k] * mass * state[3 * (n + i) + k] ** 2
        raised += p.moves[i, 1] * p.mass_kg[i] * p.gravity_m_s2 * state[3 * i + 1]
    for g in range(p.level_m.size):
        a, b = p.body[g, 0], p.body[g, 1]
        y, z, _, _ = at(p, state, turn, a, p.origin_m[g, 0], p.origin_m[g, 1])
        cos, sin = turn[b, 0], turn[b, 1]
        ny, nz = cos * p.normal[g, 0], sin * p.normal[g, 0]
        ny, nz = ny - sin * p.normal[g, 1], nz + cos * p.normal[g, 1]
        ey = turn[a, 0] * p.along[g, 0] - turn[a, 1] * p.along[g, 1]
        ez = turn[a, 1] * p.along[g, 0] + turn[a, 0] * p.along[g, 1]
        depth = p.level_m[g] - ny * (y - p.centre_m[b, 0] - state[3 * b])
        depth -= nz * (z - p.centre_m[b, 1] - state[3 * b + 1])
        for i in range(p.first[g], p.first[g + 1]):
            pressed = max(depth - p.place_m[i] * (ny * ey + nz * ez), 0.0)
            slip = state[6 * n + WORKS + i]
            stored += 0.5 * (p.kn_n_m[i] * pressed**2 + p.ks_n_m[i] * slip**2)
    for i in range(p.link.shape[0]):
        stretch = state[3 * p.link[i, 0]]
        if p.link[i, 1] >= 0:
            stretch -= state[3 * p.link[i, 1]]
        stored += 0.5 * p.link_n_m[i, 0] * stretch**2
    shift = 6 * n + WORKS + p.place_m.size
    for i in range(p.tie.shape[0]):
        past = max(tie_stretch(p, i, state, turn)[0] - state[shift + i], 0.0)
        stored += 0.5 * p.tie_law[i, 0] * past**2
    for i in range(p.floor.shape[0]):
        slip, _, az = floor_slip(p, i, state, turn)
        past = slip - state[shift + p.tie.shape[0] + i]
        stored += 0.5 * p.floor_law[i, 0] * past**2
        stored += p.floor_law[i, 2] * (state[3 * p.floor[i, 0] + 1] + az)
    return kinetic, raised, stored
