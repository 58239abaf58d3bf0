"""Joints of blocks in a row, group by group (`joints`): between them, below and behind them.

As of one block: a line of nodes turns with the block that carries it, the plane that it meets with
another, and what either is to the other is linear along the line. Supports move along y alone.
"""

from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from .dashpots import beyond, placed, push, relative, turned
from .groups import grouped, law_of, line_of, touched
from .joints import added, reached, resultants
from .vectors import alone, choose, like, put, some, take


class Groups(NamedTuple):
    """Nodes that stand on one line and meet one plane, as of `plane.Planar`."""

    first: np.ndarray  # (groups + 1,), int
    body_a: np.ndarray  # (groups,), int: the block that carries them; −1: a support
    body_b: np.ndarray  # the one with the plane
    support: np.ndarray
    origin_m: np.ndarray  # (groups, 2) from the centroid of their block; of a support, its frame
    along: np.ndarray
    normal: np.ndarray
    level_m: np.ndarray  # points with normal·r = level, r as for the origin
    shear_ratio: np.ndarray
    beta_s: np.ndarray
    friction: np.ndarray
    place_m: np.ndarray  # (nodes,)
    kn_n_m: np.ndarray
    pull_m: np.ndarray
    hold_m: np.ndarray
    bonded: np.ndarray
    tie: np.ndarray


def groups_of(scene, nodes, number, column):
    """`Groups` of nodes of a scene.

    Parameters
    ----------
    scene : Scene
    nodes : Nodes
        Those that are to be grouped.
    number : ndarray of int
        Of every block of the scene among those that are free; −1: a support.
    column : dict of str to int
        Of each motion.
    """
    blocks, rows, order, places = scene.blocks, [], [], []
    frame = np.zeros(2)
    for mine in grouped(nodes, frame):
        place, (origin, along) = line_of(nodes, frame, mine)
        i = mine[0]
        a, b, normal = nodes.a[i], nodes.b[i], nodes.normal[i, 1:]
        centre_a, centre_b = (
            np.array(blocks[block].centre_m[1:]) if number[block] >= 0 else frame
            for block in (a, b)
        )
        still = a if number[a] < 0 else b
        rows.append(
            {
                "body_a": number[a],
                "body_b": number[b],
                "support": column.get(blocks[still].motion, -1) if number[still] < 0 else -1,
                "origin_m": origin - centre_a,
                "along": along,
                "normal": normal,
                "level_m": normal @ (origin - centre_b) - nodes.gap_m[i],
                **law_of(nodes, i),
            }
        )
        order.append(mine)
        places.append(place)
    whole = ("body_a", "body_b", "support")
    of_groups = Groups._fields[1 : Groups._fields.index("place_m")]
    columns = {
        key: np.array([row[key] for row in rows], np.int64 if key in whole else float)
        for key in of_groups
    }
    for key in ("origin_m", "along", "normal"):
        columns[key] = columns[key].reshape(-1, 2)
    at = np.concatenate([*order, np.zeros(0, int)]).astype(int)
    kn = nodes.kn_n_m[at]
    return Groups(
        first=np.cumsum([0, *map(len, order)]).astype(np.int64),
        **columns,
        place_m=np.concatenate([*places, np.zeros(0)]),
        kn_n_m=kn,
        pull_m=nodes.tension_n[at] / kn,
        hold_m=nodes.cohesion_n[at] / kn,
        bonded=nodes.bonded[at],
        tie=nodes.tie[at],
    )


def nodes_of(groups, centre):
    """(group, place (y, z), stiffness) of every node; `centre`: of the blocks, for reference."""
    for g, body in enumerate(groups.body_a):
        origin = groups.origin_m[g] + (centre[body] if body >= 0 else 0.0)
        for i in range(groups.first[g], groups.first[g + 1]):
            yield g, origin + groups.place_m[i] * groups.along[g], groups.kn_n_m[i]


@inlined
def _coupled(between, low, directions, sums, size):
    """Add what the dashpots of a group do between block `low` and the next, C of the two.

    `directions`: of each (y, z), what arms of the lower and the higher block have along it at the
    line's origin, and how both grow along the line; `sums`: of each Σ kn·(1, s, s²).
    """
    for which in range(2):
        (y, z), (one, other, more) = directions[which]
        k0, k1, k2 = sums[which]
        dashpot = size[which]
        of_low, of_high = one * k0 + more * k1, other * k0 + more * k1
        both = one * of_high + more * (other * k1 + more * k2)
        entries = (
            (y * y * k0, y * z * k0, y * of_high),
            (z * y * k0, z * z * k0, z * of_high),
            (of_low * y, of_low * z, both),
        )
        for m, row in enumerate(entries):
            for n, entry in enumerate(row):
                at = 9 * low + 3 * m + n
                put(between, at, take(between, at) - dashpot * entry)


