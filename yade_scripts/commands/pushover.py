"""Entry point: static capacity curve of one model, displacement controlled.

    python3 yade_scripts pushover --scene cases/W1.json --output pushover.csv
        [--forces joint_forces.csv]

A horizontal body force λW on the façade has its resultant at the centroid. The
centroid is therefore guided outward at a slow constant speed, free to rise and turn,
and λ is the force that the guide has to bear, over W: the falling branch is followed
like the rising one. The push is slow enough for inertia and dashpots to vanish beside
λ; `speed_m_s` says how slow, and halving it is the check. λ refers to the weight of the
façade without headers (an eighth of a percent to three percent of it).
"""

from dataclasses import replace
from typing import Any

import numpy as np

from yade_scripts.commands import command
from yade_scripts.commands.tables import history_csv, to_csv
from yade_scripts.engine import adapter, loop, simulate
from yade_scripts.engine.poses import planar_turn
from yade_scripts.files import read_case, write_atomic
from yade_scripts.model import models

PUSH = "push"
FIRST_SPEED, GROWTH_S = 0.005, 0.8  # share of the final speed, and time in which it grows by e
COLUMNS = ("d_over_b", "lambda_dem")
FORCE_COLUMNS = {
    **{"d_over_b": ".6f", "joint": "", "node": "d"},
    **dict.fromkeys(("z_m", "slip_m", "normal_n", "shear_n"), ".6g"),
}


def guided(scene):
    """Return the scene with the façade's centroid guided along y."""
    blocks = list(scene.blocks)
    i = scene.index(scene.monitor)
    free = blocks[i].free.replace("y", "")
    blocks[i] = replace(blocks[i], free=free, motion=PUSH)
    return replace(scene, blocks=blocks)


def push_motion(speed_m_s, travel_m):
    """Motion of the centroid whose speed grows exponentially to `speed_m_s`, then stays.

    Bonds crack within a tenth of a millimetre, so the first part must be slow: the speed starts at
    FIRST_SPEED times the final one, after a smooth half of it.
    """
    growth = -np.log(FIRST_SPEED) * np.linspace(0.0, 1.0, 200)
    speed = np.concatenate(([0.0], FIRST_SPEED * speed_m_s * np.exp(growth)))
    time_s = np.concatenate(([0.0], 0.02 + GROWTH_S * growth))
    covered = float(np.sum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time_s)))
    left = max(travel_m - covered, 0.0) / speed_m_s
    time_s = np.concatenate((time_s, [time_s[-1] + left + 0.01]))
    speed = np.concatenate((speed, [speed_m_s]))
    # accelerations that are linear between instants and integrate to these speeds: steps,
    # each written as a value that holds over (almost) the whole interval
    edge = 1e-6 * np.diff(time_s)
    slope = np.diff(speed) / np.diff(time_s)
    knots = np.stack([time_s[:-1] + edge, time_s[1:]], axis=1).ravel()
    return adapter.SupportMotion(
        np.concatenate(([0.0], knots)), np.concatenate(([slope[0]], np.repeat(slope, 2)))
    )


def contact_table(scene, built):
    """Normal and shear force of every dry node [N], positive in compression; 0 where it is open."""
    normal, shear = np.zeros(len(scene.nodes)), np.zeros(len(scene.nodes))
    for i, sphere in enumerate(built.node_body):
        for contact in built.omega.bodies[sphere].intrs():
            if contact.isReal:
                force = contact.phys.normalForce
                tangent = contact.phys.shearForce
                normal[i] = (force[0] ** 2 + force[1] ** 2 + force[2] ** 2) ** 0.5
                shear[i] = (tangent[0] ** 2 + tangent[1] ** 2 + tangent[2] ** 2) ** 0.5
    return normal, shear


