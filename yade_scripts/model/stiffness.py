"""Mass, stiffness and damping of a scene, and the critical step they imply.

The matrices come from the node list that also builds the YADE scene: a node of
stiffness kn, ks between blocks a and b adds BᵀDB with B the relative velocity
of the two blocks at the node and D = kn·nnᵀ + ks·(I − nnᵀ), every contact taken
as closed. Damping is stiffness proportional node by node: C = Σ β BᵀDB, without the part along
joints that have no dashpot there. A link of
stiffness k and dashpot c adds k·BᵀttᵀB and c·BᵀttᵀB with its direction t, a tie k·BᵀttᵀB as if
it were taut, a floor k·BᵀttᵀB along x and y as if it stuck, the drag of a block rate·m to the
diagonal of C.
"""

from dataclasses import dataclass, replace

import numpy as np

from yade_scripts.model.bars import taut
from yade_scripts.model.scene import DOFS
from yade_scripts.model.storeys import sliding


@dataclass
class Triplets:
    """Matrices of the free degrees of freedom, K and C as coordinate triplets."""

    rows: np.ndarray
    cols: np.ndarray
    k: np.ndarray  #: stiffness [N/m, N, N·m] at (rows, cols); repeated positions add up
    c: np.ndarray  #: damping there
    mass: np.ndarray  #: diagonal mass matrix [kg, kg·m²], shape (n_free,)
    #: block index and DOF number (0–5, order of "xyzXYZ") of each equation, shape (n_free, 2)
    dof: np.ndarray

    def dense(self):
        """Return dense K and C, shape (n_free, n_free)."""
        n = len(self.mass)
        k, c = np.zeros((n, n)), np.zeros((n, n))
        np.add.at(k, (self.rows, self.cols), self.k)
        np.add.at(c, (self.rows, self.cols), self.c)
        return k, c


def _skew(r):
    """Return S with S·θ = θ × r for small rotations θ, shape (n, 3, 3)."""
    s = np.zeros((len(r), 3, 3))
    s[:, 0, 1], s[:, 0, 2] = r[:, 2], -r[:, 1]
    s[:, 1, 0], s[:, 1, 2] = -r[:, 2], r[:, 0]
    s[:, 2, 0], s[:, 2, 1] = r[:, 1], -r[:, 0]
    return s


def _between(scene, a, b, position_m):
    """Return B, shape (n, 3, 12): velocity of block a past block b at each point."""
    centres = np.array([b.centre_m for b in scene.blocks], float)
    b_matrix = np.zeros((len(a), 3, 12))
    b_matrix[:, :, 0:3] = np.eye(3)
    b_matrix[:, :, 3:6] = _skew(position_m - centres[a])
    b_matrix[:, :, 6:9] = -np.eye(3)
    b_matrix[:, :, 9:12] = -_skew(position_m - centres[b])
    return b_matrix


def _relative_velocity(scene):
    """Return B, shape (n, 3, 12): relative velocity a − b at each node, and D, shape (n, 3, 3)."""
    nodes = scene.nodes
    b_matrix = _between(scene, nodes.a, nodes.b, nodes.position_m)
    nn = np.einsum("ni,nj->nij", nodes.normal, nodes.normal)
    d = nodes.kn_n_m[:, None, None] * nn + nodes.ks_n_m[:, None, None] * (np.eye(3) - nn)
    return b_matrix, d


def free_dofs(scene):
    """Equation number of each degree of freedom, shape (n_blocks, 6); −1 where it is not free."""
    equation = np.full((len(scene.blocks), 6), -1)
    free = np.array([[letter in b.free for letter in DOFS] for b in scene.blocks])
    equation[free] = np.arange(free.sum())
    return equation


def _bars(scene):
    """Blocks a and b, place, direction, stiffness and dashpot of links, ties and floors."""
    rows = [
        (x.a, x.b, x.position_m, x.direction, x.stiffness_n_m, x.dashpot_ns_m) for x in scene.links
    ]
    rows += [(x.a, x.b, x.end_a_m, x.direction, x.stiffness_n_m, 0.0) for x in taut(scene.ties)]
    for x in scene.floors:
        if x.capacity_n > 0.0:
            held = (x.a, x.b, x.position_m)
            rows += [(*held, along, x.stiffness_n_m, 0.0) for along in np.eye(3)[:2].tolist()]
    return rows


