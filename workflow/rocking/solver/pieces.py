"""Joints of blocks in a row, group by group (`joints`): between them, below and behind them.

As of one block: a line of nodes turns with the block that carries it, the plane that it meets with
another, and what either is to the other is linear along the line. Supports move along y alone.
"""

from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from .faces import act, met, moving, resist
from .groups import grouped, law_of, line_of, touched
from .joints import reached, resultants
from .vectors import like, some, take


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
def press(p, whole, parts, rows, time, alive, counts):
    """What the groups do to their blocks; energy stored and taken in this step, bonds that broke.

    `rows`, `whole`: of `groups.untouched`; for the rest see `march`.
    """
    _, past, dt = time
    groups, touch = p.groups, touched(p.groups, rows)
    none = like(0.0, take(parts.place, 0))
    elastic = spent = broken = none
    for g in range(groups.level_m.size):
        ends, arms, normal, along, depths = met(p, groups, g, parts, alive)
        reach, gone = reached(groups, touch, g, alive, depths, counts)
        spent += gone
        if not some(reach[0] | reach[2]):
            continue
        turns, moves = moving(parts, ends, arms, normal, along, past)
        lines = *depths, *moves
        sums = resultants(groups, touch, g, whole, reach, lines, time, counts)
        (n0, n1), (t0, t1), across, within, stored, taken, gone = sums
        elastic, spent, broken = elastic + stored, spent + taken, broken + gone
        (ny, nz), (ey, ez) = normal, along
        couple = ey * (nz * n1 - ny * t1) - ez * (ny * n1 + nz * t1)
        act(parts, ends, arms, normal, (n0, t0), couple)
        beta = groups.beta_s[g] + p.lead * dt  # of dashpots, and of springs taken ahead
        joint, dashpots = (ends, arms, normal, along), (beta, groups.shear_ratio[g])
        resist(parts, joint, turns, (across, within), dashpots)
    return elastic, spent, broken
