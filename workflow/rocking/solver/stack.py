"""Several rigid blocks that stand on each other, in the plane, as plain arrays; their matrices.

They are the pieces of a façade with hinges, or the façade, bricks and headers of W3, and of W3m
the masses of the building behind them. `stack_kernel` marches them.
"""

from typing import NamedTuple

import numpy as np

from .bars import Bars, elements, row_of
from .lines import Lines, lines_of
from .lines import elements as of_lines
from .pieces import Groups, groups_of, nodes_of

FREEDOMS = "yzX"
LEAD = 0.5  # of courses, at most: their springs as by Newmark's β of 1/4, at any step
MANY = 9  # height over the thinnest course beyond which their dashpots are taken at a step's end


class Stack(NamedTuple):
    """Blocks in the y–z plane, in the frame of the reference support."""

    mass_kg: np.ndarray  # (blocks,)
    inertia_kg_m2: np.ndarray
    centre_m: np.ndarray  # (blocks, 2) reference centroids (y, z)
    free: np.ndarray  # (blocks, 3), bool: along y, z and about x; the first one moves freely
    guide: np.ndarray  # (blocks,), int: column of what moves it along y; −1: its forces do
    debris: np.ndarray  # bool: once out of its slot it stays where it is, without part in the rest
    watched: np.ndarray  # (points,), int: blocks
    monitor_m: np.ndarray  # (points, 2) points of theirs, of which the farthest moves by d
    start: np.ndarray  # (blocks, 6) y, z [m] and rotation about x [rad], and their rates
    body_a: np.ndarray  # (nodes,), int: block that carries the node; −1: a support
    body_b: np.ndarray  # block with the plane
    support: np.ndarray  # column of the support's motion; −1: it stands still
    arm_a_m: np.ndarray  # (nodes, 2) the node from the centroid of its block
    arm_b_m: np.ndarray  # a point of the plane; of a support from the origin
    normal: np.ndarray  # from b into a
    kn_n_m: np.ndarray  # (nodes,), this and what follows, see `plane.Planar`
    shear_ratio: np.ndarray
    beta_s: np.ndarray
    friction: np.ndarray
    drag: np.ndarray  # of a dry node, its dashpot along the joint over β·ks
    bonded: np.ndarray
    tie: np.ndarray
    pull_m: np.ndarray
    hold_m: np.ndarray
    rim: np.ndarray  # (nodes, 2) outward direction of the plane's rim, turns with b; 0: none
    rim_m: np.ndarray  # (nodes,) how far from b's centroid along it a node is let go for good
    partial: np.ndarray  # bool: its plane is a part of a slot; past the rim it alone is let go
    link_a: np.ndarray  # (links,), int: blocks that a spring and a dashpot join along y
    link_b: np.ndarray  # −1: the ground
    link_n_m: np.ndarray
    link_ns_m: np.ndarray
    in_row: bool  # pieces, each node between two in turn or one and a support: solved together
    lines: Lines  # beds that are summed in closed form, apart from the nodes
    groups: Groups  # of blocks in a row all other nodes; the nodes above are then none
    lead: float  # steps by which springs of pieces are taken ahead, as dashpots; 0: as they are
    beta: float  # β of all of them
    late: float  # where dashpots of `lines` act in a step: 1, in its middle; 2, at its end
    gravity_m_s2: float
    thickness_m: float
    height_m: float
    foot: int  # see `plane.Planar`
    bars: Bars


def pose(block):
    """y, z [m] and rotation about x [rad] of a block, and their rates."""
    turned, turns = block.rotation_rad[0], block.angular_velocity_rad_s[0]
    return np.array([*block.displacement_m[1:], turned, *block.velocity_m_s[1:], turns], float)


