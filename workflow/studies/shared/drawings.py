"""Oblique drawings of the models from YADE's poses, coloured by displacement."""

from typing import NamedTuple

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Polygon

from yade_scripts.model.facade import FACADE
from yade_scripts.model.facades import Facade
from yade_scripts.model.shape import shape_of

DEPTH = np.array([0.42, 0.22])  # screen displacement per metre of x, into the page
RETURN_WALL_SHOWN_M = 2.2  # of the return-wall supports, which are longer than needed
HALF = "its half brick"
FILLS = {"façade": "0.85", "header": "#E69F00", "return brick": "#56B4E9", HALF: "#9ad0ee"}
STRIPS = 20  # pieces of the façade, so that its colour follows the displacement


def project(points):
    """Screen coordinates of points (x, y, z): y to the right, z up, x into the page."""
    points = np.asarray(points, float)
    return points[..., 1:] + points[..., :1] * DEPTH


def boxes(frames, walls, config):
    """Boxes to draw: centre, size, index of the block that moves them.

    Single-block models have one support for all return walls together, drawn at each
    wall's place; W3's half model is drawn twice, at both.
    """
    facade, wall = Facade.of(config["facade"]), config["return_wall"]
    spread = 0.5 * (facade.width_m - wall["thickness_m"])
    places = np.linspace(-spread, spread, walls) if walls > 1 else np.array([0.0])
    out = []
    for i, block in enumerate(frames["blocks"]):
        centre, size = np.array(block["centre_m"]), np.array(block["size_m"])
        name = block["name"]
        if name == "base":
            continue
        if name == "façade" and not facade.is_plain:  # its storeys; openings, gable are left out
            for z0, z1, y0, y1 in shape_of(facade).storeys:
                middle = np.array([0.0, 0.5 * (y0 + y1), 0.5 * (z0 + z1)])
                out.append((middle, np.array([facade.width_m, y1 - y0, z1 - z0]), i))
        elif name == "façade":
            out.append((centre, np.array([facade.width_m, size[1], size[2]]), i))
        elif name.startswith("return wall"):
            y = -facade.gap_m - 0.5 * RETURN_WALL_SHOWN_M
            shown = np.array([wall["thickness_m"], RETURN_WALL_SHOWN_M, size[2]])
            out += [(np.array([x, y, centre[2]]), shown, i) for x in places]
        else:
            out += _w3_boxes(block, i, places, config)
    return out


def _w3_boxes(block, i, places, config):
    """Boxes of a header, or of a return brick with its half brick behind it."""
    w3, h = config["w3"], config["facade"]["height_m"]
    centre, size = np.array(block["centre_m"]), np.array(block["size_m"])
    if " header " in block["name"] or block["name"].endswith(" front"):
        return [(np.array([x, centre[1], centre[2]]), size, i) for x in places]
    low = (int(block["name"].split()[-1]) - 1) * w3["course_height_m"]
    rear = w3["brick_length_m"] - w3["overlap_m"]
    y = 0.5 * size[1] - w3["brick_length_m"]  # a cut brick's rear is shorter
    out = [(np.array([x, y, low + 0.5 * size[2]]), size, i) for x in places]
    if low + 2 * size[2] <= h + 1e-9:
        half = np.array([size[0], rear, size[2]])
        y = -w3["overlap_m"] - 0.5 * rear
        out += [(np.array([x, y, low + 1.5 * size[2]]), half, i) for x in places]
    return out


def faces(frames, frame, walls, config, magnification=1.0):
    """Visible faces of all boxes at one frame, sorted from back to front.

    Their screen coordinates, shape (n, 4, 2), and the displacement relative to the ground at each
    face's middle [m], shape (n,).
    """
    moved = np.array(frames["moved"][frame], float)
    names = [b["name"] for b in frames["blocks"]]
    ground = moved[names.index("base")][0]
    polygons, values, depths = [], [], []
    for centre, size, i in boxes(frames, walls, config):
        dy, dz, angle = moved[i]
        pivot = np.array(frames["blocks"][i]["centre_m"])
        pieces = STRIPS if frames["blocks"][i]["name"] == "façade" else 1
        for k in range(pieces):
            low = centre[2] - 0.5 * size[2] + size[2] * k / pieces
            corner = corners(centre, size, low, size[2] / pieces)
            real = turned(corner, pivot, angle) + np.array([0.0, dy - ground, dz])
            shift = real - corner
            value = float(np.linalg.norm(shift.mean(axis=0)))
            drawn = corner + magnification * shift
            visible = [(0, 1, 2, 3), (1, 5, 6, 2)]  # near side (−x), outward face (+y)
            if k == pieces - 1:
                visible.append((3, 2, 6, 7))  # top
            for face in visible:
                polygons.append(project(drawn[list(face)]))
                values.append(value)
                middle = corner[list(face)].mean(axis=0)
                depths.append((-centre[0] - (centre[1] < 0) * 1e-3, middle[1], middle[2]))
    # painter's order: far wall, façade, near wall; within each from the back and below
    order = sorted(range(len(depths)), key=lambda n: depths[n])
    return np.array(polygons)[order], np.array(values)[order]


