"""The complete building by few coordinates, which runs hundreds of times as fast in its plane.

Everything behind the crack is linear, so its lowest modes and the deformations that its ends
suffer under unit forces stand for all of it (Rubin 1975, component modes with residual
attachment). Modes alone do not do: what an impact gives back hangs on how far the ends of the
walls give way, and thirty modes leave them twice as stiff. The façade before them keeps its nodes
and moves in its plane, without turning about a vertical axis.
"""

from dataclasses import dataclass, replace

import numpy as np
from rocking.collapse.scan import Scan
from rocking.solver.plane import to_plane
from rocking.solver.runs import STEP_FRACTION, Motions, stable_step
from rocking.solver.substructure import bodies
from scipy.linalg import eigh

from studies.building.modes import Solver
from studies.building.yade.complete import apart
from yade_scripts.model.floor_motions import GROUND

STEP = 0.7  # of the whole building's critical step: coordinates are no faster than what they span


@dataclass(frozen=True)
class Reduction:
    """Coordinates q of what stands behind the crack: q̈ + rate·μ q̇ + ω²q = −Γ a_g + Hᵀf.

    Attributes
    ----------
    omega : ndarray, shape (n,)
        Circular frequencies [rad/s], ascending.
    hang, lift, roll : ndarray, shape (m, n)
        H: motion of the ends along y, outward, and along z; their rotation about x.
    participation : ndarray, shape (n,)
        Γ, along y.
    moving : ndarray, shape (n,)
        μ, share of translation in the kinetic energy: the drag acts on it alone.
    ends : ndarray of int, shape (m,)
        Blocks of the scene that end at the crack behind the façade.
    """

    omega: np.ndarray
    hang: np.ndarray
    lift: np.ndarray
    roll: np.ndarray
    participation: np.ndarray
    moving: np.ndarray
    ends: np.ndarray

    def carried(self, rate_1_s):
        """`substructure.Bodies`, each scaled so that it moves no end by more than itself."""
        scale = 1.0 / np.abs(np.vstack([self.hang, self.lift])).max(axis=0)
        mass = scale**2
        return bodies(
            mass,
            np.diag(self.omega**2 * mass),
            np.diag(rate_1_s * self.moving * mass),
            self.hang * scale,
            self.lift * scale,
            self.roll * scale,
            self.participation / scale,
        )


def reduction(scene, count):
    """`Reduction` of what stands behind the crack of a scene of `complete.complete_scene`.

    To its `count` lowest modes come three residual deformations an end, under a unit force along y
    and z and under a unit moment about x. A ValueError where some block is not held.
    """
    facade, nodes = scene.index(scene.monitor), scene.nodes
    back, blocks = nodes.b == facade, list(scene.blocks)
    blocks[facade] = replace(blocks[facade], free="")
    solver = Solver(apart(replace(scene, blocks=blocks)))
    modes, ends = solver.modes(count), np.unique(nodes.a[back])
    # motion along y, then along z, of the middle of an end's nodes, then rotation about x
    pick = np.zeros((len(solver.mass), 3 * len(ends)))
    for column, end in enumerate(ends):
        x, y, z = _middle(nodes, back & (nodes.a == end)) - blocks[end].centre_m
        parts = ((1, 1.0), (3, -z), (5, x)), ((2, 1.0), (3, y), (4, -x)), ((3, 1.0),)
        for axis, part in enumerate(parts):
            for freedom, share in part:
                equation = (solver.dof == (end, freedom)).all(axis=1)
                pick[equation, column + axis * len(ends)] = share
    static = np.stack([solver.static(force) for force in pick.T], axis=1)
    rest = static - modes.phi @ ((modes.phi.T @ pick) / modes.omega[:, None] ** 2)
    rest /= np.sqrt(np.einsum("ij,i,ij->j", rest, solver.mass, rest))
    basis = np.hstack([modes.phi, rest])
    squared, vectors = eigh(basis.T @ (solver.k @ basis), basis.T @ (solver.mass[:, None] * basis))
    phi = basis @ vectors
    along = solver.mass * (solver.dof[:, 1] == 1)
    hang, lift, roll = np.split(pick.T @ phi, 3)
    moving = np.einsum("ij,i,ij->j", phi, solver.mass * (solver.dof[:, 1] < 3), phi)
    return Reduction(np.sqrt(squared), hang, lift, roll, phi.T @ along, moving, ends)


def _middle(nodes, mine):
    """Place of an end: the middle of its nodes."""
    return nodes.position_m[mine].mean(axis=0)


def in_plane(scene, ends):
    """Scene of the façade alone in its plane, a moving support in the place of every end."""
    facade, ground, nodes = scene.index(scene.monitor), scene.index(scene.reference), scene.nodes
    back = nodes.b == facade
    held = [(i, tuple(_middle(nodes, back & (nodes.a == i)))) for i in ends]
    blocks = [
        replace(scene.blocks[ground], free="", motion=GROUND),
        *(replace(scene.blocks[i], free="", motion=f"end{i}", centre_m=at) for i, at in held),
        replace(scene.blocks[facade], free="yzX"),
    ]
    kept = [ground, *ends, facade]
    mine = (nodes.a == facade) | back
    place = np.full(len(scene.blocks), -1)
    place[kept] = np.arange(len(kept))
    kept_nodes = nodes.select(mine, a=place[nodes.a[mine]], b=place[nodes.b[mine]])
    return replace(scene, blocks=blocks, nodes=kept_nodes)


class ReducedScan(Scan):
    """Outcomes of a complete building at any amplitudes, by its reduction to so many modes.

    There is a scene for every layout of nodes that realisations use; all have the bricks of the
    first. `numerics` is that section of its case file.
    """

    def __init__(self, scenes, modes, numerics, time_s, ground_m_s2, direction):
        """Reduce the building."""
        self.numerics, self.direction, self.ground = numerics, direction, ground_m_s2
        self.reduction = reduction(scenes[0], modes)
        self.planes = [to_plane(in_plane(scene, self.reduction.ends)) for scene in scenes]
        self.carried = self.reduction.carried(scenes[0].notes["rate_1_s"])
        self.motions = Motions(time_s, ground_m_s2)
        plane = self.planes[0]
        self.static_g = plane.thickness_m / (2.0 * plane.monitor_m[1])
        critical = STEP * min(scene.notes["critical_step_s"] for scene in scenes)
        self.steps_s = [min(STEP_FRACTION * stable_step(p), critical) for p in self.planes]
