"""Explicit time history of a brick building in YADE, joints linear and bonded.

Run by YADE's own Python:

    python3 yade_scripts explicit_building --scene scene.json --motion motion.csv \
        --rate 2.3 --step 2e-4 --duration 8 --output history.csv

The run works in the frame of the ground: the ground is fixed, gravity is
(0, −a_g(t), −g), and `LinearDragEngine` gives mass-proportional damping. Each
contact node is a pair of spheres, one of either block, that touch at the node;
`CohFrict` holds them with the node's kn and ks and a strength that is never
reached. There is no collider: the pairs are fixed, and no other spheres interact.
"""

import argparse
import csv
import json
import math
import resource
import time
from typing import Any

import numpy as np

from yade_scripts.engine import loop
from yade_scripts.engine.adapter import EngineError, load_yade
from yade_scripts.model.scene import Block, Nodes, Scene

NEEDED = (
    "CohFrictMat",
    "Ip2_CohFrictMat_CohFrictMat_CohFrictPhys",
    "Ig2_Sphere_Sphere_ScGeom6D",
    "Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
    "LinearDragEngine",
)
# The normal of a pair turns by (shear displacement)/(2r). A radius far above any joint
# displacement keeps the springs linear; without a collider it may exceed the brick.
NODE_RADIUS_M = 0.1
DRAG_VISCOSITY_PA_S = 1.0


def read_scene(path):
    """Read a scene written by `scene.to_json`."""
    with open(path, encoding="utf-8") as handle:
        data: dict[str, Any] = json.load(handle)
    nodes = Nodes(**{k: np.array(v) for k, v in data.pop("nodes").items()})
    blocks = []
    for fields in data.pop("blocks"):
        values: dict[str, Any] = {
            k: tuple(v) if isinstance(v, list) else v for k, v in fields.items()
        }
        blocks.append(Block(**values))
    return Scene(blocks=blocks, nodes=nodes, **data)


