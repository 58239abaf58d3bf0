"""The compiled law of the planar solver against its statement and another integrator."""

import numpy as np
import pytest
from planar_cases import facade, rate, sorrentino
from reference_solver import simulate
from reference_solver.contact import (
    OMEGA,
    SLIP,
    THETA,
    VY,
    VZ,
    Y,
    Z,
    initial,
)
from scipy.integrate import solve_ivp


def plain_rates(wall, state, base, u, v):
    """The same law, node by node from its statement, with positions and velocities as vectors."""
    cos, sin, omega = np.cos(state[THETA]), np.sin(state[THETA]), state[OMEGA]
    force, moment, out, limit = np.zeros(2), 0.0, np.zeros(state.size), np.zeros(wall.eta_m.size)
    for i, (eta, zeta) in enumerate(zip(wall.eta_m, wall.zeta_m, strict=True)):
        arm = np.array([eta * cos + zeta * sin, zeta * cos - eta * sin])
        velocity = state[[VY, VZ]] + omega * np.array([arm[1], -arm[0]])
        normal, tangent = np.array([0.0, 1.0]), np.array([1.0, 0.0])  # on the block
        place, depth = state[[Y, Z]] + arm, 0.0
        if i < wall.nodes_base:
            depth = -place[1]
        else:
            j = wall.segment[i - wall.nodes_base]
            normal, tangent = tangent, normal
            depth, velocity = u[j] - wall.gap_m - place[0], velocity - np.array([v[j], 0.0])
        if depth <= 0.0:
            continue
        push = max(wall.kn_n_m[i] * (depth - wall.beta_s * velocity @ normal), 0.0)
        slip = tangent @ velocity
        limit[i], held = wall.friction[i] * push, wall.ks_n_m[i] * state[SLIP + i]
        shear = np.clip(held, -limit[i], limit[i])
        shear += (abs(held) < limit[i]) * wall.beta_s * wall.ks_n_m[i] * slip
        shear = np.clip(shear, -limit[i], limit[i])
        node = push * normal - shear * tangent
        force += node
        moment += arm[1] * node[0] - arm[0] * node[1]
        out[SLIP + i] = slip
    out[:SLIP] = [*state[VY : OMEGA + 1], *force / wall.mass_kg, moment / wall.inertia_kg_m2, 0, 0]
    out[VY] -= base
    out[VZ] -= wall.gravity_m_s2
    out[SLIP - 2] = force @ state[[VY, VZ]] + moment * omega
    out[SLIP - 1] = -wall.mass_kg * base * state[VY]
    return out, limit


def test_compiled_rates_are_those_of_the_law():
    """Random poses, rates, slips and wall motions; some nodes open, some slide, some stick."""
    wall, rng = facade(nodes_base=5, nodes_up=4, segments=3, gap_m=1e-4), np.random.default_rng(3)
    seen = np.zeros(3, int)
    for _ in range(50):
        state = initial(wall)
        state[[Y, Z, THETA]] += rng.normal(scale=[3e-4, 3e-4, 2e-4])
        state[VY : OMEGA + 1] = rng.normal(scale=0.02, size=3)
        state[SLIP:] = rng.normal(scale=1e-3, size=wall.eta_m.size)
        u, v = rng.normal(scale=3e-4, size=3), rng.normal(scale=0.02, size=3)
        for got, expected in zip(
            rate(wall, state, 1.3, u, v), plain_rates(wall, state, 1.3, u, v), strict=True
        ):
            assert got == pytest.approx(expected, rel=1e-10, abs=1e-9)
        limit = rate(wall, state, 1.3, u, v)[1]
        slides = np.abs(wall.ks_n_m * state[SLIP:]) >= limit
        seen += [np.sum(limit == 0.0), np.sum((limit > 0.0) & slides), np.sum(~slides)]
    assert np.all(seen > 50)


@pytest.mark.slow
def test_a_history_is_that_of_scipys_integrator():
    """Released wall through two rebounds: SciPy's RK45 on the plain law, friction returned at 1 ms.

    The returns are the one difference: at every accepted step here, at the end of a millisecond
    there; hence 0.2 % and not the tolerance.
    """
    wall = sorrentino()
    state, still, turn = initial(wall, 0.5 * wall.alpha_rad), np.zeros(1), []

    def right(t, y):
        return plain_rates(wall, y, 0.0, still, still)[0]

    scale = np.full(state.size, 1e-7)
    for _ in range(450):
        state = solve_ivp(right, (0.0, 1e-3), state, atol=scale, rtol=1e-6).y[:, -1]
        bound = plain_rates(wall, state, 0.0, still, still)[1] / wall.ks_n_m
        state[SLIP:] = np.clip(state[SLIP:], -bound, bound)
        turn.append(state[THETA])
    history = simulate(wall, duration_s=0.45, theta0_over_alpha=0.5)
    mine = np.interp(1e-3 * np.arange(1, 451), history.time_s, history.theta_rad)
    assert min(turn) < 0.0 < max(turn[300:])
    assert np.abs(mine - turn).max() < 2e-3 * turn[0]
