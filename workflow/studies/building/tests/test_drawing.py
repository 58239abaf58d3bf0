"""Drawings of brick models: what is seen, from where, and in which order it is painted."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from studies.building import drawing
from studies.building.model.assembly import build
from studies.building.modes import Solver

from yade_scripts.model.building.plan import Plan, PlanWall


@pytest.fixture(scope="module")
def building():
    plan = Plan("wall", (PlanWall("wall", (0.0, 0.0), (0.96, 0.0), 0.24, 1.92),))
    return build(plan, coarsening=4.0)


def areas(corners):
    one, other = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    return np.linalg.norm(np.cross(one, other), axis=1)


def test_the_eye_sees_up_as_up_and_right_as_right():
    """Right, up and towards the eye are a right-handed frame; right is level, up rises."""
    right, up, eye = drawing.camera()
    assert np.array([right, up, eye]) @ np.array([right, up, eye]).T == pytest.approx(np.eye(3))
    assert np.cross(right, up) == pytest.approx(eye)
    assert right[2] == 0.0
    assert up[2] > 0.0
    front = drawing.camera((0.0, 1.0, 0.0))  # from in front of the façade, which looks along +y
    assert front[0] == pytest.approx([-1.0, 0.0, 0.0])


def test_exposed_faces_are_the_surface_of_the_wall(building):
    """Joints and the ground hide the rest: 2 (l + t) h and the top, each face seen from outside."""
    block, normal, corners = drawing.exposed_faces(building)
    length, thickness, height = np.ptp(corners.reshape(-1, 3), axis=0)
    found = {axis: areas(corners[np.abs(normal[:, axis]) > 0.5]).sum() for axis in range(3)}
    assert found[1] == pytest.approx(2.0 * length * height, rel=1e-6)
    assert found[0] == pytest.approx(2.0 * thickness * height, rel=1e-6)
    assert found[2] == pytest.approx(length * thickness, rel=1e-6)
    centre = np.array([b.centre_m for b in building.scene.blocks])[block]
    assert (np.sum((corners.mean(axis=1) - centre) * normal, axis=1) > 0.0).all()


def test_tiles_cover_their_quadrilateral_and_no_more():
    quad = np.array([[[0.0, 0, 0], [3.0, 0, 0], [3.0, 2.0, 1.0], [0.0, 2.0, 1.0]]])
    source, tiles = drawing._tiles(np.concatenate([quad, 0.1 * quad]), np.array([1.0, 1.0]))
    assert (source == 0).sum() == 9  # three by three: edges of 3 and √5
    assert (source == 1).sum() == 1
    assert areas(tiles[source == 0]).sum() == pytest.approx(areas(quad)[0])
    assert areas(tiles[source == 0]).max() == pytest.approx(areas(quad)[0] / 9)
    low, high = tiles[source == 0].min(axis=(0, 1)), tiles[source == 0].max(axis=(0, 1))
    assert (low.tolist(), high.tolist()) == ([0.0, 0.0, 0.0], [3.0, 2.0, 1.0])


def painted(building, **how):
    """Polygons in the order of painting, and their colours."""
    ax = Figure().subplots()
    drawing.draw(ax, building, **how)
    (found,) = ax.collections
    return [path.vertices[:4] for path in found.get_paths()], found.get_facecolors()[:, :3]


def test_what_is_nearer_is_painted_later(building):
    """Of the wall's own faces as the eye has them: depths ascend, and none looks away."""
    block, normal, corners = drawing.exposed_faces(building)
    right, up, eye = drawing.camera()
    polygons, _ = painted(building)
    seen = normal @ eye > 1e-9
    depth = {
        tuple(np.round(np.array([c @ right, c @ up]).T.mean(axis=0), 9)): c.mean(axis=0) @ eye
        for c in corners[seen]
    }
    order = [depth[tuple(np.round(p.mean(axis=0), 9))] for p in polygons]
    assert len(order) == seen.sum()
    assert np.all(np.diff(order) >= -1e-12)


def test_a_turned_wall_is_drawn_turned(building):
    """A small turn of every block about z, with the translation it gives each block's centre:
    corners move as those of one rigid body."""
    angle, count = 1e-3, len(building.scene.blocks)
    centre = np.array([b.centre_m for b in building.scene.blocks])
    motion = np.zeros((count, 6))
    motion[:, 5] = angle
    motion[:, :3] = np.cross([0.0, 0.0, angle], centre)
    view = (1e-9, 0.0, 1.0)  # from above
    still, _ = painted(building, view=view)
    moved, _ = painted(building, view=view, motion=motion, scale=2.0)
    turned = [2.0 * angle * np.column_stack([-p[:, 1], p[:, 0]]) for p in still]
    # the picture's axes are turned against x and y by the camera, which a turn does not see
    for was, now, expected in zip(still, moved, turned, strict=True):
        assert now - was == pytest.approx(expected, abs=1e-9)


def test_a_mode_moves_the_blocks_that_it_moves(building):
    modes = Solver(building.scene).modes(2)
    motion = drawing.block_motion(modes, 1, len(building.scene.blocks))
    assert motion[modes.dof[:, 0], modes.dof[:, 1]] == pytest.approx(modes.phi[:, 1])
    assert np.count_nonzero(motion) <= len(modes.dof)


def test_faces_towards_the_light_are_brighter(building):
    """The top, then the front, then the side: as the light falls from above, in front and left."""
    light = drawing.LIGHT / np.linalg.norm(drawing.LIGHT)
    _, colours = painted(building)
    shades = np.unique(np.round(colours[:, 0], 6))
    normals = np.array([[0.0, 0, 1], [0.0, 1, 0], [-1.0, 0, 0]])
    expected = drawing.MASONRY[0] * (0.62 + 0.38 * np.clip(normals @ light, 0.0, None))
    assert shades == pytest.approx(np.sort(expected), abs=1e-6)


def test_dimensions_say_the_lengths_between_the_edges():
    wall = PlanWall("wall", (0.0, 0.0), (4.0, 0.0), 0.24, 2.5)
    ax = Figure().subplots()
    drawing.elevation(ax, wall, "wall")
    assert sorted(text.get_text() for text in ax.texts) == ["2.50", "4.00"]
