"""Welded nodes and mass-proportional damping in YADE: what makes up a linear brick building.

A welded node never breaks. It is a pair of spheres, one of either block, that touch at the
node; `CohFrict` holds them with the node's kn and ks and a strength that is never reached: one
contact where a bonded node has two, and no dashpot. The pairs are fixed, so these spheres have
no bound and the collider passes them over.

`LinearDragEngine` damps a block by 6πνr·v on one more of its spheres, r = rate·m/(6πν).
"""

import math

import numpy as np

from yade_scripts.engine.attached import Attached
from yade_scripts.lists import listed

# The normal of a pair turns by (shear displacement)/(2r). A radius far above any joint
# displacement keeps the springs linear; without a collider it may exceed the brick.
NODE_RADIUS_M = 0.1
DRAG_VISCOSITY_PA_S = 1.0
NEEDED = (
    "CohFrictMat",
    "Ip2_CohFrictMat_CohFrictMat_CohFrictPhys",
    "Ig2_Sphere_Sphere_ScGeom6D",
    "Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
    "LinearDragEngine",
)


class Welds(Attached):
    """The spheres of welded nodes and of drag, and what steps them: `drag`, an engine or none."""

    def place(self):
        """Append the spheres."""
        w, scene = self.w, self.scene
        self.pairs, self.drag = [], []
        self.welded = np.flatnonzero(scene.nodes.welded).tolist()
        dragged = [i for i, block in enumerate(scene.blocks) if block.drag_1_s > 0.0]
        if not (self.welded or dragged):
            return
        missing = [name for name in NEEDED if not hasattr(w, name)]
        if missing:
            raise ValueError(f"this YADE lacks the class(es) {listed(missing)}")
        if scene.links or scene.ties or scene.floors:
            raise ValueError(
                "welded nodes share a mask bit with links, a shape with ties and floors"
            )
        self.material = self.cohesive(frictionAngle=0.5)
        for i in self.welded:
            ends = (scene.nodes.a[i], 1.0), (scene.nodes.b[i], -1.0)
            self.pairs.append(tuple(self._half(i, int(block), sign) for block, sign in ends))
        if self.welded:
            self.between_cohesive()
        if dragged:
            ids = [self._dragged(i) for i in dragged]
            self.drag = [w.LinearDragEngine(nu=DRAG_VISCOSITY_PA_S, ids=ids)]

    def _half(self, i, index, sign):
        """Append the sphere of node i on a block; return its id."""
        nodes = self.scene.nodes
        if self.scene.blocks[index].motion is not None:
            name = self.scene.blocks[index].name
            raise ValueError(f"block '{name}' is driven: no node on it can be welded")
        return self._sphere(index, nodes.position_m[i] + sign * NODE_RADIUS_M * nodes.normal[i])

    def _dragged(self, index):
        """Append the sphere that drags a block; return its id."""
        block = self.scene.blocks[index]
        radius = block.drag_1_s * block.mass_kg / (6.0 * math.pi * DRAG_VISCOSITY_PA_S)
        return self._sphere(index, block.centre_m, radius)

    def _sphere(self, index, centre, radius=NODE_RADIUS_M):
        free = bool(self.scene.blocks[index].free)
        sphere = self.utils.sphere(
            tuple(float(v) for v in centre), radius, material=self.material, fixed=not free, mask=0
        )
        sphere.bounded = False
        return self.append(index, sphere)

    def join(self):
        """Make the contacts, with the stiffness of each node."""
        nodes = self.scene.nodes
        for i, pair in zip(self.welded, self.pairs, strict=True):
            physics = self.utils.createInteraction(*pair).phys
            physics.kn, physics.ks = float(nodes.kn_n_m[i]), float(nodes.ks_n_m[i])
            physics.normalAdhesion = physics.shearAdhesion = 1e30
