"""Reference answers for façade scenes from the independent planar solvers.

A plain façade in one piece before walls that it cannot push takes the adaptive solver of one block
(`wall`). All others, W2m, courses, pieces, ties and floors, take that of a stack (`stack`).
"""

from typing import NamedTuple

import numpy as np

from reference_solver import SupportTable, Wall, simulate_batch
from reference_solver.stack import StackSolver
from yade_scripts.model import base, floor_motions, registry, yielding
from yade_scripts.model.facades import Facade
from yade_scripts.model.models import build_scene
from yade_scripts.model.motion import amplitude
from yade_scripts.model.registry import REFERENCE_MODELS

WHAT = "the reference solver of one block"


def one_block(case):
    """Whether the adaptive solver of one block has a case; else it is a stack's."""
    kind = registry.model(case["model"])
    if kind.two_way:
        return False
    try:
        Facade.of(case["facade"]).refuse(WHAT, held=True)
    except ValueError:
        return False
    return True


def refuse_unknown(case):
    """Raise a ValueError of one line for a case that no reference solver has: bonds, bricks."""
    kind = registry.model(case["model"])
    if kind.walls not in ("none", "one", "floors") or kind.bonded:
        known = ", ".join(("free", *REFERENCE_MODELS))
        raise ValueError(f"the reference solver has no model {kind.name}: expected one of {known}")
    Facade.of(case["facade"]).refuse_bonds("the reference solver")


def wall_of(case, nodes):
    """Planar wall of a case file with so many nodes along every edge.

    A ValueError of one line for what is a stack's, or no reference solver's at all.
    """
    refuse_unknown(case)
    facade, wall = Facade.of(case["facade"]), case["return_wall"]
    kind = registry.model(case["model"])
    if kind.two_way:
        raise ValueError(
            f"the reference solver has no model {kind.name} in its form of one block: expected "
            "walls that cannot be pushed"
        )
    facade.refuse(WHAT, held=True)
    e_pa = facade.e_mpa * 1e6
    jkn, edge_pa = base.parts(facade)
    return Wall(
        facade.height_m,
        facade.thickness_m,
        facade.width_m,
        facade.density_kg_m3,
        e_pa,
        case["beta_s"],
        0.0 if kind.walls == "none" else wall["count"] * wall["thickness_m"],
        base_jkn_pa_m=jkn,
        base_edge_pa=edge_pa,
        back_jkn_pa_m=e_pa / wall["length_m"] if wall["length_m"] else None,
        shear_ratio=facade.shear_stiffness_ratio,
        base_friction_deg=facade.friction_deg,
        back_friction_deg=wall["friction_deg"],
        nodes_base=nodes,
        nodes_up=nodes,
        segments=case["smdof"]["n_dof"] if kind.chain else 1,
        gap_m=facade.gap_m,
    )


def stack_of(case, nodes, time_s, columns):
    """`StackSolver` of a case with so many nodes along every edge, under floor motions.

    Times and columns are as `floor_motions.read` gives them. A ValueError of one line for what no
    reference solver has.
    """
    refuse_unknown(case)
    counts = dict.fromkeys(("nodes_thickness", "nodes_height", "nodes_per_block"), nodes)
    scene = build_scene({**case, "numerics": {**case["numerics"], **counts}})
    return StackSolver(scene, time_s, columns)


def motion_of(time_s, columns, model):
    """Motion of the base and of the return walls, from what `floor_motions.read` gives."""
    columns = dict(columns)
    vertical = columns.pop(floor_motions.VERTICAL, None)
    ground, *floors = columns.values()
    floors = np.array(floors) if registry.model(model).chain else None
    return SupportTable(float(time_s[1] - time_s[0]), ground, floors, vertical)


def peak_and_end(case, motion_path, direction, pga_g, *, nodes, tolerance):
    """Largest |d|/b of one history, 1 if it overturns, NaN if it failed; time simulated [s]."""
    told = outcomes(case, motion_path, direction, [pga_g], nodes=nodes, tolerance=tolerance)
    return float(told.d_over_b[0]), float(told.end_s[0])


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
    motion = floor_motions.read(motion_path)
    return answers(case, motion, direction, pga_g, nodes=nodes, tolerance=tolerance)


def answers(case, motion, direction, pga_g, *, nodes, tolerance):
    """`Outcomes` of one scene and its floor motions at some amplitudes.

    `motion` is (time_s, columns), as `floor_motions.read` gives it. The tolerance is that of one
    block; a stack takes the step of its solver.
    """
    time_s, columns = motion
    scales = [amplitude(columns[floor_motions.GROUND], direction, g) for g in pga_g]
    floors = yielding.of_case(case, time_s, columns)
    if isinstance(floors, yielding.YieldingFloors):
        moved = [(floors.at(scale), [1.0]) for scale in scales]
    else:
        moved = [(columns, scales)]
    rows = []
    for shaking, factors in moved:
        if one_block(case):
            moving, wall = motion_of(time_s, shaking, case["model"]), wall_of(case, nodes)
            peaks = simulate_batch(wall, moving, factors, tolerance=tolerance, stop_d_over_b=1.0)
            status = [{"finished": "ok"}.get(word, word) for word in peaks.status]
            rows.append((np.minimum(peaks.peak_d_over_b, 1.0), status, peaks.end_time_s))
        else:
            peaks = stack_of(case, nodes, time_s, shaking).peaks(factors)
            rows.append((peaks.d_over_b, list(peaks.status), peaks.end_s))
    d_over_b, every, end_s = zip(*rows, strict=True)
    told = Outcomes(np.concatenate(d_over_b), sum(every, []), np.concatenate(end_s))
    told.d_over_b[[word == "failed" for word in told.status]] = np.nan
    return told
