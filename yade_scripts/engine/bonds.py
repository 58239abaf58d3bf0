"""Bonded contact nodes in YADE: elastic both ways until they break, dry afterwards.

A bonded node is three spheres at the same point of block a:

press  in front of a face of b, penetrating by a preload length
hook   behind an opposite face of b, penetrating by the same length
plain  the dry unilateral node, which touches nothing until the bond breaks

Press and hook carry kn/2, ks/2, β·kn/2 and β·ks/2 each. Their preloads cancel, and
while neither opens the pair is a linear spring and dashpot in both normal directions
and in shear: the node that `stiffness` assembles, counted once. The centres
coincide, so the preloads exert no couple when the block turns. (YADE's CohFrict law
would need a parallel dashpot, doubling the stiffness in compression.)

The bond breaks, with strengths over the node's own tributary area, when

    −N ≥ tension_n    or    |T| ≥ cohesion_n + max(0, N)·tan φ,

with N = kn·penetration and T = ks·slip from the poses of the two blocks. Press and hook then part
from their faces and plain meets its own, without shear: what the bond stored in tension and shear
is dissipated, the energy in compression stays. A node with tension but neither cohesion nor
friction is a tie: no shear at all.
"""

import math
from heapq import heappop, heappush
from typing import Any

import numpy as np

from yade_scripts.engine.poses import quaternion, rotation, vector

# Largest compression within which a bond stays linear. Press and hook act half of it off the node
# on either side, so their shear springs resist a turn of the joint about it by ks·(preload/2)².
PRELOAD_M = 0.005
NO_STIFFNESS = 1e-12  # N/m; of two materials YADE takes the larger when one of them is 0
FACE_OFFSET_M = 1e-3  # the centre stays inside both boxes, off their surfaces
CHECK_S = 5e-5  # shortest interval between checks
LONGEST_CHECK_S = 4e-3
REFERENCE_ACCELERATION = 50.0  # m/s²: bound on relative acceleration between two checks
PER_BOND = ("node", "matrix", "constant", "kn", "ks", "tension", "cohesion", "slope", "tie")


def _frame(normal):
    """Rows: the unit normal and two unit vectors across it."""
    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    first /= np.linalg.norm(first)
    return np.array([normal, first, np.cross(normal, first)])


def safe_wait(left_m, speed_m_s):
    """Half the time [s] to move so far, at this speed or under REFERENCE_ACCELERATION from rest."""
    return 0.5 * min(left_m / (speed_m_s + 1e-9), math.sqrt(2.0 * left_m / REFERENCE_ACCELERATION))


def separate(omega, spheres):
    """Take node spheres out of all contacts for good: YADE no longer looks at their pairs.

    YADE keeps an erased pair whose boxes overlap, unless all open pairs go: the others come back.
    """
    from yade import utils

    near = []
    for sphere in spheres:
        omega.bodies[sphere].mask = 0
    for contact in omega.interactions.all():
        pair = contact.id1, contact.id2
        if not spheres.isdisjoint(pair):
            omega.interactions.erase(*pair)
        elif not contact.isReal:
            near.append(pair)
    omega.interactions.eraseNonReal()
    for pair in near:
        utils.createInteraction(*pair, True)


class _Pair:
    """The intact bonds between two blocks, as functions of the pose of a in the frame of b."""

    def __init__(self, scene, omega, state_of_block, a, b, nodes):
        """Take over `nodes` (indices into the scene's), all of them on block a and facing b."""
        columns, n = scene.nodes, np.asarray(nodes, int)
        self.omega, self.node, self.due, self.before = omega, n, 0, 0
        self.states, self.home, self.shift = [], [], []
        arms = []
        for index in (a, b):
            block = scene.blocks[index]
            state = omega.bodies[state_of_block[index]].state
            # YADE's pose of a block that has not moved: a support's state sits on one of its
            # faces, and a clump's frame may be turned by half a turn about an axis.
            place = np.array([float(v) for v in state.pos]) - block.displacement_m
            self.shift.append(place - block.centre_m)
            self.states.append(state)
            self.home.append(state.ori.inverse() * quaternion(block.rotation_rad))
            arms.append(columns.position_m[n] - np.array(block.centre_m, float))
        self.shift = vector(self.shift[0] - self.shift[1])
        self.reach = 2.0 * float(np.linalg.norm(arms[0], axis=1).max())  # of a unit of quaternion
        # displacement of a past b at each node, in the frame of b, is matrix @ pose + constant
        axes = np.array([_frame(normal) for normal in columns.normal[n]])
        self.matrix = np.concatenate(
            [axes, (axes[:, :, :, None] * arms[0][:, None, None, :]).reshape(len(n), 3, 9)], axis=2
        )
        self.constant = -np.einsum("nij,nj->ni", axes, arms[1])
        self.kn, self.ks = columns.kn_n_m[n], columns.ks_n_m[n]
        self.tension, self.cohesion = columns.tension_n[n], columns.cohesion_n[n]
        self.slope = np.tan(columns.friction_rad[n])
        self.tie = columns.tie[n]
        self.at = self.last = self._pose()
        self.constant[:, 1:] -= self._displacement()[:, 1:]  # slip counts from here
        self.left = 0.0

    def keep(self, mask):
        """Forget the bonds outside the mask."""
        for name in PER_BOND:
            setattr(self, name, getattr(self, name)[mask])

    def _pose(self):
        """Place of a past b, and rotation of a, both in the frame of b: two tuples."""
        (a, b), (home_a, home_b) = self.states, self.home
        back = (b.ori * home_b).inverse()
        p, q = back * (a.pos - b.pos - self.shift), back * (a.ori * home_a)
        return (p[0], p[1], p[2]), (q[0], q[1], q[2], q[3])

    def moved(self, pose, since):
        """Bound on the motion of any node between two poses [m]."""
        (p, q), (p0, q0) = pose, since
        turn = math.dist(q, q0)
        if turn > 1.0:  # q and −q are the same rotation
            turn = math.dist(q, [-v for v in q0])
        return math.dist(p, p0) + self.reach * turn

    def _displacement(self):
        """Displacement of a past b since the reference: along the normal, across, across (n, 3)."""
        place, turn = self.at
        return self.matrix @ np.array(place + rotation(turn)) + self.constant

    def forces(self):
        """Normal force (compression positive) and shear force of each bond, as if intact [N].

        The shear force is a magnitude, 0 for ties.
        """
        self.at = self._pose()
        opening, across, along = self._displacement().T
        return -self.kn * opening, np.where(self.tie, 0.0, self.ks * np.hypot(across, along))

    def margin(self):
        """How far each node may move before its bond can break [m]; not positive: it breaks."""
        normal, shear = self.forces()
        pull = (self.tension + normal) / self.kn
        limit = self.cohesion + self.slope * np.maximum(normal, 0.0)
        slide = np.where(self.tie, np.inf, (limit - shear) / (self.ks + self.slope * self.kn))
        return np.minimum(pull, slide)


