"""Horizontal bending of a strip with arching thrust: plane in plan, so both solvers shake it there.

A strip between two lines that hold is, seen from above, a wall without weight that is pressed along
its length by the thrust: hinged where it opens, held at its far end.
"""

from dataclasses import replace

import pytest
from both_solvers import BETA_S, FEW
from rocking.solver.plane import to_plane
from rocking.solver.runs import Motions, history
from test_floors import floored, slow
from yade_process import in_yade

THRUST_KN, LONG_M, THICK_M = 80.0, 6.0, 0.5
NO_WEIGHT = 1e-6  # [m/s²]
FACADE = {"e_mpa": 3e4, "height_m": LONG_M, "thickness_m": THICK_M, "width_m": 1.0}
ARCH = {"load_kn": THRUST_KN, "arm_m": THICK_M, "height_m": LONG_M}  # on the outer face
ARCH |= {"friction": 0.0, "anchor_kn": 1000.0, "stiffness_kn_m": 1e6}
SHARES = {0.98: "ok", 1.02: "overturned"}


def strip(opens_m):
    """Configuration and scene of a strip that opens at a place, and the push that bends it [m/s²].

    2 H b (1/L₁ + 1/L₂)/m, the usual form of horizontal bending.
    """
    own = {**FACADE, "hinges_m": [opens_m]}
    config, scene = floored(ARCH, facade=own, numerics=FEW, models=["W1"])
    mass = config["facade"]["density_kg_m3"] * LONG_M * THICK_M
    both = 1.0 / opens_m + 1.0 / (LONG_M - opens_m)
    return config, scene, 2e3 * THRUST_KN * THICK_M * both / mass


@pytest.mark.parametrize("opens_m", [3.0, 2.0])
def test_a_strip_in_plan_bends_at_the_usual_form(opens_m):
    config, scene, push = strip(opens_m)
    scene = replace(scene, gravity_m_s2=NO_WEIGHT)
    for share, status in SHARES.items():
        t, pull = slow(share * push)
        got = history(to_plane(scene), Motions(t, -pull), config["numerics"], sample_s=0.01)
        assert got.status == status


@pytest.mark.yade
def test_so_it_does_in_yade():
    config, _, push = strip(2.5)
    t, _ = slow(1.0)
    pushes = [(-slow(share * push)[1]).tolist() for share in SHARES]
    found = in_yade(
        "corner_cases", "strips", config=config, beta_s=BETA_S, time_s=t.tolist(), pushes=pushes
    )
    assert found == list(SHARES.values())