def corners(centre, size, low, tall):
    """Corners of a box of height `tall` from `low` up, shape (8, 3), in VTK's order."""
    x0, x1 = centre[0] - 0.5 * size[0], centre[0] + 0.5 * size[0]
    y0, y1 = centre[1] - 0.5 * size[1], centre[1] + 0.5 * size[1]
    z0, z1 = low, low + tall
    side = ((y0, z0), (y1, z0), (y1, z1), (y0, z1))
    return np.array([(x, y, z) for x in (x0, x1) for y, z in side])


def turned(points, pivot, angle):
    """Points turned about x by `angle` (positive: outward top moves inward) about the pivot."""
    c, s = np.cos(angle), np.sin(angle)
    r = points - pivot
    y = c * r[:, 1] - s * r[:, 2]
    z = s * r[:, 1] + c * r[:, 2]
    return pivot + np.stack([r[:, 0], y, z], axis=1)


def outline(centre, size, moved=(0.0, 0.0, 0.0)):
    """Corners of a box seen along x, shape (4, 2), moved by (dy, dz) and turned about its centre.

    The angle is about x [rad], as in YADE's poses: positive where an outward top moves inward.
    """
    (_, y, z), (_, depth, height), (dy, dz, angle) = centre, size, moved
    c, s = np.cos(angle), np.sin(angle)
    x = 0.5 * np.array([(-depth, -height), (depth, -height), (depth, height), (-depth, height)])
    return x @ np.array([[c, s], [-s, c]]) + (y + dy, z + dz)


def leaning(block, theta, toe_m):
    """How a block has moved in W3 when its façade has turned outward by θ about its toe.

    Headers go with the façade and stay level (rule hinged); bricks rest. It is dy, dz of the
    centre [m] and the angle about x [rad], as in `outline`.
    """
    _, y, z = block.centre_m
    if " header " in block.name:
        return np.sin(theta) * z, 0.0, 0.0
    if block.name != FACADE:
        return 0.0, 0.0, 0.0
    c, s = np.cos(theta), np.sin(theta)
    return (c - 1.0) * (y - toe_m) + s * z, -s * (y - toe_m) + (c - 1.0) * z, -theta


def side_view(axis, scene, config, theta=0.0):
    """Draw the side of a scene of W3 with its façade turned outward by θ."""
    last = None
    for centre, size, i in boxes({"blocks": [vars(b) for b in scene.blocks]}, 1, config):
        block = scene.blocks[i]  # of a brick's two boxes the second is the half brick
        kind = "façade" if block.name == FACADE else "return brick" if i != last else HALF
        kind, last = "header" if " header " in block.name else kind, i
        shape = outline(centre, size, leaning(block, theta, config["facade"]["thickness_m"]))
        over = 2 + (kind == "header")
        axis.add_patch(Polygon(shape, fc=FILLS[kind], ec="k", lw=0.4, zorder=over))


class FrameLook(NamedTuple):
    """How frames are drawn: displacement at the colours' end [m], limits in x and y."""

    largest_m: float
    limits: tuple
    magnification: float = 1.0


def draw(axis, frames, frame, walls, config, look):
    """Draw one frame by a `FrameLook`; returns the collection, for a colour bar."""
    polygons, values = faces(frames, frame, walls, config, look.magnification)
    collection = PolyCollection(
        polygons, array=values, cmap="viridis", edgecolors="0.75", linewidths=0.25
    )
    collection.set_clim(0.0, look.largest_m)
    axis.add_collection(collection)
    axis.set(xlim=look.limits[0], ylim=look.limits[1], aspect="equal")
    axis.set_axis_off()
    return collection
