"""Nodes that have slid past the rim of their face: they are released for good.

Rims stand in `scene.notes["rims"]`, see `faces`. If such a node belongs to one of the blocks in
`scene.notes["debris"]`, that block has come out of its slot: it falls, and takes no further part;
not so for the joints listed in `scene.notes["partial"]`, whose face is only a part of the slot.
"""

import math
from operator import mul
from typing import Any

import numpy as np

from yade_scripts.engine.bonds import safe_wait, separate
from yade_scripts.engine.poses import rotation
from yade_scripts.model.scene import DOFS

RELEASE_CHECK_S = 4e-3


class Releases:
    """Releases nodes that have slid past the rim of their face; called between steps.

    `released` has (time_s, node) in that order.
    """

    def __init__(self, scene, omega, state_of_block, node_body, bonds):
        """Find the nodes of `scene` whose joint has a rim."""
        self.visit: Any = None
        self.period, self.before = round(RELEASE_CHECK_S / omega.dt), 0.0
        nodes, rims = scene.nodes, scene.notes["rims"]
        self.bonds, self.body_of = bonds, state_of_block
        self.debris = {scene.index(name) for name in scene.notes.get("debris", ())}
        self.touching = {
            k: np.flatnonzero((nodes.a == k) | (nodes.b == k)).tolist() for k in self.debris
        }
        self.omega, self.node_body, self.released = omega, node_body, []
        names = [scene.joints[j] for j in nodes.joint]
        self.node = [i for i, name in enumerate(names) if name in rims]
        partial = set(scene.notes.get("partial", ()))
        self.partial = {i for i in self.node if names[i] in partial}
        used = sorted({int(k) for i in self.node for k in (nodes.a[i], nodes.b[i])})
        self.states = {k: omega.bodies[state_of_block[k]].state for k in used}
        # a clump's frame may be turned by half a turn about an axis; blocks start unturned
        self.home = {k: state.ori.inverse() for k, state in self.states.items()}
        self.start = {k: tuple(state.pos) for k, state in self.states.items()}
        self.arm, self.direction, self.edge = {}, {}, {}
        self.of_pair: dict[tuple, list] = {}
        self.slack: dict[tuple, float] = {}  # of the nearest node, when the pair was last checked
        self.checked: dict[tuple, tuple] = {}  # where the pair was then
        self.last: dict[tuple, tuple] = {}  # where it was at the last call
        self.reach: dict[tuple, float] = {}
        for i in self.node:
            a, b = pair = int(nodes.a[i]), int(nodes.b[i])
            self.arm[i] = (nodes.position_m[i] - np.array(scene.blocks[a].centre_m)).tolist()
            direction, edge = rims[names[i]]
            self.direction[i] = tuple(direction)
            self.edge[i] = edge - float(np.dot(direction, scene.blocks[b].centre_m))
            slack = edge - float(np.dot(direction, nodes.position_m[i]))
            self.of_pair.setdefault(pair, []).append(i)
            self.slack[pair] = min(slack, self.slack.get(pair, slack))
            self.checked[pair] = self.last[pair] = (0.0,) * 5
            for k in pair:
                away = math.dist(nodes.position_m[i], scene.blocks[k].centre_m)
                self.reach[pair] = max(away, self.reach.get(pair, 0.0))

    def __call__(self):
        """Release what has passed its rim, in the frame of the block that has the rim."""
        places, turns, moved = {}, {}, {}
        for k, state in self.states.items():
            p, q, turn = state.pos, self.start[k], state.ori * self.home[k]
            places[k] = p[0], p[1], p[2]
            turns[k] = x, y, z, w = turn[0], turn[1], turn[2], turn[3]
            angle = 2.0 * math.copysign(math.hypot(x, y, z), x * w)  # q and −q are the same
            moved[k] = p[0] - q[0], p[1] - q[1], p[2] - q[2], angle
        wait, elapsed = math.inf, max(self.omega.time - self.before, self.omega.dt)
        for pair in list(self.of_pair):
            (a, b), reach = (moved[k] for k in pair), self.reach[pair]
            now = a[0] - b[0], a[1] - b[1], a[2] - b[2], reach * a[3], reach * b[3]
            # no need to look closely before a good part of the way is done
            left = 0.5 * self.slack[pair] - math.dist(now, self.checked[pair])
            if left < 0.0:
                self.checked[pair] = now
                self.slack[pair] = self._check_pair(pair, places, turns)
                left = 0.5 * self.slack[pair]
            wait = min(wait, safe_wait(left, math.dist(now, self.last[pair]) / elapsed))
            self.last[pair] = now
        self.before = self.omega.time
        if self.visit is not None and math.isfinite(wait):
            self.visit.period = self.period * max(1, int(wait / (self.period * self.omega.dt)))

    def _check_pair(self, pair, places, turns):
        """Release what has passed its rim; return how far the next node of a pair is from it."""
        (a, b), least = pair, math.inf
        gap = [p - q for p, q in zip(places[a], places[b], strict=True)]
        turn, back = rotation(turns[a]), rotation(turns[b])
        for i in [i for i in self.of_pair.get(pair, ()) if i in self.node]:
            arm, out, left = self.arm[i], self.direction[i], self.edge[i]
            for row in (0, 1, 2):
                left -= sum(map(mul, back[3 * row : 3 * row + 3], out)) * (
                    gap[row] + sum(map(mul, turn[3 * row : 3 * row + 3], arm))
                )
            if left >= 0.0:
                least = min(least, left)
                continue
            loose = set() if i in self.partial else self.debris.intersection(pair)
            for block in loose:
                self._let_fall(block)
            if not loose:
                self._release(i)
        return least

    def _release(self, i):
        separate(self.omega, {self.node_body[i]})
        if i in self.node:
            self.node.remove(i)
        self.released.append((float(self.omega.time), i))

    def _let_fall(self, block):
        """Release every node of a block and leave it where it is, without part in the rest."""
        if self.bonds is not None:
            self.bonds.end(self.touching[block])
        for i in self.touching[block]:
            self._release(i)
        self.of_pair = {pair: nodes for pair, nodes in self.of_pair.items() if block not in pair}
        self.debris.discard(block)
        state = self.omega.bodies[self.body_of[block]].state
        state.blockedDOFs = DOFS
        state.vel = state.angVel = (0.0, 0.0, 0.0)
