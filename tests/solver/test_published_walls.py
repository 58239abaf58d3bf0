"""Collapse multipliers of dry block walls by others, by the solver of several blocks.

Ferris and Tin-Loi (2001), International Journal of Mechanical Sciences 43: walls in the plane of
blocks 0.4 × 0.175 m in running bond, friction 0.65 in every joint, on a fixed bed, pushed sideways
by a share of their weight. Five blocks wide, six rows give a multiplier of 0.643 and ten 0.564.
"""

import itertools
import math

import numpy as np
import pytest
from rocking.solver import Motions, history, to_plane

from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.scene import Block, Interface, NodeList, Scene, box_inertia

LENGTH, HEIGHT, DENSITY = 0.4, 0.175, 1000.0
FRICTION, STIFFNESS_PA_M, BETA_S = 0.65, 2e8, 4e-4
RULES = {
    "overturn_ratio": 1.0,
    "rest_time_s": 0.1,
    "after_motion_s": 0.0,
    "quiet_ratio": 0.0,
    "max_speed_ratio": 50.0,
    "rest_velocity_m_s": 0.0,
}


def wall(rows, across, ends=2):
    """Rows of blocks, halves at the ends of every other one; nodes at the ends of each contact."""
    whole = across * LENGTH
    bed = Block(
        "bed", (0.0, whole / 2, -0.1), (1.0, whole, 0.2), 1.0, (1.0,) * 3, free="", motion="ground"
    )
    blocks, courses = [bed], [[(0.0, whole, 0)]]
    for r in range(rows):
        inner = np.arange(0.0 if r % 2 else 0.5, across) * LENGTH
        edges = np.unique([0.0, *inner, whole])
        courses.append([])
        for low, high in itertools.pairwise(edges.tolist()):
            size, mass = (1.0, high - low, HEIGHT), DENSITY * (high - low) * HEIGHT
            courses[-1].append((low, high, len(blocks)))
            centre = (0.0, 0.5 * (low + high), (r + 0.5) * HEIGHT)
            inertia = box_inertia(mass, size)
            blocks.append(Block(f"block {len(blocks)}", centre, size, mass, inertia, free="yzX"))
    nodes, (places, weights) = NodeList(), gauss_lobatto(ends)
    law = {"beta_s": BETA_S, "friction_rad": math.atan(FRICTION)}

    def join(a, b, start, along, length, normal):
        line = np.array(start) + np.outer(places * length, along)
        stiff = STIFFNESS_PA_M, STIFFNESS_PA_M
        nodes.add_joint(
            f"{a} on {b}", a, b, line, normal, weights * length, Interface(*stiff, **law)
        )

    for r, (below, row) in enumerate(itertools.pairwise(courses)):
        for (low, high, a), (first, last, b) in itertools.product(row, below):
            start, end = max(low, first), min(high, last)
            if end - start > 1e-9:
                join(a, b, (0.0, start, r * HEIGHT), (0.0, 1.0, 0.0), end - start, (0, 0, 1))
        for (_, edge, b), (_, _, a) in itertools.pairwise(row):
            join(a, b, (0.0, edge, r * HEIGHT), (0.0, 0.0, 1.0), HEIGHT, (0, 1, 0))
    top = blocks[-1]
    point = (0.0, top.centre_m[1], rows * HEIGHT)
    return Scene(blocks, nodes.joints, nodes.done(), top.name, point, "bed", 0.05)


@pytest.mark.slow
def test_multiplier_of_ferris_and_tin_loi():
    """Six rows stand under 0.62 of their weight sideways and fall under 0.66; published 0.643."""
    plane = to_plane(wall(6, 5))
    share = Motions([0.0, 0.1, 0.5, 1.5], 9.81 * np.array([0.0, 0.0, 1.0, 1.0]))
    stands, falls = (history(plane, share, RULES, level) for level in (0.62, 0.66))
    assert stands.status == "ok"
    assert abs(stands.d_m[-1]) < 2e-3
    assert falls.status == "overturned"