@inlined
def _resist(own, block, arms, directions, sums, dashpots):
    """Add the dashpots of a group to those of a block."""
    at = 6 * block
    yy, yz, yt = take(own, at), take(own, at + 1), take(own, at + 2)
    had = yy, yz, yt, take(own, at + 3), take(own, at + 4), take(own, at + 5)
    for m, value in enumerate(added(had, arms, directions, sums, dashpots)):
        put(own, at + m, value)


@inlined
def press(p, whole, parts, rows, time, alive, counts):
    """What the groups do to their blocks; energy stored and taken in this step, bonds that broke.

    `rows`, `whole`: of `groups.untouched`; for the rest see `march`.
    """
    _, past, dt = time
    groups, supports = p.groups, parts.supports
    touch = touched(groups, rows)
    none = like(0.0, take(parts.place, 0))
    elastic = spent = broken = none
    for g in range(groups.level_m.size):
        a, b = groups.body_a[g], groups.body_b[g]
        j = groups.support[g] if groups.support[g] >= 0 else len(supports.y) - 1
        su = take(supports.y, j)
        ry, rz = like(groups.origin_m[g, 0], su), like(groups.origin_m[g, 1], su)
        ey, ez = like(groups.along[g, 0], su), like(groups.along[g, 1], su)
        ny, nz = like(groups.normal[g, 0], su), like(groups.normal[g, 1], su)
        py, pz = ry + su, rz
        if a >= 0:
            ry, rz = turned(parts.turn, a, (ry, rz))
            ey, ez = turned(parts.turn, a, (ey, ez))
            py, pz = placed(p, parts, a, (ry, rz))
        by, bz = py - su, pz
        if b >= 0:
            ny, nz = turned(parts.turn, b, (ny, nz))
            by, bz = beyond(p, parts, b, py, pz)
        d0, d1 = groups.level_m[g] - ny * by - nz * bz, -(ny * ey + nz * ez)
        if not alone(d0):
            d0, d1 = choose(alive, d0, -1.0), choose(alive, d1, 0.0)
        reach, gone = reached(groups, touch, g, alive, (d0, d1), counts)
        spent += gone
        if not some(reach[0] | reach[2]):
            continue
        ty, tz = -nz, ny
        arms = (ry, rz), (by, bz)
        vy, vz, uy, uz, spin, turn = relative(parts, a, b, arms, past, supports, j)
        more_n, more_t = nz * ey - ny * ez, tz * ey - ty * ez
        q0, q1 = -(ny * vy + nz * vz), -spin * more_n
        s0, s1 = ty * vy + tz * vz, spin * more_t
        g0, g1 = ty * uy + tz * uz, turn * more_t
        lines = d0, d1, q0, q1, s0, s1, g0, g1
        sums = resultants(groups, touch, g, whole, reach, lines, time, counts)
        (n0, n1), (t0, t1), across, along, stored, taken, gone = sums
        elastic, spent, broken = elastic + stored, spent + taken, broken + gone
        fy, fz = ny * n0 - ty * t0, nz * n0 - tz * t0
        far = ey * (nz * n1 - tz * t1) - ez * (ny * n1 - ty * t1)
        beta = groups.beta_s[g] + p.lead * dt  # of dashpots, and of springs taken ahead
        dashpots, directions = (beta, groups.shear_ratio[g]), (ny, nz, ty, tz)
        if a >= 0:
            push(parts.force, a, 1.0, (fy, fz), (ry, rz), far)
            _resist(parts.own, a, (ry, rz, ey, ez), directions, (across, along), dashpots)
        else:
            put(supports.fy, j, take(supports.fy, j) + fy)
        if b >= 0:
            push(parts.force, b, -1.0, (fy, fz), (by, bz), far)
            _resist(parts.own, b, (by, bz, ey, ez), directions, (across, along), dashpots)
        else:
            put(supports.fy, j, take(supports.fy, j) - fy)
        if a >= 0 and b >= 0:
            of_a, of_b = (
                (nz * ry - ny * rz, tz * ry - ty * rz),
                (nz * by - ny * bz, tz * by - ty * bz),
            )
            low, one, other = (a, of_a, of_b) if a < b else (b, of_b, of_a)
            both = ((ny, nz), (one[0], other[0], more_n)), ((ty, tz), (one[1], other[1], more_t))
            _coupled(parts.between, low, both, (across, along), (beta, beta * dashpots[1]))
    return elastic, spent, broken
