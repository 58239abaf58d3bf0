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
from typing import Any

import numpy as np

PRELOAD_M = 0.05  # largest compression within which a bond stays linear
NO_STIFFNESS = 1e-12  # N/m; of two materials YADE takes the larger when one of them is 0
FACE_OFFSET_M = 1e-3  # the centre stays inside both boxes, off their surfaces
CHECK_S = 5e-5  # shortest interval between checks
LONGEST_CHECK_S = 4e-3
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


def rotations(quaternions):
    """Rotation matrices of quaternions (x, y, z, w), shapes (n, 4) and (n, 3, 3)."""
    x, y, z, w = quaternions.T
    out = np.empty((len(quaternions), 3, 3))
    out[:, 0, 0] = 1 - 2 * (y * y + z * z)
    out[:, 0, 1] = 2 * (x * y - z * w)
    out[:, 0, 2] = 2 * (x * z + y * w)
    out[:, 1, 0] = 2 * (x * y + z * w)
    out[:, 1, 1] = 1 - 2 * (x * x + z * z)
    out[:, 1, 2] = 2 * (y * z - x * w)
    out[:, 2, 0] = 2 * (x * z - y * w)
    out[:, 2, 1] = 2 * (y * z + x * w)
    out[:, 2, 2] = 1 - 2 * (x * x + y * y)
    return out


def rotation(orientation):
    """Rotation matrix of one YADE quaternion, shape (3, 3)."""
    return rotations(np.array([[float(orientation[i]) for i in range(4)]]))[0]


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
    reach its strength at its present rate and under a generous acceleration, halved.

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
        self.visit: Any = None
        self.last: tuple | None = None
        n = self.node
        used = sorted(set(nodes.a[n]) | set(nodes.b[n]))
        slot = {block: k for k, block in enumerate(used)}
        self.a = np.array([slot[k] for k in nodes.a[n]])
        self.b = np.array([slot[k] for k in nodes.b[n]])
        self.states = [omega.bodies[state_of_block[k]].state for k in used]
        centres = np.array([scene.blocks[k].centre_m for k in used], float)
        # YADE's pose of a block that has not moved: a support's state sits on one of its
        # faces, and a clump's frame may be turned by half a turn about an axis.
        self.shift, self.home_t = np.zeros((len(used), 3)), np.zeros((len(used), 3, 3))
        for k, (block, state) in enumerate(zip(used, self.states, strict=True)):
            moved = scene.blocks[block]
            place = np.array([float(v) for v in state.pos]) - moved.displacement_m
            self.shift[k] = place - moved.centre_m
            turned = rotation_matrix(moved.rotation_rad)
            self.home_t[k] = (turned.T @ rotation(state.ori)).T
        self.arm_a = (nodes.position_m[n] - centres[self.a])[:, :, None]
        self.arm_b = (nodes.position_m[n] - centres[self.b])[:, :, None]
        self.normal = nodes.normal[n][:, :, None]
        self.kn, self.ks = nodes.kn_n_m[n], nodes.ks_n_m[n]
        self.tension, self.cohesion = nodes.tension_n[n], nodes.cohesion_n[n]
        self.slope = np.tan(nodes.friction_rad[n])
        self.tie = np.array([is_tie(nodes, i) for i in n])
        self.shear_ks = np.where(self.tie, 0.0, self.ks)
        self.start = self._relative()[0]  # slip counts from here, penetration from the plane

    def _relative(self):
        """Displacement of each node on a relative to b, and the normal turned with b."""
        rows = []
        for state in self.states:
            p, q = state.pos, state.ori
            rows.append((p[0], p[1], p[2], q[0], q[1], q[2], q[3]))
        poses = np.array(rows)
        place = poses[:, :3] - self.shift
        turn = rotations(poses[:, 3:]) @ self.home_t
        turn_b = turn[self.b]
        delta = (turn[self.a] @ self.arm_a)[:, :, 0] - (turn_b @ self.arm_b)[:, :, 0]
        delta += place[self.a] - place[self.b]
        return delta, (turn_b @ self.normal)[:, :, 0]

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
        if self.visit is not None:
            self._schedule(margin)

    def _schedule(self, margin):
        """Set the next check from the distance to the nearest strength and its rate [m, m/s]."""
        if not self.intact.any():
            self.visit.period = math.inf
            return
        now = float(self.omega.time)
        kept = self.intact & np.isfinite(margin)
        wait = CHECK_S
        if self.last is not None and now > self.last[0]:
            left = np.maximum(margin[kept], 0.0)
            rate = np.abs(margin[kept] - self.last[1][kept]) / (now - self.last[0])
            reach = np.minimum(left / (rate + 1e-9), np.sqrt(2.0 * left / REFERENCE_ACCELERATION))
            wait = min(max(0.5 * float(reach.min()), CHECK_S), LONGEST_CHECK_S)
        self.last = (now, margin)
        self.visit.period = max(1, int(wait / self.omega.dt))

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
            (press, self.dead),
            (hook, self.dead),
            (plain, self.materials[node]),
        ):
            set_material(self.omega.bodies[sphere], material)
        self.intact[k] = False
        self.broken.append((float(self.omega.time), node))
