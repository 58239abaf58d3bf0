"""What links, ties, floors and welded nodes have in common in YADE: massless bodies on blocks."""

from yade_scripts.model.scene import DOFS


class Attached:
    """Massless bodies of one kind that move with blocks, and the law between them.

    `members` has YADE's ids by block; geometry, physics and law are functors for the interaction
    loop, none where a scene needs none.
    """

    def __init__(self, w, utils, omega, scene):
        """Append the bodies; `join` follows once the engines stand and blocks are in place."""
        self.w, self.utils, self.omega, self.scene = w, utils, omega, scene
        self.members: dict[int, list] = {}
        self.geometry, self.physics, self.law = [], [], []
        self.place()

    def place(self):
        """Append what the scene has of this kind."""
        raise NotImplementedError

    def join(self):
        """Make contacts that no collider finds."""

    def append(self, block, body):
        """Append a body that moves with block number `block`; return its YADE id."""
        number = self.omega.bodies.append(body)
        body.state.mass, body.state.inertia = 0.0, (0.0, 0.0, 0.0)
        if not self.scene.blocks[block].free:
            body.state.blockedDOFs = DOFS
        self.members.setdefault(block, []).append(number)
        return number

    def cohesive(self, **kind):
        """Material of spheres whose contacts YADE keeps whatever their normal force."""
        material = self.w.CohFrictMat(
            density=1e-30,
            young=1.0,
            poisson=0.3,
            isCohesive=True,
            momentRotationLaw=False,
            normalCohesion=1e30,
            shearCohesion=1e30,
            **kind,
        )
        self.omega.materials.append(material)
        return material

    def between_cohesive(self):
        """Take the functors of contacts between such spheres."""
        w = self.w
        self.geometry = [w.Ig2_Sphere_Sphere_ScGeom6D(updateRotations=False)]
        self.physics = [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)]
        self.law = [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]
