"""From a scanned surface to what a block weighs, stands on and rocks about.

Lengths in metre, z up, the centre of mass at the origin once `Solid` has been found.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, HalfspaceIntersection

WAVES = 200  # of a random field
DOWN = np.array([0.0, 0.0, -1.0])
STEEPEST_RAD = math.radians(65.0)  # what touches only beyond this tilt is left out
ROLLED_RAD = math.radians(45.0)  # the same in space
FLAT_M = 2e-4  # corners that stand out from the line of their neighbours by less are left out


@dataclass(frozen=True)
class Solid:
    """Surface points about the centre of mass, volume [m³] and tensor of inertia over mass [m²]."""

    points_m: np.ndarray
    volume_m3: float
    inertia_m2: np.ndarray


def solid(surface_m, more_m=()):
    """`Solid` of a homogeneous block from points on its whole surface.

    Its surface is taken as seen from the centre of mass: points that are neighbours by direction
    are joined to triangles, so that hollows count as far as that centre sees into them. Of
    tetrahedra with the corners 0, a, b, c volume is |a·(b × c)|/6, first moment V(a + b + c)/4, and
    ∫xxᵀ = V[(a + b + c)(a + b + c)ᵀ + aaᵀ + bbᵀ + ccᵀ]/20. `more_m` are points that belong to the
    surface too and do not weigh, as corners of its hull.
    """
    points = np.asarray(surface_m, float)
    centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
    for _ in range(6):
        ray = points - centre
        faces = ConvexHull(ray / np.linalg.norm(ray, axis=1)[:, None]).simplices
        a, b, c = (ray[faces[:, i]] for i in range(3))
        parts = np.abs(np.einsum("ij,ij->i", a, np.cross(b, c))) / 6.0
        volume = parts.sum()
        middle = parts @ (a + b + c) / (4.0 * volume)
        centre = centre + middle
    second = sum(np.einsum("i,ij,ik->jk", parts, q, q) for q in (a, b, c, a + b + c)) / 20.0
    second = second / volume - np.outer(middle, middle)
    inertia = np.trace(second) * np.eye(3) - second
    every = np.concatenate([points, np.reshape(np.asarray(more_m, float), (-1, 3))])
    return Solid(every - centre, float(volume), inertia)


def field(rng, places_m, deviation_m, length_m):
    """Gaussian random field of stated standard deviation and correlation exp(−r²/2L²) at (x, y)."""
    wave = rng.normal(0.0, 1.0 / length_m, (WAVES, 2))
    phase = rng.uniform(0.0, 2.0 * math.pi, WAVES)
    sums = np.cos(np.asarray(places_m) @ wave.T + phase).sum(axis=1)
    return deviation_m * math.sqrt(2.0 / WAVES) * sums


def turned(axis, angle):
    """Matrix of a rotation by an angle about a unit axis (Rodrigues)."""
    x, y, z = axis
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * k @ k


def at_rest(points_m, turns=30):
    """Rotation matrix that brings a rigid convex block to rest on a level plane.

    It stands on the facet of its hull below the centre of mass; from a pose in which that facet is
    not level it is turned until it is, and again where another one is then below.
    """
    whole = np.eye(3)
    for _ in range(turns):
        hull = ConvexHull(points_m @ whole.T)
        normal = hull.equations[_below(hull), :3]
        angle = math.acos(min(1.0, float(-normal[2])))
        if angle < 1e-7:
            break
        axis = np.cross(normal, DOWN)
        whole = turned(axis / np.linalg.norm(axis), angle) @ whole
    return whole


def _below(hull):
    """Facet that the vertical through the origin leaves the hull by."""
    steep = hull.equations[:, :3] @ DOWN
    with np.errstate(divide="ignore"):
        way = np.where(steep > 1e-12, -hull.equations[:, 3] / steep, np.inf)
    return int(np.argmin(way))


def profile(points_m, direction_rad):
    """Lower outline of a block in the vertical plane through its centre of mass: (n, 2) of (s, z).

    s counts along the direction. It is the section of the hull, and not its shadow: where a corner
    of the polygon that a block stands on points into the direction of shaking, the block turns
    about an edge beside it, at distance d and angle ψ from the direction, and its uplift at
    a = g d/(h cos ψ) is that of a planar block whose toe is d/cos ψ away, where the edge meets the
    plane. Corners that are reached up to a tilt of `STEEPEST_RAD`, without those nearly in line.
    """
    hull = points_m if isinstance(points_m, ConvexHull) else ConvexHull(points_m)
    along = np.array([math.cos(direction_rad), math.sin(direction_rad), 0.0])
    planes = np.stack(
        [hull.equations[:, :3] @ along, hull.equations[:, 2], hull.equations[:, 3]], axis=1
    )
    planes = planes[np.hypot(planes[:, 0], planes[:, 1]) > 1e-9]
    corners = HalfspaceIntersection(planes, np.zeros(2)).intersections
    outline = ConvexHull(corners)
    corners = corners[outline.vertices]  # counterclockwise
    return _chain(corners)


def _chain(corners):
    """Corners reached between tilts of ±STEEPEST_RAD, from −s to +s."""
    low, high = (_deepest(corners, turn) for turn in (-STEEPEST_RAD, STEEPEST_RAD))
    count = len(corners)
    picked = [(low + k) % count for k in range((high - low) % count + 1)]
    chain = [tuple(corners[i]) for i in picked]
    while len(chain) > 2:  # leave out what stands out least, until all stand out enough
        gaps = [_height(*chain[i - 1 : i + 2]) for i in range(1, len(chain) - 1)]
        least = int(np.argmin(gaps))
        if gaps[least] >= FLAT_M:
            break
        chain.pop(least + 1)
    return np.array(chain)


def _deepest(corners, turn):
    """Corner that is lowest when the block is turned towards +s by an angle."""
    return int(np.argmin(corners @ np.array([-math.sin(turn), math.cos(turn)])))


def _height(before, corner, behind):
    """Distance of a corner from the line through its neighbours."""
    line = np.subtract(behind, before)
    off = np.subtract(corner, before)
    return abs(line[0] * off[1] - line[1] * off[0]) / math.hypot(*line)


def barrier(chain, side):
    """Energy barrier over m g [m], and tilt at it [rad], of turning towards +s or −s.

    The centre of mass over the plane at a tilt θ is max(−(p·n)) over the corners; the barrier is
    its maximum less its value where the block stands.
    """
    tilt = np.linspace(0.0, STEEPEST_RAD, 400)
    down = np.stack([side * np.sin(tilt), -np.cos(tilt)], axis=1)
    height = (chain @ down.T).max(axis=0)
    top = int(np.argmax(height))
    return float(height[top] - height[0]), float(tilt[top])


def corners(points_m, within_m=3e-4):
    """Corners of the hull that a block stands or rolls on, (n, 3): enough of them, not all.

    What a block rests on at a tilt n is the corner that is farthest along it. Corners are added,
    those first whose lack is felt most, until in 1,200 directions up to `ROLLED_RAD` none that is
    missing stands out by more than `within_m`.
    """
    every = points_m[ConvexHull(points_m).vertices]
    tilt = ROLLED_RAD * np.sqrt((np.arange(1200) + 0.5) / 1200)
    around = np.pi * (3.0 - math.sqrt(5.0)) * np.arange(1200)
    down = [np.sin(tilt) * np.cos(around), np.sin(tilt) * np.sin(around), -np.cos(tilt)]
    reach = every @ np.array(down)
    farthest = reach.max(axis=0)
    lowest = np.flatnonzero(every[:, 2] < every[:, 2].min() + 1e-6)
    chosen = [int(i) for i in lowest]
    while True:
        lack = farthest - reach[chosen].max(axis=0)
        worst = int(np.argmax(lack))
        if lack[worst] <= within_m:
            return every[chosen]
        chosen.append(int(np.argmax(reach[:, worst])))
