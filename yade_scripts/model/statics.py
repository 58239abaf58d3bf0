"""Where the pieces of a façade rest under their weight and loads, before anything shakes them.

Where loads stand off the middle of a joint its pieces lean and the joint may open. At rest the
forces of nodes, ties, floors and weight on every piece are in balance; its pose is found by
Newton's method, with the rates of these forces by differences. Nothing is linear but the law of
each: nodes that may only push, ties that only pull, what slides, and the lever of a weight that
leans. Joints of courses have springs that are even along them (note "even" of the scene): two
points by Gauss's rule on what is pressed of one have their force and moment. Masses that walls hang
on, and floors with a mass of their own, stand where they are.

What joints bear along themselves is found as if it had grown from the upright; a run starts without
it, and slips by T/ks, some millionths of the thickness, to have it again.
"""

from dataclasses import replace

import numpy as np

from yade_scripts.model.rest import DoesNotStandError
from yade_scripts.model.scene import DOFS, DRY

PLANE = [DOFS.index(letter) for letter in "yzX"]
BALANCE = 1e-6  # of all weights: forces are in balance, and moments with the thickness as lever
STEP = 1e-6  # of W/Σkn, and of that over the thickness, by which rates of forces are taken
STEPS, SHORTER = 60, 12  # Newton's, and halves of each


def rotated(cosine, sine, vector):
    """Vectors (y, z) turned about x, by the cosines and sines of angles."""
    y, z = vector[:, 0], vector[:, 1]
    return np.column_stack([cosine * y - sine * z, sine * y + cosine * z])


class Balance:
    """Forces in the plane on the blocks of a scene at rest, by their pose.

    A pose has y, z [m] of each block's centroid from its reference place and its rotation about
    x [rad], shape (blocks, 3).
    """

    def __init__(self, scene):
        """Of the scene's nodes, ties, floors and weights."""
        self.scene, nodes = scene, scene.nodes
        self.centre_m = np.array([block.centre_m[1:] for block in scene.blocks], float)
        self.weight_n = scene.gravity_m_s2 * np.array([block.mass_kg for block in scene.blocks])
        even = [k for k, name in enumerate(scene.joints) if name in scene.notes.get("even", ())]
        lines = [np.flatnonzero((nodes.joint == k) & (nodes.kind == DRY)) for k in even]
        lines = [mine for mine in lines if mine.size > 1]
        pairs = [mine[np.lexsort(nodes.position_m[mine].T)[[0, -1]]] for mine in lines]
        ends = np.ravel(np.array(pairs, int).reshape(-1, 2).T)  # all first ones, all last ones
        sums = [np.tile([k[mine].sum() for mine in lines], 2) for k in (nodes.kn_n_m, nodes.ks_n_m)]
        self.ends = nodes.select(ends, kn_n_m=sums[0], ks_n_m=sums[1])
        summed = np.concatenate([np.zeros(0, int), *lines])
        self.single = nodes.select(np.setdiff1d(np.arange(len(nodes)), summed))

    def start(self):
        """Pose in which the scene has its blocks."""
        return np.array([[*b.displacement_m[1:], b.rotation_rad[0]] for b in self.scene.blocks])

    def _moved(self, pose, blocks, place_m):
        """By how much points of blocks, given in the reference position, have moved in a pose."""
        arm, angle = place_m - self.centre_m[blocks], pose[blocks, 2]
        less = -2.0 * np.sin(0.5 * angle) ** 2  # cos − 1, to the last digit
        return pose[blocks, :2] + rotated(less, np.sin(angle), arm)

    def _push(self, total, pose, blocks, force, place_m):
        """Add forces at places to those on blocks, with their moments."""
        arm = place_m - self.centre_m[blocks] - pose[blocks, :2]
        moment = arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
        np.add.at(total, blocks, np.column_stack([force, moment]))

    def __call__(self, pose):
        """Force along y and z [N] and moment about x [N·m] on each block, shape (blocks, 3)."""
        total = np.zeros(pose.shape)
        total[:, 1] = -self.weight_n
        self._nodes(total, pose, self.single)
        self._nodes(total, pose, self._pressed(pose))
        for tie in self.scene.ties:
            ends = [([tie.a], np.array([tie.end_a_m[1:]])), ([tie.b], np.array([tie.end_b_m[1:]]))]
            a, b = (end + self._moved(pose, block, end) for block, end in ends)
            length = float(np.linalg.norm(a - b))
            pull = tie.stiffness_n_m * (length - tie.length_m - tie.slack_m)
            pull = min(max(pull, 0.0), tie.capacity_n)
            self._push(total, pose, [tie.a], (b - a) * (pull / length), a)
        for floor in self.scene.floors:
            place = np.array([floor.position_m[1:]])
            moved = self._moved(pose, [floor.a], place)
            past = moved[0, 0] - pose[floor.b, 0] - floor.from_m
            held = min(max(floor.stiffness_n_m * past, -floor.capacity_n), floor.capacity_n)
            self._push(total, pose, [floor.a], np.array([[-held, -floor.load_n]]), place + moved)
        return total

    def _apart(self, pose, nodes):
        """Where nodes are, how far from their planes along its normal and across it [m], and both.

        What they meet is on b; distance along the plane grows from the reference position.
        """
        place, normal = nodes.position_m[:, 1:], nodes.normal[:, 1:]
        gap, turn = nodes.gap_m[:, None] * normal, pose[nodes.b, 2]
        moved = self._moved(pose, nodes.a, place)
        apart = moved - self._moved(pose, nodes.b, place - gap) + gap
        normal = rotated(np.cos(turn), np.sin(turn), normal)
        along = np.column_stack([-normal[:, 1], normal[:, 0]])
        past, slip = (np.einsum("ni,ni->n", axis, apart) for axis in (normal, along))
        return place + moved, past, slip, normal, along

    def _pressed(self, pose):
        """Two nodes on what is pressed of each even joint; where nothing is, without stiffness.

        Penetration is linear along a joint.
        """
        ends = self.ends
        first, last = np.split(-self._apart(pose, ends)[1], 2)
        zero = np.clip(first / np.where(first == last, np.inf, first - last), 0.0, 1.0)
        low = np.where(first > 0.0, 0.0, zero)
        high = np.where(last > 0.0, 1.0, zero)
        share = np.where(np.maximum(first, last) > 0.0, high - low, 0.0)
        middle, half = 0.5 * (low + high), 0.5 * share
        at = np.concatenate([middle - half / np.sqrt(3.0), middle + half / np.sqrt(3.0)])
        start, end = np.split(ends.position_m, 2)
        place = np.tile(start, (2, 1)) + at[:, None] * np.tile(end - start, (2, 1))
        half = np.tile(half, 2)
        first, last = np.split(ends.gap_m, 2)
        gap = np.tile(first, 2) + at * np.tile(last - first, 2)
        stiff = {"kn_n_m": half * ends.kn_n_m, "ks_n_m": half * ends.ks_n_m}
        return ends.select(slice(None), position_m=place, gap_m=gap, **stiff)

    def _nodes(self, total, pose, nodes):
        """Add the forces of some nodes; those along a joint grow from the reference position."""
        at, past, slip, normal, along = self._apart(pose, nodes)
        push, shear, dry = -nodes.kn_n_m * past, -nodes.ks_n_m * slip, nodes.kind == DRY
        push = np.where(dry, np.maximum(push, 0.0), push)
        most = np.where(dry, np.tan(nodes.friction_rad) * push, np.inf)
        shear = np.clip(shear, -most, most)
        force = push[:, None] * normal + shear[:, None] * along
        self._push(total, pose, nodes.a, force, at)
        self._push(total, pose, nodes.b, -force, at)


