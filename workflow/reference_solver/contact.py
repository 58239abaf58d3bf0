"""Equations of motion of the block: finite rotation, unilateral nodes, Coulomb friction.

A node carries N = max(0, kn·δ + β·kn·δ̇) while its penetration δ is positive. In
shear an elastic displacement s follows the slip rate and is limited to
|ks·s| ≤ μN; beside it the dashpot β·ks takes what the spring leaves of μN, so that
spring and dashpot together keep |T| ≤ μN. N = 0 therefore also forgets s.

With body coordinates (η, ζ) a node lies at y + η cosθ + ζ sinθ and
z − η sinθ + ζ cosθ. The base is met along −z, the return walls along −y.
"""

import math
from typing import NamedTuple

import numpy as np
from rocking.runtime.compiled import compiled

# entries of the state
Y, Z, THETA, VY, VZ, OMEGA, WORK_CONTACT, WORK_INPUT, SLIP = range(9)


class Law(NamedTuple):
    """Block and nodes as plain arrays, base nodes first.

    Of the nodes body coordinates, stiffnesses and tan φ, shape (nodes,); of those that are not the
    base's the return-wall segment, shape (nodes − n_base,). `bounded` is as in `Wall`.
    """

    n_base: int
    eta_m: np.ndarray
    zeta_m: np.ndarray
    kn_n_m: np.ndarray
    ks_n_m: np.ndarray
    friction: np.ndarray
    segment: np.ndarray
    bounded: bool
    beta_s: float
    gap_m: float
    mass_kg: float
    inertia_kg_m2: float
    gravity_m_s2: float
    h_m: float
    b_m: float


def law_of(wall):
    """The `Law` of a `Wall`."""
    return Law(
        wall.nodes_base,
        wall.eta_m,
        wall.zeta_m,
        wall.kn_n_m,
        wall.ks_n_m,
        wall.friction,
        wall.segment,
        bool(wall.bounded),
        *map(float, (wall.beta_s, wall.gap_m, wall.mass_kg, wall.inertia_kg_m2)),
        *map(float, (wall.gravity_m_s2, wall.h_m, wall.b_m)),
    )


def initial(wall, theta_rad=0.0):
    """State, shape (8 + nodes,), of the block at rest or held at θ.

    It holds the centroid's y and z relative to the base's original position, θ, their rates, the
    work of the contact forces and of the inertia forces so far, and the elastic shear
    displacements.
    """
    state = np.zeros(SLIP + wall.eta_m.size)
    state[[Y, Z]] = wall.released_pose(theta_rad)
    state[THETA] = theta_rad
    return state


@compiled
def penetration(law, i, y, z, cos, sin, wall_u):
    """Penetration δ of node i [m], negative where it is open."""
    if i < law.n_base:
        return law.eta_m[i] * sin - law.zeta_m[i] * cos - z
    u = wall_u[law.segment[i - law.n_base]]
    return u - y - law.eta_m[i] * cos - law.zeta_m[i] * sin - law.gap_m


@compiled
def rates(law, state, base_m_s2, lift_m_s2, wall_u, wall_v, out, limit):
    """Time derivative of the state and the friction limits μN, into `out` and `limit`.

    Supports accelerate along y and z; return walls, of shape (segments,), have displacements and
    velocities relative to the base. State and `out` are of shape (8 + nodes,), limits (nodes,).
    """
    y, z, theta = state[Y], state[Z], state[THETA]
    vy, vz, omega = state[VY], state[VZ], state[OMEGA]
    cos, sin = math.cos(theta), math.sin(theta)
    wc, ws = omega * cos, omega * sin
    fy = fz = moment = 0.0
    for i in range(law.eta_m.size):
        limit[i] = out[SLIP + i] = 0.0
        depth = penetration(law, i, y, z, cos, sin, wall_u)
        if depth <= 0.0:
            continue
        eta, zeta = law.eta_m[i], law.zeta_m[i]
        along_y, along_z = vy + zeta * wc - eta * ws, vz - eta * wc - zeta * ws
        base = i < law.n_base
        if base:
            rate, slip = -along_z, along_y
        else:
            rate, slip = wall_v[law.segment[i - law.n_base]] - along_y, along_z
        normal = max(law.kn_n_m[i] * (depth + law.beta_s * rate), 0.0)
        most = law.friction[i] * normal
        elastic = law.ks_n_m[i] * state[SLIP + i]
        shear = min(max(elastic, -most), most)
        if abs(elastic) < most:
            shear += law.beta_s * law.ks_n_m[i] * slip
            if law.bounded:
                shear = min(max(shear, -most), most)
        limit[i], out[SLIP + i] = most, slip
        # N and T resist penetration and slip
        py, pz = (-shear, normal) if base else (normal, -shear)
        fy += py
        fz += pz
        moment += py * (zeta * cos - eta * sin) - pz * (eta * cos + zeta * sin)
    out[Y], out[Z], out[THETA] = vy, vz, omega
    out[VY] = fy / law.mass_kg - base_m_s2
    out[VZ] = fz / law.mass_kg - law.gravity_m_s2 - lift_m_s2
    out[OMEGA] = moment / law.inertia_kg_m2
    out[WORK_CONTACT] = fy * vy + fz * vz + moment * omega
    out[WORK_INPUT] = -law.mass_kg * (base_m_s2 * vy + lift_m_s2 * vz)


@compiled
def return_map(law, state, limit):
    """Limit the elastic shear displacements to μN/ks in place."""
    for i in range(law.eta_m.size):
        bound = limit[i] / law.ks_n_m[i]
        state[SLIP + i] = min(max(state[SLIP + i], -bound), bound)


@compiled
def elastic_energy(law, state, wall_u):
    """Energy stored in the nodes [J]."""
    cos, sin, total = math.cos(state[THETA]), math.sin(state[THETA]), 0.0
    for i in range(law.eta_m.size):
        depth = max(penetration(law, i, state[Y], state[Z], cos, sin, wall_u), 0.0)
        total += law.kn_n_m[i] * depth**2 + law.ks_n_m[i] * state[SLIP + i] ** 2
    return 0.5 * total


@compiled
def top_displacement(law, state):
    """Displacement d of the top's mid-thickness point relative to the base [m]."""
    return state[Y] + 0.5 * law.h_m * math.sin(state[THETA]) - 0.5 * law.b_m
