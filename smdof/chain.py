"""Shear chains of lumped masses: modes, damping and floor motions.

The substitute structure of the study: n equal masses and n equal storey springs
in series on a moving base, tuned to the building's first period. Floors are
numbered from the bottom; relative motion is measured from the ground.
"""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from .oscillator import checked_motion, oscillator_response, refine_linear

POINTS_PER_PERIOD = 50  # output step of floor motions: shortest period over this


@dataclass(frozen=True)
class Chain:
    """Masses and storey stiffnesses, both from the bottom up.

    Parameters
    ----------
    mass_kg : tuple of n floats
    stiffness_n_m : tuple of n floats
        Spring i joins floor i to floor i − 1, the first one to the ground.

    Raises
    ------
    ValueError
        If there is no mass, the lengths differ or a value is not positive and finite.
    """

    mass_kg: tuple
    stiffness_n_m: tuple

    def __post_init__(self):
        """Check lengths and values."""
        if len(self.mass_kg) == 0 or len(self.mass_kg) != len(self.stiffness_n_m):
            raise ValueError(
                f"chain: expected one stiffness a mass, got {len(self.mass_kg)} masses "
                f"and {len(self.stiffness_n_m)} stiffnesses"
            )
        for name in ("mass_kg", "stiffness_n_m"):
            for i, value in enumerate(getattr(self, name)):
                if not (math.isfinite(value) and value > 0.0):
                    raise ValueError(f"chain: {name}[{i}] must be positive, got {value}")

    @property
    def n_dof(self):
        """Number of masses."""
        return len(self.mass_kg)

    def matrices(self):
        """Return the mass and stiffness matrices M [kg] and K [N/m], shape (n, n)."""
        k = np.asarray(self.stiffness_n_m, float)
        stiffness = np.diag(k + np.append(k[1:], 0.0))
        stiffness -= np.diag(k[1:], 1) + np.diag(k[1:], -1)
        return np.diag(np.asarray(self.mass_kg, float)), stiffness

    def modes(self):
        """Circular frequencies and participation of the modes.

        Returns
        -------
        omega_rad_s : ndarray, shape (n,)
            Ascending.
        participation : ndarray, shape (n, n)
            Column j is Γ_j φ_j with Γ_j = φᵀM1/φᵀMφ: the share of mode j in each
            floor's response, bottom to top. Rows sum to 1, and the scaling of φ
            does not matter.
        """
        mass, stiffness = self.matrices()
        values, phi = scipy.linalg.eigh(stiffness, mass)  # φᵀMφ = 1
        gamma = phi.T @ np.diag(mass)
        return np.sqrt(values), phi * gamma

    def periods_s(self):
        """Return the modal periods 2π/ω, longest first [s]."""
        return 2.0 * np.pi / self.modes()[0]

    def effective_mass_ratio(self):
        """Return each mode's effective mass over the total mass; they sum to 1."""
        mass = np.asarray(self.mass_kg, float)
        return mass @ self.modes()[1] / mass.sum()

    def damping_ratios(self, damping_ratio=0.05, damping_model="modal", rayleigh_modes=(1, 2)):
        """Damping ratio of every mode.

        Parameters
        ----------
        damping_ratio : float
            ζ of every mode ("modal") or of the two named modes ("rayleigh").
        damping_model : {"modal", "rayleigh"}
            Rayleigh: C = αM + βK, ζ = α/(2ω) + βω/2 (the study's eq. 2), classical as well.
        rayleigh_modes : tuple of 2 ints
            Modes, counted from 1, that get exactly `damping_ratio`.

        Returns
        -------
        ndarray, shape (n,)

        Raises
        ------
        ValueError
            If the model is unknown, the modes do not exist or a ratio leaves [0, 1).
        """
        omega, _ = self.modes()
        if damping_model == "modal":
            zeta = np.full(self.n_dof, float(damping_ratio))
        elif damping_model == "rayleigh":
            alpha, beta = self.rayleigh(damping_ratio, rayleigh_modes)
            zeta = alpha / (2.0 * omega) + beta * omega / 2.0
        else:
            raise ValueError(
                f"damping_model: expected 'modal' or 'rayleigh', got '{damping_model}'"
            )
        if np.any(~(zeta >= 0.0)) or np.any(zeta >= 1.0):
            raise ValueError(f"damping ratios must lie in [0, 1), got {np.round(zeta, 4).tolist()}")
        return zeta

    def damping_matrix(self, damping_ratio=0.05, damping_model="modal"):
        """Damping matrix C = Σ 2ζ_j ω_j (Mφ_j)(Mφ_j)ᵀ, φᵀMφ = 1 [N·s/m], shape (n, n).

        Clough and Penzien (2003), eq. 12-57.
        """
        mass, stiffness = self.matrices()
        values, phi = scipy.linalg.eigh(stiffness, mass)
        zeta = self.damping_ratios(damping_ratio, damping_model, (1, min(2, self.n_dof)))
        shape = mass @ phi
        return (shape * (2.0 * zeta * np.sqrt(values))) @ shape.T

    def rayleigh(self, damping_ratio=0.05, rayleigh_modes=(1, 2)):
        """Return α [1/s] and β [s] that give two modes the same damping ratio.

        α = 2ζω_iω_j/(ω_i + ω_j), β = 2ζ/(ω_i + ω_j); one mode named twice (the only
        choice of a chain of one mass) gives it half from each part.
        """
        omega, _ = self.modes()
        i, j = rayleigh_modes
        if self.n_dof == 1:
            i = j = 1
        if not (1 <= i <= self.n_dof and 1 <= j <= self.n_dof):
            raise ValueError(f"rayleigh_modes: expected 1 to {self.n_dof}, got {(i, j)}")
        w_i, w_j = omega[i - 1], omega[j - 1]
        factor = 2.0 * damping_ratio / (w_i + w_j)
        return factor * w_i * w_j, factor


