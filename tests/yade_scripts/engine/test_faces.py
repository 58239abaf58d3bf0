"""Faces as boxes, and nodes that slide past a rim: geometry, without YADE."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from yade_process import resolved

from yade_scripts.engine import faces, releases
from yade_scripts.engine.bonds import FACE_OFFSET_M
from yade_scripts.engine.faces import Faces
from yade_scripts.engine.poses import rotation
from yade_scripts.engine.releases import Releases
from yade_scripts.model.models import build_scene


def scene_of(model, **sections):
    config = resolved(numerics={"nodes_thickness": 3, "nodes_height": 3}, **sections)
    return build_scene({**config, "model": model, "beta_s": 0.0})


@pytest.mark.parametrize(
    "normal", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0, -1, 0), (0, 0.6, 0.8), (0.48, -0.6, -0.64)]
)
def test_the_box_s_third_axis_is_the_normal(normal):
    """A rotation, by the shortest way from z: what is across both axes stays where it is."""
    normal = np.array(normal, float)
    axes = faces._axes(normal)
    assert axes.T @ axes == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert axes[:, 2] == pytest.approx(normal)
    across = np.cross([0.0, 0.0, 1.0], normal)
    if np.linalg.norm(across) > 0.0:
        assert axes @ across == pytest.approx(across)


@pytest.mark.parametrize("model", ["W1", "W1c", "W3"])
def test_nodes_lie_on_the_surface_of_their_box(model):
    """Less the gap of a node; a bond's two faces stand off by FACE_OFFSET_M, one on either side:
    what presses meets one that looks along its normal, what pulls one that looks back."""
    gap = {} if model == "W3" else {"facade": {"gap_m": 2e-3}}
    scene = scene_of(model, **gap)
    found, nodes = Faces(scene), scene.nodes
    for i, key in enumerate(found.plain):
        centre, half, axes = found.shape(key, 3.0)
        surface = centre + half[2] * axes[:, 2]
        above = float(nodes.normal[i] @ (nodes.position_m[i] - surface))
        assert above == pytest.approx(nodes.gap_m[i], abs=1e-8)
        if found.press[i] is not None:
            for other, way in ((found.press[i], 1.0), (found.hook[i], -1.0)):
                centre, half, axes = found.shape(other, 3.0)
                assert axes[:, 2] == pytest.approx(way * nodes.normal[i])
                level = float(nodes.normal[i] @ (centre + half[2] * axes[:, 2]))
                here = float(nodes.normal[i] @ nodes.position_m[i]) - nodes.gap_m[i]
                assert level - here == pytest.approx(way * FACE_OFFSET_M, abs=1e-8)
    if model == "W1c":
        assert any(key is not None for key in found.press)


def test_a_box_ends_at_its_rim():
    """Along the rim's direction it reaches the rim exactly; its nodes lie on it at the start."""
    scene = scene_of("W3")
    found = Faces(scene)
    rims = scene.notes["rims"]
    seen = 0
    for key, nodes in found.nodes_of.items():
        if key[3] is None:
            continue
        direction, edge = np.array(key[3][0]), key[3][1]
        centre, half, axes = found.shape(key, 3.0)
        corner = centre @ direction + np.abs(axes.T @ direction) @ half
        assert corner == pytest.approx(edge, abs=1e-8)
        inside = np.abs((scene.nodes.position_m[nodes] - centre) @ axes) - half
        assert inside.max() < 1e-8
        seen += 1
    assert seen > 0
    assert rims


class Turn(tuple):
    """A unit quaternion (x, y, z, w), with what of YADE's is asked for."""

    def inverse(self):
        x, y, z, w = self
        return Turn((-x, -y, -z, w))

    def __mul__(self, other):
        (x, y, z, w), (a, b, c, d) = self, other
        return Turn(
            (
                w * a + x * d + y * c - z * b,
                w * b - x * c + y * d + z * a,
                w * c + x * b - y * a + z * d,
                w * d - x * a - y * b - z * c,
            )
        )


def rotated(angle_rad):
    """A turn about x, as a quaternion and as a matrix."""
    turn = Turn((math.sin(0.5 * angle_rad), 0.0, 0.0, math.cos(0.5 * angle_rad)))
    return turn, np.array(rotation(turn)).reshape(3, 3)


def moved(monkeypatch, way_m, angle_rad=0.0, which="a"):
    """W3 with the block `a` of a joint that has a rim drawn along it, and a, b or both turned.

    Returns
    -------
    left : dict
        Node to what is left to its rim, by vectors in space [m].
    gone : set
        Nodes that were released.
    """
    scene = scene_of("W3")
    states = [
        SimpleNamespace(pos=list(map(float, b.centre_m)), ori=Turn((0.0, 0.0, 0.0, 1.0)))
        for b in scene.blocks
    ]
    bodies = [SimpleNamespace(state=state) for state in states]
    omega, gone = SimpleNamespace(dt=1e-4, time=0.0, bodies=bodies), set()
    monkeypatch.setattr(releases, "separate", lambda _, nodes: gone.update(nodes))
    watch = Releases(scene, omega, range(len(states)), range(len(scene.nodes)), None)
    watch.debris = set()  # nodes are released one by one
    rims, names = scene.notes["rims"], [scene.joints[j] for j in scene.nodes.joint]
    i = next(i for i, name in enumerate(names) if name in rims)
    direction, edge = map(np.array, rims[names[i]])
    pair = {"a": int(scene.nodes.a[i]), "b": int(scene.nodes.b[i])}
    turn, matrix = rotated(angle_rad)
    turns = {name: matrix if name in which else np.eye(3) for name in pair}
    for name, k in pair.items():
        start = np.array(scene.blocks[k].centre_m)
        new = matrix @ start if which == "ab" else start
        states[k].pos = list(new + way_m * direction * (name == "a" or which == "ab"))
        states[k].ori = turn if name in which else states[k].ori
    omega.time = 1.0
    watch()
    a, b = (scene.blocks[k].centre_m for k in pair.values())
    left = {}
    for j in (j for j, name in enumerate(names) if name == names[i]):
        node = states[pair["a"]].pos + turns["a"] @ (scene.nodes.position_m[j] - a)
        own = turns["b"].T @ (node - states[pair["b"]].pos)  # as the rim's block sees it
        left[j] = edge - direction @ (own + b)
    return left, gone & set(left)


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_a_node_is_released_where_it_has_slid_past_its_rim(monkeypatch, share):
    """A block drawn along the rim's direction: nodes go one after the other, the nearest first."""
    start = moved(monkeypatch, 0.0)[0].values()
    for way in (share * min(start), share * 0.5 * (min(start) + max(start)), 1.1 * max(start)):
        left, gone = moved(monkeypatch, way)
        assert {j for j, m in left.items() if m < 0.0} == gone


@pytest.mark.parametrize("which", ["a", "b"])
def test_nodes_turn_with_their_block_and_the_rim_with_its_own(monkeypatch, which):
    start = moved(monkeypatch, 0.0)[0].values()
    for angle in (-0.6, 0.6):
        left, gone = moved(monkeypatch, 0.5 * (min(start) + max(start)), angle, which)
        assert {j for j, m in left.items() if m < 0.0} == gone
        assert min(abs(m) for m in left.values()) > 1e-6


def test_blocks_that_travel_and_turn_together_release_nothing(monkeypatch):
    """The rim is one of the block that has it, in its own frame, however far both have gone."""
    left, gone = moved(monkeypatch, 5.0, 0.4, "ab")
    start, _ = moved(monkeypatch, 0.0)
    assert left == pytest.approx(start)
    assert not gone
