"""The block, its interface nodes and its initial poses."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.polynomial import legendre
from rocking.mechanics.closed_forms import block
from scipy.optimize import brentq


def lobatto(count):
    """Points and weights on [0, 1] of the Gauss–Lobatto quadrature."""
    if count < 2:
        raise ValueError(f"nodes: expected at least 2 Gauss–Lobatto nodes, got {count}")
    # Golub–Welsch on the interior: the zeros of P'_{n−1} are those of the Jacobi
    # polynomial P^(1,1)_{n−2}, eigenvalues of its symmetric recurrence matrix
    k = np.arange(1, count - 2)
    off = np.sqrt(k * (k + 2.0) / ((2.0 * k + 1.0) * (2.0 * k + 3.0)))
    recurrence = np.zeros((count - 2, count - 2))
    if count > 3:
        recurrence = np.diag(off, 1) + np.diag(off, -1)
    interior = np.linalg.eigvalsh(recurrence)
    x = np.concatenate(([-1.0], interior, [1.0]))
    last = legendre.legval(x, [0.0] * (count - 1) + [1.0])
    return 0.5 * (x + 1.0), 1.0 / (count * (count - 1) * last**2)


@dataclass(frozen=True)
class Wall:
    """A façade of unit description: geometry, material, interfaces and their nodes.

    y is positive outward with the back face at y = 0 and the front toe at y = b,
    z is up, θ is positive when the top moves outward.

    Parameters
    ----------
    h_m, b_m, w_m : float
        Height, thickness and width.
    density_kg_m3, e_pa : float
        Masonry density and Young modulus.
    beta_s : float
        Stiffness-proportional damping of every interface.
    return_thickness_m : float
        Total thickness of the return walls in contact with the back face (two
        walls of 0.375 m: 0.75); 0 leaves the wall free standing.
    base_jkn_pa_m, back_jkn_pa_m : float or None
        Normal stiffness per area; None means E/h at the base and E/(h/2) at the back.
    base_edge_pa : float
        Stiffness per width along either edge of the base, beside the even one.
    shear_ratio : float
        jks/jkn of both interfaces.
    base_friction_deg, back_friction_deg : float
    nodes_base, nodes_up : int
        Nodes across b, and up each return-wall segment.
    segments : int
        Return-wall segments, of equal heights.
    gap_m : float
        Clearance between back face and return walls at the start.
    gravity_m_s2 : float
    bounded : bool
        Spring and dashpot along a joint keep |T| ≤ μN together. False: the law that YADE ships, in
        which a node that sticks has its dashpot beside what friction holds.

    Raises
    ------
    ValueError
        If a value is not physical; the message names it.
    """

    h_m: float
    b_m: float
    w_m: float = 1.0
    density_kg_m3: float = 1800.0
    e_pa: float = 1.8e9
    beta_s: float = 0.0
    return_thickness_m: float = 0.0
    base_jkn_pa_m: float | None = None
    back_jkn_pa_m: float | None = None
    base_edge_pa: float = 0.0
    shear_ratio: float = 0.33
    base_friction_deg: float = 30.0
    back_friction_deg: float = 30.0
    nodes_base: int = 9
    nodes_up: int = 9
    segments: int = 1
    gap_m: float = 0.0
    gravity_m_s2: float = 9.81
    bounded: bool = True
    eta_m: np.ndarray = field(init=False, repr=False, compare=False)
    zeta_m: np.ndarray = field(init=False, repr=False, compare=False)
    kn_n_m: np.ndarray = field(init=False, repr=False, compare=False)
    ks_n_m: np.ndarray = field(init=False, repr=False, compare=False)
    friction: np.ndarray = field(init=False, repr=False, compare=False)
    segment: np.ndarray = field(init=False, repr=False, compare=False)

    def __post_init__(self):
        """Check the values and place the nodes: base first, then the segments from the base up."""
        for name in ("h_m", "b_m", "w_m", "density_kg_m3", "e_pa", "shear_ratio", "gravity_m_s2"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0.0):
                raise ValueError(f"{name}: expected a positive value, got {getattr(self, name)}")
        for name in (
            "beta_s",
            "return_thickness_m",
            "gap_m",
            "base_friction_deg",
            "back_friction_deg",
        ):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise ValueError(f"{name}: expected at least 0, got {getattr(self, name)}")
        if self.segments < 1:
            raise ValueError(f"segments: expected at least 1, got {self.segments}")
        base_jkn = self.base_jkn_pa_m or self.e_pa / self.h_m
        back_jkn = self.back_jkn_pa_m or self.e_pa / (0.5 * self.h_m)
        x, weight = lobatto(self.nodes_base)
        eta, zeta = [(x - 0.5) * self.b_m], [np.full(x.size, -0.5 * self.h_m)]
        kn, segment = [base_jkn * self.b_m * self.w_m * weight], []
        kn[0][[0, -1]] += self.base_edge_pa * self.w_m
        if self.return_thickness_m > 0.0:
            x, weight = lobatto(self.nodes_up)
            height = self.h_m / self.segments
            bottoms = np.cumsum([0.0, *[height] * (self.segments - 1)])
            for j, bottom in enumerate(bottoms):
                eta.append(np.full(x.size, -0.5 * self.b_m))
                zeta.append(bottom + x * height - 0.5 * self.h_m)
                kn.append(back_jkn * self.return_thickness_m * height * weight)
                segment.append(np.full(x.size, j))
        values = {
            "eta_m": np.concatenate(eta),
            "zeta_m": np.concatenate(zeta),
            "kn_n_m": np.concatenate(kn),
            "ks_n_m": self.shear_ratio * np.concatenate(kn),
            "segment": np.concatenate(segment).astype(int) if segment else np.zeros(0, int),
        }
        friction = np.full(values["eta_m"].size, math.tan(math.radians(self.back_friction_deg)))
        friction[: self.nodes_base] = math.tan(math.radians(self.base_friction_deg))
        for name, value in (values | {"friction": friction}).items():
            object.__setattr__(self, name, value)

    @property
    def n_segments(self):
        """Number of return-wall segments, 0 without return walls."""
        return self.segments if self.return_thickness_m > 0.0 else 0

    @property
    def mass_kg(self):
        """Mass of the wall."""
        return self.density_kg_m3 * self.h_m * self.b_m * self.w_m

    @property
    def inertia_kg_m2(self):
        """Moment of inertia about the centroid, m(h² + b²)/12."""
        return self.mass_kg * (self.h_m**2 + self.b_m**2) / 12.0

    @property
    def alpha_rad(self):
        """Slenderness atan(b/h)."""
        return block(self.h_m, self.b_m).alpha_rad

    @property
    def p_rad_s(self):
        """Rocking frequency √(3g/4R)."""
        return block(self.h_m, self.b_m, self.gravity_m_s2).p_rad_s

    def released_pose(self, theta_rad):
        """Centroid (y, z) of the block held at θ about its front toe.

        The toe stands at y = b (the heel at y = 0 for θ < 0); the block sinks until the elastic
        base forces carry its weight. θ = 0 is the block at rest. |θ| is below a right angle.
        """
        if not abs(theta_rad) < 0.5 * math.pi:
            raise ValueError(f"theta: expected less than a right angle, got {theta_rad} rad")
        cos, sin = math.cos(theta_rad), math.sin(theta_rad)
        base = slice(0, self.nodes_base)
        depth = self.eta_m[base] * sin - self.zeta_m[base] * cos  # of the nodes below the centroid
        kn, weight = self.kn_n_m[base], self.mass_kg * self.gravity_m_s2

        def excess(z):
            return np.sum(kn * np.maximum(0.0, depth - z)) - weight

        low = depth.max() - weight / kn.min() - self.b_m
        z = brentq(excess, low, depth.max(), xtol=1e-16, rtol=1e-15)
        toe = 0.5 * self.b_m if theta_rad >= 0.0 else -0.5 * self.b_m
        y = toe + 0.5 * self.b_m - (toe * cos - 0.5 * self.h_m * sin)
        return y, z
