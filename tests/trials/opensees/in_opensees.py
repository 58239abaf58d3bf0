"""One history of a planar scene in OpenSees; run by `run.py` in a Python that has openseespy.

    python in_opensees.py < asked.json > answer.json

Rigid blocks are spiders of stiff elastic beams with corotational geometry, their mass at the
centroid. A contact node is a flat slider. Across it is a ViscoelasticGap, whose tension the slider
drops, N = max(0, kn (δ + β δ̇)); along it a spring ks slides at μN, without a dashpot. What slips
while it is open it keeps. The frame is the ground's: masses feel −m a_g, driven walls have their
motion relative to it at every node, and the chain of W2m is masses on springs and dashpots. A node
tied by equalDOF to one whose motion is imposed is a step ahead of it, so none is. TRBDF2 damps what
impacts leave in the stiff beams, where Newmark's constant average acceleration errs by several per
cent at the same step. ViscoelasticGap keeps its dashpot out of the tangent, with which Newton's own
iteration does not converge on light courses; accelerated in a Krylov subspace of twelve it takes
three to six iterations. Where it does not converge it is tried from the initial tangent, then with
halves of the step, up to six times.
"""

import json
import math
import os
import sys
import time

import numpy as np
import openseespy.opensees as ops

STIFF_N_M = 1e12  # of the beams, axial and 12 EI/L³
TINY = 1e-3
SETTLE_S = 0.6  # before the motion
TOLERANCE_M, HALVINGS = 1e-9, 6
SUBSPACE = ("-maxDim", 12)
ALGORITHMS = (
    (("KrylovNewton", *SUBSPACE), 100),
    (("KrylovNewton", "-iterate", "initial", "-increment", "initial", *SUBSPACE), 200),
)


def add_blocks(blocks):
    """A node at each centroid with its mass, fixed where it is not free; node i + 1 is block i."""
    for i, block in enumerate(blocks, 1):
        ops.node(i, *block["centre_m"][1:])
        ops.fix(i, *(int(freedom not in block["free"]) for freedom in "yzX"))
        if block["free"]:
            mass = [block["mass_kg"]] * 2 + [block["inertia_kg_m2"][0]]
            ops.mass(
                i, *(m if f in block["free"] else 0.0 for m, f in zip(mass, "yzX", strict=True))
            )


class Model:
    """Tags in use, and the beams and sliders that are added."""

    def __init__(self, scene):
        """Build a scene."""
        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        self.scene, self.blocks, self.tag = scene, scene["blocks"], len(scene["blocks"])
        add_blocks(self.blocks)
        ops.geomTransf("Corotational", 1)
        ops.uniaxialMaterial("Elastic", 1, TINY)
        self.points, self.driven = {}, {}
        nodes = scene["nodes"]
        for k in range(len(nodes["a"])):
            self.contact({name: column[k] for name, column in nodes.items()})
        for link in scene["links"]:
            self.link(link)

    def new(self):
        self.tag += 1
        return self.tag

    def point(self, block, place):
        """A node that moves with a block as a rigid part of it."""
        key = block, *(round(v, 9) for v in place)
        if key not in self.points:
            node = self.points[key] = self.new()
            own, centre = self.blocks[block], self.blocks[block]["centre_m"][1:]
            ops.node(node, *place)
            if "X" in own["free"]:
                long = max(math.dist(place, centre), TINY)
                area, inertia = STIFF_N_M * long, STIFF_N_M * long**3 / 12.0
                ops.element("elasticBeamColumn", self.new(), block + 1, node, area, 1.0, inertia, 1)
            elif own["free"]:
                ops.fix(node, 0, 1, 1)
                ops.equalDOF(block + 1, node, 1)
            else:
                ops.fix(node, 1, 1, 1)
                self.driven.setdefault(block + 1, [block + 1]).append(node)
        return self.points[key]

    def contact(self, node):
        """A flat slider between a node of block a and the plane of block b."""
        place, normal = node["position_m"][1:], node["normal"][1:]
        low, high = self.point(int(node["b"]), place), self.point(int(node["a"]), place)
        law, friction = self.new(), self.new()
        gap = -max(node["gap_m"], 1e-12)
        ops.uniaxialMaterial(
            "ViscoelasticGap", law, node["kn_n_m"], node["beta_s"] * node["kn_n_m"], gap
        )
        ops.frictionModel("Coulomb", friction, math.tan(node["friction_rad"]))
        across = (normal[0], normal[1], 0.0, -normal[1], normal[0], 0.0)
        ops.element(
            "flatSliderBearing", self.new(), low, high, friction, node["ks_n_m"],
            "-P", law, "-Mz", 1, "-orient", *across,
        )  # fmt: skip

    def link(self, link):
        """A spring and a dashpot along y, to the ground where b does not move."""
        spring, dashpot, both = self.new(), self.new(), self.new()
        ops.uniaxialMaterial("Elastic", spring, link["stiffness_n_m"])
        ops.uniaxialMaterial("Viscous", dashpot, max(link["dashpot_ns_m"], TINY), 1.0)
        ops.uniaxialMaterial("Parallel", both, spring, dashpot)
        ends = [self.beside(link["a"]), self.beside(link["b"])]
        ops.element("zeroLength", self.new(), *ends, "-mat", both, "-dir", 1)

    def beside(self, block):
        """A node of a mass at one common place, since links have no length."""
        key = block, "link"
        if key not in self.points:
            node = self.points[key] = self.new()
            ops.node(node, -1.0, 0.0)
            ops.fix(node, int(not self.blocks[block]["free"]), 1, 1)
            if self.blocks[block]["free"]:
                ops.equalDOF(block + 1, node, 1)
        return self.points[key]


