"""Floors of a scene in YADE: a force on a sphere of the façade, and a cohesive pair that slides.

The load is a `ForceEngine` on a massless sphere of the façade's clump, at the floor's point; under
a vertical motion a second engine adds what its mass weighs more or less there. What
holds is `CohFrict` between that sphere and one of the carrier, REACH_M straight above: ks is the
floor's, the cohesion its capacity, there is no friction, and `fragile` is off, so that the shear
across the vertical is elastic, perfectly plastic and the same whichever way it points; kn is
nothing. Their radii put the contact at the façade's sphere, and REACH_M is so long that the normal
stays vertical. The spheres have mask 0, so no collider finds them.
"""

from yade_scripts.engine import drives
from yade_scripts.engine.attached import Attached

REACH_M, RADIUS_M = 1e3, 1e-5  # the contact shears a radius above the point
NO_STIFFNESS = 1e-6  # N/m along the vertical


class Floors(Attached):
    """The spheres of each floor, and what holds it; those that hold nothing stay single.

    The geometry serves the wires of ties too: YADE has one for two spheres. `pairs` are YADE's ids
    of the spheres on the façade and on the carrier, or None.
    """

    def place(self):
        """Append the spheres."""
        self.pairs = []
        if not self.scene.floors:
            return
        self.between_cohesive()
        material = self.cohesive(frictionAngle=0.0, fragile=False)
        for floor in self.scene.floors:
            x, y, z = floor.position_m
            above = (x, y, z + REACH_M)
            ends = [(floor.a, (x, y, z), RADIUS_M), (floor.b, above, REACH_M + RADIUS_M)]
            ids = []
            for block, centre, radius in ends[: 1 + (floor.capacity_n > 0.0)]:
                sphere = self.utils.sphere(centre, radius, fixed=False, material=material, mask=0)
                ids.append(self.append(block, sphere))
            self.pairs.append((ids[0], ids[1] if len(ids) > 1 else None))

    def loads(self, lift=None):
        """Engines of the loads; `lift` is the vertical motion in whose frame they act."""
        w, engines = self.w, []
        for floor, (body, _) in zip(self.scene.floors, self.pairs, strict=True):
            if floor.load_n > 0.0:
                engines.append(w.ForceEngine(force=(0.0, 0.0, -floor.load_n), ids=[body]))
            if floor.load_n > 0.0 and lift is not None:
                mass = floor.load_n / self.scene.gravity_m_s2
                engines.append(drives.force(w, lift, -mass, 2, [body]))
        return engines

    def join(self):
        """Make the contacts."""
        for floor, pair in zip(self.scene.floors, self.pairs, strict=True):
            if pair[1] is not None:
                physics = self.utils.createInteraction(*pair).phys
                physics.kn, physics.ks = NO_STIFFNESS, floor.stiffness_n_m
                physics.shearAdhesion = floor.capacity_n


class Raised:
    """Loads of floors times their height above the reference position."""

    def __init__(self, scene, built):
        """Take hold of the points that are loaded."""
        self.gravity = scene.gravity_m_s2
        self.loads = [
            (floor.load_n, built.omega.bodies[body].state, floor.position_m[2])
            for floor, (body, _) in zip(scene.floors, built.floors, strict=True)
        ]

    def __call__(self):
        """Energy now [J]."""
        return sum(load * (state.pos[2] - height) for load, state, height in self.loads)

    def momentum(self):
        """Mass of the loads times their speed along z [kg·m/s]."""
        return sum(load * state.vel[2] for load, state, _ in self.loads) / self.gravity
