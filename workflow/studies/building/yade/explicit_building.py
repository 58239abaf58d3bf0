"""Explicit time history of a brick building in YADE, joints linear and welded.

Run by YADE's own Python:

    python3 yade_scripts explicit_building --scene scene.json --motion motion.csv
        --output history.csv

Step, duration and the rate of damping stand in the scene's notes. The run works in the frame of the
ground: the ground is fixed, every block feels −m·a_g along y and, where it is asked for, its weight
from the first step on; `LinearDragEngine` gives mass-proportional damping.
"""

from dataclasses import replace

import numpy as np

from yade_scripts.commands import command
from yade_scripts.commands.tables import history_csv
from yade_scripts.engine import adapter, loop
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.motion import SupportMotion
from yade_scripts.model.scene import from_dict

COLUMNS = ("time_s", "top_m_s2", "corner_m_s2", "top_m", "corner_m")


class ExplicitBuilding:
    """A building scene in YADE, ready to step: supports fixed, every node welded.

    `ground_m_s2` along y is linear between samples; the step is below 2/ω_max. A drag a·m·v of the
    rate a acts on every free block, rotational inertia is not damped. Gravity acts from the first
    step on.
    """

    def __init__(self, scene, time_s, ground_m_s2, step_s, rate_1_s, gravity_m_s2=0.0):
        """Reset YADE and build the scene in it."""
        blocks = [
            replace(b, drag_1_s=rate_1_s) if b.free else replace(b, motion=None)
            for b in scene.blocks
        ]
        self.scene = replace(scene, blocks=blocks, shaking=GROUND, gravity_m_s2=gravity_m_s2)
        self.step_s, self.motion = step_s, SupportMotion(time_s, ground_m_s2)
        self.built = adapter.build(self.scene, {GROUND: self.motion}, step_s)

    def run(self, duration_s, points):
        """Run from rest: times of steps, absolute acceleration and displacement of blocks along y.

        Displacement is relative to the ground, shape (n_points, n). EngineError if the motion
        outgrows the building: the step was too long.
        """
        omega = self.built.omega
        steps = round(duration_s / self.step_s)
        t = np.arange(steps) * self.step_s
        states = [omega.bodies[self.built.body[i]].state for i in points]
        start = [state.pos[1] for state in states]
        velocity, position = np.zeros((2, len(points), steps + 1))

        def keep():
            n = omega.iter
            for i, state in enumerate(states):
                position[i, n] = state.pos[1] - start[i]
                velocity[i, n] = state.vel[1]

        loop.between(keep, 1)
        loop.run(omega, steps)
        displacement = position[:, :-1]
        size = max(max(block.size_m) for block in self.scene.blocks)
        if not (np.all(np.isfinite(velocity)) and np.all(np.abs(displacement) < size)):
            raise adapter.EngineError("the explicit run lost its stability: the step is too long")
        # velocities live at half steps: their difference is the acceleration at the step
        ground = np.interp(t, self.motion.time_s, self.motion.acceleration_m_s2)
        acceleration = np.diff(velocity, axis=1) / self.step_s + ground
        return t, acceleration, displacement


def corner(scene):
    """Return the index of the highest block, of those the one farthest along y, then x.

    A corner of a wall's top feels the rattling that symmetry keeps from the floors.
    """
    free = [i for i, block in enumerate(scene.blocks) if block.free]
    return max(free, key=lambda i: [round(scene.blocks[i].centre_m[k], 6) for k in (2, 1, 0)])


def main(arguments=None):
    """Parse the command line, run, write the history; return the exit status."""
    texts = {"motion": "time_s, ground acceleration in m/s² (CSV)", "output": "history (CSV)"}
    parser = command.parser(__doc__, "scene", **texts)
    parser.add_argument("--gravity", type=float, default=0.0, help="downward, sudden [m/s²]")
    options = parser.parse_args(arguments)
    scene = from_dict(read_json(options.scene, "nodes", "blocks"))
    with open(options.motion, encoding="utf-8") as handle:
        lines = [line for line in handle if not line.startswith("#")]
    motion = np.loadtxt(lines[1:], delimiter=",", usecols=(0, 1))
    rate, step, duration = (scene.notes[key] for key in ("rate_1_s", "step_s", "duration_s"))
    duration = min(duration, motion[-1, 0])
    limit = scene.notes.get("omega_max_rad_s")
    if limit and step >= 2.0 / limit:
        raise ValueError(f"step of {step:g} s: expected less than the critical {2.0 / limit:g} s")
    points = [scene.index(scene.monitor), corner(scene)]
    building = ExplicitBuilding(scene, motion[:, 0], motion[:, 1], step, rate, options.gravity)
    t, acceleration, displacement = building.run(duration, points)
    table = np.vstack([t, acceleration, displacement]).T
    formats = dict.fromkeys(COLUMNS, ".9g")
    write_atomic(options.output, history_csv({}, COLUMNS, table, formats))
    return 0
