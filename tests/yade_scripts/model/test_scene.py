"""Quadrature, stiffness and critical step of scenes."""

import numpy as np
import pytest
from yade_process import resolved

from yade_scripts.model import facade, stiffness
from yade_scripts.model import scene as scenes
from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.scene import Block, Interface, NodeList, Scene, box_inertia, held, to_json


@pytest.mark.parametrize("count", [2, 3, 4, 5, 9, 17])
def test_lobatto_rule_is_exact_up_to_its_degree(count):
    """n points integrate polynomials of degree 2n − 3, and no more."""
    points, weights = gauss_lobatto(count)
    assert points[0] == 0.0
    assert points[-1] == 1.0
    for degree in range(2 * count - 2):
        assert weights @ points**degree == pytest.approx(1.0 / (degree + 1), rel=1e-12)
    if count <= 5:  # beyond, the first inexact degree is lost in rounding
        assert abs(weights @ points ** (2 * count - 2) - 1.0 / (2 * count - 1)) > 1e-8


def test_base_rotational_stiffness_is_exact_with_three_nodes():
    """K about the toe line of a full-contact base is jkn·b²/12·A about its middle."""
    config = resolved(numerics={"nodes_thickness": 3})
    scene = facade.facade_scene(config, "free", 0.0)
    k, _ = stiffness.assemble(scene).dense()
    f = config["facade"]
    h, b, area = f["height_m"], f["thickness_m"], f["thickness_m"] * f["width_m"]
    jkn, jks = facade.joint_stiffness(config)[0], 0.33 * facade.joint_stiffness(config)[0]
    # equations: y, z, rotation about x through the centroid, h/2 above the base
    assert k[1, 1] == pytest.approx(jkn * area)
    assert k[0, 0] == pytest.approx(jks * area)
    assert k[2, 2] == pytest.approx(jkn * area * b**2 / 12 + jks * area * h**2 / 4)
    assert k[0, 2] == pytest.approx(jks * area * h / 2)


@pytest.mark.parametrize("model", ["free", "W1", "W2"])
def test_stiffness_is_symmetric_and_positive(model):
    """K is symmetric with no negative eigenvalue; C = βK for a single β."""
    scene = facade.facade_scene(resolved(), model, 0.002)
    k, c = stiffness.assemble(scene).dense()
    assert np.allclose(k, k.T, rtol=0, atol=1e-6 * k.max())
    assert np.linalg.eigvalsh(k).min() > 0.0
    assert np.allclose(c, 0.002 * k)


def test_rigid_motion_of_a_free_pair_costs_no_energy():
    """Two joined free blocks have exactly six zero-stiffness modes in three dimensions."""
    blocks = [
        Block(n, (0.0, 0.0, z), (1.0, 0.5, 1.0), 900.0, box_inertia(900.0, (1.0, 0.5, 1.0)))
        for n, z in (("low", 0.5), ("high", 1.5))
    ]
    nodes = NodeList()
    corners = [[x, y, 1.0] for x in (-0.5, 0.5) for y in (-0.25, 0.25)]
    nodes.add_joint("bed", 1, 0, corners, (0, 0, 1), 0.125, Interface(1e9, 4e8))
    scene = Scene(blocks, nodes.joints, nodes.done(), "high", (0, 0, 2.0), "low", 0.5)
    omega, _ = stiffness.modes(scene)
    assert np.sum(omega < 1e-3 * omega[-1]) == 6


def test_critical_step_of_one_spring():
    """A block on vertical springs alone: Δt_crit = (2/ω)(√(1+ζ²) − ζ) with ω² = k/m."""
    mass, jkn, beta = 500.0, 1e8, 0.003
    block = Block("block", (0, 0, 0.5), (1, 1, 1), mass, box_inertia(mass, (1, 1, 1)), free="z")
    ground = Block("ground", (0, 0, -0.5), (1, 1, 1), 1.0, (1, 1, 1), free="")
    nodes = NodeList()
    nodes.add_joint("bed", 1, 0, [[0, 0, 0]], (0, 0, 1), 1.0, Interface(jkn, jkn, beta_s=beta))
    scene = Scene([ground, block], nodes.joints, nodes.done(), "block", (0, 0, 1), "ground", 1.0)
    omega = np.sqrt(jkn / mass)
    zeta = beta * omega / 2
    expected = 2 / omega * (np.sqrt(1 + zeta**2) - zeta)
    assert stiffness.critical_step(scene) == pytest.approx(expected, rel=1e-12)
    # the general criterion, used where β differs from node to node, gives the same
    twice = NodeList()
    for share, b in ((0.5, beta), (0.5, beta * (1 + 1e-9))):
        twice.add_joint("bed", 1, 0, [[0, 0, 0]], (0, 0, 1), share, Interface(jkn, jkn, beta_s=b))
    scene = Scene([ground, block], twice.joints, twice.done(), "block", (0, 0, 1), "ground", 1.0)
    assert stiffness.critical_step(scene) == pytest.approx(expected, rel=1e-6)