def assemble(scene):
    """Assemble K, C and the diagonal M of a scene's free degrees of freedom, as `Triplets`.

    ValueError if a free block has no positive mass or inertia, or nothing is free.
    """
    equation = free_dofs(scene)
    if equation.max() < 0:
        raise ValueError("the scene has no free degree of freedom")
    mass = np.array([[b.mass_kg] * 3 + list(b.inertia_kg_m2) for b in scene.blocks], float)
    for i, block in enumerate(scene.blocks):
        if np.any(mass[i][equation[i] >= 0] <= 0.0):
            raise ValueError(f"block '{block.name}' needs a positive mass and inertia")
    b_matrix, d = _relative_velocity(scene)
    element = np.einsum("nki,nkl,nlj->nij", b_matrix, d, b_matrix)
    nodes = scene.nodes
    across = np.einsum("nk,nki->ni", nodes.normal, b_matrix)
    across = nodes.kn_n_m[:, None, None] * np.einsum("ni,nj->nij", across, across)
    damping = across + nodes.along[:, None, None] * (element - across)
    damping = nodes.beta_s[:, None, None] * damping
    a, b = nodes.a, nodes.b
    bars = _bars(scene)
    if bars:
        bar_a, bar_b, place, along, k_bar, c_bar = map(np.array, zip(*bars, strict=True))
        row = np.einsum("ni,nij->nj", along, _between(scene, bar_a, bar_b, place))
        pattern = np.einsum("ni,nj->nij", row, row)
        element = np.concatenate([element, k_bar[:, None, None] * pattern])
        damping = np.concatenate([damping, c_bar[:, None, None] * pattern])
        a, b = np.concatenate([a, bar_a]), np.concatenate([b, bar_b])
    numbers = np.concatenate([equation[a], equation[b]], axis=1)
    rows = np.repeat(numbers[:, :, None], 12, axis=2)
    cols = np.repeat(numbers[:, None, :], 12, axis=1)
    keep = (rows >= 0) & (cols >= 0) & ((element != 0.0) | (damping != 0.0))
    dof = np.argwhere(equation >= 0)
    rows, cols, k, c = rows[keep], cols[keep], element[keep], damping[keep]
    mass = mass[equation >= 0]
    rate = np.array([block.drag_1_s for block in scene.blocks])[dof[:, 0]]
    dragged = np.flatnonzero((rate > 0.0) & (dof[:, 1] < 3))
    if dragged.size:
        rows, cols = np.concatenate([rows, dragged]), np.concatenate([cols, dragged])
        k = np.concatenate([k, np.zeros(dragged.size)])
        c = np.concatenate([c, (rate * mass)[dragged]])
    return Triplets(rows, cols, k, c, mass, dof)


def modes(scene):
    """Circular frequencies and mass-normalised modes of a small scene, every contact closed.

    Solves K φ = ω² M φ densely; for large scenes use the triplets with a sparse solver. Frequencies
    ascend [rad/s], shape (n_free,); columns of the second, (n_free, n_free), are modes, φᵀMφ = I.
    """
    matrices = assemble(scene)
    k, _ = matrices.dense()
    scale = 1.0 / np.sqrt(matrices.mass)
    values, vectors = np.linalg.eigh(k * scale[:, None] * scale[None, :])
    return np.sqrt(np.clip(values, 0.0, None)), vectors * scale[:, None]


def critical_step(scene):
    """Largest stable step Δt_crit of the leapfrog scheme with a lagged viscous force [s].

    Every contact is taken as closed, so opening only helps. Central differences with the damping
    force taken from the previous half step,
    u₍ₙ₊₁₎ = 2uₙ − u₍ₙ₋₁₎ − Δt²M⁻¹Kuₙ − ΔtM⁻¹C(uₙ − u₍ₙ₋₁₎), are stable while
    Δt² λ(K) + 2Δt λ(C) ≤ 4 in every mode. With C = βK that is Δt_crit = (2/ω)(√(1 + ζ²) − ζ),
    ζ = βω/2, at the largest ω. Where β differs from node to node the modes do not uncouple; the
    limit is then the largest Δt at which 4M − Δt²K − 2ΔtC stays positive semidefinite, found by
    bisection.
    """
    matrices = assemble(scene)
    k, c = matrices.dense()
    scale = 1.0 / np.sqrt(matrices.mass)
    k = k * scale[:, None] * scale[None, :]
    c = c * scale[:, None] * scale[None, :]
    omega2 = np.linalg.eigvalsh(k)[-1]
    betas = np.unique(scene.nodes.beta_s)
    dragged = any(block.drag_1_s for block in scene.blocks)
    whole = np.all(scene.nodes.along == 1.0)
    if len(betas) == 1 and whole and not (_bars(scene) or dragged):
        omega = np.sqrt(omega2)
        zeta = betas[0] * omega / 2.0
        return 2.0 / omega * (np.sqrt(1.0 + zeta**2) - zeta)
    low, high = 0.0, 2.0 / np.sqrt(omega2)
    for _ in range(60):
        middle = 0.5 * (low + high)
        stable = np.linalg.eigvalsh(middle**2 * k + 2.0 * middle * c)[-1] <= 4.0
        low, high = (middle, high) if stable else (low, middle)
    return low


