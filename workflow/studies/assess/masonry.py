"""A façade of any shape as masses for its mechanisms: what lies between two heights.

Between two edges (storeys, openings, the gable) the width is linear in z and the thickness is
constant, so two Gauss points carry the weight, its centroid and its second moment along the height
exactly.
"""

import itertools

from rocking.mechanics.closed_forms import GRAVITY_M_S2
from rocking.mechanics.mechanism import gauss

from yade_scripts.model.facades import Facade
from yade_scripts.model.shape import shape_of

STRIPS = 40  # of a wedge, whose edge crosses openings anywhere


class Masonry:
    """Weights of a façade, a `Facade` or its section, by height.

    height_m is what the return walls hold, top_m the top of the whole façade, edges_m where
    thickness or width changes.
    """

    def __init__(self, facade):
        """Read the shape."""
        self.facade = Facade.of(facade)
        self.shape = shape_of(self.facade)
        self.tapers = bool(self.facade.top_thickness_m)
        self.unit_weight = self.facade.density_kg_m3 * GRAVITY_M_S2
        self.width_m = self.facade.width_m
        self.height_m, self.top_m = self.facade.height_m, self.shape.top_m
        storeys, openings = self.shape.storeys, self.shape.openings
        edges = {0.0, self.height_m, self.top_m, *(z for s in storeys for z in s[:2])}
        edges |= {z for o in openings for z in o[2:]}
        edges |= {z for c in self.shape.cornices for z in c[:2]}
        self.edges_m = sorted(edges)
        self.gable_m = self.top_m - max(s[1] for s in storeys)

    def faces(self, height_m, above=True):
        """Places of back and front face at a height, on one side of a step [m]."""
        if self.tapers and 0.0 <= height_m <= self.height_m - (1e-6 if above else 0.0):
            b, t = self.facade.thickness_m, self.facade.tapered_m(height_m)
            return (b - t, b) if self.facade.flush_face == "outer" else (0.0, t)
        eps = 1e-6 if above else -1e-6
        if self.gable_m > 1e-9 and height_m + eps > self.height_m:
            return self.shape.crown
        last = self.shape.storeys[-1]
        return self.shape.faces_at(min(max(height_m + eps, 0.0), last[1]))

    def width(self, height_m):
        """Width of masonry at a height [m]."""
        width_m = self.width_m
        if self.gable_m > 1e-9 and height_m > self.top_m - self.gable_m:
            width_m *= (self.top_m - height_m) / self.gable_m
        half = 0.5 * width_m
        for x0, x1, z0, z1 in self.shape.openings:
            if z0 <= height_m <= z1:
                width_m -= max(0.0, min(x1, half) - max(x0, -half))
        return max(width_m, 0.0)

    def projecting(self, height_m):
        """Cornices at a height: (y0, y1)."""
        return [(y0, y1) for z0, z1, y0, y1 in self.shape.cornices if z0 < height_m < z1]

    def masses(self, low_m, high_m):
        """Weights between two heights: (weight_n, y_m, z_m), two an interval of `edges_m`."""
        cuts = [low_m, *(z for z in self.edges_m if low_m < z < high_m), high_m]
        masses = []
        for a, b in itertools.pairwise(cuts):
            for z in gauss(a, b):
                back, front = self.faces(z)
                weight = 0.5 * (b - a) * self.width(z) * (front - back) * self.unit_weight
                masses.append((weight, 0.5 * (back + front), z))
                for y0, y1 in self.projecting(z):
                    weight = 0.5 * (b - a) * self.width_m * (y1 - y0) * self.unit_weight
                    masses.append((weight, 0.5 * (y0 + y1), z))
        return [row for row in masses if row[0] > 0.0]

    @property
    def weight_n(self):
        """Weight of the whole façade [N]."""
        return sum(weight for weight, *_ in self.masses(0.0, self.top_m))

    def strips(self, foot_m):
        """Strips of a wedge from a foot to what the return walls hold: (z, height) at Gauss points.

        They end at every edge, since thickness and width change there.
        """
        step = (self.height_m - foot_m) / STRIPS
        cuts = {foot_m + k * step for k in range(STRIPS)} | {self.height_m}
        cuts |= {z for z in self.edges_m if foot_m < z < self.height_m}
        pairs = itertools.pairwise(sorted(cuts))
        return [(z, 0.5 * (high - low)) for low, high in pairs for z in gauss(low, high)]

    def wedge(self, foot_m, tangent, side):
        """Part of the façade that a corner takes with it: (weight_n, x_m, y_m, z_m).

        Between the corner on one side (−1, 1) and a crack that leaves it at `foot_m` and reaches
        (z − foot) · tangent along the façade; x counts from that corner inward, to the centroid of
        what the openings leave.
        """
        masses = []
        for z, height in self.strips(foot_m):
            reach = min((z - foot_m) * tangent, self.width_m)
            wide, first = reach, 0.5 * reach**2
            for x0, x1, z0, z1 in self.shape.openings:
                if z0 <= z <= z1:
                    ends = (0.5 * self.width_m - side * x for x in (x0, x1))
                    near, far = sorted(min(max(x, 0.0), reach) for x in ends)
                    wide, first = wide - (far - near), first - 0.5 * (far**2 - near**2)
            back, front = self.faces(z)
            weight = wide * height * (front - back) * self.unit_weight
            if weight > 0.0:
                masses.append((weight, first / wide, 0.5 * (back + front), z))
            for y0, y1 in self.projecting(z) if reach > 0.0 else ():
                weight = reach * height * (y1 - y0) * self.unit_weight
                masses.append((weight, 0.5 * reach, 0.5 * (y0 + y1), z))
        return masses
