"""What blocks are made of in YADE: materials, carriers, node spheres, faces and clumps.

Each contact node is a small sphere of the block that carries it, against a box that stands for
the opposite block's face. The spheres weigh nothing; mass and inertia sit on the clump. Bonded
nodes are explained in `bonds`, welded ones in `welds`.
"""

import numpy as np

from yade_scripts.engine.bonds import PRELOAD_M
from yade_scripts.engine.library import EngineError
from yade_scripts.engine.poses import quaternion
from yade_scripts.model.scene import DOFS

LEAST_BETA_S = 1e-15  # a dashpot of exactly 0 in series with the face would become the face's
PARTNER_STIFFNESS = 1e30  # materials combine in series; the face must not soften the node
UNLIMITED_FRICTION = 1.57  # rad
# A clump's frame is its principal frame, axes in the order of the moments.
# Ascending stand-in moments keep that frame on x, y, z; the real ones follow.
STAND_IN_INERTIA = (1.0, 2.0, 3.0)


class SceneParts:
    """Appends the bodies of a scene's blocks to YADE; its spheres have the radius `radius_m`.

    `node_body` is as of `adapter.Built`; `bonded` has the ids of a bonded node's two halves and its
    dry sphere.
    """

    def __init__(self, w, utils, omega, scene, faces, radius_m):
        """Append the rigid material of faces; others follow as nodes need them."""
        self.w, self.utils, self.omega = w, utils, omega
        self.scene, self.faces, self.radius_m = scene, faces, radius_m
        self.reach_m = 4.0 * max(max(b.size_m) for b in scene.blocks)
        self.node_body, self.tie = [-1] * len(scene.nodes), scene.nodes.tie
        self.bonded: dict[int, tuple] = {}
        self.materials: dict[tuple, object] = {}
        self.rigid = w.ViscElMat(
            density=1e-12,
            kn=PARTNER_STIFFNESS,
            ks=PARTNER_STIFFNESS,
            cn=PARTNER_STIFFNESS,
            cs=PARTNER_STIFFNESS,
            frictionAngle=UNLIMITED_FRICTION,
        )
        omega.materials.append(self.rigid)

    def _material(self, kn, ks, beta, friction, drag=1.0):
        """Viscoelastic material of a node; one of each kind."""
        key = (float(kn), float(ks), float(beta), float(friction), float(drag))
        if key not in self.materials:
            kn, ks, beta, friction, drag = key
            across, along = max(beta, LEAST_BETA_S), max(drag * beta, LEAST_BETA_S)
            self.materials[key] = self.w.ViscElMat(
                density=1e-12, kn=kn, ks=ks, cn=across * kn, cs=along * ks, frictionAngle=friction
            )
            self.omega.materials.append(self.materials[key])
        return self.materials[key]

    def _node_material(self, i):
        n = self.scene.nodes
        return self._material(n.kn_n_m[i], n.ks_n_m[i], n.beta_s[i], n.friction_rad[i], n.drag[i])

    def _bond_material(self, i):
        """Half a node; the shear of a tie slips freely."""
        n = self.scene.nodes
        friction = 0.0 if self.tie[i] else UNLIMITED_FRICTION
        return self._material(0.5 * n.kn_n_m[i], 0.5 * n.ks_n_m[i], n.beta_s[i], friction)

    def _sphere(self, position, radius_m, material, mask):
        body = self.utils.sphere(tuple(position), radius_m, material=material, mask=mask)
        return self.omega.bodies.append(body)

    def _weightless(self, ids):
        for i in ids:
            state = self.omega.bodies[i].state
            state.mass, state.inertia = 0.0, (0.0, 0.0, 0.0)
        return ids

    def faces_of(self, index):
        """Append the faces of a block; return their ids."""
        keys = self.faces.of_block(index)
        return [self.faces.append(self.omega, key, self.reach_m, self.rigid) for key in keys]

    def joined(self, block, ids):
        """Clump the faces of a driven support, so that preloads between them stay inside it."""
        box = self.utils.box(
            tuple(block.centre_m), (0.1, 0.1, 0.1), fixed=False, mask=0, material=self.rigid
        )
        carrier = self.omega.bodies.append(box)
        state = self.omega.bodies[carrier].state
        state.mass, state.inertia = 1.0, STAND_IN_INERTIA
        return self.omega.bodies.clump([carrier, *self._weightless(ids)])

    def members(self, index):
        """Append carrier, node spheres and faces of a free block; return their ids."""
        block, nodes, faces = self.scene.blocks[index], self.scene.nodes, self.faces
        carrier = self.utils.box(
            center=tuple(block.centre_m),
            extents=tuple(0.5 * s for s in block.size_m),
            fixed=False,
            wire=True,
            material=self.rigid,
            mask=0,
        )
        ids = [self.omega.bodies.append(carrier)]
        state = self.omega.bodies[ids[0]].state
        state.mass, state.inertia = block.mass_kg, STAND_IN_INERTIA
        for i in np.flatnonzero((nodes.a == index) & ~nodes.welded):
            is_bonded = faces.press[i] is not None
            self.node_body[i] = self._sphere(
                nodes.position_m[i] + self.radius_m * nodes.normal[i],
                self.radius_m,
                self._node_material(i),
                0 if is_bonded else faces.bit[faces.plain[i]],
            )
            new = [self.node_body[i]]
            if is_bonded:
                place, material = nodes.position_m[i], self._bond_material(i)
                new += [
                    self._sphere(place, PRELOAD_M, material, faces.bit[key])
                    for key in (faces.press[i], faces.hook[i])
                ]
                self.bonded[int(i)] = (*new[1:], new[0])
            ids += self._weightless(new)
        return ids + self._weightless(self.faces_of(index))

    def clump(self, block, members, full_rotation):
        """Join members to a clump with the block's mass, freedoms and initial pose.

        Returns its id and the inverse of its frame: YADE may start a clump turned by 180°.
        """
        from yade import minieigenHP

        clump = self.omega.bodies.clump(members)
        state = self.omega.bodies[clump].state
        frame = np.array([list(row) for row in state.ori.toRotationMatrix()])
        if not np.allclose(np.abs(np.diag(frame)), 1.0, atol=1e-9):
            raise EngineError(f"YADE turned the frame of block '{block.name}'")
        unturned = state.ori.inverse()
        state.mass = block.mass_kg
        state.inertia = tuple(block.inertia_kg_m2)
        state.blockedDOFs = "".join(d for d in DOFS if d not in block.free)
        self.omega.bodies[clump].aspherical = full_rotation
        state.pos = tuple(np.array(block.centre_m) + np.array(block.displacement_m))
        if any(block.rotation_rad):
            state.ori = quaternion(block.rotation_rad) * state.ori
        state.vel = tuple(block.velocity_m_s)
        state.angVel = tuple(block.angular_velocity_rad_s)
        spin = state.ori.inverse() * state.angVel  # a full rotation is integrated by its momentum
        state.angMom = state.ori * minieigenHP.Vector3(
            *(i * w for i, w in zip(block.inertia_kg_m2, spin, strict=True))
        )
        return clump, unturned
