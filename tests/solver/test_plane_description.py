"""A scene as the plane that is marched: its nodes, where they stand and what they hold."""

import numpy as np
import pytest
from rocking.solver import to_plane
from test_plane import BETA_S, NODES
from yade_process import resolved

from yade_scripts.model.models import build_scene


@pytest.mark.parametrize("model", ["W1c", "W2"])
def test_the_plane_of_a_scene_says_what_its_nodes_say(model):
    """Places, planes less their gaps, stiffness, friction and strengths, node by node."""
    config = resolved(**{"numerics": NODES, "facade": {"gap_m": 3e-3, "friction_deg": 35.0}})
    scene = build_scene({**config, "model": model, "beta_s": BETA_S})
    plane, nodes, block = to_plane(scene), scene.nodes, scene.blocks[1]
    f = config["facade"]
    size = f["thickness_m"] ** 2 + f["height_m"] ** 2
    assert plane.inertia_kg_m2 == pytest.approx(plane.mass_kg * size / 12.0)
    assert plane.carried.all()  # the façade carries the nodes, walls and ground the planes
    found = []
    for g in range(len(plane.level_m)):
        for i in range(plane.first[g], plane.first[g + 1]):
            place = plane.origin_m[g] + plane.place_m[i] * plane.along[g]
            gap = plane.normal[g] @ place - plane.level_m[g]
            kn = plane.kn_n_m[i]
            law = plane.shear_ratio[g] * kn, plane.friction[g], plane.pull_m[i] * kn
            found.append((*place, gap, kn, *law, plane.hold_m[i] * kn))
    expected = zip(
        *(nodes.position_m[:, 1:] - np.array(block.centre_m)[1:]).T,
        *(nodes.gap_m, nodes.kn_n_m, nodes.ks_n_m, np.tan(nodes.friction_rad)),
        *(nodes.tension_n, nodes.cohesion_n),
        strict=True,
    )
    order = {"key": lambda row: np.round(row, 6).tolist()}
    one, other = sorted(found, **order), sorted(expected, **order)
    assert np.array(one) == pytest.approx(np.array(other))
    assert np.unique(nodes.friction_rad).size == 2