def stacked(scene, free, column, bars):
    """Reduce a scene with several free blocks, see `plane.to_plane`.

    `free` are these, the façade or its lowest piece first; `column` is that of each motion.
    """
    nodes, blocks = scene.nodes, scene.blocks
    number = np.full(len(blocks), -1, np.int64)
    number[free] = np.arange(len(free))
    a, b = number[nodes.a], number[nodes.b]
    if np.any((a < 0) & (b < 0)):
        raise ValueError("planar solver: every node of several blocks must meet a free one")
    links = [link for link in scene.links if number[link.a] >= 0]
    if any(tuple(link.direction) != (0.0, 1.0, 0.0) for link in links):
        raise ValueError("planar solver: expected links along y")
    in_row = bool(
        not links
        and all(set(FREEDOMS) <= set(blocks[i].free) and blocks[i].motion is None for i in free)
        and np.all((a < 0) | (b < 0) | (np.abs(a - b) == 1))
    )
    beta = nodes.beta_s[0]
    even = in_row and np.all(nodes.beta_s == beta) and scene.notes.get("even", ())
    heights = [blocks[i].size_m[2] for i in free]
    lines, summed = lines_of(scene, even or (), number, column)
    grouped = in_row & ~summed
    grouped &= np.all(nodes.drag[grouped] == 1.0)
    return Stack(
        **_of_blocks(scene, free, number, column),
        **_of_nodes(scene, nodes.select(~summed & ~grouped), number, column),
        link_a=np.array([number[link.a] for link in links], np.int64),
        link_b=np.array([number[link.b] for link in links], np.int64),
        link_n_m=np.array([link.stiffness_n_m for link in links], float),
        link_ns_m=np.array([link.dashpot_ns_m for link in links], float),
        in_row=in_row,
        lines=lines,
        groups=groups_of(scene, nodes.select(grouped), number, column),
        lead=LEAD if even else 0.0,
        beta=float(beta),
        late=2.0 if even and sum(heights) > MANY * min(heights) else 1.0,
        gravity_m_s2=float(scene.gravity_m_s2),
        thickness_m=float(scene.thickness_m),
        height_m=float(max(p[2] for _, p in scene.watched) - nodes.position_m[:, 2].min()),
        foot=column.get(blocks[scene.index(scene.reference)].motion, -1),
        bars=bars,
    )


def _of_blocks(scene, free, number, column):
    """Fields of a `Stack` that are of its blocks and of its watched points."""
    mine, debris = [scene.blocks[i] for i in free], scene.notes.get("debris", ())
    watched = [(scene.index(name), point) for name, point in scene.watched]
    arms = [np.subtract(point, scene.blocks[i].centre_m)[1:] for i, point in watched]
    return {
        "mass_kg": np.array([block.mass_kg for block in mine], float),
        "inertia_kg_m2": np.array([block.inertia_kg_m2[0] for block in mine], float),
        "centre_m": np.array([block.centre_m[1:] for block in mine], float),
        "free": np.array([[dof in block.free for dof in FREEDOMS] for block in mine]),
        "guide": np.array([column.get(block.motion, -1) for block in mine], np.int64),
        "debris": np.array([block.name in debris for block in mine]),
        "watched": number[[i for i, _ in watched]],
        "monitor_m": np.array(arms, float),
        "start": np.array([pose(block) for block in mine]),
    }


def _of_nodes(scene, nodes, number, column):
    """Fields of a `Stack` that are of nodes one by one."""
    a, b = number[nodes.a], number[nodes.b]
    centre = np.array([block.centre_m[1:] for block in scene.blocks], float)
    from_a, from_b = (
        np.where((number[side] >= 0)[:, None], centre[side], 0.0) for side in (nodes.a, nodes.b)
    )
    normal = nodes.normal[:, 1:]
    still = np.where(a < 0, nodes.a, nodes.b)
    support = [column.get(scene.blocks[i].motion, -1) for i in still]
    joint = [scene.joints[j] for j in nodes.joint]
    rims, partial = scene.notes.get("rims", {}), set(scene.notes.get("partial", ()))
    none = ((0.0, 0.0, 0.0), 0.0)
    rim = np.array([rims.get(name, none)[0][1:] for name in joint], float).reshape(-1, 2)
    edge = np.array([rims.get(name, none)[1] for name in joint], float)
    return {
        "body_a": a,
        "body_b": b,
        "support": np.where((a >= 0) & (b >= 0), -1, np.array(support, np.int64)),
        "arm_a_m": nodes.position_m[:, 1:] - from_a,
        "arm_b_m": nodes.position_m[:, 1:] - nodes.gap_m[:, None] * normal - from_b,
        "normal": np.ascontiguousarray(normal),
        "kn_n_m": nodes.kn_n_m,
        "shear_ratio": nodes.ks_n_m / nodes.kn_n_m,
        "beta_s": nodes.beta_s,
        "friction": np.tan(nodes.friction_rad),
        "drag": nodes.drag,
        "bonded": nodes.bonded,
        "tie": nodes.tie,
        "pull_m": nodes.tension_n / nodes.kn_n_m,
        "hold_m": nodes.cohesion_n / nodes.kn_n_m,
        "rim": rim,
        "rim_m": edge - np.einsum("ni,ni->n", rim, from_b),
        "partial": np.array([name in partial for name in joint], bool),
    }


