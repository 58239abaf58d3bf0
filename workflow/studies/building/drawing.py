"""Drawings of brick models: exposed faces in parallel projection, painted from back to front."""

from itertools import pairwise

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Rectangle

VIEW = (-0.62, 0.62, 0.48)  # from the building towards the eye: front façade and left wall
LIGHT = np.array([-0.45, 0.75, 1.0])
MASONRY = np.array([0.80, 0.52, 0.40])
TIMBER = np.array([0.86, 0.74, 0.50])
JOINT = np.array([0.25, 0.20, 0.18])


def exposed_faces(building):
    """Faces of boxes that no joint covers.

    Block of each, shape (m,), outward normal, shape (m, 3), and corners in order around the face
    [m], shape (m, 4, 3).
    """
    blocks = building.scene.blocks[:-1]
    centre = np.array([b.centre_m for b in blocks])
    half = 0.5 * np.array([b.size_m for b in blocks])
    covered = np.zeros((len(blocks), 3, 2))  # axis; low face, high face
    faces = building.interfaces
    np.add.at(covered, (faces.a, faces.axis, 0), faces.area_m2)
    on_block = faces.b >= 0
    np.add.at(covered, (faces.b[on_block], faces.axis[on_block], 1), faces.area_m2[on_block])
    out = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        area = 4.0 * half[:, u] * half[:, v]
        for side, sign in ((0, -1.0), (1, 1.0)):
            index = np.flatnonzero(covered[:, axis, side] < 0.99 * area)
            corners = np.repeat(centre[index][:, None, :], 4, axis=1)
            corners[:, :, axis] += sign * half[index, axis][:, None]
            corners[:, :, u] += np.array([-1, 1, 1, -1]) * half[index, u][:, None]
            corners[:, :, v] += np.array([-1, -1, 1, 1]) * half[index, v][:, None]
            normal = np.zeros((len(index), 3))
            normal[:, axis] = sign
            out.append((index, normal, corners))
    return tuple(np.concatenate(parts) for parts in zip(*out, strict=True))


def camera(view=VIEW):
    """Return the picture's axes as unit vectors: right, up, towards the eye."""
    eye = np.asarray(view, float) / np.linalg.norm(view)
    right = np.cross((0.0, 0.0, 1.0), eye)
    right /= np.linalg.norm(right)
    return right, np.cross(eye, right), eye


def block_motion(modes, mode, count):
    """Translations and rotation vectors of the blocks in a mode, shape (count, 6)."""
    motion = np.zeros((count, 6))
    motion[modes.dof[:, 0], modes.dof[:, 1]] = modes.phi[:, mode]
    return motion


def draw(
    ax, building, *, motion=None, scale=1.0, colour_map=None, view=VIEW, edge_width=0.15, without=()
):
    """Draw a brick model.

    `motion`, shape (n_blocks, 6), has translation and rotation vector of each block, multiplied by
    `scale`; `colour_map` colours by displacement over the largest one, masonry and timber without
    it. The view is from the building towards the eye; joints are `edge_width` points wide; blocks
    named in `without` are left out.
    """
    block, normal, corners = exposed_faces(building)
    right, up, eye = camera(view)
    hidden = [i for i, b in enumerate(building.scene.blocks) if b.name in without]
    seen = (normal @ eye > 1e-9) & ~np.isin(block, hidden)
    block, normal, corners = block[seen], normal[seen], corners[seen]
    is_brick = block < len(building.bricks)
    # Painting by distance of the centroids hides correctly only among faces of like size.
    tile, corners = _tiles(corners, np.where(is_brick, 1.2 * building.brick.length_m, 0.12))
    block, normal, is_brick = block[tile], normal[tile], is_brick[tile, None]
    colours = np.where(is_brick, MASONRY, TIMBER)
    if motion is not None:
        centre = np.array([b.centre_m for b in building.scene.blocks])[block]
        turn = np.cross(motion[block, None, 3:], corners - centre[:, None, :])
        moved = motion[block, None, :3] + turn
        if colour_map is not None:
            size = np.linalg.norm(moved.mean(axis=1), axis=1)
            colours = colour_map(size / size.max())[:, :3]
        corners = corners + scale * moved
    light = LIGHT / np.linalg.norm(LIGHT)
    shade = 0.62 + 0.38 * np.clip(normal @ light, 0.0, None)
    colours = np.clip(colours * shade[:, None], 0.0, 1.0)
    edges = np.where(is_brick, JOINT, colours)
    order = np.argsort(corners.mean(axis=1) @ eye, kind="stable")
    flat = np.stack([corners @ right, corners @ up], axis=-1)[order]
    ax.add_collection(
        PolyCollection(
            list(flat),
            facecolors=colours[order],
            edgecolors=edges[order],
            linewidths=edge_width,
            rasterized=True,
        )
    )
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.axis("off")


