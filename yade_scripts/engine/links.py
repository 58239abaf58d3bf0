"""Links of a scene in YADE: a spring and a dashpot that pull as well as push.

A link is a sphere on block a with half the stiffness and half the dashpot, and on block b two
rigid boxes, one before and one behind it along the link's direction, GAP_M from its centre and
penetrated by REACH_M. The two preloads cancel, and while the centre stays between the boxes the
pair is linear both ways, as the ties of `bonds` are. Contacts lose their dashpot where their
force would become tensile, so a dashpot gets at least the stiffness that keeps it working at
FASTEST_M_S: 2e-2 1/s times c, below 1e-4 of a chain's stiffness. All links share one mask bit
and stand side by side in x, out of each other's reach.
"""

from yade_scripts.engine.attached import Attached
from yade_scripts.engine.bonds import NO_STIFFNESS
from yade_scripts.model.scene import DOFS

REACH_M, GAP_M = 1e3, 10.0
FASTEST_M_S = 20.0  # of one end past the other
BIT = 1 << 30  # beyond those of the faces


def built_stiffness(link):
    """Stiffness of a link as it is built [N/m]."""
    return max(link.stiffness_n_m, link.dashpot_ns_m * FASTEST_M_S / REACH_M)


class Links(Attached):
    """The spheres and boxes of a scene's links."""

    def place(self):
        """Append them, all on one mask bit."""
        w, utils, scene = self.w, self.utils, self.scene
        rigid = w.ViscElMat(density=1e-30, kn=1e30, ks=1e30, cn=1e30, cs=1e30, frictionAngle=0.0)
        if scene.links:
            self.omega.materials.append(rigid)
        for number, link in enumerate(scene.links, 1):
            _check(scene, link)
            half = w.ViscElMat(
                density=1e-30,
                kn=0.5 * built_stiffness(link),
                cn=max(0.5 * link.dashpot_ns_m, NO_STIFFNESS),
                ks=NO_STIFFNESS,
                cs=NO_STIFFNESS,
                frictionAngle=0.0,
            )
            self.omega.materials.append(half)
            middle = (link.position_m[0] + 5.0 * REACH_M * number, *link.position_m[1:])
            sphere = utils.sphere(middle, REACH_M + GAP_M, fixed=False, material=half, mask=BIT)
            boxes = [
                utils.box(
                    [middle[i] + side * 2.0 * GAP_M * link.direction[i] for i in range(3)],
                    (GAP_M, GAP_M, GAP_M),
                    fixed=False,
                    material=rigid,
                    mask=BIT,
                )
                for side in (-1.0, 1.0)
            ]
            self.append(link.a, sphere)
            for box in boxes:
                self.append(link.b, box)


def _check(scene, link):
    """Refuse a link on blocks that turn or are guided."""
    for block in (scene.blocks[link.a], scene.blocks[link.b]):
        guided = block.free and block.motion is not None
        if guided or set(block.free) & set(DOFS[3:]):
            raise ValueError(f"link '{link.name}': block '{block.name}' is guided or can turn")