def weigh(model):
    """Weights, which grow to their size and rest before the motion begins."""
    ops.timeSeries("Path", 1, "-time", 0.0, 0.5 * SETTLE_S, 1e6, "-values", 0.0, 1.0, 1.0)
    ops.pattern("Plain", 1, 1)
    for i, block in enumerate(model.blocks, 1):
        if "z" in block["free"]:
            ops.load(i, 0.0, -block["mass_kg"] * model.scene["gravity_m_s2"], 0.0)


def solver():
    """How a step is solved; the tangent of sliding is not symmetric."""
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")


def between(time_s, a, step_s):
    """Displacement, velocity and acceleration at every step, a linear between its samples.

    With displacements linear between samples of the record courses did not converge.
    """
    h, jerk = np.diff(time_s), np.diff(a) / np.diff(time_s)
    v = np.concatenate(([0.0], np.cumsum(0.5 * h * (a[1:] + a[:-1]))))
    u = np.concatenate(([0.0], np.cumsum(h * (v[:-1] + h * (2.0 * a[:-1] + a[1:]) / 6.0))))
    at = step_s * np.arange(round((time_s[-1] - time_s[0]) / step_s) + 1)
    k = np.minimum(np.searchsorted(time_s - time_s[0], at + 1e-9, "right") - 1, h.size - 1)
    s = at - time_s[k] + time_s[0]
    speed = v[k] + s * (a[k] + 0.5 * s * jerk[k])
    return u[k] + s * (v[k] + s * (0.5 * a[k] + s * jerk[k] / 6.0)), speed, a[k] + s * jerk[k]


def shake(model, asked):
    """Loads of the inertia forces, and motions of driven walls relative to the ground."""
    time_s = SETTLE_S + np.array(asked["time_s"])
    ground = asked["factor"] * np.array(asked["columns"]["ground"])
    ops.timeSeries("Path", 2, "-time", *time_s, "-values", *ground)
    ops.pattern("Plain", 2, 2)
    for i, block in enumerate(model.blocks, 1):
        if "y" in block["free"]:
            ops.load(i, -block["mass_kg"], 0.0, 0.0)
    series = 10
    for i, block in enumerate(model.blocks, 1):
        name = block["motion"]
        if name in (None, "ground"):
            continue
        a = asked["factor"] * np.array(asked["columns"][name]) - ground
        for k, values in enumerate(between(np.array(asked["time_s"]), a, asked["dt_s"])):
            ops.timeSeries(
                "Path", series + k, "-dt", asked["dt_s"], "-startTime", SETTLE_S,
                "-values", *values, "-useLast",
            )  # fmt: skip
        ops.pattern("MultipleSupport", series)
        ops.groundMotion(
            series, "Plain", "-disp", series, "-vel", series + 1, "-accel", series + 2
        )  # fmt: skip
        for node in model.driven.get(i, [i]):
            ops.remove("sp", node, 1)
            ops.imposedMotion(node, 1, series)
        series += 10


def advance(step_s, counts, depth=0):
    """One step by the first algorithm that converges, or two halves of it."""
    for algorithm, most in ALGORITHMS:
        counts["steps"] += 1
        ops.test("NormDispIncr", TOLERANCE_M, most)
        ops.algorithm(*algorithm)
        if ops.analyze(1, step_s) == 0:
            return True
        counts["again"] += 1
    return depth < HALVINGS and all(advance(0.5 * step_s, counts, depth + 1) for _ in range(2))


def run(asked):
    """Peak |d|/b of one history, how it ended, and its time."""
    scene = asked["scene"]
    began = time.process_time()
    model = Model(scene)
    weigh(model)
    shake(model, asked)
    solver()
    ops.integrator("TRBDF2")
    ops.analysis("Transient")
    built = time.process_time() - began
    names = [block["name"] for block in scene["blocks"]]
    watched = [[scene["monitor"], scene["monitor_point_m"]], *scene["notes"].get("watched", [])]
    arms = []
    for name, point in watched:
        i = names.index(name)
        arms.append((i + 1, *np.subtract(point, scene["blocks"][i]["centre_m"])[1:].tolist()))
    peak, status, counts = 0.0, "ok", {"steps": 0, "again": 0}
    began, end = time.process_time(), SETTLE_S + asked["end_s"]
    while ops.getTime() < end - 1e-9:
        if not advance(asked["dt_s"], counts):
            status = "failed"
            break
        for node, y, z in arms:
            turn = ops.nodeDisp(node, 3)
            d = ops.nodeDisp(node, 1) + math.cos(turn) * y - math.sin(turn) * z - y
            peak = max(peak, abs(d) / scene["thickness_m"])
        if peak >= 1.0:
            status = "overturned"
            break
    took = time.process_time() - began
    return {
        **{"d_over_b": peak, "status": status, "cpu_s": took, "built_s": built},
        **{"end_s": ops.getTime() - SETTLE_S, **counts},
    }


def main():
    """Read what is asked, write what was found; OpenSees reports every impact, to nowhere."""
    asked = json.load(sys.stdin)
    answer = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2) if "-v" not in sys.argv else None
    found = run(asked)
    os.write(answer, json.dumps(found).encode())


if __name__ == "__main__":
    main()
