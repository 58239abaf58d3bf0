"""Shape of a rigid façade: setbacks, openings, a gable or a parapet; its mass and its contacts.

The façade is a box a storey of its thickness, less the boxes of its openings, under a triangular
prism (gable) or a further box (parapet); or such a prism alone, a gable by itself. With signed
masses m_i, centroids r_i and moments J_i of the parts about their own centroids (box:
m(l_j² + l_k²)/12; prism of width w, height g and thickness t: J_x = m(t²/12 + g²/18),
J_y = m(w²/24 + g²/18), J_z = m(w²/24 + t²/12))

    m = Σ m_i,  r = Σ m_i r_i/m,  J = Σ [J_i + m_i(|d_i|² 1 − d_i d_iᵀ)],  d_i = r_i − r

exactly. With b_g from the centroid out to the toe and z_g down to the base, it turns from the
static multiplier λ = b_g/z_g on, and its weight line passes the toe when its top, H above the base,
has moved by H b_g/z_g: that is the b of d/b, and b itself for a plain façade.

Wedges of the return walls and cornices are in `beside`.

Hinges cut it into rigid pieces: each has the parts between its two, by the same sums. Two pieces
meet on the thickness that both have there, and on the width that no opening takes from either.
"""

import bisect
import functools
import itertools
import math
from dataclasses import dataclass

import numpy as np

from yade_scripts.model.base import course_tops
from yade_scripts.model.beside import cornices_of, wedge_parts
from yade_scripts.model.facades import TRIANGLE, Facade
from yade_scripts.model.intervals import without
from yade_scripts.model.scene import box_inertia

SLIVER_M = 1e-9


