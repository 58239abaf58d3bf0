"""Reference answers for façade scenes from the independent planar solver."""

from typing import NamedTuple

import numpy as np

from rocking.reference import SupportTable, Wall, simulate_batch
from yade_scripts.model import base, floor_motions, registry
from yade_scripts.model.motion import amplitude
from yade_scripts.model.shape import refuse


def wall_of(case, nodes):
    """Planar wall of a case file with so many nodes along every edge.

    A ValueError of one line for return walls that it does not have: those of free, W1 and W2 alone.
    """
    facade, wall, kind = case["facade"], case["return_wall"], registry.model(case["model"])
    if kind.walls not in ("none", "one", "floors") or kind.bonded or kind.two_way:
        raise ValueError(f"the reference solver has no model {kind.name}: expected free, W1 or W2")
    refuse(facade, "the reference solver", held=True)
    e_pa = facade["e_mpa"] * 1e6
    jkn, edge_pa = base.parts(facade)
    return Wall(
        facade["height_m"],
        facade["thickness_m"],
        facade["width_m"],
        facade["density_kg_m3"],
        e_pa,
        case["beta_s"],
        0.0 if kind.walls == "none" else wall["count"] * wall["thickness_m"],
        base_jkn_pa_m=jkn,
        base_edge_pa=edge_pa,
        back_jkn_pa_m=e_pa / wall["length_m"] if wall["length_m"] else None,
        shear_ratio=facade["shear_stiffness_ratio"],
        base_friction_deg=facade["friction_deg"],
        back_friction_deg=wall["friction_deg"],
        nodes_base=nodes,
        nodes_up=nodes,
        segments=case["smdof"]["n_dof"] if kind.chain else 1,
        gap_m=facade["gap_m"],
    )


def read_motion(path, model):
    """Motion of the base and of the return walls, from a file of floor motions."""
    time_s, columns = floor_motions.read(path)
    return motion_of(time_s, columns, model)


def motion_of(time_s, columns, model):
    """Motion of the base and of the return walls, from what `floor_motions.read` gives."""
    columns = dict(columns)
    vertical = columns.pop(floor_motions.VERTICAL, None)
    ground, *floors = columns.values()
    floors = np.array(floors) if registry.model(model).chain else None
    return SupportTable(float(time_s[1] - time_s[0]), ground, floors, vertical)


def peak_and_end(case, motion_path, direction, pga_g, *, nodes, tolerance):
    """Largest |d|/b of one history, 1 if it overturns, NaN if it failed; time simulated [s]."""
    found = outcomes(case, motion_path, direction, [pga_g], nodes=nodes, tolerance=tolerance)
    return float(found.d_over_b[0]), float(found.end_s[0])


class Outcomes(NamedTuple):
    """Of histories at some amplitudes, each of shape (n,).

    Largest |d|/b, 1 where the façade overturns, NaN where the history failed; "ok", "overturned" or
    "failed"; time simulated.
    """

    d_over_b: np.ndarray
    status: list
    end_s: np.ndarray


def outcomes(case, motion_path, direction, pga_g, *, nodes, tolerance):
    """`Outcomes` of one scene and a file of floor motions at some amplitudes."""
    motion = read_motion(motion_path, case["model"])
    return answers(case, motion, direction, pga_g, nodes=nodes, tolerance=tolerance)


def answers(case, motion, direction, pga_g, *, nodes, tolerance):
    """`Outcomes` of one scene and `SupportTable` at some amplitudes."""
    scales = [amplitude(motion.base_m_s2, direction, g) for g in pga_g]
    found = simulate_batch(
        wall_of(case, nodes), motion, scales, tolerance=tolerance, stop_d_over_b=1.0
    )
    peaks = np.minimum(found.peak_d_over_b, 1.0)
    peaks[[status == "failed" for status in found.status]] = np.nan
    status = [{"finished": "ok"}.get(word, word) for word in found.status]
    return Outcomes(peaks, status, found.end_time_s)


def ensemble_peaks(case, motion_path, direction, pga_g, factors, *, nodes=17, dt_s=4e-4):
    """Largest d/b by factor of an ensemble of amplitudes, 1 where the façade overturns."""
    motion = read_motion(motion_path, case["model"])
    scales = amplitude(motion.base_m_s2, direction, pga_g) * np.asarray(factors, float)
    result = simulate_batch(wall_of(case, nodes), motion, scales, dt_s=dt_s, stop_d_over_b=1.0)
    return np.minimum(result.peak_d_over_b, 1.0)
