"""The W1 cases of the accuracy study in MuJoCo, for comparison.

Configured as its manual allows: the same contact nodes as spheres against planes, elliptic
friction cones, Newton solver, direct stiffness and damping (negative solref) scaled by the body's
inverse weight so that each contact is the node's own spring and dashpot, and a small constant
impedance so that contacts do not stiffen each other. MuJoCo's friction has no shear spring. The
scene is solved in the base's frame: gravity carries the ground acceleration.
"""

import math
import time

import numpy as np
from outside import AFTER_S, SAMPLE_S, Peak

NAME, PACKAGE = "MuJoCo", "mujoco"
STEPS = (0.2, 0.1, 0.05)  # over the critical one of our own scheme
IMPEDANCE = 1e-3
RADIUS_M = 1e-3


def model_text(scene, dt_s, scale=1.0):
    """MJCF text of a planar façade scene; `scale` is the body's inverse weight [1/kg]."""
    index = scene.index(scene.monitor)
    block, nodes = scene.blocks[index], scene.nodes
    centre = np.array(block.centre_m)
    ix, iy, iz = block.inertia_kg_m2
    geoms = []
    for i in range(len(nodes)):
        at = nodes.position_m[i] - centre + RADIUS_M * nodes.normal[i]
        bit = 1 if nodes.normal[i][2] > 0.5 else 2
        k, c = nodes.kn_n_m[i] * scale, nodes.beta_s[i] * nodes.kn_n_m[i] * scale
        geoms.append(
            f'<geom type="sphere" size="{RADIUS_M}" pos="{at[0]} {at[1]} {at[2]}" mass="0" '
            f'contype="{bit}" conaffinity="0" priority="1" condim="3" '
            f'friction="{math.tan(nodes.friction_rad[i])} 0 0" solref="{-k} {-c}" '
            f'solimp="{IMPEDANCE} {IMPEDANCE} 0.001 0.5 2"/>'
        )
    start = block.displacement_m
    body = "\n".join(geoms)
    return f"""<mujoco><compiler inertiafromgeom="false" boundmass="0"/>
<option timestep="{dt_s}" cone="elliptic" solver="Newton" iterations="50" tolerance="1e-12"
 integrator="Euler" gravity="0 0 {-scene.gravity_m_s2}"/>
<worldbody><geom type="plane" size="50 50 1" contype="0" conaffinity="1"/>
<geom type="plane" size="50 50 1" euler="-90 0 0" contype="0" conaffinity="2"/>
<body pos="{centre[0]} {centre[1] + start[1]} {centre[2] + start[2]}">
<inertial pos="0 0 0" mass="{block.mass_kg}" diaginertia="{ix} {iy} {iz}"/>
<joint type="slide" axis="0 1 0"/><joint type="slide" axis="0 0 1"/>
<joint type="hinge" axis="1 0 0"/>
{body}</body></worldbody></mujoco>"""


def run_case(scene, time_s, acceleration, dt_s):
    """Peak of one history, simulated and wall time; see `outside.compare`."""
    import mujoco

    first = mujoco.MjModel.from_xml_string(model_text(scene, dt_s))
    model = mujoco.MjModel.from_xml_string(
        model_text(scene, dt_s, float(first.body_invweight0[1, 0]))
    )
    data = mujoco.MjData(model)
    steps = math.ceil((time_s[-1] + AFTER_S) / dt_s)
    ground = np.interp(np.arange(steps) * dt_s, time_s, acceleration, right=0.0).tolist()
    peak, every = Peak(scene), max(1, round(SAMPLE_S / dt_s))
    began = time.perf_counter()
    for n in range(steps):
        model.opt.gravity[1] = -ground[n]
        mujoco.mj_step(model, data)
        if n % every == 0 and peak.add(data.qpos[0], data.qpos[2]):
            break
    return peak, (n + 1) * dt_s, time.perf_counter() - began