@dataclass(frozen=True)
class Shape:
    """What a scene takes from the shape of its façade.

    The centroid's x counts from the façade's middle, y from the back face at its foot, z from its
    base. `tensor_kg_m2` is about it; thickness is that at the base, height that of what the return
    walls hold, `top_m` the whole façade's. `storeys` are (z0, z1, y0, y1) from the base up, a new
    one at every hinge too; `openings` (x0, x1, z0, z1); `parts` the signed (mass_kg, centre,
    tensor, size) that were added up, none across a hinge; `hinges_m` the heights at which it is cut
    into rigid pieces.
    """

    mass_kg: float
    centre_m: tuple
    tensor_kg_m2: np.ndarray
    thickness_m: float
    height_m: float
    width_m: float
    top_m: float
    storeys: tuple
    openings: tuple
    parts: tuple
    hinges_m: tuple = ()
    cornices: tuple = ()  # (z0, z1, y0, y1)
    slope: float = 0.0  # of a wedge's crack: how far back it reaches over its height
    crown: tuple = ()  # (y0, y1) at the very top of what the return walls hold, a gable's
    tapers: bool = False  # in a straight line from the base to the crown

    def piece_at(self, height_m):
        """Which of the rigid pieces between hinges a height belongs to, the lower at a hinge."""
        return bisect.bisect_left(self.hinges_m, height_m - 1e-9)

    @property
    def pieces(self):
        """(mass_kg, centre, tensor, size) of the rigid pieces, from the lowest up."""
        edges = (0.0, *self.hinges_m, self.top_m)
        pieces = []
        for k, (low, high) in enumerate(itertools.pairwise(edges)):
            mine = [part for part in self.parts if self.piece_at(part[1][2]) == k]
            mass, centre, tensor = _total(mine)
            faces = [y for z0, _, *ys in self.storeys if low <= z0 < high for y in ys]
            size = (self.width_m, max(faces) - min(faces), high - low)
            pieces.append((mass, centre, tensor, size))
        return pieces

    def joint_at(self, hinge_m, key="hinges_m"):
        """Where the pieces below and above a hinge meet: (y0, y1) of the faces, and lost width [m].

        ValueError of one line that names the key which states the hinge, if they do not meet.
        """
        below = next(s for s in self.storeys if s[1] == hinge_m)
        above = next(s for s in self.storeys if s[0] == hinge_m)
        y0, y1 = max(below[2], above[2]), min(below[3], above[3])
        holes = [(x0, x1) for x0, x1, z0, z1 in self.openings if z0 <= hinge_m <= z1]
        strips = without([(-0.5 * self.width_m, 0.5 * self.width_m)], holes, SLIVER_M)
        lost = self.width_m - sum(b - a for a, b in strips) if holes else 0.0
        if not (y1 > y0 and strips):
            raise ValueError(f"facade.{key} = {hinge_m:g}: expected masonry below and above")
        return y0, y1, lost

    @property
    def lever_m(self):
        """Distances (b_g, z_g) of the centroid from the front toe, inward and up."""
        return self.thickness_m - self.centre_m[1], self.centre_m[2]

    @property
    def size_m(self):
        """Edges of the box that bounds it."""
        low, high = min(s[2] for s in self.storeys), max(s[3] for s in self.storeys)
        return (self.width_m, high - low, self.top_m)

    @property
    def static_multiplier(self):
        """λ = b_g/z_g from which it turns about a rigid toe [-]."""
        return self.lever_m[0] / self.lever_m[1]

    @property
    def overturning_m(self):
        """Displacement H b_g/z_g of the top at which the weight line passes the toe."""
        return self.top_m * self.static_multiplier

    @property
    def base_strips(self):
        """Parts (x0, x1) of the base that stand on something: the piers between its doors."""
        doors = [(x0, x1) for x0, x1, z0, _ in self.openings if z0 <= 0.0]
        return without([(-0.5 * self.width_m, 0.5 * self.width_m)], doors, SLIVER_M)

    @property
    def base_lost_m(self):
        """Width of the base that its doors take."""
        return float(sum(x1 - x0 for x0, x1, z0, _ in self.openings if z0 <= 0.0))

    def faces_at(self, height_m):
        """Places of back and front face (y0, y1) at a height, those below at a step [m]."""
        return next(s[2:] for s in self.storeys if s[0] <= height_m <= s[1])

    def tapered_faces_at(self, height_m):
        """`faces_at` of the façade itself, not of the boxes that stand for its taper [m]."""
        if not self.tapers or height_m > self.height_m:
            return self.faces_at(height_m)
        share, base = height_m / self.height_m, (0.0, self.thickness_m)
        return tuple(a + share * (z - a) for a, z in zip(base, self.crown, strict=True))

    def back_parts(self, low_m, tall_m, walls):
        """Contact of the back face with return walls (x0, x1) from a height up to so much above it.

        Cut wherever the back face steps or an opening begins or ends in front of a wall: (low_m,
        tall_m, y_m, lost_m, strips), the face's y, the width that openings take from the walls, and
        what is left of them.
        """
        near = [
            (x0, x1, z0, z1)
            for x0, x1, z0, z1 in self.openings
            if any(x0 < right and x1 > left for left, right in walls)
        ]
        high = low_m + tall_m
        edges = [s[0] for s in self.storeys[1:]] + [z for row in near for z in row[2:]]
        cuts = sorted({z for z in edges if low_m + 1e-9 < z < high - 1e-9})
        spans, parts = [(low_m, tall_m)], []
        if cuts:
            spans = [(a, b - a) for a, b in itertools.pairwise((low_m, *cuts, high))]
        for foot, tall in spans:
            middle = foot + 0.5 * tall
            y, _ = self.faces_at(middle)
            holes = [(x0, x1) for x0, x1, z0, z1 in near if z0 < middle < z1]
            strips = without(walls, holes, SLIVER_M)
            lost = sum(b - a for a, b in walls) - sum(b - a for a, b in strips) if holes else 0.0
            if strips:
                parts.append((foot, tall, y, lost, strips))
        return parts


