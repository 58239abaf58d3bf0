"""Walls of the planar solver for tests, and the rates of its compiled law."""

import numpy as np
from reference_solver import Wall
from reference_solver.contact import law_of, rates


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
