"""Walls of the planar solver for tests, and the rates of its compiled law."""

import numpy as np
from reference_solver import Wall
from reference_solver.contact import initial, law_of, rates, return_map, top_displacement
from reference_solver.integrate import Drive, _support


def sorrentino(**changes):
    values = dict(
        h_m=0.8,
        b_m=0.11,
        density_kg_m3=1750.0,
        e_pa=1.8e9,
        beta_s=0.000125,
        return_thickness_m=0.22,
        nodes_base=3,
        nodes_up=3,
    )
    return Wall(**(values | changes))


def facade(**changes):
    values = dict(
        h_m=6.48,
        b_m=0.375,
        w_m=4.4,
        density_kg_m3=1800.0,
        e_pa=1.8e9,
        beta_s=0.00276,
        return_thickness_m=0.75,
    )
    return Wall(**(values | changes))


def rate(wall, state, base=0.0, u=None, v=None, lift=0.0):
    """Rates and friction limits of the compiled law, for one state."""
    out, limit = np.empty(state.size), np.empty(wall.eta_m.size)
    still = np.zeros(wall.n_segments + 1)
    u, v = still if u is None else u, still if v is None else v
    rates(law_of(wall), state, base, lift, u, v, out, limit)
    return out, limit


def drive_of(motion):
    """What the compiled loops take of a motion."""
    relative = motion.relative_m_s2, motion.relative_m_s, motion.relative_m
    return Drive(float(motion.dt_s), motion.base_m_s2, motion.vertical_m_s2, *relative)


def stepped(wall, motion, scale, dt_s):
    """State at the end and largest |d|/b by the classical Runge–Kutta scheme, at a fixed step.

    A whole number of steps fills an interval of the motion. It ends where |d| passes 2b. Friction
    is returned once a step: first-order accurate across the jumps of the contact forces, otherwise
    fourth.
    """
    law, state, drive = law_of(wall), initial(wall), drive_of(motion)
    u, v = np.zeros(wall.n_segments + 1), np.zeros(wall.n_segments + 1)
    stages, limit, peak = np.zeros((4, state.size)), np.empty(wall.eta_m.size), 0.0
    parts = round(motion.dt_s / dt_s)
    for step in range(round(motion.duration_s / dt_s)):
        k, part = divmod(step, parts)
        for i, share in enumerate((0.0, 0.5, 0.5, 1.0)):
            base, lift = _support(drive, scale, k, (part + share) * dt_s, u, v)
            tried = state + share * dt_s * stages[i - 1]
            rates(law, tried, base, lift, u, v, stages[i], limit)
            if i == 0:
                return_map(law, state, limit)
        state = state + dt_s / 6.0 * (stages[0] + 2.0 * (stages[1] + stages[2]) + stages[3])
        peak = max(peak, abs(top_displacement(law, state)) / wall.b_m)
        if peak > 2.0:
            break
    return state, peak