def shape_of(facade):
    """`Shape` of a façade, or of its section of the configuration.

    ValueError of one line with key, value and what was expected, if parts lie outside each other's
    bounds, openings overlap, or the weight falls outside the base.
    """
    return _shape(Facade.of(facade))


@functools.lru_cache(maxsize=256)
def _shape(facade):
    h, b, width, density = (
        facade.height_m,
        facade.thickness_m,
        facade.width_m,
        facade.density_kg_m3,
    )
    gable, parapet = facade.gable_height_m, facade.parapet_height_m
    if gable and parapet:
        raise ValueError(f"facade.parapet_height_m = {parapet:g}: expected 0 (m) with a gable")
    storeys = _storeys(facade)
    openings = _openings(facade)
    alone, crown = facade.outline == TRIANGLE, _crown(facade, storeys)
    boxes = () if alone else storeys
    parts = [_box(density, (-0.5 * width, 0.5 * width), s[2:], s[:2]) for s in boxes]
    for x0, x1, z0, z1 in openings:
        for s0, s1, y0, y1 in storeys:
            if min(z1, s1) > max(z0, s0):
                parts.append(_box(-density, (x0, x1), (y0, y1), (max(z0, s0), min(z1, s1))))
    if alone:
        parts.append(_prism(density, width, storeys[0][2:], 0.0, h))
    if gable:
        parts.append(_prism(density, width, crown, h, gable))
    parts += wedge_parts(facade, storeys) if facade.wedge_deg else []
    cornices = cornices_of(facade, storeys) if facade.cornices else ()
    parts += [_box(density, (-0.5 * width, 0.5 * width), c[2:], c[:2]) for c in cornices]
    mass, centre, tensor = _total(parts)
    top = h + gable + parapet
    shape = Shape(
        mass,
        tuple(map(float, centre)),
        tensor,
        b,
        h,
        width,
        top,
        storeys,
        openings,
        tuple(parts),
        _hinges(facade),
        cornices,
        facade.wedge_slope,
        crown,
        bool(facade.top_thickness_m),
    )
    low = -math.inf if shape.slope else 0.0  # a wedge leans back on its crack
    if not low < shape.centre_m[1] < b:
        key = "cornices" if cornices else "thickness_steps"
        raise ValueError(
            f"facade.{key}: the weight falls {shape.centre_m[1]:.3g} m from the back of "
            f"the base; expected between 0 and facade.thickness_m = {b:g} (m)"
        )
    if shape.base_lost_m > width - 1e-3:
        raise ValueError("facade.openings: doors take the whole base; expected piers between them")
    return shape


def _total(parts):
    """Mass, centroid and moments about it of signed parts."""
    mass = sum(part[0] for part in parts)
    first = parts[0][1]
    centre = first + sum(m * (r - first) for m, r, _, _ in parts) / mass
    tensor = sum(moments + m * _offset(r - centre) for m, r, moments, _ in parts)
    return mass, centre, tensor


def _prism(density, width_m, faces, foot_m, height_m):
    """Mass, centroid, moments and size of a triangular prism on a width, between two faces."""
    y0, y1 = faces
    t = y1 - y0
    mass = 0.5 * density * height_m * t * width_m
    gyration_m2 = np.array([t**2 / 12, width_m**2 / 24, width_m**2 / 24])
    gyration_m2 += np.array([height_m**2 / 18, height_m**2 / 18, t**2 / 12])
    centre = np.array([0.0, 0.5 * (y0 + y1), foot_m + height_m / 3.0])
    return mass, centre, np.diag(mass * gyration_m2), (width_m, t, height_m)


def _offset(d):
    return (d @ d) * np.eye(3) - np.outer(d, d)


def _box(density, x, y, z):
    """Signed mass, centroid, moments and size of a box between bounds."""
    size = (x[1] - x[0], y[1] - y[0], z[1] - z[0])
    mass = density * size[2] * size[1] * size[0]
    centre = np.array([0.5 * (low + high) for low, high in (x, y, z)])
    return mass, centre, np.diag(box_inertia(mass, size)), size


