"""Pieces of a façade between hinges, and a gable alone: masses another way, and their statics."""

import numpy as np
import pytest
from both_solvers import BETA_S, FEW, slow
from rocking.configuration.config import ConfigError
from rocking.solver import Motions, history, to_plane
from test_shape import DOOR, SIDE, STEP, WINDOW, summed
from yade_process import resolved

from yade_scripts.model.facade import facade_scene
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.shape import shape_of

CUT = {
    "a setback between hinges": {"thickness_steps": [STEP]},
    "inner face flush": {"thickness_steps": [STEP], "flush_face": "inner"},
    "openings across hinges": {"openings": [WINDOW, DOOR, SIDE]},
    "all of it, and a gable": {
        "thickness_steps": [STEP],
        "openings": [WINDOW, DOOR, SIDE],
        "gable_height_m": 1.5,
    },
}


@pytest.mark.parametrize("name", CUT)
def test_pieces_are_those_of_the_drawing(name):
    """Sums over cells between the hinges: mass, centroid and moments of each within 0.2 %."""
    facade = resolved(facade={**CUT[name], "hinges_m": [2.0, 4.4]}, models=["W1"])["facade"]
    shape = shape_of(facade)
    edges = (0.0, 2.0, 4.4, shape.top_m)
    assert len(shape.pieces) == 3
    for (mass, centre, tensor, _), low, high in zip(shape.pieces, edges, edges[1:], strict=False):
        expected = summed(facade, low, high)
        assert mass == pytest.approx(expected[0], rel=2e-3)
        assert centre == pytest.approx(expected[1], abs=3e-3)
        assert tensor == pytest.approx(expected[2], rel=3e-3, abs=2e-3 * expected[2][2, 2])
    assert sum(piece[0] for piece in shape.pieces) == pytest.approx(shape.mass_kg, rel=1e-12)


def test_joints_have_what_both_pieces_have():
    """Thickness of the thinner, width less openings that stand on the hinge or hang from it."""
    facade = {"thickness_steps": [{"z_m": 2.0, "thickness_m": 0.25}], "openings": [WINDOW]}
    shape = shape_of(
        resolved(facade={**facade, "hinges_m": [2.0, 4.0, 4.5]}, models=["W1"])["facade"]
    )
    assert shape.joint_at(2.0) == pytest.approx((0.125, 0.375, 0.0))
    assert shape.joint_at(4.0) == pytest.approx((0.125, 0.375, 1.0))  # its sill
    assert shape.joint_at(4.5) == pytest.approx((0.125, 0.375, 1.0))
    wide = {"openings": [{"z_m": 2.5, "width_m": 4.398, "height_m": 1.0}], "hinges_m": [3.0]}
    inner = {"thickness_steps": [{"z_m": 2.0, "thickness_m": 0.25}], "hinges_m": [2.0]}
    config = resolved(facade=inner, models=["W1"], numerics=FEW)
    nodes = facade_scene(config, "W1", BETA_S).nodes
    at = np.isclose(nodes.position_m[:, 2], 2.0) & (nodes.normal[:, 2] > 0.5)
    jkn = 1.8e9 / (0.5 * 6.48)
    assert nodes.kn_n_m[at].sum() == pytest.approx(jkn * 0.25 * 4.4)
    assert nodes.position_m[at, 1].min() == pytest.approx(0.125)
    with pytest.raises(ConfigError, match="falls by itself|masonry"):
        resolved(facade=wide, models=["W1"])


HELD = {"height_m": 6.0, "load_kn": 20.0, "arm_m": 0.1, "friction": 0.0, "anchor_kn": 1000.0}
BENT = {  # flush face, and what differs
    "thinner above, outer face flush": ({}, 3.0),
    "thinner above, inner face flush": ({"flush_face": "inner"}, 3.0),
    "a hinge above the setback, a window below it": (
        {"openings": [{"z_m": 1.0, "width_m": 1.4, "height_m": 1.2}]},
        3.6,
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", BENT)
def test_vertical_bending_over_a_setback(name):
    """λ by virtual work of the pieces as they are: a push of 0.99 of it is borne, 1.01 fells.

    The lower piece turns by one about its toe, the upper by r = h₁/h₂ back about the inner edge y_j
    of the joint: λ Σ W u = Σ W w, u = z or h₁ − r (z − h₁), w = y_t − y or y_t − y_j + r (y − y_j).
    """
    own, hinge = BENT[name]
    facade = {"height_m": 6.0, "thickness_m": 0.4, "e_mpa": 1e5, **own}
    facade["thickness_steps"] = [{"z_m": 3.0, "thickness_m": 0.3}]
    facade |= {"hinges_m": [hinge], "floors": [{**HELD, "stiffness_kn_m": 1e6}]}
    config = resolved(facade=facade, models=["W1"], numerics=FEW)
    scene, shape = facade_scene(config, "W1", BETA_S), shape_of(config["facade"])
    (m1, c1, *_), (m2, c2, *_) = shape.pieces
    w1, w2, r, y_j = (
        m1 * GRAVITY_M_S2,
        m2 * GRAVITY_M_S2,
        hinge / (6.0 - hinge),
        shape.joint_at(hinge)[0],
    )
    back = shape.faces_at(6.0)[0]
    load_y = back + HELD["arm_m"]
    rises = 0.4 - y_j + r * (np.array([c2[1], load_y]) - y_j)
    resisting = w1 * (0.4 - c1[1]) + w2 * rises[0] + 20e3 * rises[1]
    pushed = w1 * c1[2] + w2 * (hinge - r * (c2[2] - hinge))
    for share, status in ((0.99, "ok"), (1.01, "overturned")):
        t, pull = slow(share * GRAVITY_M_S2 * resisting / pushed)
        got = history(to_plane(scene), Motions(t, -pull), config["numerics"], sample_s=0.01)
        assert got.status == status


def test_a_gable_alone():
    """m = ρ w h b/2 with its centroid at h/3; sums over cells; λ = (b/2)/(h/3) under a push."""
    facade = {"outline": "triangle", "sides": "two", "height_m": 2.0, "e_mpa": 1e5}
    damping = {"law": "value", "beta_s": BETA_S}
    config = resolved(facade=facade, models=["W1"], numerics=FEW, damping=damping)
    f = config["facade"]
    shape = shape_of(f)
    assert shape.mass_kg == pytest.approx(0.5 * 1800.0 * 2.0 * 0.375 * 4.4)
    assert shape.centre_m == pytest.approx((0.0, 0.1875, 2.0 / 3.0))
    drawn = {**f, "height_m": 0.0, "gable_height_m": 2.0}
    mass, centre, tensor = summed(drawn, 0.0, 2.0)
    assert shape.mass_kg == pytest.approx(mass, rel=5e-3)
    assert shape.centre_m == pytest.approx(centre, abs=3e-3)
    assert shape.tensor_kg_m2 == pytest.approx(tensor, rel=5e-3, abs=5e-3 * tensor[2, 2])
    scene = facade_scene(config, "W1", BETA_S)
    assert scene.thickness_m == pytest.approx(1.5 * 0.375)
    for share, status in ((0.99, "ok"), (1.01, "overturned")):
        t, pull = slow(share * GRAVITY_M_S2 * 0.1875 / (2.0 / 3.0))
        for side in (-1.0, 1.0):
            motions = Motions(t, side * pull)
            got = history(to_plane(scene), motions, config["numerics"], sample_s=0.01)
            assert got.status == status
