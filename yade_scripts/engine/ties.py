"""Ties of a scene in YADE: its wire model between two spheres that touch nothing else.

`Law2_ScGeom_WirePhys_WirePM` pulls along the line between the centres of two spheres by a
force–lengthening curve, unloads along the first slope, never pushes, and ends where the curve
ends. That is the law of `scene.Tie`. The spheres have mask 0, so no collider finds them: each
pair is joined by hand, with radii that keep it overlapping at any lengthening, since YADE keeps
geometry only between what has met.
"""

import math

from yade_scripts.engine.attached import Attached

UNIT_DIAMETER_M = 2.0 / math.pi**0.5  # of a section of 1 m²: stresses are then forces
RISE = 1e-9  # of the capacity along the plateau, whose ends YADE wants to differ


def _curve(tie):
    """Lengthening [m] and pull [N] where the law bends and where it ends."""
    bend = tie.capacity_n / tie.stiffness_n_m
    end = max(tie.elongation_m, bend * (1.0 + RISE))
    return (bend, tie.capacity_n), (end, tie.capacity_n * (1.0 + RISE))


def _reach(tie):
    """Radius of the spheres: they overlap by half of it when the tie snaps."""
    return 2.0 * (tie.length_m + tie.slack_m + tie.elongation_m) / 3.0


class Ties(Attached):
    """Two spheres for each tie, and the wire between them; `pairs` are their ids on a and on b."""

    def place(self):
        """Append the spheres."""
        w, self.pairs = self.w, []
        if self.scene.ties:
            self.geometry = [w.Ig2_Sphere_Sphere_ScGeom()]
            self.physics = [w.Ip2_WireMat_WireMat_WirePhys()]
            self.law = [w.Law2_ScGeom_WirePhys_WirePM()]
        for tie in self.scene.ties:
            material = w.WireMat(density=1e-30, diameter=UNIT_DIAMETER_M)
            self.omega.materials.append(material)
            ids = []
            for block, end in ((tie.a, tie.end_a_m), (tie.b, tie.end_b_m)):
                sphere = self.utils.sphere(end, _reach(tie), fixed=False, material=material, mask=0)
                ids.append(self.append(block, sphere))
            self.pairs.append(tuple(ids))

    def join(self):
        """Make the wires.

        A wire's curve is stated by strains of the length at which it is made, and its slack by the
        overlap from which it counts.
        """
        bodies = self.omega.bodies
        for tie, pair in zip(self.scene.ties, self.pairs, strict=True):
            ends = [bodies[i].state.pos for i in pair]
            length = (ends[0] - ends[1]).norm()
            curve = [(lengthening / length, pull) for lengthening, pull in _curve(tie)]
            bodies[pair[0]].mat.strainStressValues = curve
            wire = self.utils.createInteraction(*pair).phys
            wire.initD = 2.0 * _reach(tie) - tie.length_m - tie.slack_m