class ExplicitBuilding:
    """A building scene in YADE, ready to step.

    Parameters
    ----------
    scene : Scene
        Supports are fixed; every node is bonded.
    step_s : float
        Time step, below 2/ω_max of the scene.
    rate_1_s : float
        Mass-proportional damping rate a: drag a·m·v on every free block. Rotational
        inertia is not damped.
    gravity_m_s2 : float
        Downward acceleration, applied from the first step; 0 leaves it out.
    """

    def __init__(self, scene, step_s, rate_1_s, gravity_m_s2=0.0):
        """Reset YADE and build the scene in it."""
        w = load_yade()
        missing = [name for name in NEEDED if not hasattr(w, name)]
        if missing:
            raise EngineError(f"this YADE lacks the class(es) {', '.join(missing)}")
        from yade import utils

        self.scene, self.step_s, self.gravity = scene, step_s, gravity_m_s2
        self.omega = omega = w.Omega()
        loop.reset(omega)
        material = w.CohFrictMat(
            density=1e-12,
            young=1.0,
            poisson=0.3,
            frictionAngle=0.5,
            isCohesive=True,
            momentRotationLaw=False,
            normalCohesion=1e30,
            shearCohesion=1e30,
        )
        omega.materials.append(material)
        self.body, pairs, dragged = self._bodies(utils, material, rate_1_s)
        self.newton = w.NewtonIntegrator(damping=0.0, gravity=(0, 0, 0))
        engines = [
            w.ForceResetter(),
            w.InteractionLoop(
                [w.Ig2_Sphere_Sphere_ScGeom6D()],
                [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)],
                [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment()],
            ),
        ]
        if rate_1_s > 0.0:
            engines.append(w.LinearDragEngine(nu=DRAG_VISCOSITY_PA_S, ids=dragged))
        omega.engines = [*engines, self.newton]
        omega.dt = step_s
        nodes = scene.nodes
        for i, (one, two) in enumerate(pairs):
            physics = utils.createInteraction(one, two).phys
            physics.kn, physics.ks = float(nodes.kn_n_m[i]), float(nodes.ks_n_m[i])
            physics.normalAdhesion = physics.shearAdhesion = 1e30

    def _bodies(self, utils, material, rate_1_s):
        """Append every block; return the body of each, the sphere pairs and the drag spheres."""
        omega, nodes = self.omega, self.scene.nodes
        pairs = np.full((len(nodes), 2), -1)
        order_a = _groups(nodes.a, len(self.scene.blocks))
        order_b = _groups(nodes.b, len(self.scene.blocks))
        body, dragged = [], []
        for index, block in enumerate(self.scene.blocks):
            members = []
            for column, sign, group in ((0, 1.0, order_a[index]), (1, -1.0, order_b[index])):
                for i in group:
                    centre = nodes.position_m[i] + sign * NODE_RADIUS_M * nodes.normal[i]
                    sphere = utils.sphere(
                        tuple(centre), NODE_RADIUS_M, material=material, fixed=not block.free
                    )
                    pairs[i, column] = omega.bodies.append(sphere)
                    members.append(int(pairs[i, column]))
            if not block.free:
                body.append(members[0] if members else -1)
                continue
            carrier = omega.bodies.append(
                utils.box(block.centre_m, tuple(0.5 * x for x in block.size_m), material=material)
            )
            radius = rate_1_s * block.mass_kg / (6.0 * math.pi * DRAG_VISCOSITY_PA_S)
            drag = utils.sphere(block.centre_m, max(radius, 1e-6), material=material)
            dragged.append(omega.bodies.append(drag))
            for member in (dragged[-1], *members):
                state = omega.bodies[member].state
                state.mass, state.inertia = 0.0, (0.0, 0.0, 0.0)
            body.append(_clump(omega, block, [carrier, dragged[-1], *members]))
        return body, [(int(a), int(b)) for a, b in pairs], dragged

    def run(self, time_s, ground_m_s2, duration_s, points):
        """Run from rest and return the histories of some blocks.

        Parameters
        ----------
        time_s, ground_m_s2 : ndarray, shape (nt,)
            Ground acceleration along y, linear between samples.
        duration_s : float
        points : sequence of int
            Blocks observed.

        Returns
        -------
        time_s : ndarray, shape (n,)
            Every step.
        acceleration_m_s2, displacement_m : ndarray, shape (n_points, n)
            Absolute acceleration and displacement relative to the ground along y.

        Raises
        ------
        EngineError
            If the motion outgrows the building: the step was too long.
        """
        steps = round(duration_s / self.step_s)
        t = np.arange(steps + 1) * self.step_s
        ground = np.interp(t, time_s, ground_m_s2)
        states = [self.omega.bodies[self.body[i]].state for i in points]
        velocity = np.zeros((len(points), steps + 1))
        displacement = np.zeros((len(points), steps))
        start = [state.pos[1] for state in states]
        values = ground.tolist()
        first = self.omega.iter

        def drive():  # one call a step costs microseconds, the step milliseconds
            n = self.omega.iter - first
            self.newton.gravity = (0.0, -values[n], -self.gravity)
            for i, state in enumerate(states):
                displacement[i, n] = state.pos[1] - start[i]
                velocity[i, n] = state.vel[1]

        self.omega.engines = [loop.runner(drive, 1), *self.omega.engines]
        loop.run(self.omega, steps)
        velocity[:, steps] = [state.vel[1] for state in states]
        size = max(max(block.size_m) for block in self.scene.blocks)
        if not (np.all(np.isfinite(velocity)) and np.all(np.abs(displacement) < size)):
            raise EngineError("the explicit run lost its stability: the step is too long")
        # velocities live at half steps: their difference is the acceleration at the step
        acceleration = np.diff(velocity, axis=1) / self.step_s + ground[:-1]
        return t[:-1], acceleration, displacement


def corner(scene):
    """Return the index of the highest block, of those the one farthest along y, then x.

    A corner of a wall's top feels the rattling that symmetry keeps from the floors.
    """
    free = [i for i, block in enumerate(scene.blocks) if block.free]
    return max(free, key=lambda i: [round(scene.blocks[i].centre_m[k], 6) for k in (2, 1, 0)])


