"""An own boundary condition: the wall of `scene_by_hand` with a steel frame before it, in YADE.

    PYTHONPATH=. /usr/bin/python3 docs/examples/own_boundary_condition.py

The frame is a block that moves with the ground, a gap away from the wall; the joint between them
is a line of nodes with that gap. Bodies, faces, K, M and the critical step follow from the scene,
and so does the compiled planar solver.
"""

import math
from dataclasses import fields, replace

import numpy as np
from scene_by_hand import B_M, H_M, NUMERICS, WIDTH_M, standing

from yade_scripts.engine import adapter, simulate
from yade_scripts.model import scene as parts
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

HEIGHT_M, RAIL_M, GAP_M = 2.5, 0.2, 0.05  # of the rail, its depth, its distance from the wall
PULSE_G, PULSE_S = 0.25, 0.6
TIME_S = np.linspace(0.0, 1.0, 201)
GROUND_M_S2 = np.where(
    TIME_S < PULSE_S,
    PULSE_G * STANDARD_GRAVITY_M_S2 * np.sin(2.0 * math.pi * TIME_S / PULSE_S),
    0.0,
)


def framed(scene, gap_m=GAP_M):
    """The scene with a frame before the wall."""
    rail = parts.Block(
        "frame",
        (0.0, B_M + gap_m + 0.5, HEIGHT_M),
        (WIDTH_M, 1.0, RAIL_M),
        1.0,
        (1.0, 1.0, 1.0),
        free="",
        motion="ground",
    )
    nodes = parts.NodeList()
    nodes.add_joint(
        "frame",
        scene.index("wall"),
        len(scene.blocks),
        [(0.0, B_M, HEIGHT_M + z) for z in (-0.5 * RAIL_M, 0.5 * RAIL_M)],
        (0.0, -1.0, 0.0),  # from the frame into the wall
        0.5 * RAIL_M * WIDTH_M,
        parts.Interface(1e9, 0.4e9, beta_s=1e-4, friction_rad=math.radians(20.0), gap_m=gap_m),
    )
    frame_nodes = nodes.done()
    frame_nodes.joint = frame_nodes.joint + len(scene.joints)
    both = {
        f.name: np.concatenate([getattr(scene.nodes, f.name), getattr(frame_nodes, f.name)])
        for f in fields(frame_nodes)
    }
    return replace(
        scene,
        blocks=[*scene.blocks, rail],
        joints=[*scene.joints, *nodes.joints],
        nodes=parts.Nodes(**both),
    )


def met_d_over_b():
    """Displacement of the top, over the thickness, at which the rail's upper edge is met."""
    return GAP_M * H_M / (HEIGHT_M + 0.5 * RAIL_M) / B_M


def shaken(scene, limit_s=4.0):
    """History of a scene under one cycle of sine."""
    step_s, _ = simulate.choose_step(scene, NUMERICS)
    ground = adapter.SupportMotion(TIME_S, GROUND_M_S2)
    rules = simulate.StopRules(TIME_S[-1], limit_s)
    return simulate.run(scene, {"ground": ground}, step_s, rules)


if __name__ == "__main__":
    for name, scene in (("alone", standing()), ("with the frame", framed(standing()))):
        history = shaken(scene)
        outward = history.d_m.max() / B_M
        print(f"{name}: {history.status}, top moves outward by {outward:.3f} of the thickness")
    print(f"the frame is met at {met_d_over_b():.3f}")