def matrices_of(size, springs):
    """Stiffness and damping by (row, stiffness, two factors of the dashpot) of each spring."""
    k, c = np.zeros((2, size, size))
    for row, stiffness, (factor, other) in springs:
        touched = np.flatnonzero(row)
        at, element = np.ix_(touched, touched), np.outer(row[touched], row[touched])
        k[at] += stiffness * element
        c[at] += factor * (other * element)
    return k, c


def stack_matrices(stack, supports=0):
    """Mass, stiffness and damping of what moves freely, nodes closed, ties taut.

    As `plane.matrices`, of the free ones among y, z, rotation of every block; supports that other
    masses carry move along y alone. Returns beside them which block each freedom belongs to;
    supports and floors count on.
    """
    p, n = stack, len(stack.mass_kg)
    floors = p.bars.mass_kg[p.bars.mass_kg > 0.0]
    size = 3 * n + supports + floors.size

    def between(contacts, i, place, kn, drag):
        ny, nz = contacts.normal[i]
        sides = (contacts.body_a[i], 1.0), (contacts.body_b[i], -1.0)
        ends = [(m, sign, place - p.centre_m[m]) for m, sign in sides if m >= 0]
        for (y, z), ratio, share in (
            ((ny, nz), 1.0, 1.0),
            ((-nz, ny), contacts.shear_ratio[i], drag),
        ):
            row = row_of(size, (y, z), ends)
            if supports and contacts.support[i] >= 0:
                row[3 * n + contacts.support[i]] = y if contacts.body_a[i] < 0 else -y
            yield row, ratio * kn, (1.0, contacts.beta_s[i] * share * ratio * kn)

    def springs():
        node = p.arm_a_m + np.where((p.body_a >= 0)[:, None], p.centre_m[p.body_a], 0.0)
        for i, kn in enumerate(p.kn_n_m):
            yield from between(p, i, node[i], kn, 1.0 if p.bonded[i] else p.drag[i])
        for i, place, kn in of_lines(p.lines, p.centre_m):
            yield from between(p.lines, i, place, kn, 0.0)
        for g, place, kn in nodes_of(p.groups, p.centre_m):
            yield from between(p.groups, g, place, kn, 1.0)
        for stiffness, dashpot, row in elements(p.bars, supports, n):
            yield row, stiffness, (1.0, dashpot)
        for i, (a, b) in enumerate(zip(p.link_a, p.link_b, strict=True)):
            row = np.zeros(size)
            row[3 * a] = 1.0
            if b >= 0:
                row[3 * b] = -1.0
            yield row, p.link_n_m[i], (1.0, p.link_ns_m[i])

    k, c = matrices_of(size, springs())
    mass = np.stack([p.mass_kg, p.mass_kg, p.inertia_kg_m2], axis=1).ravel()
    more = supports + floors.size
    block = np.concatenate((np.repeat(np.arange(n), 3), n + np.arange(more)))
    moving = np.concatenate((p.free.ravel(), np.ones(more, bool)))
    at = np.ix_(moving, moving)
    return np.concatenate((mass[p.free.ravel()], floors)), k[at], c[at], block[moving]
