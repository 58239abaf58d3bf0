"""Chains that yield in OpenSees; run by `chains.py` in a Python that has openseespy.

    python chain_in_opensees.py < asked.json > answer.json

Masses on zero-length storeys of Steel01, kinematic hardening, with the chain's own damping matrix
as dashpots between masses, under an acceleration of the base that is straight between samples.
Newmark's constant average acceleration, Newton's iteration.
"""

import json
import sys
import time

import openseespy.opensees as ops


def run(asked):
    """Largest drift of each storey [m], time of the processor [s], and failed steps."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    masses, damping, n = asked["mass_kg"], asked["damping"], len(asked["mass_kg"])
    ops.node(0, 0.0)
    ops.fix(0, 1)
    for j, mass in enumerate(masses, 1):
        ops.node(j, 0.0)
        ops.mass(j, mass)
    for j in range(1, n + 1):
        k, strength = asked["k_n_m"][j - 1], asked["yield_n"][j - 1]
        ops.uniaxialMaterial("Steel01", j, strength, k, asked["hardening"])
        ops.element("zeroLength", j, j - 1, j, "-mat", j, "-dir", 1)
    tag = n
    for i in range(n):
        for j in (None, *range(i + 1, n)):
            c = sum(damping[i]) if j is None else -damping[i][j]
            if c > 0.0:
                tag += 1
                ops.uniaxialMaterial("Viscous", tag, c, 1.0)
                other = 0 if j is None else j + 1
                ops.element("zeroLength", tag, other, i + 1, "-mat", tag, "-dir", 1)
    step = asked["step_s"]
    ops.timeSeries("Path", 1, "-dt", step, "-values", *asked["ground_m_s2"])
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-6 * max(asked["yield_n"]), 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    peak, failed, began = [0.0] * n, 0, time.process_time()
    for _ in asked["ground_m_s2"][1:]:
        failed += ops.analyze(1, step) != 0
        u = [0.0, *(ops.nodeDisp(j, 1) for j in range(1, n + 1))]
        peak = [max(p, abs(b - a)) for p, a, b in zip(peak, u, u[1:], strict=False)]
    return {"drift_m": peak, "cpu_s": time.process_time() - began, "failed": failed}


if __name__ == "__main__":
    json.dump([run(asked) for asked in json.load(sys.stdin)], sys.stdout)
