"""What a configuration becomes in SI units: weights, stiffnesses, strengths and the chain.

Both solvers read these numbers from one scene, so that comparing them cannot show a wrong unit.
"""

import math

import numpy as np
import pytest
from yade_process import resolved

from yade_scripts.model.facade import facade_scene

FACADE = {"height_m": 6.0, "thickness_m": 0.4, "width_m": 5.0, "density_kg_m3": 1700.0}
FACADE |= {"e_mpa": 1500.0, "friction_deg": 35.0, "shear_stiffness_ratio": 0.3}
WALL = {"count": 2, "thickness_m": 0.25, "friction_deg": 25.0, "cohesion_mpa": 0.12}
WALL |= {"tension_mpa": 0.05, "length_m": 2.5, "building_mass_kg": 50000.0}


def scene(model="W2c", **sections):
    merged = {"facade": {**FACADE, **sections.pop("facade", {})}, "return_wall": WALL, **sections}
    return facade_scene(resolved(**merged), model, 0.002)


def test_mass_and_inertia_of_the_façade():
    """ρ h b w = 20.4 t; about x through the centroid m (h² + b²)/12."""
    block = scene().blocks[1]
    mass = 1700.0 * 6.0 * 0.4 * 5.0
    assert block.mass_kg == pytest.approx(mass)
    assert block.inertia_kg_m2[0] == pytest.approx(mass * (6.0**2 + 0.4**2) / 12.0)
    assert block.centre_m == pytest.approx((0.0, 0.2, 3.0))


def test_joints_have_stiffness_and_strength_over_their_area():
    """Base E/h over b w; return walls E/L, tan φ, c and f_t over two walls of 0.25 m by 6 m."""
    nodes = scene().nodes
    base, back = nodes.normal[:, 2] > 0.5, nodes.normal[:, 1] > 0.5
    assert np.all(base ^ back)
    area = 2 * 0.25 * 6.0
    for mine, total, jkn, friction in ((base, 2.0, 250e6, 35.0), (back, area, 600e6, 25.0)):
        assert nodes.area_m2[mine].sum() == pytest.approx(total)
        assert nodes.kn_n_m[mine].sum() == pytest.approx(jkn * total)
        assert nodes.ks_n_m[mine].sum() == pytest.approx(0.3 * jkn * total)
        assert nodes.friction_rad[mine] == pytest.approx(math.radians(friction))
        assert nodes.beta_s[mine] == pytest.approx(0.002)
    assert nodes.cohesion_n[back].sum() == pytest.approx(0.12e6 * area)
    assert nodes.tension_n[back].sum() == pytest.approx(0.05e6 * area)
    assert not nodes.cohesion_n[base].any()
    assert not nodes.tension_n[base].any()
    assert np.all(nodes.position_m[back, 1] == 0.0)  # the inner face: the façade falls outward
    assert nodes.position_m[base, 1].min() == 0.0
    assert nodes.position_m[base, 1].max() == pytest.approx(0.4)


@pytest.mark.parametrize("model", ["W1", "W2", "W2m"])
def test_a_block_behind_the_façade_is_as_wide_as_all_return_walls(model):
    found = scene(model)
    carriers = set(found.nodes.b[found.nodes.normal[:, 1] > 0.5])  # of the joint behind the façade
    behind = [found.blocks[k] for k in carriers]
    assert behind
    assert [one.size_m[0] for one in behind] == pytest.approx([2 * 0.25] * len(behind))


def test_a_clearance_is_the_nodes_gap():
    nodes = scene("W2", facade={"gap_m": 0.012}).nodes
    back = nodes.normal[:, 1] > 0.5
    assert nodes.gap_m[back] == pytest.approx(0.012)
    assert not nodes.gap_m[~back].any()


def test_walls_that_carry_the_building_have_its_mass_period_and_damping():
    """Two-way coupled walls: 50 t in all, T1 = 0.35 s, ζ = 4 % in every mode, by their links."""
    made = scene("W2m", smdof={"period_s": 0.35, "damping_ratio": 0.04})
    walls = [i for i, block in enumerate(made.blocks) if block.name.startswith("return wall")]
    mass = np.array([made.blocks[i].mass_kg for i in walls])
    assert mass.sum() == pytest.approx(50000.0)
    k, c = np.zeros((2, len(walls), len(walls)))
    for link in made.links:
        ends = [walls.index(i) for i in (link.a, link.b) if i in walls]
        row = np.zeros(len(walls))
        row[ends] = [1.0, -1.0][: len(ends)]
        k += link.stiffness_n_m * np.outer(row, row)
        c += link.dashpot_ns_m * np.outer(row, row)
    values, vectors = np.linalg.eigh(k / mass[0])
    assert 2.0 * math.pi / math.sqrt(values[0]) == pytest.approx(0.35, rel=1e-6)
    first = np.abs(vectors[:, 0])
    assert np.all(np.diff(first) > 0.0)  # the top moves most
    modal = vectors.T @ (c / mass[0]) @ vectors
    assert np.diag(modal) / (2.0 * np.sqrt(values)) == pytest.approx(0.04, rel=1e-6)
    assert np.abs(modal - np.diag(np.diag(modal))).max() < 1e-6 * modal.max()