def shear_chain(n_dof, period_s, total_mass_kg=1.0):
    """Chain of equal masses and stiffnesses with a given first period.

    ω_1 = 2√(k/m) sin(π/(2(2n + 1))), hence k/m = ω_1²/(4 sin²(π/(4n + 2))).

    Parameters
    ----------
    n_dof : int
        Number of masses, at least 1.
    period_s : float
        First period T1.
    total_mass_kg : float
        Sum of the masses; motions do not depend on it.

    Returns
    -------
    Chain

    Raises
    ------
    ValueError
        If n_dof is not a whole number of at least 1 or the period is not positive.
    """
    if int(n_dof) != n_dof or n_dof < 1:
        raise ValueError(f"n_dof: expected a whole number of at least 1, got {n_dof}")
    if not (math.isfinite(period_s) and period_s > 0.0):
        raise ValueError(f"period_s: expected a positive period, got {period_s}")
    n = int(n_dof)
    mass = total_mass_kg / n
    ratio = (2.0 * math.pi / period_s) ** 2 / (4.0 * math.sin(math.pi / (4 * n + 2)) ** 2)
    return Chain((mass,) * n, (ratio * mass,) * n)


@dataclass(frozen=True)
class FloorMotions:
    """Response of a chain; every array is sampled at `time_s`.

    Attributes
    ----------
    time_s, ground_m_s2 : ndarray, shape (nt,)
    floors_m_s2 : ndarray, shape (n, nt)
        Absolute accelerations, bottom to top.
    relative_m, relative_m_s : ndarray, shape (n, nt)
        Displacements and velocities relative to the ground.
    refine : int
        Parts into which each record interval was divided.
    """

    time_s: np.ndarray
    ground_m_s2: np.ndarray
    floors_m_s2: np.ndarray
    relative_m: np.ndarray
    relative_m_s: np.ndarray
    refine: int


def floor_motions(
    ground_m_s2,
    dt_s,
    chain=None,
    damping_ratio=0.05,
    damping_model="modal",
    rayleigh_modes=(1, 2),
    refine=None,
    tail_s=0.0,
):
    """Floor accelerations of a chain on a base that moves with a piecewise-linear acceleration.

    Each mode is integrated exactly (`oscillator_response`), so the output step
    only decides where the response is sampled. The default divides the record's
    step into the fewest equal parts not longer than T_n/50, so that straight
    lines between samples represent the floor motion.

    Parameters
    ----------
    ground_m_s2 : array_like, shape (nt,)
        Ground acceleration, positive in the direction of positive displacements.
    dt_s : float
        Record step.
    chain : Chain or None
        None is the study's, `shear_chain(4, 0.27)`.
    damping_ratio, damping_model, rayleigh_modes
        See `Chain.damping_ratios`.
    refine : int or None
        Parts of each record step; None chooses as above.
    tail_s : float
        Zero ground acceleration appended, after a linear drop over one record
        step, for the floors to ring down; rounded up to whole record steps.

    Returns
    -------
    FloorMotions

    Raises
    ------
    ValueError
        If the motion, its damping, `refine` or `tail_s` is unusable.
    """
    ground = checked_motion(ground_m_s2, dt_s)
    chain = shear_chain(4, 0.27) if chain is None else chain
    if not isinstance(chain, Chain):
        raise TypeError(f"chain: expected a Chain, as of shear_chain, got {type(chain).__name__}")
    omega, _ = chain.modes()
    zeta = chain.damping_ratios(damping_ratio, damping_model, rayleigh_modes)
    if not (math.isfinite(tail_s) and tail_s >= 0.0):
        raise ValueError(f"tail_s: expected a duration of at least 0, got {tail_s}")
    if refine is None:
        shortest = 2.0 * math.pi / omega[-1]
        # the small allowance keeps a step that is T_n/50 up to rounding undivided
        refine = max(1, math.ceil(dt_s * POINTS_PER_PERIOD / shortest - 1e-9))
    if int(refine) != refine or refine < 1:
        raise ValueError(f"refine: expected a whole number of at least 1, got {refine}")
    if tail_s > 0.0:
        ground = np.append(ground, np.zeros(1 + math.ceil(tail_s / dt_s - 1e-9)))
    ground = refine_linear(ground, int(refine))
    return _by_modes(chain, zeta, ground, dt_s / int(refine), int(refine))


def _by_modes(chain, zeta, ground, step, refine):
    """`FloorMotions`, of each mode with its damping ratio the exact response, in sum."""
    omega, participation = chain.modes()
    shape = (chain.n_dof, ground.size)
    floors, displacement, velocity = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    for w, z, share in zip(omega, zeta, participation.T, strict=True):
        q, v = oscillator_response(-ground, step, w, z)
        displacement += share[:, None] * q
        velocity += share[:, None] * v
        # absolute acceleration = −M⁻¹(C u̇ + K u): exact, no differencing
        floors -= share[:, None] * (2.0 * z * w * v + w**2 * q)
    time = np.arange(ground.size) * step
    return FloorMotions(time, ground, floors, displacement, velocity, refine)
