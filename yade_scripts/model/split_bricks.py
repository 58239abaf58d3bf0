"""Return bricks of W3 cut by an inclined plane that may break in shear (`header_joint: study`).

The study cuts "lower elements of the return walls" so that a header that rises with the façade
shears off the front of the brick above it instead of lifting the whole column. Here the plane
falls from the end of the header above, y = −v, towards the façade by the angle s::

            y = −v
        ┌──────┬────┐  top of the course
        │ rear  ╲   │  the half brick stands on the rear
        │        ╲  │  front: what lies between the two headers
        └─────────╲─┘  y = −v + H tan s, still behind the façade

Both parts are driven along y and free in z and about x like every return brick. The plane
carries tension and cohesion until it breaks, then friction; what rises at the front opens it.
"""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.model.quadrature import GAUSS
from yade_scripts.model.scene import Block, box_inertia

UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
ONTO_BRICK = ((0.0, 1.0, 0.0), 0.0)  # rim of a brick's face: it ends where the façade begins


def lowest_edge(height_m, overlap_m, inclination_rad):
    """Place y [m] of the plane's lower edge, −v + H tan s: behind the façade's face, below 0.

    ValueError if the plane meets the façade's face above the bottom of the brick.
    """
    y = -overlap_m + height_m * math.tan(inclination_rad)
    if y >= 0.0:
        limit = math.degrees(math.atan(overlap_m / height_m))
        raise ValueError(
            f"w3.split_inclination_deg = {math.degrees(inclination_rad):g}: expected less than "
            f"{limit:.1f} (°), so that the plane ends in the brick's lower bed"
        )
    return y


def polygon_moments(points):
    """Area, centroid, ∫y² dA and ∫z² dA about it of a polygon (y, z), by Green's theorem."""
    points = np.asarray(points, float)
    following = np.roll(points, -1, axis=0)
    cross = points[:, 0] * following[:, 1] - following[:, 0] * points[:, 1]
    area = 0.5 * cross.sum()
    centre = ((points + following) * cross[:, None]).sum(axis=0) / (6.0 * area)
    squares = points**2 + points * following + following**2
    second = (squares * cross[:, None]).sum(axis=0) / 12.0
    return abs(area), centre, np.abs(second) - abs(area) * centre**2


def add_parts(assembly, name, x, bottom, motion, half_brick):
    """Append rear and front of a split brick, and their plane; return the indices of the two.

    The rear keeps the name of the brick, and has the half brick on it if there is one; the motion
    drives both along y.
    """
    top, v, length = bottom + assembly.course, assembly.v, assembly.length
    low = lowest_edge(assembly.course, v, assembly.split_inclination)
    parts = {
        name: [[(-length, bottom), (low, bottom), (-v, top), (-length, top)]],
        f"{name} front": [[(low, bottom), (0.0, bottom), (0.0, top), (-v, top)]],
    }
    if half_brick:
        above = top + assembly.course
        parts[name].append([(-length, top), (-v, top), (-v, above), (-length, above)])
    for part, polygons in parts.items():
        mass, centre, inertia = _solid(assembly, polygons)
        size = (assembly.t, float(np.ptp([y for y, _ in polygons[0]])), assembly.course)
        assembly.blocks.append(
            Block(part, (x, *centre), size, mass, inertia, free="zX", motion=motion)
        )
    rear, front = len(assembly.blocks) - 2, len(assembly.blocks) - 1
    _plane(assembly, name, x, rear, front, (low, bottom), (-v, top))
    return rear, front


def add_bed(assembly, name, lower, rear, front, header, x):
    """Bed joint above course `lower`: a header below, the two parts of a cut brick on it."""
    z, v = lower * assembly.course, assembly.v
    low = lowest_edge(assembly.course, v, assembly.split_inclination)
    on_header = ((0.0, -1.0, 0.0), v)
    # name, carrier, whose face, y, normal, length, rim of the face
    rows = [("front edge", front, header, 0.0, UP, -low, on_header)]
    if low > -v:  # the plane is inclined: the header's rear edge still lies under the rear
        under = low + v
        rows += [
            ("front part inner edge", front, header, low, UP, -low, on_header),
            ("rear part edge", header, rear, -v, DOWN, under, ((0.0, 1.0, 0.0), low)),
            ("rear part inner edge", rear, header, low, UP, under, on_header),
        ]
        assembly.partial += [f"{name} {row[0]}" for row in rows[1:]]
    else:
        rows.append(("rear edge", header, front, -v, DOWN, -low, ONTO_BRICK))
    for edge, a, b, y, normal, length, rim in rows:
        area = 0.5 * assembly.t * length
        assembly.nodes.add_joint(f"{name} {edge}", a, b, [(x, y, z)], normal, area, assembly.bed)
        assembly.rims[f"{name} {edge}"] = rim
    assembly.beds.append(name)


def _solid(assembly, polygons):
    """Mass [kg], centroid (y, z) and principal moments of prisms of the wall's thickness."""
    areas, centres, seconds = zip(*(polygon_moments(p) for p in polygons), strict=True)
    masses = assembly.density * assembly.t * np.array(areas)
    mass = float(masses.sum())
    centre = (masses[:, None] * np.array(centres)).sum(axis=0) / mass
    spread = np.array(seconds) / np.array(areas)[:, None] + (np.array(centres) - centre) ** 2
    yy, zz = (masses[:, None] * spread).sum(axis=0)
    xx = box_inertia(mass, (assembly.t, 0.0, 0.0))[1]
    return mass, tuple(centre), (float(yy + zz), float(xx + zz), float(xx + yy))


def _plane(assembly, name, x, rear, front, low, high):
    """Bond two Gauss points of the plane, from the front's rear face into the rear."""
    low, high = np.array(low), np.array(high)
    middle, along = 0.5 * (low + high), high - low
    s = assembly.split_inclination
    places = [(x, *(middle + sign * GAUSS * along)) for sign in (-1.0, 1.0)]
    assembly.nodes.add_joint(
        f"{name} plane",
        rear,
        front,
        places,
        (0.0, -math.cos(s), -math.sin(s)),
        0.5 * assembly.t * float(np.hypot(*along)),
        replace(assembly.brick, **assembly.bond("lower")),
    )