def lag_factors(scene, dt_s):
    """Factors on the return walls' kn and ks (and so on their dashpots) for the lagged velocity.

    The scheme takes a dashpot's velocity half a step late, v₍ₙ₋½₎ = vₙ − (Δt/2)aₙ, so
    M aₙ = F − K xₙ − C v₍ₙ₋½₎ is the system with the mass M − (Δt/2)C: an error of
    first order in the step. For one mode, K and C divided by 1 + (Δt/2)φᵀCφ/φᵀMφ
    restore the second order. A façade, or a piece of it between hinges, hits its return walls
    rotating about its front toe, wall by wall, so each joint is corrected for that mode alone;
    where the wall moves too, with the inertia of both in series. The correction vanishes with
    the step; the critical step is that of the scene as given.

    The factors, shape (n_nodes,), are 1 for base and hinges, for scenes with other free blocks
    (masses of links apart) and without damping.
    """
    nodes = scene.nodes
    factors = np.ones(len(nodes))
    linked = {i for link in scene.links for i in (link.a, link.b)}
    free = [i for i, block in enumerate(scene.blocks) if block.free and i not in linked]
    pieces = [scene.index(name) for name, _ in scene.watched]
    if sorted(pieces) != free or dt_s <= 0.0:
        return factors
    b_matrix, d = _relative_velocity(scene)
    upright = np.abs(nodes.normal[:, 1]) > 0.5
    for piece in pieces:
        block = scene.blocks[piece]
        out, down = block.arms_m
        phi = np.array([0.0, down, out, -1.0, 0.0, 0.0])  # about the toe, outward
        inertia = block.mass_kg * (phi[1] ** 2 + phi[2] ** 2) + block.inertia_kg_m2[0]
        velocity = np.where(
            (nodes.a == piece)[:, None], b_matrix[:, :, :6] @ phi, b_matrix[:, :, 6:] @ phi
        )
        damping = nodes.beta_s * np.einsum("ni,nij,nj->n", velocity, d, velocity)
        of_piece = upright & ((nodes.a == piece) | (nodes.b == piece))
        for touched in np.unique(nodes.b[of_piece]):
            mine = of_piece & (nodes.b == touched)
            rate = damping[mine].sum() / inertia
            wall = scene.blocks[touched]
            if wall.free:
                rate += (nodes.beta_s * nodes.kn_n_m)[mine].sum() / wall.mass_kg
            factors[mine] = 1.0 / (1.0 + 0.5 * dt_s * rate)
    return factors


def link_factor(scene, dt_s):
    """Factor on the links' k and c for the lagged velocity, exact for their first mode.

    The same correction as in `lag_factors`; higher modes keep an error of Δt·ζ(ω_j − ω_1)
    in ω². 1 without links or where they carry nothing free.
    """
    masses = sorted({i for x in scene.links for i in (x.a, x.b) if scene.blocks[i].free})
    if not masses:
        return 1.0
    blocks = [b if i in masses else replace(b, free="") for i, b in enumerate(scene.blocks)]
    none = scene.nodes.select(slice(0))
    storeys = [scene.floors[k] for k in sliding(scene)]
    matrices = assemble(replace(scene, blocks=blocks, nodes=none, ties=[], floors=storeys))
    k, c = matrices.dense()
    scale = 1.0 / np.sqrt(matrices.mass)
    first = np.linalg.eigh(k * np.outer(scale, scale))[1][:, 0] * scale
    return 1.0 / (1.0 + 0.5 * dt_s * first @ c @ first)


def compensated(scene, dt_s):
    """Return the scene with nodes and links corrected for the lagged velocity of dashpots."""
    factors, factor = lag_factors(scene, dt_s), link_factor(scene, dt_s)
    nodes = replace(
        scene.nodes, kn_n_m=scene.nodes.kn_n_m * factors, ks_n_m=scene.nodes.ks_n_m * factors
    )
    links = [
        replace(x, stiffness_n_m=factor * x.stiffness_n_m, dashpot_ns_m=factor * x.dashpot_ns_m)
        for x in scene.links
    ]
    floors = list(scene.floors)
    for k in sliding(scene) if factor != 1.0 else ():
        scaled = (factor * floors[k].stiffness_n_m, factor * floors[k].capacity_n)
        floors[k] = replace(floors[k], stiffness_n_m=scaled[0], capacity_n=scaled[1])
    return replace(scene, nodes=nodes, links=links, floors=floors)
