"""Bonded contact nodes in YADE: elastic both ways until they break, dry afterwards.

A bonded node is three spheres at the same point of block a:

press  in front of a face of b, penetrating by a preload length
hook   behind an opposite face of b, penetrating by the same length
plain  the dry unilateral node, without stiffness until the bond breaks

Press and hook carry kn/2, ks/2, β·kn/2 and β·ks/2 each. Their preloads cancel, and
while neither opens the pair is a linear spring and dashpot in both normal directions
and in shear: exactly the node that `stiffness` assembles, counted once. The centres
coincide, so the preloads exert no couple when the block turns. (YADE's CohFrict law
would need a parallel dashpot, doubling the stiffness in compression.)

The bond breaks, with strengths over the node's own tributary area, when

    −N ≥ tension_n    or    |T| ≥ cohesion_n + max(0, N)·tan φ,

with N = kn·penetration and T = ks·slip from the poses of the two blocks. The
stiffness of press and hook then passes to plain, which starts without shear: what the
bond stored in tension and shear is dissipated, the energy in compression stays. A node with tension
but neither cohesion nor friction is a tie: no shear at all.
"""

import math

import numpy as np

PRELOAD_M = 0.05  # largest compression within which a bond stays linear
FACE_OFFSET_M = 1e-3  # the centre stays inside both boxes, off their surfaces
CHECK_S = 5e-5  # shortest interval between checks
LONGEST_CHECK_S = 1e-3
REFERENCE_ACCELERATION = 50.0  # m/s²: bound on relative acceleration between two checks


def is_tie(nodes, i):
    """Tell whether a bonded node transmits no shear (neither cohesion nor friction)."""
    return bool(nodes.cohesion_n[i] == 0.0 and nodes.friction_rad[i] == 0.0)


def rotation_matrix(vector):
    """Rotation matrix of a rotation vector, shape (3, 3) (Rodrigues' formula)."""
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = np.asarray(vector) / angle
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * (k @ k)


def rotation(orientation):
    """Rotation matrix of a YADE quaternion (x, y, z, w), shape (3, 3)."""
    x, y, z, w = (float(orientation[i]) for i in range(4))
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def set_material(body, material):
    """Give a node sphere another ViscElMat, in its present contacts too, without shear."""
    body.material = material
    for contact in body.intrs():
        phys = contact.phys
        phys.kn, phys.ks = material.kn, material.ks
        phys.cn, phys.cs = material.cn, material.cs
        phys.tangensOfFrictionAngle = math.tan(material.frictionAngle)
        phys.shearForce = (0.0, 0.0, 0.0)


