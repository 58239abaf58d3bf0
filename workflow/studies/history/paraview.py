"""Histories as VTK files for ParaView: the blocks as bodies, the contacts as points with a force.

A history becomes a collection (`.pvd`) of instants, each with two parts (`.vtu`): the blocks as
hexahedra and the contacts as vertices. Half models are written whole, with both return walls, as
they are drawn; the contacts are those of the part that is modelled.
"""

from pathlib import Path
from xml.sax.saxutils import quoteattr

import meshio
import numpy as np

from studies.shared.drawings import boxes, corners, turned
from yade_scripts.model.facades import Facade


def blocks(frames, frame, walls, config):
    """Blocks of one instant as a mesh of hexahedra.

    Its points are where they are in the frame of the motion's origin [m], with displacement_m and
    velocity_m_s; its cells have block (index in the scene), free and spin_rad_s. Frames are of
    `studies.shared.yade.frames` with contacts, `walls` is the number of return walls, `config`
    has sections facade, return_wall, w3.
    """
    moved, rates = (np.array(frames[key][frame], float) for key in ("moved", "velocity"))
    base = [i for i, b in enumerate(frames["blocks"]) if b["name"] == "base"]
    facade = Facade.of(config["facade"])  # the base is a slab a little wider than it
    slab = np.array([1.2 * facade.width_m, 6.0 * facade.thickness_m, 0.2])
    shown = [*boxes(frames, walls, config), *((np.array([0.0, 0.0, -0.1]), slab, i) for i in base)]
    places: list[np.ndarray] = []
    shifts, velocities, cells = [], [], []
    for centre, size, i in shown:
        block = frames["blocks"][i]
        pivot, (dy, dz, angle) = np.array(block["centre_m"]), moved[i]
        start = corners(centre, size, centre[2] - 0.5 * size[2], size[2])
        place = turned(start, pivot, angle) + np.array([0.0, dy, dz])
        arm = place - (pivot + np.array([0.0, dy, dz]))
        vy, vz, spin = rates[i]
        velocity = np.stack([0.0 * arm[:, 0], vy - spin * arm[:, 2], vz + spin * arm[:, 1]], axis=1)
        cells.append(len(places) * 8 + np.arange(8))
        places.append(place)
        shifts.append(place - start)
        velocities.append(velocity)
    index = [i for *_, i in shown]
    return meshio.Mesh(
        np.concatenate(places),
        [("hexahedron", np.array(cells))],
        point_data={
            "displacement_m": np.concatenate(shifts),
            "velocity_m_s": np.concatenate(velocities),
        },
        cell_data={
            "block": [np.array(index)],
            "free": [np.array([int(bool(frames["blocks"][i]["free"])) for i in index])],
            "spin_rad_s": [rates[index, 2]],
        },
    )


def contacts(frames, frame):
    """Contacts of one instant as vertices, with force_n [N] and the block that it acts on."""
    table = np.array(frames["contacts"][frame], float).reshape(-1, 7)
    vertices = np.arange(len(table)).reshape(-1, 1)
    data = {"force_n": table[:, 3:6], "block": table[:, 6].astype(int)}
    return meshio.Mesh(table[:, :3], [("vertex", vertices)], point_data=data)


def write(collection, frames, walls, config):
    """Write a history: the collection, name.pvd, and its instants in the folder name/ beside it.

    Frames, walls and configuration are as `blocks` takes them.
    """
    collection = Path(collection)
    folder = collection.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for k, time_s in enumerate(frames["time_s"]):
        parts = {"blocks": blocks(frames, k, walls, config), "contacts": contacts(frames, k)}
        for part, (what, mesh) in enumerate(parts.items()):
            if not len(mesh.points):
                continue
            path = folder / f"{what}_{k:04d}.vtu"
            mesh.write(path, file_format="vtu", binary=True)
            name = quoteattr(f"{folder.name}/{path.name}")
            rows.append(f'    <DataSet timestep="{time_s:.6g}" part="{part}" file={name}/>')
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="Collection" version="0.1">',
        "  <Collection>",
        *rows,
        "  </Collection>",
        "</VTKFile>",
    ]
    collection.write_text("\n".join(lines) + "\n", "utf-8")
