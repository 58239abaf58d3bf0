"""A scene with one free block as plain arrays of its own plane, for the compiled kernel."""

from typing import NamedTuple

import numpy as np

from .bars import Bars, elements, of_scene, row_of
from .groups import grouped, law_of, line_of
from .stack import FREEDOMS, matrices_of, pose, stacked


class Planar(NamedTuple):
    """One block in the y–z plane, in the frame of a support.

    Nodes of a joint that stand on one line and meet one plane are a group: penetration, its
    rate and the slip rate are then linear in the place s along the line, and the two ends tell
    whether any of its nodes touches. Lengths count from the block's reference centroid.
    """

    first: np.ndarray  # (groups + 1,), int: group i has first[i]:first[i + 1], ordered by s
    origin_m: np.ndarray  # (groups, 2) a node stands at origin + s·along
    along: np.ndarray
    normal: np.ndarray  # from block b into block a (y, z)
    arm_m: np.ndarray  # origin from the centre of the group's support, about which that turns
    level_m: np.ndarray  # (groups,) the plane: points with normal·r = level
    carried: np.ndarray  # bool: the block carries the nodes; else the plane, which turns with it
    support: np.ndarray  # int: column of its motion; −1: it stands still in this frame
    beta_s: np.ndarray  # dashpots β·k
    shear_ratio: np.ndarray  # ks/kn
    friction: np.ndarray  # tan φ
    place_m: np.ndarray  # (nodes,) s
    kn_n_m: np.ndarray
    pull_m: np.ndarray  # tension of a bond over kn
    hold_m: np.ndarray  # its cohesion over kn
    bonded: np.ndarray
    tie: np.ndarray  # bool: a bond that transmits no shear
    start: np.ndarray  # (6,) y, z [m] and rotation about x [rad] of the block, and their rates
    mass_kg: float
    inertia_kg_m2: float
    gravity_m_s2: float
    thickness_m: float
    monitor_m: np.ndarray  # (2,) point that moves by d
    foot: int  # column of the motion of what it stands on, from which d counts; −1: the frame's
    bars: Bars

    @property
    def height_m(self):
        """Of the monitored point above the lowest node [m]."""
        return self.monitor_m[1] - self.origin_m[:, 1].min()


def moving_supports(scene, frame=None):
    """Names of the motions, other than the frame's, that drive blocks, in block order.

    `frame` is the name of its motion, by default the reference's.
    """
    still = frame or scene.blocks[scene.index(scene.reference)].motion
    names = [block.motion for block in scene.blocks]
    return [name for name in dict.fromkeys(names) if name not in (None, still)]


def to_plane(scene, frame=None):
    """Reduce a scene to its plane.

    Parameters
    ----------
    scene : yade_scripts.model.scene.Scene
        Free blocks with the freedoms y, z and rotation about x; supports at rest or driven
        along y.
    frame : str or None
        See `moving_supports`; of supports that a chain carries it is the ground's.

    Returns
    -------
    Planar or Stack
        The latter for several free blocks.

    Raises
    ------
    ValueError
        One line if the scene is not of that kind.
    """
    free, names = _free_blocks(scene), moving_supports(scene, frame)
    reference = scene.blocks[scene.index(scene.reference)]
    if names and any(b.motion is None for b in scene.blocks if not b.free) and reference.motion:
        raise ValueError("planar solver: a support at rest beside a driven reference")
    column = {name: i for i, name in enumerate(names)}
    if len(free) > 1:
        return stacked(scene, free, column, of_scene(scene, free, column))
    return _of_one_block(scene, free[0], column)


def _free_blocks(scene):
    """Indices of the free blocks of a scene; ValueError where the scene is not planar."""
    sprung = {floor.b for floor in scene.floors}  # floors with a mass of their own
    free = [i for i, block in enumerate(scene.blocks) if block.free and i not in sprung]
    if not free or any(not set(scene.blocks[i].free) <= set(FREEDOMS) for i in free):
        raise ValueError("planar solver: expected free blocks with the freedoms y, z, rotation x")
    if np.any(np.abs(scene.nodes.normal[:, 0]) > 1e-12):
        raise ValueError("planar solver: every node must push in the plane")
    return free


