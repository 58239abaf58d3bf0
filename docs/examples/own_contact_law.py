"""Another contact law: the wall of `scene_by_hand` on Hertz's contacts, in YADE.

    PYTHONPATH=. /usr/bin/python3 docs/examples/own_contact_law.py

YADE's own functors take the place of the interaction loop before the first step: normal force
k δ^1.5 at each node, Mindlin's shear, Coulomb friction, no dashpots. Nodes and faces stay.
"""

import math

from scene_by_hand import MASS_KG, let_go, standing, told

from yade_scripts.engine.library import load_yade
from yade_scripts.model.gravity import GRAVITY_M_S2

YOUNG_PA, POISSON, RADIUS_M = 2e12, 0.2, 1e-3  # of a node's sphere, which stands for its joint
K_N_M15 = 2.0 / 3.0 * YOUNG_PA / (1.0 - POISSON**2) * math.sqrt(0.5 * RADIUS_M)  # two alike
WEIGHT_N = MASS_KG * GRAVITY_M_S2
STEP_S = 5e-6  # of our own: the critical step of the project is that of linear springs


def depth_m(nodes):
    """How deep so many nodes are pressed by the wall's weight, (W/(n k))^(2/3) [m]."""
    return (WEIGHT_N / (nodes * K_N_M15)) ** (2.0 / 3.0)


def hertzian(built, damping=0.0):
    """Give nodes and faces another material, and the interaction loop another law.

    Parameters
    ----------
    built : adapter.Built
    damping : float
        Of YADE's integrator, for a wall that is to come to rest.
    """
    w, omega = load_yade(), built.omega
    material = w.FrictMat(
        density=1e-12, young=YOUNG_PA, poisson=POISSON, frictionAngle=math.radians(35.0)
    )
    omega.materials.append(material)
    for body in omega.bodies:
        if body.shape and not body.isClump:
            body.material = material
    loop = w.InteractionLoop(
        [w.Ig2_Box_Sphere_ScGeom()],
        [w.Ip2_FrictMat_FrictMat_MindlinPhys()],
        [w.Law2_ScGeom_MindlinPhys_Mindlin()],
    )
    omega.engines = [loop if type(e) is w.InteractionLoop else e for e in omega.engines]
    next(e for e in omega.engines if type(e) is w.NewtonIntegrator).damping = damping


def settled():
    """How deep the nodes of the upright wall are pressed when it has come to rest [m]."""
    kept = []

    def setup(built):
        hertzian(built, damping=0.4)
        kept.append(built)

    let_go(standing(), 0.3, setup, STEP_S)
    depths = [i.geom.penetrationDepth for i in kept[0].omega.interactions]
    return sum(depths) / len(depths), len(depths)


def rocking(ratio, limit_s):
    """History of the wall let go at a share of its critical angle, its toe pressed by all of it."""
    return let_go(standing(ratio, depth_m(1)), limit_s, hertzian, STEP_S)


if __name__ == "__main__":
    deep_m, nodes = settled()
    print(f"at rest {1e6 * deep_m:.2f} µm deep, closed form {1e6 * depth_m(nodes):.2f} µm")
    print(told(rocking(0.5, 2.0), 0.5))
