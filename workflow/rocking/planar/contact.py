"""Equations of motion of the block: finite rotation, unilateral nodes, Coulomb friction.

A node carries N = max(0, kn·δ + β·kn·δ̇) while its penetration δ is positive. In
shear an elastic displacement s follows the slip rate and is limited to
|ks·s| ≤ μN; the dashpot β·ks acts while the node sticks, not while it slides (the
law of the YADE scenes). N = 0 therefore also forgets s.
"""

import numpy as np

# columns of the state
Y, Z, THETA, VY, VZ, OMEGA, WORK_CONTACT, WORK_INPUT, SLIP = range(9)


class Equations:
    """Right-hand side for many independent blocks at once.

    A state is an array of shape (cases, 8 + nodes): centroid y and z relative to
    the base's original position, θ, their rates, the work of the contact forces
    and of the inertia forces so far, and the elastic shear displacements.

    With body coordinates (η, ζ) a node lies at y + η cosθ + ζ sinθ and
    z − η sinθ + ζ cosθ. Penetration δ is linear in (y, z, cosθ, sinθ, 1), and both
    δ̇ and the slip rate are linear in (ẏ, ż, θ̇cosθ, θ̇sinθ) with constant
    matrices; by virtual work the transpose of the second one collects the forces.
    """

    def __init__(self, wall):
        """Build the kinematic matrices of the nodes of `wall`, base nodes first."""
        self.wall = wall
        self.n_base = nb = wall.nodes_base
        self.kn, self.ks = wall.kn_n_m, wall.ks_n_m
        self.cn, self.cs = wall.beta_s * wall.kn_n_m, wall.beta_s * wall.ks_n_m
        self.friction = wall.friction
        self.mass, self.inertia = wall.mass_kg, wall.inertia_kg_m2
        eta, zeta = wall.eta_m, wall.zeta_m
        self.nodes = eta.size
        self.size = SLIP + self.nodes
        one, none = np.ones(self.nodes), np.zeros(self.nodes)
        base = np.arange(self.nodes) < nb
        # rows y, z, cosθ, sinθ, 1: the base is met along −z, the return walls along −y
        self.depth = np.where(
            base, [none, -one, -zeta, eta, none], [-one, none, -eta, -zeta, -wall.gap_m * one]
        )
        # rows ẏ, ż, θ̇cosθ, θ̇sinθ of the velocities along y and z
        along_y, along_z = np.array([one, none, zeta, -eta]), np.array([none, one, -eta, -zeta])
        self.rate = np.where(base, -along_z, -along_y)
        self.slip = np.where(base, along_y, along_z)
        self.velocity = self._joined(self.nodes)
        self.velocity_base = self._joined(nb)

    def _joined(self, count):
        """Matrix of (δ̇, slip rate) of the first `count` nodes, shape (4, 2·count)."""
        return np.ascontiguousarray(np.hstack((self.rate[:, :count], self.slip[:, :count])))

    def initial(self, theta_rad=0.0):
        """State of blocks at rest or held at θ (scalar or one angle a case)."""
        angles = np.atleast_1d(np.asarray(theta_rad, float))
        state = np.zeros((angles.size, self.size))
        state[:, THETA] = angles
        state[:, [Y, Z]] = [self.wall.released_pose(t) for t in angles]
        return state

    def penetration(self, state, wall_u=None):
        """Penetration δ of every node, negative where it is open, shape (cases, nodes)."""
        place = np.ones((len(state), 5))
        place[:, 0:2] = state[:, Y:THETA]
        place[:, 2], place[:, 3] = np.cos(state[:, THETA]), np.sin(state[:, THETA])
        depth = place @ self.depth
        if wall_u is not None:
            depth[:, self.n_base :] += wall_u[..., self.wall.segment]
        return depth

    def rates(self, state, base_m_s2, wall_u=None, wall_v=None):
        """Time derivative of the state and the friction limits μN, shape (cases, nodes).

        Parameters
        ----------
        state : ndarray, shape (cases, 8 + nodes)
        base_m_s2 : float or ndarray, shape (cases,)
        wall_u, wall_v : ndarray or None, shape (segments,) or (cases, segments)
            Return-wall displacements and velocities relative to the base.
        """
        nb, n = self.n_base, self.nodes
        cos, sin, omega = np.cos(state[:, THETA]), np.sin(state[:, THETA]), state[:, OMEGA]
        motion = np.empty((len(state), 4))
        motion[:, 0:2] = state[:, VY:OMEGA]
        np.multiply(omega, cos, out=motion[:, 2])
        np.multiply(omega, sin, out=motion[:, 3])
        place = np.ones((len(state), 5))
        place[:, 0:2] = state[:, Y:THETA]
        place[:, 2], place[:, 3] = cos, sin

        depth = place @ self.depth
        if n > nb:
            if wall_u is not None:
                depth[:, nb:] += wall_u[..., self.wall.segment]
            if depth[:, nb:].max() <= 0.0:  # in flight: only the base matters
                n, depth = nb, depth[:, :nb]
        matrix = self.velocity if n > nb else self.velocity_base
        joined = motion @ matrix  # δ̇ and slip rates side by side
        rate, slip = joined[:, :n], joined[:, n:]
        if n > nb and wall_v is not None:
            rate[:, nb:] += wall_v[..., self.wall.segment]
        closed = depth > 0.0
        normal = np.maximum(self.kn[:n] * depth + self.cn[:n] * rate, 0.0)
        normal *= closed
        limit = self.friction[:n] * normal
        elastic = self.ks[:n] * state[:, SLIP : SLIP + n]
        shear = np.minimum(np.maximum(elastic, -limit), limit)
        shear += self.cs[:n] * slip * (np.abs(elastic) < limit)

        # N and T resist penetration and slip: minus the transpose
        force = np.concatenate((normal, shear), axis=1) @ matrix.T
        fy, fz = -force[:, 0], -force[:, 1]
        moment = -(cos * force[:, 2] + sin * force[:, 3])
        out = np.zeros_like(state)
        out[:, Y:VY] = state[:, VY:WORK_CONTACT]
        out[:, VY] = fy / self.mass - base_m_s2
        out[:, VZ] = fz / self.mass - self.wall.gravity_m_s2
        out[:, OMEGA] = moment / self.inertia
        out[:, WORK_CONTACT] = fy * state[:, VY] + fz * state[:, VZ] + moment * omega
        out[:, WORK_INPUT] = -self.mass * base_m_s2 * state[:, VY]
        np.multiply(slip, closed, out=out[:, SLIP : SLIP + n])
        return out, limit

    def return_map(self, state, limit):
        """Limit the elastic shear displacements to μN/ks in place; nodes left out of `limit` open.

        `limit` has one column a node, or one a base node when no return wall is touched.
        """
        n = limit.shape[1]
        bound = limit / self.ks[:n]
        held = state[:, SLIP : SLIP + n]
        np.minimum(np.maximum(held, -bound), bound, out=held)
        state[:, SLIP + n :] = 0.0

    def energies(self, state, wall_u=None):
        """Kinetic, potential (zero at z = h/2) and elastic interface energy [J], shape (cases,)."""
        kinetic = 0.5 * self.mass * (state[:, VY] ** 2 + state[:, VZ] ** 2)
        kinetic += 0.5 * self.inertia * state[:, OMEGA] ** 2
        lift = state[:, Z] - 0.5 * self.wall.h_m
        potential = self.mass * self.wall.gravity_m_s2 * lift
        depth = np.maximum(self.penetration(state, wall_u), 0.0)
        elastic = 0.5 * np.sum(self.kn * depth**2 + self.ks * state[:, SLIP:] ** 2, axis=1)
        return kinetic, potential, elastic

    def top_displacement(self, state):
        """Displacement d of the top's mid-thickness point relative to the base [m]."""
        return state[:, Y] + 0.5 * self.wall.h_m * np.sin(state[:, THETA]) - 0.5 * self.wall.b_m
