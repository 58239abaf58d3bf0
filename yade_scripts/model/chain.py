"""The building's chain of masses as links between return-wall blocks.

Written apart from `smdof`, which works by modes and needs SciPy: here the same chain is
its matrices, and what they say about pairs of masses. The classical damping matrix with
ratio ζ in every mode is C = Σ 2ζω_j (Mφ_j)(Mφ_j)ᵀ, for equal masses and storey stiffnesses
2ζ√(km)·√K̂ with K̂ = K/k. The root of such a matrix has no positive off-diagonal entry and no
negative row sum, so passive dashpots represent it exactly: −C_ij between every two masses
and Σ_j C_ij from mass i to the ground. Springs follow from K in the same way.
"""

import math

import numpy as np

from yade_scripts.model.bars import Link

ROUNDING = 1e-9  # of the largest entry


def chain_matrices(smdof, mass_kg):
    """M, K and C of the chain of section smdof, relative to the ground [kg, N/m, N·s/m], (n, n).

    k/m = ω₁²/(4 sin²(π/(4n + 2))), equal masses from the bottom up, `mass_kg` all of them. Damping:
    ratio ζ in every mode ("modal"), or C = αM + βK with ζ in the first two ("rayleigh"; a single
    mode takes half from each).
    """
    n, zeta = smdof["n_dof"], smdof["damping_ratio"]
    each_kg = mass_kg / n
    first = 2.0 * math.pi / smdof["period_s"]
    storey = each_kg * first**2 / (4.0 * math.sin(math.pi / (4 * n + 2)) ** 2)
    pattern = 2.0 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    pattern[-1, -1] = 1.0
    mass, stiffness = each_kg * np.eye(n), storey * pattern
    values, vectors = np.linalg.eigh(stiffness / each_kg)
    omega = np.sqrt(values)
    if smdof["damping_model"] == "modal":
        damping = each_kg * (vectors * (2.0 * zeta * omega)) @ vectors.T
    else:
        low, high = omega[0], omega[min(1, n - 1)]
        damping = 2.0 * zeta / (low + high) * (low * high * mass + stiffness)
    return mass, stiffness, damping


def yields(smdof):
    """Whether section smdof states a strength: else its chain stays elastic."""
    return smdof.get("base_shear_ratio") is not None


def chain_links(smdof, mass_kg, masses, heights_m):
    """Links along y that have K and C of `chain_matrices`, between masses (indices of blocks).

    Block 0 is the ground. Of a chain that yields the springs are what is left of them beyond yield,
    and the rest are `storeys.sliders`. ValueError if the matrices would need a negative spring or
    dashpot.
    """
    _, stiffness, damping = chain_matrices(smdof, mass_kg)
    if yields(smdof):
        stiffness = smdof["hardening"] * stiffness
    least_k, least_c = (ROUNDING * np.abs(m).max() for m in (stiffness, damping))
    links = []
    for i, mass in enumerate(masses):
        for j in (None, *range(i + 1, len(masses))):
            k, c = (m[i].sum() if j is None else -m[i, j] for m in (stiffness, damping))
            k, c = (0.0 if abs(v) <= least else v for v, least in ((k, least_k), (c, least_c)))
            if k or c:
                other, block = ("ground", 0) if j is None else (f"mass {j + 1}", masses[j])
                name, place = f"mass {i + 1} – {other}", (0.0, 0.0, heights_m[i])
                links.append(Link(name, mass, block, float(k), float(c), place))
    return links
