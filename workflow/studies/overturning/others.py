"""The same draws by the other solvers: the reference in the plane, YADE in space."""

import math
import tempfile

import numpy as np
from reference_solver import SupportTable, Wall
from reference_solver.batch import simulate_batch
from rocking.collapse.yade import run_yade
from rocking.tables import write_json

from studies.overturning import blocks, geometry
from studies.overturning.table import STEP_S
from yade_scripts.files import read_json
from yade_scripts.model.floor_motions import write
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.scene import to_json

IN_SPACE = 0.3  # of YADE's critical step


class Footed(Wall):
    """A block of the reference solver that stands on corners, in place of a rectangle's base.

    Its d is that of a point `blocks.ARM_M` above the centre of mass, so that h/2 is that arm and b
    the way of it at which the block has fallen; mass and inertia are its own.
    """

    standing: blocks.Standing

    def __init__(self, standing):
        """Of a draw in the plane."""
        y, z = np.asarray(standing.corners_m, float).T
        order = np.argsort(y)
        friction = math.tan(standing.friction_rad)
        values = {
            "h_m": 2.0 * blocks.ARM_M,
            "b_m": blocks.ARM_M * math.sin(standing.fallen_rad),
            "beta_s": standing.beta_s,
            "gravity_m_s2": STANDARD_GRAVITY_M_S2,
            "gap_m": 0.0,
            "bounded": True,
            "nodes_base": len(y),
            "return_thickness_m": 0.0,
            "segments": 1,
            "eta_m": y[order],
            "zeta_m": z[order],
            "kn_n_m": np.full(len(y), standing.contact_n_m),
            "ks_n_m": np.full(len(y), standing.contact_n_m),
            "friction": np.full(len(y), friction),
            "segment": np.zeros(0, int),
            "standing": standing,
        }
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def mass_kg(self):
        """Mass of the block."""
        return float(self.standing.mass_kg)

    @property
    def inertia_kg_m2(self):
        """Moment of inertia about the centroid."""
        return float(self.standing.inertia_kg_m2[0])

    @property
    def rest_rad(self):
        """Rotation θ at rest, towards +y: the corners of either side sink by what they carry."""
        return -blocks.rest_pose(self.standing)[1]

    def released_pose(self, theta_rad):
        """Centroid (y, z) at rest, turned by `rest_rad`; y from half of `b_m`."""
        sunk, _ = blocks.rest_pose(self.standing)
        return 0.5 * self.b_m, float(-self.zeta_m.min() - sunk)


def fell_by_reference(standing, motions, tolerance=1e-5):
    """Which of some motions overturn a block, by the reference solver."""
    wall = Footed(standing)
    fell = []
    for motion in motions:
        table = SupportTable(STEP_S, motion.ground_m_s2)
        out = simulate_batch(
            wall,
            table,
            [1.0],
            table.duration_s + blocks.NUMERICS["after_motion_s"],
            theta0_over_alpha=wall.rest_rad / wall.alpha_rad,
            tolerance=tolerance,
            stop_d_over_b=1.0,
        )
        if out.status[0] == "failed":
            raise ValueError("the reference solver failed")
        fell.append(bool(out.overturned[0]))
    return np.array(fell)


def in_space(draw):
    """`Standing` of a draw with six freedoms."""
    standing = draw.standing
    inertia = standing.mass_kg * np.diag(draw.inertia_m2)
    corners = geometry.corners(draw.points_m) * np.array([1.0, draw.width, 1.0])
    return standing._replace(corners_m=corners, inertia_kg_m2=tuple(inertia.tolist()))


def by_yade(draws, motions, limit_s=3600.0):
    """Outcomes of draws under motions in three dimensions, see YADE's command `stand`.

    `draws` by name, `motions` by number; the outcomes are by (name, number).
    """
    with tempfile.TemporaryDirectory(prefix="rocking-") as room:
        for number, motion in motions.items():
            write(f"{room}/{number}.csv", motion.time_s[:-1], motion.ground_m_s2[:-1])
        entries = []
        for name, draw in draws.items():
            standing = in_space(draw)
            text = to_json(blocks.with_step(blocks.scene(standing)))
            entries += [
                {
                    "id": f"{name}|{number}",
                    "scene": text,
                    "motion": f"{room}/{number}.csv",
                    "fallen_rad": standing.fallen_rad,
                    "step_fraction": IN_SPACE,
                }
                for number in motions
            ]
        write_json(f"{room}/list.json", entries)
        words = ("--list", f"{room}/list.json", "--output", f"{room}/out.json")
        run_yade("stand", *words, folder=room, limit_s=limit_s)
        outcomes = read_json(f"{room}/out.json")
    keys = [outcome["id"].split("|") for outcome in outcomes]
    return {(name, int(n)): outcome for (name, n), outcome in zip(keys, outcomes, strict=True)}
