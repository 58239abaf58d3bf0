"""A façade of any shape as masses for its mechanisms: what lies between two heights.

Between two edges (storeys, openings, the gable) the width is linear in z and the thickness is
constant, so two Gauss points carry the weight, its centroid and its second moment along the height
exactly.
"""

import itertools
import math

from rocking.mechanics.closed_forms import G_M_S2
from yade_scripts.model.shape import shape_of

STRIPS = 40  # of a wedge, whose edge crosses openings anywhere


class Masonry:
    """Weights of a façade by height.

    Parameters
    ----------
    section : dict
        Section facade.

    Attributes
    ----------
    shape : yade_scripts.model.shape.Shape
    height_m, top_m : float
        Of what the return walls hold; of the whole façade.
    edges_m : list of float
        Heights at which thickness or width changes.
    """

    def __init__(self, section):
        """Read the shape."""
        self.shape = shape_of(section)
        self.unit_weight = section["density_kg_m3"] * G_M_S2
        self.width_m = section["width_m"]
        self.height_m, self.top_m = section["height_m"], self.shape.top_m
        storeys, openings = self.shape.storeys, self.shape.openings
        edges = {0.0, self.height_m, self.top_m, *(z for s in storeys for z in s[:2])}
        edges |= {z for o in openings for z in o[2:]}
        self.edges_m = sorted(edges)
        self.gable_m = self.top_m - max(s[1] for s in storeys)

    def faces(self, height_m, above=True):
        """Places of back and front face at a height, on one side of a step [m]."""
        eps = 1e-6 if above else -1e-6
        last = self.shape.storeys[-1]
        return self.shape.faces_at(min(max(height_m + eps, 0.0), last[1]))

    def width(self, height_m, low_x=-math.inf, high_x=math.inf):
        """Width of masonry at a height, between two places along the façade [m]."""
        half = 0.5 * self.width_m
        if self.gable_m > 1e-9 and height_m > self.top_m - self.gable_m:
            half *= (self.top_m - height_m) / self.gable_m
        left, right = max(-half, low_x), min(half, high_x)
        found = max(0.0, right - left)
        for x0, x1, z0, z1 in self.shape.openings:
            if z0 <= height_m <= z1:
                found -= max(0.0, min(x1, right) - max(x0, left))
        return max(found, 0.0)

    def masses(self, low_m, high_m):
        """Weights between two heights: (weight_n, y_m, z_m), two an interval of `edges_m`."""
        cuts = [low_m, *(z for z in self.edges_m if low_m < z < high_m), high_m]
        found = []
        for a, b in itertools.pairwise(cuts):
            back, front = self.faces(0.5 * (a + b))
            for z in _gauss(a, b):
                weight = 0.5 * (b - a) * self.width(z) * (front - back) * self.unit_weight
                found.append((weight, 0.5 * (back + front), z))
        return [row for row in found if row[0] > 0.0]

    def wedge(self, foot_m, tangent, side):
        """Part of the façade that a corner takes with it: (weight_n, x_m, y_m, z_m).

        Between the corner on one side (−1, 1) and a crack that leaves it at `foot_m` and reaches
        (z − foot) · tangent along the façade; x counts from that corner inward.
        """
        found = []
        step = (self.height_m - foot_m) / STRIPS
        for k in range(STRIPS):
            z = foot_m + (k + 0.5) * step
            reach = min((z - foot_m) * tangent, self.width_m)
            corner = 0.5 * side * self.width_m
            ends = sorted((corner, corner - side * reach))
            wide = self.width(z, *ends)
            back, front = self.faces(z)
            weight = wide * step * (front - back) * self.unit_weight
            if weight > 0.0:
                found.append((weight, 0.5 * reach, 0.5 * (back + front), z))
        return found


def _gauss(low, high):
    middle, arm = 0.5 * (low + high), 0.5 * (high - low) / math.sqrt(3.0)
    return middle - arm, middle + arm