class Bonds:
    """Follows the bonded nodes of a built scene and breaks them; called between steps.

    Strengths are computed when the blocks of a pair may have moved by half of what the nearest bond
    had left, and looked after again no later than half the time in which it could reach its
    strength at their present speed or under a generous acceleration.

    `spheres` has by node YADE's ids (press, hook, plain), of a broken bond (plain,); `broken`
    (time_s, node) in the order of breaking.
    """

    def __init__(self, scene, omega, state_of_block, spheres, partners):
        """Take over the bonded nodes, by `spheres`; the other ids are YADE's too.

        `state_of_block` says whose state carries each block's pose, `partners` by node id and mask
        of the face that its plain sphere will touch.
        """
        self.omega, self.spheres, self.partners = omega, spheres, partners
        self.broken = []
        self.visit: Any = None
        of_pair: dict[tuple, list] = {}
        for i in sorted(spheres):
            of_pair.setdefault((int(scene.nodes.a[i]), int(scene.nodes.b[i])), []).append(i)
        self.pairs = [
            _Pair(scene, omega, state_of_block, a, b, nodes) for (a, b), nodes in of_pair.items()
        ]
        self.queue = [(0, number) for number in range(len(self.pairs))]  # a heap: step, pair

    def __call__(self):
        """Look after the pairs that are due; set when to come again."""
        now, due = self.omega.iter, []
        while self.queue and self.queue[0][0] <= now:
            due.append(heappop(self.queue)[1])
        for number in sorted(due):
            pair = self.pairs[number]
            if len(pair.node):
                self._look_after(pair, now)
                heappush(self.queue, (pair.due, number))
        if self.visit is not None:
            self.visit.period = self.queue[0][0] - now if self.queue else math.inf

    def _look_after(self, pair, now):
        """Break the bonds of a pair that have reached their strength; set its next turn."""
        dt, pose = self.omega.dt, pair._pose()
        left = pair.left - pair.moved(pose, pair.at)
        if left <= 0.5 * pair.left:
            margin = pair.margin()
            over = margin <= 0.0
            if over.any():
                for node in pair.node[over].tolist():
                    self._break(node)
                pair.keep(~over)
                margin = margin[~over]
            left = pair.left = float(margin.min(initial=math.inf))
        speed = pair.moved(pose, pair.last) / (max(now - pair.before, 1) * dt)
        pair.last, pair.before = pose, now
        wait = min(max(CHECK_S, safe_wait(left, speed)), LONGEST_CHECK_S)
        pair.due = now + max(1, int(wait / dt))

    def end(self, nodes):
        """Take the bonds of some nodes out of the scene, broken or not; not counted as broken."""
        ended = set(self.spheres).intersection(nodes)
        separate(self.omega, {sphere for node in ended for sphere in self.spheres[node]})
        for pair in self.pairs:
            pair.keep(~np.isin(pair.node, nodes))

    def _break(self, node):
        """Part press and hook from their faces and let the plain node meet its own."""
        from yade import utils

        press, hook, plain = self.spheres[node]
        face, mask = self.partners[node]
        separate(self.omega, {press, hook})
        self.spheres[node] = (plain,)
        for sphere in (press, hook):
            self.omega.bodies.erase(sphere)  # of its clump too, which would move it at every step
        self.omega.bodies[plain].mask = mask
        utils.createInteraction(plain, face, True)
        self.broken.append((float(self.omega.time), node))