def _groups(values, count):
    """Return, for each number below `count`, the positions at which it occurs in `values`."""
    order = np.argsort(values, kind="stable")
    edges = np.searchsorted(values[order], np.arange(count + 1))
    return [order[edges[i] : edges[i + 1]] for i in range(count)]


def _clump(omega, block, members):
    """Join a carrier and massless spheres to a clump with the block's mass and freedoms."""
    # Stand-in moments in ascending order keep the clump's frame on x, y, z (signs apart).
    state = omega.bodies[members[0]].state
    state.mass, state.inertia = block.mass_kg, (1.0, 2.0, 3.0)
    number = omega.bodies.clump(members)
    state = omega.bodies[number].state
    frame = np.array([list(row) for row in state.ori.toRotationMatrix()])
    if not np.allclose(np.abs(np.diag(frame)), 1.0, atol=1e-9):
        raise EngineError(f"YADE turned the frame of block '{block.name}'")
    state.pos = tuple(block.centre_m)
    state.mass, state.inertia = block.mass_kg, tuple(block.inertia_kg_m2)
    state.blockedDOFs = "".join(d for d in "xyzXYZ" if d not in block.free)
    omega.bodies[number].aspherical = False
    return number


def main(arguments=None):
    """Read a scene and a motion, run, write the history (CSV) and the cost (JSON)."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scene", required=True, help="scene file (JSON)")
    parser.add_argument("--motion", required=True, help="CSV: time_s, ground acceleration in m/s²")
    parser.add_argument("--rate", type=float, help="damping rate a [1/s]; default the scene's note")
    parser.add_argument("--step", type=float, help="time step [s]; default the scene's note")
    parser.add_argument("--duration", type=float, help="[s]; default the scene's note")
    parser.add_argument("--steps", type=int, help="number of steps instead of a duration")
    parser.add_argument("--gravity", type=float, default=0.0, help="downward, sudden [m/s²]")
    parser.add_argument("--output", required=True, help="CSV: time_s, top and corner")
    parser.add_argument("--cost", help="JSON with steps, wall time and memory")
    options = parser.parse_args(arguments)
    scene = read_scene(options.scene)
    with open(options.motion, encoding="utf-8", newline="") as handle:
        rows = [row for row in csv.reader(line for line in handle if not line.startswith("#"))]
    motion = np.array([[float(v) for v in row[:2]] for row in rows[1:]])
    rate, step, duration = (
        scene.notes[key] if given is None else given
        for key, given in (
            ("rate_1_s", options.rate),
            ("step_s", options.step),
            ("duration_s", options.duration),
        )
    )
    if options.steps is not None:
        duration = options.steps * step
    duration = min(duration, motion[-1, 0])
    limit = scene.notes.get("omega_max_rad_s")
    if limit and step >= 2.0 / limit:
        raise ValueError(f"step of {step:g} s: expected less than the critical {2.0 / limit:g} s")
    points = [scene.index(scene.monitor), corner(scene)]
    clocks = [(time.perf_counter(), time.process_time())]
    building = ExplicitBuilding(scene, step, rate, options.gravity)
    clocks.append((time.perf_counter(), time.process_time()))
    t, acceleration, displacement = building.run(motion[:, 0], motion[:, 1], duration, points)
    clocks.append((time.perf_counter(), time.process_time()))
    with open(options.output, "w", encoding="utf-8") as handle:
        handle.write("time_s,top_m_s2,corner_m_s2,top_m,corner_m\n")
        for row in np.vstack([t, acceleration, displacement]).T:
            handle.write(",".join(f"{value:.9g}" for value in row) + "\n")
    if options.cost:
        cost = {
            "blocks": len(scene.blocks),
            "pairs": len(scene.nodes),
            "steps": len(t),
            "step_s": step,
            "build_s": clocks[1][0] - clocks[0][0],
            "run_s": clocks[2][0] - clocks[1][0],
            "run_cpu_s": clocks[2][1] - clocks[1][1],
            "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
        }
        with open(options.cost, "w", encoding="utf-8") as handle:
            json.dump(cost, handle, indent=1)
