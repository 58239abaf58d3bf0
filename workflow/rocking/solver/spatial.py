"""A façade in three dimensions under two horizontal components: a compiled solver of its own.

One free block with all six freedoms, in the frame of the reference support, on the nodes of a full
scene. A node at r = R s from the centroid (R the rotation, s fixed in the block) meets a plane that
does not turn; its penetration, closing rate and slip are vectors of space:

    m dv/dt = Σ f − m (a_x, a_y, g + a_z),  dL/dt = Σ r × f,  ω = R J⁻¹ Rᵀ L,  dq/dt = ½ ω q

with f the law of the planar solver, its friction acting against the slip in the joint's plane:
|ks·slip| ≤ μN, the dashpot β·ks while it sticks. Leapfrog: poses at whole steps, rates between,
dashpots from the rate that the last acceleration predicts. Written apart from YADE, which is its
check; without a motion along the façade it is the planar solver's.
"""

import math
from typing import NamedTuple

import numpy as np

from yade_scripts.model.floor_motions import VERTICAL
from yade_scripts.model.motion import along
from yade_scripts.model.stiffness import critical_step

from .inputs import FAILED
from .plane import moving_supports
from .runs import STATUS, Motions, limits
from .spatial_kernel import COLUMNS, Spatial, at_rest, march_spatial

STEP_FRACTION = 0.2  # of the critical step


def to_block(scene, step_fraction=STEP_FRACTION):
    """Reduce a full scene to its one free block.

    Raises
    ------
    ValueError
        One line, if more than one block is free, or joints are bonded or tied.
    """
    free = [i for i, block in enumerate(scene.blocks) if block.free]
    if len(free) != 1 or scene.blocks[free[0]].free != "xyzXYZ" or scene.shaking:
        raise ValueError("two components: expected one free block with all freedoms")
    nodes, block = scene.nodes, scene.blocks[free[0]]
    if np.any(nodes.a != free[0]) or nodes.bonded.any() or scene.ties or scene.floors:
        raise ValueError("two components: expected dry joints, without ties and floors")
    column = {name: i for i, name in enumerate(moving_supports(scene))}
    centre, turned = np.array(block.centre_m), np.array(block.rotation_rad, float)
    arm, half = nodes.position_m - centre, 0.5 * np.linalg.norm(turned)
    line = np.stack([nodes.joint, nodes.position_m[:, 0], nodes.gap_m], axis=1)
    bounds = np.flatnonzero(np.any(np.diff(line, axis=0) != 0.0, axis=1)) + 1
    return Spatial(
        np.concatenate(([0], bounds, [len(nodes)])),
        arm,
        nodes.normal.copy(),
        np.einsum("ni,ni->n", nodes.normal, arm) - nodes.gap_m,
        np.array([column.get(scene.blocks[i].motion, -1) for i in nodes.b], np.int64),
        nodes.kn_n_m.copy(),
        nodes.ks_n_m.copy(),
        nodes.beta_s.copy(),
        np.tan(nodes.friction_rad),
        np.array(block.inertia_kg_m2, float),
        np.array(block.displacement_m, float),
        np.array([math.cos(half), *(turned * (0.5 * np.sinc(half / math.pi)))]),
        np.array(scene.monitor_point_m, float) - centre,
        float(block.mass_kg),
        float(scene.gravity_m_s2),
        float(scene.thickness_m),
        step_fraction * float(critical_step(scene)),
    )


def two_motions(scene, time_s, columns):
    """`Motions` across and along the façade, of the scene's supports.

    Parameters
    ----------
    scene : Scene
    time_s, columns
        Of every motion of the scene, see `floor_motions.motion_columns`; what is missing along
        is zero.
    """
    base = scene.blocks[scene.index(scene.reference)].motion
    names = [base, *moving_supports(scene)]
    still = np.zeros(len(time_s))
    across = [columns[name] for name in names]
    beside = [columns.get(along(name), still) for name in names]
    up = columns.get(VERTICAL)
    return [Motions(time_s, rows[0], rows[1:], up) for rows in (across, beside)]


class Outcome(NamedTuple):
    """One history.

    Attributes
    ----------
    d_over_b, twist_rad, slid_m : float
        Largest |d|/b (NaN where it failed), rotation about z, centroid's displacement along x.
    status : str
    end_s : float
    rows : ndarray, shape (n, COLUMNS)
        See `march_spatial`.
    """

    d_over_b: float
    twist_rad: float
    slid_m: float
    status: str
    end_s: float
    rows: np.ndarray


def history(spatial, motions, numerics, factor=1.0, *, sample_s=None):
    """One history.

    Parameters
    ----------
    spatial : Spatial
    motions : pair of Motions
        Along y and x, see `two_motions`.
    numerics : dict
        Section numerics, see `runs.history`.
    factor : float
        On all accelerations; its sign turns the building by half a turn.
    sample_s : float or None
        Interval between rows; None: none.

    Returns
    -------
    Outcome
    """
    p = spatial
    across, beside = (m.table(p.step_s) for m in motions)
    height = p.monitor_m[2] - p.arm_m[:, 2].min()
    uplift = p.gravity_m_s2 * p.thickness_m / height
    (rules, *own), (_, *others) = (
        limits(uplift, p.thickness_m, m, numerics, np.array([factor])) for m in motions
    )
    ends = max(own[0][0], others[0][0])
    every = max(1, round((sample_s or 1.0) / p.step_s))
    count = math.ceil(rules.limit_s / p.step_s) // every + 1 if sample_s else 0
    rows = np.zeros((count, COLUMNS))
    start = at_rest(p, across.place_m.shape[1])
    peak, status, end, written, twist, slid = march_spatial(
        p, start, across, beside, factor, rules, float(ends), float(own[2][0]), every, rows
    )
    ratio = math.nan if status == FAILED else peak / p.thickness_m
    return Outcome(ratio, twist, slid, STATUS[int(status)], end, rows[:written])