class Bonds:
    """Follows the bonded nodes of a built scene and breaks them; called by a PyRunner.

    Between checks the pose is left alone for as long as the nearest bond cannot
    reach its strength at the present relative speed, halved for safety.

    Attributes
    ----------
    intact : ndarray of bool, shape (n_bonded,)
    broken : list of (time_s, node)
        In the order of breaking.
    """

    def __init__(self, scene, omega, state_of_block, spheres, materials, dead):
        """Take over the bonded nodes.

        Parameters
        ----------
        scene : Scene
        omega : Omega
        state_of_block : list of int
            YADE id whose state carries each block's pose.
        spheres : dict of int to tuple of int
            Node index to YADE ids (press, hook, plain).
        materials : dict of int to ViscElMat
            Node index to the material that wakes its plain sphere.
        dead : ViscElMat
            Material without stiffness: the contact stays in YADE's lists but carries nothing.
        """
        nodes = scene.nodes
        self.omega, self.spheres = omega, spheres
        self.materials, self.dead = materials, dead
        self.node = np.array(sorted(spheres), int)
        self.intact = np.ones(len(self.node), bool)
        self.broken = []
        self.runner = None
        n = self.node
        used = sorted(set(nodes.a[n]) | set(nodes.b[n]))
        slot = {block: k for k, block in enumerate(used)}
        self.a = np.array([slot[k] for k in nodes.a[n]])
        self.b = np.array([slot[k] for k in nodes.b[n]])
        self.states = [omega.bodies[state_of_block[k]].state for k in used]
        centres = np.array([scene.blocks[k].centre_m for k in used], float)
        # YADE's pose of a block that has not moved: a support's state sits on one of its
        # faces, and a clump's frame may be turned by half a turn about an axis.
        self.shift, self.home = np.zeros((len(used), 3)), []
        for k, (block, state) in enumerate(zip(used, self.states, strict=True)):
            moved = scene.blocks[block]
            place = np.array([float(v) for v in state.pos]) - moved.displacement_m
            self.shift[k] = place - moved.centre_m
            turned = rotation_matrix(moved.rotation_rad)
            self.home.append(turned.T @ rotation(state.ori))
        self.arm_a = nodes.position_m[n] - centres[self.a]
        self.arm_b = nodes.position_m[n] - centres[self.b]
        self.normal = nodes.normal[n]
        self.kn, self.ks = nodes.kn_n_m[n], nodes.ks_n_m[n]
        self.tension, self.cohesion = nodes.tension_n[n], nodes.cohesion_n[n]
        self.slope = np.tan(nodes.friction_rad[n])
        self.tie = np.array([is_tie(nodes, i) for i in n])
        self.shear_ks = np.where(self.tie, 0.0, self.ks)
        self.turning = [bool(scene.blocks[block].free) for block in used]
        self.reach_a = float(np.linalg.norm(self.arm_a, axis=1).max())
        self.reach_b = float(np.linalg.norm(self.arm_b, axis=1).max())
        self.pairs = [
            (a, b, np.flatnonzero((self.a == a) & (self.b == b)))
            for a, b in sorted(set(zip(self.a.tolist(), self.b.tolist(), strict=True)))
        ]
        self.start = self._relative()[0]  # slip counts from here, penetration from the plane

    def _relative(self):
        """Displacement of each node on a relative to b, and the normal turned with b."""
        delta, unit = np.empty((len(self.node), 3)), self.normal.copy()
        turns, places = [], []
        for state, home, shift, turns_ in zip(
            self.states, self.home, self.shift, self.turning, strict=True
        ):
            turns.append(rotation(state.ori) @ home.T if turns_ else None)
            p = state.pos
            places.append(np.array((p[0], p[1], p[2])) - shift)
        for a, b, part in self.pairs:
            relative = self.arm_a[part] @ turns[a].T + (places[a] - places[b])
            if turns[b] is None:
                relative -= self.arm_b[part]
            else:
                relative -= self.arm_b[part] @ turns[b].T
                unit[part] = self.normal[part] @ turns[b].T
            delta[part] = relative
        return delta, unit

    def forces(self):
        """Normal force (compression positive) and shear force of each bond, as if intact.

        Returns
        -------
        normal, shear : ndarray, shape (n_bonded,)
            [N]; shear is a magnitude, 0 for ties.
        """
        delta, unit = self._relative()
        opening = (delta * unit).sum(axis=1)
        slip = delta - self.start
        slip -= (slip * unit).sum(axis=1)[:, None] * unit
        return -self.kn * opening, self.shear_ks * np.sqrt((slip * slip).sum(axis=1))

    def __call__(self):
        """Break what has reached its strength; set the interval to the next check."""
        normal, shear = self.forces()
        limit = self.cohesion + self.slope * np.maximum(normal, 0.0)
        pull_margin = (self.tension + normal) / self.kn
        shear_margin = (limit - shear) / self.ks
        shear_margin[self.tie] = np.inf
        margin = np.minimum(pull_margin, shear_margin)
        over = self.intact & (margin <= 0.0)
        if over.any():
            for k in np.flatnonzero(over):
                self._break(k)
        if self.runner is not None:
            self._schedule(margin)

    def _schedule(self, margin):
        """Set the next check from the distance to the nearest strength [m]."""
        if not self.intact.any():
            self.runner.dead = True
            return
        left = max(0.0, float(margin[self.intact].min()))
        speeds, spins = [], []
        for state in self.states:
            v, w = state.vel, state.angVel
            speeds.append((v[0], v[1], v[2]))
            spins.append((w[0] ** 2 + w[1] ** 2 + w[2] ** 2) ** 0.5)
        speed = 1e-12
        for a, b, part in self.pairs:
            if self.intact[part].any():
                linear = math.dist(speeds[a], speeds[b])
                turning = spins[a] * self.reach_a + spins[b] * self.reach_b
                speed = max(speed, linear + turning)
        wait = 0.5 * min(left / speed, math.sqrt(2.0 * left / REFERENCE_ACCELERATION))
        wait = min(max(wait, CHECK_S), LONGEST_CHECK_S)
        self.runner.iterPeriod = max(1, int(wait / self.omega.dt))

    def end(self, nodes):
        """Take the bonds of some nodes out of the scene, broken or not; not counted as broken."""
        for k in np.flatnonzero(np.isin(self.node, nodes)):
            for sphere in self.spheres[int(self.node[k])]:
                set_material(self.omega.bodies[sphere], self.dead)
            self.intact[k] = False

    def _break(self, k):
        """Take the stiffness of press and hook away and give it to the plain node."""
        node = int(self.node[k])
        press, hook, plain = self.spheres[node]
        for sphere, material in (
            (press, self.dead), (hook, self.dead), (plain, self.materials[node]),
        ):  # fmt: skip
            set_material(self.omega.bodies[sphere], material)
        self.intact[k] = False
        self.broken.append((float(self.omega.time), node))