def _tiles(corners, largest):
    """Split quadrilaterals with an edge above `largest`: source of each tile, and the tiles."""
    edge = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).max(axis=1)
    small = np.flatnonzero(edge <= largest)
    source, tiles = [small], [corners[small]]
    for i in np.flatnonzero(edge > largest):
        a, b, c, d = corners[i]
        nu = int(np.ceil(np.linalg.norm(b - a) / largest[i]))
        nv = int(np.ceil(np.linalg.norm(d - a) / largest[i]))
        u, v = (np.linspace(0.0, 1.0, n + 1)[:, None] for n in (nu, nv))
        rows = (1.0 - v)[:, None] * (a + u * (b - a)) + v[:, None] * (d + u * (c - d))
        quads = np.stack([rows[:-1, :-1], rows[:-1, 1:], rows[1:, 1:], rows[1:, :-1]], axis=2)
        tiles.append(quads.reshape(-1, 4, 3))
        source.append(np.full(nu * nv, i))
    return np.concatenate(source), np.concatenate(tiles)


def elevation(ax, wall, label):
    """Draw a wall's elevation with its openings and dimensions [m]."""
    ax.add_patch(_box((0.0, wall.base_m), wall.length_m, wall.height_m, MASONRY))
    edges = {0.0, wall.length_m}
    levels = {wall.base_m, wall.top_m}
    for opening in wall.openings:
        low, high = wall.span(opening)
        ax.add_patch(_box((low, opening.sill_m), high - low, opening.height_m, "white"))
        edges |= {low, high}
        levels |= {opening.sill_m, opening.head_m}
    _dimensions(ax, sorted(edges), wall.base_m - 0.35, horizontal=True)
    _dimensions(ax, sorted(levels), -0.35, horizontal=False)
    _frame(ax, label, (0.0, wall.length_m), (wall.base_m, wall.top_m))


def plan_view(ax, plan, label):
    """Draw a plan with wall names, floor beams' direction and overall dimensions [m]."""
    xs, ys = [], []
    for wall in plan.walls:
        (x0, x1), (y0, y1) = wall.footprint()
        ax.add_patch(_box((x0, y0), x1 - x0, y1 - y0, MASONRY))
        middle, angle = ((x0 + x1) / 2, (y0 + y1) / 2), 0 if wall.axis == 0 else 90
        ax.text(*middle, wall.name, ha="center", va="center", rotation=angle, fontsize=6)
        xs += [x0, x1]
        ys += [y0, y1]
    x, y = (min(xs), max(xs)), (min(ys), max(ys))
    _dimensions(ax, x, y[0] - 0.35, horizontal=True)
    _dimensions(ax, y, x[0] - 0.35, horizontal=False)
    middle = (sum(x) / 2, sum(y) / 2)
    for vector, name in (((1.0, 0.0), "x"), ((0.0, 1.0), "y (motion)")):
        tip = (middle[0] + vector[0], middle[1] + vector[1])
        ax.annotate("", xy=tip, xytext=middle, arrowprops={"arrowstyle": "->", "lw": 0.8})
        ax.text(tip[0] + 0.1, tip[1] + 0.1, name, fontsize=6)
    _frame(ax, label, x, y)


def _frame(ax, label, x, y):
    """Title of a drawing between two x and two y, with room for dimensions below and left."""
    ax.set_title(label)
    ax.set_xlim(x[0] - 1.1, x[1] + 0.2)
    ax.set_ylim(y[0] - 1.0, y[1] + 0.2)
    ax.set_aspect("equal")
    ax.axis("off")


def _box(corner, width, height, colour):
    return Rectangle(corner, width, height, facecolor=colour, edgecolor="0.25", linewidth=0.6)


def _dimensions(ax, marks, line, *, horizontal):
    """Draw a dimension chain with ticks at `marks` along a line."""
    fixed = [line] * len(marks)
    style = {"color": "0.35", "lw": 0.5, "marker": "|" if horizontal else "_", "ms": 4}
    ax.plot(*((marks, fixed) if horizontal else (fixed, marks)), **style)
    aligned = {"ha": "center", "va": "top"} if horizontal else {"ha": "right", "va": "center"}
    for low, high in pairwise(marks):
        middle, text = (low + high) / 2, f"{high - low:.2f}"
        where = (middle, line - 0.12) if horizontal else (line - 0.12, middle)
        ax.text(*where, text, fontsize=5.5, color="0.25", **aligned)