class _Recorder:
    """Samples displacement and guide force; optionally the joint forces now and then."""

    def __init__(self, scene, weight_n, period_of_forces):
        self.scene, self.weight, self.each = scene, weight_n, period_of_forces
        self.rows: list[tuple] = []
        self.forces: list[tuple] = []
        self.built: Any = None

    def attach(self, built, iter_period):
        """Start sampling every `iter_period` steps."""
        self.built = built
        sampler = loop.runner(self, iter_period, at_start=False)
        built.omega.engines = [*built.omega.engines, sampler]

    def __call__(self):
        scene, omega = self.scene, self.built.omega
        facade = scene.index(scene.monitor)
        body = self.built.body[facade]
        state, block = omega.bodies[body].state, scene.blocks[facade]
        turn = planar_turn(state, self.built.unturned[facade])
        y, z = np.subtract(scene.monitor_point_m, block.centre_m)[1:]
        d = state.pos[1] - block.centre_m[1] + np.cos(turn) * y - np.sin(turn) * z - y
        self.rows.append((d / scene.thickness_m, -omega.forces.f(body)[1] / self.weight))
        if self.each and len(self.rows) % self.each == 1:
            normal, shear = contact_table(scene, self.built)
            self.forces.append((d / scene.thickness_m, float(turn), normal, shear))


def push(scene, numerics, *, speed_m_s=0.02, reach=1.0, samples=400, force_samples=0):
    """Push a scene over: its curve (d/b, λ), contact forces on the way and nodes that broke.

    λ is the guide's force over the façade's weight. The top moves at `speed_m_s`, the centroid is
    guided at half of it, up to d/b = `reach`. Forces are (d_over_b, rotation_rad, normal_n,
    shear_n) of `force_samples` instants; broken nodes (time_s, node).
    """
    scene = guided(scene)
    step, _ = simulate.choose_step(scene, numerics)
    travel = 0.5 * reach * scene.thickness_m
    motion = push_motion(0.5 * speed_m_s, travel)
    still = adapter.SupportMotion.none(motion.duration_s)
    motions = {name: still for name in scene.motions} | {PUSH: motion}
    built = adapter.build(scene, motions, step, node_radius_m=numerics["node_radius_m"])
    steps = int(motion.duration_s / step)
    weight = scene.blocks[scene.index(scene.monitor)].mass_kg * scene.gravity_m_s2
    each = max(1, samples // force_samples) if force_samples else 0
    recorder = _Recorder(scene, weight, each)
    recorder.attach(built, max(1, steps // samples))
    loop.run(built.omega, steps)
    broken = built.bonds.broken if built.bonds else []
    return np.array(recorder.rows, float), recorder.forces, broken


def forces_csv(scene, forces):
    """Contact forces along the push as CSV text, one line a node and sample."""
    nodes = scene.nodes
    rows = (
        (d, scene.joints[nodes.joint[i]], i, z, -z * np.sin(turn), normal[i], shear[i])
        for d, turn, normal, shear in forces
        for i, z in enumerate(nodes.position_m[:, 2])
    )
    return to_csv((dict(zip(FORCE_COLUMNS, row, strict=True)) for row in rows), FORCE_COLUMNS)


def main(arguments=None):
    """Parse the command line, push, write the curve; return the exit status."""
    parser = command.parser(__doc__, "scene", output="curve to write (CSV)")
    parser.add_argument("--forces", help="contact forces along the push to write (CSV)")
    args = parser.parse_args(arguments)
    case = read_case(args.scene)
    scene, settings = models.build_scene(case), case["pushover"]
    adapter.load_yade()
    curve, forces, broken = push(
        scene,
        models.numerics(case),
        speed_m_s=settings["speed_m_s"],
        reach=settings["reach_d_over_b"],
        samples=settings["samples"],
        force_samples=settings["force_samples"] if args.forces else 0,
    )
    write_atomic(args.output, history_csv({}, COLUMNS, curve, dict.fromkeys(COLUMNS, ".9g")))
    if args.forces:
        write_atomic(args.forces, forces_csv(scene, forces))
    peak = curve[:, 1].max()
    say = command.progress(case["model"])
    say(f"pushover: peak λ = {peak:.4f}, {len(broken)} bonded nodes broke")
    return 0
