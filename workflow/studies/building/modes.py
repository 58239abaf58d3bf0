"""Sparse modes of a scene and their effective masses.

K and M come from `yade_scripts.stiffness.assemble`, the same nodes that build
the YADE scene, every contact closed.
"""

from dataclasses import dataclass, fields, replace

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from yade_scripts.model import stiffness

DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
CHUNK_NODES = 16384


def sparse_of(triplets, values):
    """Sparse matrix of one value a triplet of `stiffness.assemble`: its k or its c."""
    size = len(triplets.mass)
    return sparse.coo_array((values, (triplets.rows, triplets.cols)), shape=(size, size))


def matrices(scene):
    """Assemble the sparse K and the diagonal of M of a scene; block and DOF (0–5) of each equation.

    `stiffness.assemble` keeps a 12 × 12 block for every node in memory; it is called here on
    CHUNK_NODES at a time, all blocks present, so that the equation numbers agree and the sums
    stay small. Units are N/m, N, N·m and kg, kg·m².
    """
    total = None
    for start in range(0, len(scene.nodes), CHUNK_NODES):
        nodes = scene.nodes.select(slice(start, start + CHUNK_NODES))
        triplets = stiffness.assemble(replace(scene, nodes=nodes))
        piece = sparse_of(triplets, triplets.k).tocsc()
        total = piece if total is None else total + piece
    return total, triplets.mass, triplets.dof


def rigid_motions(scene, dof, mass):
    """Unit rigid motions of the free equations, shape (n, 6), columns in the order of DIRECTIONS.

    Rotations turn about the centre of the translational mass, so they carry no translation of it.
    """
    centres = np.array([b.centre_m for b in scene.blocks], float)[dof[:, 0]]
    along_x = dof[:, 1] == 0
    weight = mass[along_x]
    centre = weight @ centres[along_x] / weight.sum()
    arm = centres - centre
    r = np.zeros((len(mass), 6))
    for axis in range(3):
        r[dof[:, 1] == axis, axis] = 1.0
        r[dof[:, 1] == 3 + axis, 3 + axis] = 1.0
        one, two = (axis + 1) % 3, (axis + 2) % 3  # e_axis × arm has these two components
        r[dof[:, 1] == one, 3 + axis] = -arm[dof[:, 1] == one, two]
        r[dof[:, 1] == two, 3 + axis] = arm[dof[:, 1] == two, one]
    return r


@dataclass
class Modes:
    """Modes of a scene in ascending frequency.

    Attributes
    ----------
    omega : ndarray, shape (m,)
        Circular frequencies [rad/s].
    phi : ndarray, shape (n, m)
        φᵀMφ = 1.
    participation : ndarray, shape (m, 6)
        Γ = φᵀMr for the rigid motions of DIRECTIONS.
    effective_ratio : ndarray, shape (m, 6)
        Γ²/(rᵀMr): share of the mass (of the rotational inertia) that moves with the mode.
    dof : ndarray, shape (n, 2)
    mass : ndarray, shape (n,)
    """

    omega: np.ndarray
    phi: np.ndarray
    participation: np.ndarray
    effective_ratio: np.ndarray
    dof: np.ndarray
    mass: np.ndarray

    @classmethod
    def of(cls, scene, dof, mass, omega, phi):
        """Modes of a scene by their frequencies and shapes."""
        rigid = rigid_motions(scene, dof, mass)
        participation = phi.T @ (mass[:, None] * rigid)
        total = np.einsum("ni,n,ni->i", rigid, mass, rigid)
        return cls(omega, phi, participation, participation**2 / total, dof, mass)

    @property
    def period_s(self):
        """Periods 2π/ω, descending [s]."""
        return 2.0 * np.pi / self.omega

    def save(self, path):
        """Write the modes to an .npz file."""
        with open(path, "wb") as handle:
            np.savez(handle, **{f.name: getattr(self, f.name) for f in fields(self)})

    @classmethod
    def load(cls, path):
        """Read modes written by `save`."""
        with np.load(path) as data:
            return cls(**{f.name: data[f.name] for f in fields(cls)})

    def largest(self, direction):
        """Return the index of the mode with the largest effective mass in a direction."""
        return int(np.argmax(self.effective_ratio[:, DIRECTIONS.index(direction)]))


class Solver:
    """Lowest modes of one K for any M: K is factorised once.

    The eigenvalues 1/ω² of √M·K⁻¹·√M are found by Lanczos iteration from a fixed
    start vector, so repeated runs agree.

    Parameters
    ----------
    scene : Scene

    Raises
    ------
    ValueError
        If K is singular: some block is not tied to a support.
    """

    def __init__(self, scene):
        """Assemble and factorise."""
        self.scene = scene
        self.k, self.mass, self.dof = matrices(scene)
        try:
            self._lu = splu(
                sparse.csc_array(self.k),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise ValueError("the stiffness is singular: some block is not held") from error

    def static(self, force):
        """Return the displacements K⁻¹f of a static load f, shape (n,)."""
        return self._lu.solve(np.asarray(force, float))

    def mass_with(self, added_kg):
        """Return the diagonal of M with mass spread evenly over blocks, {index: kg}.

        A block's rotational inertia grows with its mass.
        """
        mass = self.mass.copy()
        for block, extra in added_kg.items():
            equations = self.dof[:, 0] == block
            mass[equations] *= 1.0 + extra / self.scene.blocks[block].mass_kg
        return mass

    def modes(self, count, mass=None):
        """Return the `count` lowest `Modes`, with the scene's own M or another diagonal."""
        mass = self.mass if mass is None else mass
        size = len(mass)
        root = np.sqrt(mass)
        operator = LinearOperator(
            (size, size), matvec=lambda x: root * self.static(root * np.ravel(x)), dtype=float
        )
        count = min(count, size - 1)
        start = np.random.default_rng(0).standard_normal(size)
        values, vectors = eigsh(operator, k=count, which="LA", v0=start, tol=1e-10)
        order = np.argsort(-values)
        omega = 1.0 / np.sqrt(values[order])
        phi = vectors[:, order] / root[:, None]
        peak = np.argmax(np.abs(phi), axis=0)
        phi *= np.sign(phi[peak, np.arange(count)])  # the sign of a mode is free: fix it
        return Modes.of(self.scene, self.dof, mass, omega, phi)


def per_mass(matrix, mass):
    """M^−½ K M^−½ of a sparse K and a diagonal M."""
    scale = sparse.diags_array(1.0 / np.sqrt(mass))
    return sparse.csr_array(scale @ matrix @ scale)


def largest_eigenvalue(matrix, tolerance):
    """Largest eigenvalue of a sparse symmetric matrix by Lanczos iteration."""
    start = np.random.default_rng(0).standard_normal(matrix.shape[0])
    how = {"which": "LA", "v0": start, "tol": tolerance, "return_eigenvectors": False}
    return float(eigsh(matrix, k=1, **how)[0])


def largest_frequency(k, mass):
    """Return the largest circular frequency of K and a diagonal M [rad/s], to 0.1 %."""
    return float(np.sqrt(largest_eigenvalue(per_mass(k, mass), 1e-3)))