def resting(scene):
    """A scene of pieces with these where they rest under weight and loads; as it is if they do.

    DoesNotStandError of one line where they have no such place.
    """
    balance, linked = Balance(scene), {i for link in scene.links for i in (link.a, link.b)}
    free = [
        (i, k)
        for i, block in enumerate(scene.blocks)
        for k, dof in enumerate(PLANE)
        if DOFS[dof] in block.free and i not in linked
    ]
    rows, columns = np.array(free).T
    weight = balance.weight_n[np.unique(rows)].sum() + sum(x.load_n for x in scene.floors)
    turns, sunk_m = columns == 2, weight / scene.nodes.kn_n_m.sum()
    scale = np.where(turns, weight * scene.thickness_m, weight)
    step = STEP * np.where(turns, sunk_m / scene.thickness_m, sunk_m)

    def left(moved):
        pose = balance.start()
        pose[rows, columns] += moved
        return balance(pose)[rows, columns] / scale

    moved = _balanced(left, step)
    if not moved.any():
        return scene
    pose = balance.start()
    pose[rows, columns] += moved
    blocks = list(scene.blocks)
    for i in np.unique(rows):
        (y, z, turn), block = pose[i].tolist(), blocks[i]
        place = (block.displacement_m[0], y, z)
        blocks[i] = replace(block, displacement_m=place, rotation_rad=(turn, 0.0, 0.0))
    return replace(scene, blocks=blocks)


def _balanced(left, differences):
    """Root of `left` by Newton's method from nothing; a step is halved until less is left.

    `differences` are those of each unknown by which rates are taken.
    """
    moved = np.zeros(differences.size)
    now = left(moved)
    for _ in range(STEPS):
        if np.abs(now).max() <= BALANCE:
            return moved
        rates = [(left(moved + row) - now) / row.sum() for row in np.diag(differences)]
        try:
            step = -np.linalg.solve(np.transpose(rates), now)
        except np.linalg.LinAlgError:  # something has come loose
            break
        for _ in range(SHORTER):
            after = left(moved + step)
            if np.linalg.norm(after) < np.linalg.norm(now):
                break
            step = 0.5 * step
        moved, now = moved + step, left(moved + step)
    raise DoesNotStandError(
        "facade: its pieces do not stand under weight and loads; expected loads and thrusts nearer "
        "the middle of its thickness, or what holds it"
    )
