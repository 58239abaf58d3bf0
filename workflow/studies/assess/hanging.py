"""Horizontal bending: a wedge of wall that hangs between two lines that hold, and opens between.

Two triangles meet on a vertical line x_m. Each turns outward about its crack, the straight line
from the foot (x_m, z_f) up to its end (x_e, z_t), on the outer face. With the tilt θ of the line
where they meet, D = z_t − z_f and L_i the length of a body, its angle about its crack is

    sin φ_i = ℓ_i/L_i sin θ,  ℓ_i = √(L_i² + D²),

so that both move the line where they meet by D sin θ at z_t. A point s from the crack and e behind
the outer face moves outward by s sin φ + e(1 − cos φ), and along the normal of the crack, which
points to (x_m, z_t), by s(cos φ − 1) + e sin φ: up by L/ℓ of it, and D/ℓ of it towards the other
body. Where they touch, at the inner face, they press each other apart by that. A thrust H at the
height z_H holds them (the arch). At rest, of a plain wall of thickness b and weight W of both, with
H at z_t, the virtual work is

    α0 = [W b/(2D) + H b(1/L₁ + 1/L₂)]/(W/3).

H = 0 is the wedge that holds by its weight alone, 3 b/(2D). The usual form for a strip of constant
depth, α0 = 2 H b(1/L₁ + 1/L₂)/W, has the strip's load in place of the wedge's and leaves out what
lifts (Milano and others, ReLUIS 2008, as remembered: no text read). Derived here.
"""

import math
from typing import NamedTuple

import numpy as np
from rocking.mechanics.mechanism import Mechanism, Pull, Weight, cos_sin


class Wedge(NamedTuple):
    """Where the two bodies are: x along the wall, y outward, z upward [m]."""

    left_m: float
    middle_m: float
    right_m: float
    foot_m: float
    top_m: float  # at which the cracks end
    outer_m: float  # y about which both turn
    inner_m: float  # y at which they touch each other

    @property
    def depth_m(self):
        """D."""
        return self.top_m - self.foot_m

    def length(self, x):
        """L of the body that x belongs to."""
        left = x < self.middle_m
        return self.middle_m - self.left_m if left else self.right_m - self.middle_m

    def ends(self, z):
        """Ends in x of both bodies at a height: the cracks, and above them verticals."""
        share = min(max((self.top_m - z) / self.depth_m, 0.0), 1.0)
        return (
            self.left_m + share * (self.middle_m - self.left_m),
            self.right_m - share * (self.right_m - self.middle_m),
        )

    def from_crack(self, x, z):
        """s: distance of a point from the crack of its body."""
        long = self.length(x)
        beyond = self.middle_m - x if x < self.middle_m else x - self.middle_m
        along = math.hypot(long, self.depth_m)
        return ((long - beyond) * self.depth_m - (self.top_m - z) * long) / along

    def move(self, x, y, z):
        """Path θ → (y, z) of a point."""
        long = self.length(x)
        along = math.hypot(long, self.depth_m)
        s, e = self.from_crack(x, z), self.outer_m - y

        def path(theta):
            cos, sin = self._turned(long, theta)
            out = self.outer_m + s * sin - e * cos
            return out, z + long / along * (s * (cos - 1.0) + e * sin)

        return path

    def apart(self, height_m):
        """Path θ → (how far the bodies press each other apart at a height, 0)."""
        e = self.outer_m - self.inner_m

        def path(theta):
            apart_m = 0.0 * theta
            for long in (self.middle_m - self.left_m, self.right_m - self.middle_m):
                along = math.hypot(long, self.depth_m)
                s = (height_m - self.foot_m) * long / along
                cos, sin = self._turned(long, theta)
                apart_m = apart_m + self.depth_m / along * (s * (cos - 1.0) + e * sin)
            return apart_m, 0.0 * theta

        return path

    def _turned(self, long, theta):
        """Cosine and sine of a body's angle about its crack."""
        _, sin = cos_sin(theta)
        sin = math.hypot(long, self.depth_m) / long * sin
        root = np.sqrt(1.0 - sin**2 + 0j) if isinstance(sin, np.ndarray) else (1.0 - sin**2) ** 0.5
        return root, sin


def hanging(name, wedge, masses, loads=(), pulls=(), thrust_n=0.0):
    """Horizontal bending of a `Wedge`, see above; its control point is the top where it opens.

    Masses and loads are (weight_n, x_m, y_m, z_m), pulls (force_n, x_m, z_m, slack_m, reach_m) on
    its outer face. The thrust acts at the top of the cracks.
    """
    carried = [row for row in (*masses, *loads) if row[0] > 0.0]
    weights = tuple(Weight(w, wedge.move(x, y, z)) for w, x, y, z in carried)
    bodies = (
        [row for row in carried if (row[1] < wedge.middle_m) is left] for left in (True, False)
    )
    lumped = tuple(_lump(wedge, body) for body in bodies if body)
    held = [
        Pull(force, wedge.move(x, wedge.outer_m, z), reach, False, slack)
        for force, x, z, slack, reach in pulls
    ]
    if thrust_n > 0.0:
        held.append(Pull(thrust_n, wedge.apart(wedge.top_m)))
    control = wedge.move(wedge.middle_m, wedge.outer_m, wedge.top_m)
    shorter = min(wedge.middle_m - wedge.left_m, wedge.right_m - wedge.middle_m)
    largest = 0.99 * math.asin(shorter / math.hypot(shorter, wedge.depth_m))
    return Mechanism(name, weights, control, tuple(held), largest, lumped=lumped)


def _lump(wedge, rows):
    """What one body carries as one `Weight` at its centroid: paths are linear in their points."""
    rows = np.array(rows)
    total = rows[:, 0].sum()
    return Weight(float(total), wedge.move(*(rows[:, 0] @ rows[:, 1:] / total).tolist()))
