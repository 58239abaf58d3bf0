"""A scene by hand: a wall let go at half its critical angle rocks on a base, in YADE.

    PYTHONPATH=. /usr/bin/python3 docs/examples/scene_by_hand.py

Two blocks and one joint, with nothing of the workflow. A rigid block would be upright after
the quarter period acosh(1/(1 − θ₀/α))/p, p = √(3g/4R) (Housner 1963).
"""

import math

import numpy as np

from yade_scripts.engine import adapter, simulate
from yade_scripts.model import scene as parts
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.rest import initial_pose, settlement

H_M, B_M, WIDTH_M = 3.0, 0.3, 1.0
MASS_KG = 1800.0 * H_M * B_M * WIDTH_M
JKN_PA_M, BETA_S = 1e10, 1e-4  # normal stiffness of the joint, its damping
ALPHA, SIZE_M = math.atan2(B_M, H_M), 0.5 * math.hypot(B_M, H_M)
NUMERICS = {"step_s": None, "step_fraction": 0.05}


def standing(ratio=0.0, sunk_m=None):
    """The wall on its base, turned outward by a share of its critical angle.

    Parameters
    ----------
    ratio : float
        θ₀/α.
    sunk_m : float, optional
        How deep its toe is pressed; None: as deep as its weight asks.

    Returns
    -------
    Scene
        It stands at 0 ≤ y ≤ b; the nodes of the base are on its edges and between them.
    """
    points, weights = gauss_lobatto(9)  # on 0 to 1, both ends included
    nodes = parts.NodeList()
    nodes.add_joint(
        "base",
        1,  # the wall carries the nodes
        0,  # and the base is the plane through them
        [(0.0, y, 0.0) for y in points * B_M],
        (0.0, 0.0, 1.0),
        weights * B_M * WIDTH_M,
        parts.Interface(JKN_PA_M, 0.4 * JKN_PA_M, beta_s=BETA_S, friction_rad=math.radians(35.0)),
    )
    joint = nodes.done()
    if sunk_m is None:
        lift_m = (1.0 - points) * B_M * math.sin(ratio * ALPHA)
        sunk_m = settlement(MASS_KG * GRAVITY_M_S2, joint.kn_n_m, lift_m)
    moved_m, turned_rad = initial_pose((0.5 * B_M, 0.5 * H_M), ratio * ALPHA, sunk_m)
    size_m = (WIDTH_M, B_M, H_M)
    base = parts.Block(
        "base", (0.0, 0.0, -0.5), (4.0, 4.0, 1.0), 1.0, (1.0, 1.0, 1.0), free="", motion="ground"
    )
    wall = parts.Block(
        "wall",
        (0.0, 0.5 * B_M, 0.5 * H_M),
        size_m,
        MASS_KG,
        parts.box_inertia(MASS_KG, size_m),
        free="yzX",  # it moves in the plane
        displacement_m=moved_m,
        rotation_rad=turned_rad,
    )
    return parts.Scene(
        [base, wall],
        nodes.joints,
        joint,
        monitor="wall",
        monitor_point_m=(0.0, 0.5 * B_M, H_M),
        reference="base",
        thickness_m=B_M,
    )


def let_go(scene, limit_s, setup=None, step_s=None):
    """Run a scene on ground that stands still.

    Parameters
    ----------
    scene : Scene
    limit_s : float
    setup : callable, optional
        Takes the scene as built in YADE, before its first step.
    step_s : float, optional
        None: a twentieth of the critical step.

    Returns
    -------
    simulate.YadeHistory
    """
    still = adapter.SupportMotion(np.array([0.0, limit_s + 1.0]), np.zeros(2))
    step_s = step_s or simulate.choose_step(scene, NUMERICS)[0]
    rules = simulate.StopRules(limit_s, limit_s)
    return simulate.run(scene, {"ground": still}, step_s, rules, sample_s=0.002, setup=setup)


def quarter_s(history):
    """Time at which the wall first passes the upright [s]."""
    i = int(np.argmax(history.rotation_rad <= 0.0))
    (t0, t1), (r0, r1) = history.time_s[i - 1 : i + 1], history.rotation_rad[i - 1 : i + 1]
    return float(t0 + (t1 - t0) * r0 / (r0 - r1))


def closed_form_s(ratio):
    """Quarter period of a rigid block, for small angles (Housner 1963) [s]."""
    return math.acosh(1.0 / (1.0 - ratio)) / math.sqrt(0.75 * GRAVITY_M_S2 / SIZE_M)


def told(history, ratio):
    """Two lines on a history that began at a share of the critical angle."""
    upright = f"upright after {quarter_s(history):.3f} s, rigid block {closed_form_s(ratio):.3f} s"
    back = -history.rotation_rad.min() / (ratio * ALPHA)
    return f"{upright}\nthen leans the other way, by {back:.2f} of the angle it was let go at"


if __name__ == "__main__":
    print(told(let_go(standing(0.5), 2.0), 0.5))