def _hinges(facade):
    """Heights of the joints between rigid pieces: as stated, or between courses [m]."""
    if facade.courses:
        return tuple(course_tops(facade)[:-1])
    return facade.hinges_m


def _storeys(facade):
    """(z0, z1, y0, y1) of the storeys of thickness, the parapet last."""
    h, b = facade.height_m, facade.thickness_m
    steps, last = facade.thickness_steps, 0.0
    if steps and facade.top_thickness_m:
        raise ValueError(
            f"facade.top_thickness_m = {facade.top_thickness_m:g}: expected null with "
            "facade.thickness_steps"
        )
    for number, row in enumerate(steps, 1):
        if not last < row.z_m < h:
            raise ValueError(
                f"facade.thickness_steps[{number}].z_m = {row.z_m:g}: expected ascending "
                f"heights above 0 and below facade.height_m = {h:g} (m)"
            )
        last = row.z_m
    hinges = _hinges(facade)
    cuts = [z for z in facade.slices_m if all(abs(z - hinge) > 1e-6 for hinge in hinges)]
    feet = sorted({0.0, *hinges, *cuts, *(row.z_m for row in steps)})
    edges, thick = [*feet, h], [_thickness(b, steps, z) for z in feet]
    if cuts:
        thick = [facade.tapered_m(0.5 * (a + z)) for a, z in itertools.pairwise(edges)]
    if parapet := facade.parapet_height_m:
        edges.append(h + parapet)
        thick.append(facade.parapet_thickness_m or facade.top_thickness_m or thick[-1])
    outer = facade.flush_face == "outer"
    back = [b - t if outer else 0.0 for t in thick]
    rows = zip(edges, edges[1:], back, thick, strict=False)
    return tuple((z0, z1, y, y + t) for z0, z1, y, t in rows)


def _crown(facade, storeys):
    """Faces (y0, y1) at the top of what the return walls hold."""
    if not facade.top_thickness_m:
        return next(s[2:] for s in storeys if s[1] >= facade.height_m - SLIVER_M)
    b, t = facade.thickness_m, facade.top_thickness_m
    return (b - t, b) if facade.flush_face == "outer" else (0.0, t)


def _thickness(b, steps, height_m):
    """Thickness from a height up."""
    return [b, *(row.thickness_m for row in steps if row.z_m <= height_m)][-1]


def _openings(facade):
    """(x0, x1, z0, z1) of the openings, inside the façade and apart from each other."""
    h, width = facade.height_m, facade.width_m
    openings: list[tuple] = []
    for number, row in enumerate(facade.openings, 1):
        where = f"facade.openings[{number}]"
        x, z, wide, tall = row.x_m, row.z_m, row.width_m, row.height_m
        if abs(x) + 0.5 * wide > 0.5 * width + 1e-9:
            raise ValueError(
                f"{where}.x_m = {x:g}: expected its {wide:g} m within half of facade.width_m on "
                f"either side of the middle, {0.5 * width:g} (m)"
            )
        if z + tall > h + 1e-9:
            raise ValueError(
                f"{where}.height_m = {tall:g}: expected a head, z_m + height_m, of at most "
                f"facade.height_m = {h:g} (m)"
            )
        mine = (x - 0.5 * wide, x + 0.5 * wide, z, z + tall)
        beside = wide
        for other, (x0, x1, z0, z1) in enumerate(openings, 1):
            if mine[2] < z1 - 1e-9 and mine[3] > z0 + 1e-9:
                if mine[0] < x1 - 1e-9 and mine[1] > x0 + 1e-9:
                    raise ValueError(f"{where}: expected it apart from facade.openings[{other}]")
                beside += x1 - x0
        if beside > width - 1e-3:
            raise ValueError(f"{where}.width_m = {wide:g}: expected masonry beside the openings")
        openings.append(mine)
    return tuple(openings)