def _of_one_block(scene, free, column):
    """`Planar` of a scene whose only free block is `free`; `column` numbers the moving supports."""
    block, nodes = scene.blocks[free], scene.nodes
    if block.free != FREEDOMS:
        raise ValueError("planar solver: expected a block that is free along y, z and about x")
    if np.any(nodes.drag != 1.0):
        raise ValueError("planar solver: expected dashpots along the joints of a single block")
    if np.any((nodes.a == free) == (nodes.b == free)):
        raise ValueError("planar solver: every node must join the block to a support")
    centre = np.array(block.centre_m)[1:]
    groups = [_group(scene, free, centre, column, mine) for mine in grouped(nodes, centre)]
    sizes = [len(group["place_m"]) for group in groups]
    order = np.concatenate([group.pop("nodes") for group in groups])
    kn = nodes.kn_n_m[order]
    places = np.concatenate([group.pop("place_m") for group in groups])
    kinds = {"carried": bool, "support": np.int64}
    columns = {
        key: np.array([group[key] for group in groups], kinds.get(key, float)) for key in groups[0]
    }
    return Planar(
        first=np.concatenate(([0], np.cumsum(sizes))).astype(np.int64),
        **columns,
        place_m=places,
        kn_n_m=kn,
        pull_m=nodes.tension_n[order] / kn,
        hold_m=nodes.cohesion_n[order] / kn,
        bonded=nodes.bonded[order],
        tie=nodes.tie[order],
        start=pose(block),
        mass_kg=float(block.mass_kg),
        inertia_kg_m2=float(block.inertia_kg_m2[0]),
        gravity_m_s2=float(scene.gravity_m_s2),
        thickness_m=float(scene.thickness_m),
        monitor_m=np.array(scene.monitor_point_m, float)[1:] - centre,
        foot=column.get(scene.blocks[scene.index(scene.reference)].motion, -1),
        bars=of_scene(scene, [free], column),
    )


def _group(scene, free, centre, column, mine):
    """Values of one group, its nodes in order, by the names of `Planar`."""
    nodes, i = scene.nodes, mine[0]
    place, (origin, direction) = line_of(nodes, centre, mine)
    carried = nodes.a[i] == free
    support = scene.blocks[nodes.b[i] if carried else nodes.a[i]]
    normal = nodes.normal[i, 1:]
    return {
        "nodes": mine,
        "origin_m": origin,
        "along": direction,
        "normal": normal,
        "arm_m": origin + centre - np.array(support.centre_m)[1:],
        "level_m": normal @ origin - nodes.gap_m[i],
        "carried": carried,
        "support": column.get(support.motion, -1),
        **law_of(nodes, i),
        "place_m": place,
    }


def matrices(planar, supports=0):
    """Mass, stiffness and damping of the block and what it meets, nodes closed, ties taut.

    Summed over the arrays that the loop marches, not by `stiffness.assemble` over the scene:
    supports that other masses carry are freedoms here alone, and tests hold the one against the
    other.

    Returns
    -------
    mass : ndarray, shape (3 + floors,)
        Of y, z, rotation about x, and of the floors that have a mass.
    k, c : ndarray, shape (3 + 3·supports + floors, 3 + 3·supports + floors)
        The freedoms of the supports along y follow the block's, those of the floors follow them,
        then come those of the supports along z, and their rotations about x.
    """
    p = planar
    floors = p.bars.mass_kg[p.bars.mass_kg > 0.0]
    size = 3 + 3 * supports + floors.size

    def springs():
        for g in range(len(p.level_m)):
            for i in range(p.first[g], p.first[g + 1]):
                arm = p.origin_m[g] + p.place_m[i] * p.along[g]
                far_y, far_z = p.arm_m[g] + p.place_m[i] * p.along[g]
                ny, nz = p.normal[g]
                for (y, z), ratio in (((ny, nz), 1.0), ((-nz, ny), p.shear_ratio[g])):
                    row = row_of(size, (y, z), ((0, 1.0, arm),))
                    if supports and p.support[g] >= 0:
                        row[3 + p.support[g]] = -y
                        row[size - 2 * supports + p.support[g]] = -z
                        row[size - supports + p.support[g]] = y * far_z - z * far_y
                    yield row, ratio * p.kn_n_m[i], (p.beta_s[g], ratio * p.kn_n_m[i])
        for stiffness, dashpot, part in elements(p.bars, supports):
            yield np.pad(part, (0, 2 * supports)), stiffness, (dashpot, 1.0)

    k, c = matrices_of(size, springs())
    return np.array([p.mass_kg, p.mass_kg, p.inertia_kg_m2, *floors]), k, c
