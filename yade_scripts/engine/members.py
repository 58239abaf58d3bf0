"""What ties, floors, links and welded nodes have in common in YADE, and the engine of a motion."""

from yade_scripts.model.motion import numbers
from yade_scripts.model.scene import DOFS


def append(omega, scene, block, body, members):
    """Append a massless body that moves with a block; return its YADE id.

    Parameters
    ----------
    omega : Omega
    scene : Scene
    block : int
        Its number in the scene.
    body : Body
    members : dict of int to list of int
        YADE ids by block, to which its own is added.
    """
    number = omega.bodies.append(body)
    body.state.mass, body.state.inertia = 0.0, (0.0, 0.0, 0.0)
    if not scene.blocks[block].free:
        body.state.blockedDOFs = DOFS
    members.setdefault(block, []).append(number)
    return number


def cohesive(w, **kind):
    """Material of spheres whose contacts YADE keeps whatever their normal force."""
    return w.CohFrictMat(
        density=1e-30,
        young=1.0,
        poisson=0.3,
        isCohesive=True,
        momentRotationLaw=False,
        normalCohesion=1e30,
        shearCohesion=1e30,
        **kind,
    )


def cohesive_functors(w):
    """Geometry, physics and law of the interaction loop between such spheres."""
    return (
        [w.Ig2_Sphere_Sphere_ScGeom6D(updateRotations=False)],
        [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)],
        [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment()],
    )


def force(w, motion, mass_kg, axis, ids):
    """Engine of the force mass·a along an axis (0, 1, 2) on each body; a is the motion's."""
    return w.InterpolatingDirectedForceEngine(
        times=numbers(motion.time_s),
        magnitudes=(mass_kg * motion.acceleration_m_s2).tolist(),
        direction=tuple(int(i == axis) for i in range(3)),
        ids=ids,
        wrap=False,
    )


def set_back(state, axis, acceleration_m_s2, dt_s):
    """Take a body's velocity half a step back, where velocities live, under its acceleration."""
    velocity = list(state.vel)
    velocity[axis] -= 0.5 * dt_s * float(acceleration_m_s2)
    state.vel = tuple(velocity)
