"""Contact faces of a scene as YADE boxes, and the mask bit that pairs each with its nodes.

A face is a plane of a block that nodes touch. Its box is oversized on purpose: masks
decide who touches it, and a node at the rim of the real face must meet a flat face,
not the edge of a box. Where blocks slide off each other the rim is real; it is then
stated in `scene.notes["rims"]` as joint name → (outward direction of the rim, its
level along that direction), see `releases`.

YADE's masks hold 30 bits. Scenes with more faces get boxes of their joint's size plus
the largest relative motion, and faces whose boxes and nodes cannot meet share a bit.
"""

from typing import Any

import numpy as np

from yade_scripts.engine.bonds import FACE_OFFSET_M

BITS = 30
# Of boxes alone, where spheres may meet spheres: what has the same mask can then be kept apart
BOX_BIT, NODE_BITS = 1 << 30, (1 << 30) - 1
LOCAL_REACH_M = 0.75  # beyond the joint's nodes in its plane
LOCAL_DEPTH_M = 0.30  # of a local box behind its face
MOTION_M = 0.25  # boxes this far apart never meet before the run has ended


class Faces:
    """Faces (block, normal, level, rim, who meets it) of a scene, the nodes on them, their bits.

    Pieces of a façade have faces of their own on one wall: on the bit of one face their nodes at a
    hinge would meet each other, where ties and floors make spheres meet. Else anyone meets it.

    `nodes_of`, `bit` and `body` (YADE's id, once the box has been appended) are by key; `box_bit`
    is a further bit of all boxes. `plain`, `press` and `hook` are the key of each node's faces; the
    last two None for dry nodes, all for welded ones.
    """

    def __init__(self, scene):
        """Group the nodes of a scene by face."""
        nodes, rims = scene.nodes, scene.notes.get("rims", {})
        self.scene, self.apart = scene, len(scene.watched) > 1
        self.nodes_of: dict[tuple, list] = {}
        self.body: dict[tuple, int] = {}
        self.plain: list[Any] = []
        self.press: list[Any] = []
        self.hook: list[Any] = []
        bonded, welded = nodes.bonded, nodes.welded
        self.box_bit = BOX_BIT if welded.any() else 0
        for i in range(len(nodes)):
            if welded[i]:  # pairs of spheres, see `welds`
                for keys in (self.plain, self.press, self.hook):
                    keys.append(None)
                continue
            normal = nodes.normal[i]
            level = float(normal @ nodes.position_m[i] - nodes.gap_m[i])
            rim = rims.get(scene.joints[nodes.joint[i]])
            if rim is not None:
                rim = (tuple(float(v) for v in rim[0]), round(float(rim[1]), 9))
            self.plain.append(self._add(i, normal, level, rim))
            on = bonded[i]
            self.press.append(self._add(i, normal, level + FACE_OFFSET_M, None) if on else None)
            self.hook.append(self._add(i, -normal, FACE_OFFSET_M - level, None) if on else None)
        self.local = len(self.nodes_of) > BITS
        self.bit = (
            self._colour() if self.local else {key: 1 << n for n, key in enumerate(self.nodes_of)}
        )

    def _add(self, i, normal, level, rim):
        meets = int(self.scene.nodes.a[i]) if self.apart else None
        key = (int(self.scene.nodes.b[i]), tuple(np.round(normal, 12)), round(level, 9), rim, meets)
        self.nodes_of.setdefault(key, []).append(i)
        return key

    def of_block(self, index):
        """Return the keys of the faces of one block."""
        return [key for key in self.nodes_of if key[0] == index]

    def shape(self, key, reach_m):
        """Centre, half edges and axes of a face's box: columns, two in its plane, then normal."""
        _, normal, level, rim, _ = key
        normal = np.array(normal)
        points = self.scene.nodes.position_m[self.nodes_of[key]]
        middle = np.mean(points, axis=0)
        on_face = middle + (level - normal @ middle) * normal
        axes = _axes(normal)
        half = np.full(3, float(reach_m))
        if self.local:
            spread = 0.5 * np.ptp(points @ axes[:, :2], axis=0)
            half[:2] = spread + LOCAL_REACH_M
            half[2] = 0.5 * LOCAL_DEPTH_M
            centre_plane = 0.5 * (np.max(points @ axes, 0) + np.min(points @ axes, 0))
            on_face = axes[:, :2] @ centre_plane[:2] + level * normal
        if rim is not None:  # slide the box back until it ends at the rim
            direction, edge = np.array(rim[0]), rim[1]
            width = float(np.abs(axes.T @ direction) @ half)
            on_face = on_face + (edge - width - direction @ on_face) * direction
        return on_face - half[2] * normal, half, axes

    def append(self, omega, key, reach_m, material):
        """Append the YADE box whose surface is the face `key`, in the reference position."""
        from yade import minieigenHP, utils

        centre, half, _ = self.shape(key, reach_m)
        normal = key[1]
        axis_to = minieigenHP.Quaternion()
        axis_to.setFromTwoVectors(minieigenHP.Vector3(0, 0, 1), minieigenHP.Vector3(*normal))
        box = utils.box(
            center=tuple(centre),
            extents=tuple(float(v) for v in half),
            orientation=axis_to,
            fixed=False,
            wire=True,
            material=material,
            mask=self.bit[key] | self.box_bit,
        )
        self.body[key] = omega.bodies.append(box)
        return self.body[key]

    def _colour(self):
        """Bits, given greedily, that no two faces share whose boxes and nodes could meet.

        ValueError beyond 30.
        """
        keys = list(self.nodes_of)
        position = self.scene.nodes.position_m
        shapes = {key: self.shape(key, 0.0) for key in keys}

        def meets(face, other):
            centre, half, axes = shapes[face]
            inside = np.abs((position[self.nodes_of[other]] - centre) @ axes) - half
            return bool(np.any(np.all(inside < MOTION_M, axis=1)))

        bit: dict[tuple, int] = {}
        for key in keys:
            taken = {bit[k] for k in bit if meets(key, k) or meets(k, key)}
            free = [1 << n for n in range(BITS) if 1 << n not in taken]
            if not free:
                raise ValueError(f"{len(keys)} contact faces cannot share YADE's {BITS} mask bits")
            bit[key] = free[0]
        return bit


def _axes(normal):
    """Axes of the box that YADE turns from z to `normal` by the shortest rotation."""
    z = np.array([0.0, 0.0, 1.0])
    cross, cosine = np.cross(z, normal), float(normal @ z)
    if cosine < -1.0 + 1e-12:  # half a turn: any axis in the plane; boxes are symmetric
        return np.diag([1.0, -1.0, -1.0])
    k = np.array(
        [[0.0, -cross[2], cross[1]], [cross[2], 0.0, -cross[0]], [-cross[1], cross[0], 0.0]]
    )
    return np.eye(3) + k + k @ k / (1.0 + cosine)