def test_return_wall_nodes_do_not_depend_on_how_the_wall_is_cut():
    """W1 and W2 have the same total back stiffness, and the same moment of it."""
    config = resolved()
    total, moment = {}, {}
    for model in ("W1", "W2"):
        nodes = facade.facade_scene(config, model, 0.0).nodes
        back = nodes.normal[:, 1] > 0.5
        total[model] = nodes.kn_n_m[back].sum()
        moment[model] = nodes.kn_n_m[back] @ nodes.position_m[back, 2] ** 2
    assert total["W1"] == pytest.approx(total["W2"], rel=1e-12)
    assert moment["W1"] == pytest.approx(moment["W2"], rel=1e-12)


@pytest.mark.parametrize("nodes", [3, 5, 9])
def test_released_block_is_in_vertical_equilibrium(nodes):
    """At release the base nodes that touch carry the weight, no more and no less."""
    config = resolved(numerics={"nodes_thickness": nodes})
    scene = facade.facade_scene(config, "W1", 0.0, release_ratio=0.5)
    block = scene.blocks[1]
    angle = block.rotation_rad[0]
    c, s = np.cos(angle), np.sin(angle)
    arm = scene.nodes.position_m - np.array(block.centre_m)
    z = block.centre_m[2] + block.displacement_m[2] + s * arm[:, 1] + c * arm[:, 2]
    base = scene.nodes.normal[:, 2] > 0.5
    depth = np.where(base, -z, 0.0)
    weight = scene.nodes.kn_n_m @ np.clip(depth, 0.0, None)
    assert 1 <= np.sum(depth > 0) < nodes
    assert weight == pytest.approx(block.mass_kg * scene.gravity_m_s2, rel=1e-9)


def test_bad_scenes_are_refused_by_name():
    """Unknown model, impossible release, non-positive stiffness: one line each."""
    config = resolved()
    with pytest.raises(ValueError, match="unknown façade model 'W9'"):
        facade.facade_scene(config, "W9", 0.0)
    with pytest.raises(ValueError, match="release"):
        facade.facade_scene(config, "W1", 0.0, release_ratio=1.0)
    with pytest.raises(ValueError, match="joint 'bed': jkn must be positive"):
        NodeList().add_joint("bed", 0, 1, [[0, 0, 0]], (0, 0, 1), 1.0, Interface(-1.0, 1.0))


def test_equal_scenes_serialise_equally():
    """The cache key of a scene depends on its content alone."""
    one = to_json(facade.facade_scene(resolved(), "W2", 0.001))
    assert one == to_json(facade.facade_scene(resolved(), "W2", 0.001))
    assert one != to_json(facade.facade_scene(resolved(), "W2", 0.0010001))


@pytest.mark.parametrize(
    ("strengths", "kind"),
    [
        ((0.0, 0.0, 0.5), scenes.DRY),
        ((0.1e6, 0.2e6, 0.5), scenes.BOND),
        ((0.0, 0.2e6, 0.0), scenes.BOND),
        ((0.1e6, 0.0, 0.5), scenes.BOND),
        ((0.1e6, 0.0, 0.0), scenes.TIE),
    ],
)
def test_a_joint_says_what_holds_it(strengths, kind):
    """Dry without strength; smooth where neither cohesion nor friction resists shear."""
    nodes = NodeList()
    nodes.add_joint(
        "joint", 1, 0, [(0, 0, 0)], (0, 0, 1), [0.5], Interface(1e9, 1e9, **held(*strengths))
    )
    found = nodes.done()
    assert found.kind.tolist() == [kind]
    assert found.tie.tolist() == [kind == scenes.TIE]
    assert found.bonded.tolist() == [kind != scenes.DRY]
    assert (found.tension_n[0], found.cohesion_n[0]) == (0.5 * strengths[0], 0.5 * strengths[1])


def test_a_dry_joint_with_a_strength_is_refused():
    with pytest.raises(ValueError, match="joint 'joint': a dry joint has no strength"):
        NodeList().add_joint(
            "joint", 1, 0, [(0, 0, 0)], (0, 0, 1), [1.0], Interface(1e9, 1e9, tension_pa=1.0)
        )
