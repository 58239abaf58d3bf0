"""The mechanisms that a façade can fall by, over its real shape, and the least of them.

Whole façade about its base; parts above every floor, sill, head, step and the foot of a gable;
vertical bending between levels that hold; the corners. Loads of floors move with the part that they
bear on. What holds are ties and anchors; the friction of floors is left out, since nobody has
verified that it lasts until collapse.
"""

import itertools
import math
from typing import NamedTuple

import numpy as np

from rocking.assessment.blocks import bending, interlocking, toppling
from rocking.assessment.checks import CANTILEVER, initial_period
from rocking.assessment.masonry import Masonry
from rocking.assessment.mechanism import WHOLE, Mechanism
from yade_scripts.model.floors import place_of
from yade_scripts.model.holds import rod

ADDED_REACH_M = 0.2  # elongation of a rod of 4 m that snaps at 5 %; of an anchor, unknown
HINGES = 19  # heights at which a span may open
FEET = 10  # heights from which a part may part with interlocked return walls
CRACKED = 0.5  # of the modulus, in T0
LEAST_PART_M = 0.3  # lower parts are no mechanism of a façade


def stretched(section, factor):
    """Section facade with every height times a factor: floors, ties and openings move with it."""
    found = {**section, "height_m": factor * section["height_m"]}
    for key in ("gable_height_m", "parapet_height_m"):
        if found.get(key):
            found[key] = factor * found[key]
    for rows in ("floors", "ties", "openings", "thickness_steps"):
        found[rows] = [
            {k: factor * v if k in ("height_m", "z_m") else v for k, v in row.items()}
            for row in section.get(rows) or ()
        ]
    return found


class Candidate(NamedTuple):
    """One mechanism and where it is.

    Attributes
    ----------
    name : str
    mechanism : Mechanism
    foot_m : float
        Height of its hinge over the façade's base.
    place : float
        Height of the middle of the line that holds it, over the building's height.
    on_ground : bool
        Its hinge is on the ground.
    t0_s : float
        Period before the onset, of an element free to vibrate; else 0.
    """

    name: str
    mechanism: Mechanism
    foot_m: float
    place: float
    on_ground: bool
    t0_s: float = 0.0


def ties_of(section, added_n=0.0):
    """Rows of ties and anchors of section facade as pulls, rigid up to their capacity.

    Parameters
    ----------
    section : dict
        Section facade; each row pulls with what `rod` gives until its elongation, each anchored
        floor with its anchors until 0.2 m.
    added_n : float
        Capacity of one more row at the height of the highest, at the top where there is none.

    Returns
    -------
    list of (force_n, height_m, reach_m, fades)
    """
    rows, pulls = section["ties"], []
    for row in rows:
        _, capacity, elongation = rod(row)
        pulls.append((capacity, row["height_m"], elongation + 1e-3 * row["slack_mm"], False))
    for row in section.get("floors", ()):
        if row["anchor_kn"] > 0.0:
            pulls.append((1e3 * row["anchor_kn"], row["height_m"], ADDED_REACH_M, False))
    if added_n > 0.0:
        height = max((row["height_m"] for row in rows), default=section["height_m"])
        pulls.append((added_n, height, ADDED_REACH_M, False))
    return pulls


class Family:
    """All mechanisms of one façade.

    Parameters
    ----------
    sections : mapping
        Sections facade, return_wall and assessment of a configuration.
    added_n : float
        See `ties_of`.
    """

    def __init__(self, sections, added_n=0.0):
        """Read shape, loads and ties."""
        names = "facade", "return_wall", "assessment"
        self.section, self.wall, self.settings = (sections[name] for name in names)
        section, settings = self.section, self.settings
        self.masonry = Masonry(section)
        self.base_m = section.get("base_height_m") or 0.0
        self.height_m = self.masonry.height_m
        inset = settings["hinge_inset_m"]
        if not 0.0 <= inset <= 0.5 * section["thickness_m"]:
            raise ValueError(
                f"assessment.hinge_inset_m = {inset:g}: expected 0 to half of "
                f"facade.thickness_m = {section['thickness_m']:g} (m)"
            )
        self.pulls = ties_of(section, added_n)
        self.loads = self._loads()
        self.pushes = [(1e3 * settings["pushing_kn"], self.height_m)]

    def _loads(self):
        """(weight_n, y_m, z_m) of what floors and roof bear on the façade."""
        load, arm = self.settings["roof_load_kn"], self.settings["roof_arm_m"]
        if load is None:
            shape = self.masonry.shape
            rows = self.section.get("floors", ())
            return [(1e3 * row["load_kn"], *place_of(row, shape)[1:]) for row in rows]
        back, front = self.masonry.faces(self.height_m, above=False)
        y = 0.5 * (back + front) if arm is None else back + arm
        return [(1e3 * load, y, self.height_m)] if load else []

    def _place(self, low_m, high_m):
        """Height of the middle of a line over the building's height."""
        share = (self.base_m + 0.5 * (low_m + high_m)) / (self.base_m + self.height_m)
        return min(share, 1.0)

    def _edge(self, height_m, inset_m):
        """Outer edge about which what lies above turns, less the inset."""
        outer = self.masonry.faces(height_m)[1]
        if height_m > 0.0:
            outer = min(outer, self.masonry.faces(height_m, above=False)[1])
        return outer - inset_m

    def part(self, foot_m, name):
        """Overturning of what lies above a height."""
        m, inset = self.masonry, self.settings["hinge_inset_m"]
        hinge = (self._edge(foot_m, inset), foot_m)
        pulls = [p for p in self.pulls if p[1] > foot_m + 1e-6]
        if self.settings["interlocking_course_m"] and foot_m < self.height_m - 1e-6:
            pulls.append(self._interlocked(foot_m))
        loads = [row for row in self.loads if row[2] >= foot_m + (1e-6 if foot_m else 0.0)]
        pushes = [row for row in self.pushes if row[1] > foot_m + 1e-6]
        masses = m.masses(foot_m, m.top_m)
        found = toppling(name, masses, hinge, (hinge[0], m.top_m), loads, pulls, pushes)
        free = foot_m >= self.height_m - 1e-6  # above all that the return walls hold
        stated = self.settings["height_ratio"]
        place = self._place(foot_m, max(self.height_m, foot_m))
        if foot_m == 0.0 and stated is not None:
            place = stated
        t0 = self._period(foot_m, m.top_m) if free else 0.0
        return Candidate(name, found, foot_m, place, self.base_m + foot_m <= 0.0, t0)

    def _period(self, foot_m, top_m):
        back, front = self.masonry.faces(foot_m)
        e = CRACKED * 1e6 * self.section["e_mpa"]
        return initial_period(top_m - foot_m, front - back, self.masonry.unit_weight, e, CANTILEVER)

    def _interlocked(self, foot_m):
        own, wall = self.settings, self.wall
        force, height, reach, fades = interlocking(
            self.height_m - foot_m,
            own["interlocking_course_m"],
            wall["thickness_m"],
            own["interlocking_overlap_m"],
            own["interlocking_friction"],
            self.masonry.unit_weight,
            wall["count"],
        )
        return force, foot_m + height, reach, fades

    def cuts(self):
        """Heights above which a part may turn, and what is there."""
        found = {0.0: WHOLE}
        names = []
        if self.masonry.top_m > self.height_m:
            above = "foot of the gable" if self.masonry.gable_m > 1e-9 else "foot of the parapet"
            names.append((self.height_m, above))
        names += [(row["height_m"], "floor") for row in self.section.get("floors", ())]
        names += [(z0, "sill of an opening") for *_, z0, _ in self.masonry.shape.openings]
        names += [(z1, "head of an opening") for *_, z1 in self.masonry.shape.openings]
        names += [(s[0], "change of thickness") for s in self.masonry.shape.storeys[1:]]
        if self.settings["interlocking_course_m"]:
            names += [(self.height_m * k / FEET, "joint of courses") for k in range(1, FEET)]
        for z, what in names:
            key = round(float(z), 6)
            if LEAST_PART_M <= key <= self.masonry.top_m - LEAST_PART_M and key not in found:
                found[key] = f"part above {key:.2f} m ({what})"
        return dict(sorted(found.items()))

    def levels(self):
        """Heights at which anchored floors or ties hold the façade, the base first.

        A floor that holds by its friction alone is left out, as in all mechanisms. Of those nearer
        than `LEAST_PART_M`, as ties below a floor, the lowest.
        """
        held = [r["height_m"] for r in self.section.get("floors", ()) if r.get("anchor_kn")]
        held += [row["height_m"] for row in self.section["ties"]]
        found = [0.0]
        for z in sorted(round(float(z), 6) for z in held):
            if z >= found[-1] + LEAST_PART_M:
                found.append(z)
        return found

    def bends(self, low_m, high_m):
        """Whether the wall between two levels may bend: higher than thick, and it does not lock."""
        back, front = self.masonry.faces(low_m)
        return high_m - low_m > front - back and self.span(low_m, high_m).mechanism.falls()

    def span(self, low_m, high_m):
        """Vertical bending between two levels, opening where the multiplier is least."""
        shares = np.arange(1, HINGES + 1) / (HINGES + 1.0)
        heights = low_m + shares * (high_m - low_m)
        found = [(self.bent(low_m, float(z), high_m), float(z)) for z in heights]
        mechanism, hinge = min(found, key=lambda item: item[0].multiplier())
        name = f"vertical bending from {low_m:.2f} to {high_m:.2f} m, open at {hinge:.2f} m"
        place = self._place(low_m, high_m)
        return Candidate(name, mechanism, low_m, place, self.base_m + low_m <= 0.0)

    def bent(self, low_m, hinge_m, high_m):
        """Two blocks between two levels that hold, all above bearing on them."""
        m, inset = self.masonry, self.settings["hinge_inset_m"]
        back = max(m.faces(hinge_m)[0], m.faces(hinge_m, above=False)[0])
        joint = (back + inset, hinge_m)
        outer = m.faces(high_m, above=False)[1]
        between = [row for row in self.loads if low_m < row[2] < high_m - 1e-6]
        above = [row for row in self.loads if row[2] >= high_m - 1e-6]
        if high_m < m.top_m - 1e-6:
            above += m.masses(high_m, m.top_m)
        return bending(
            "vertical bending",
            m.masses(low_m, hinge_m),
            m.masses(hinge_m, high_m),
            (self._edge(low_m, inset), low_m),
            joint,
            (outer, high_m),
            between,
            above,
        )

    def corner(self, side):
        """A corner that turns about the bisector's normal through its outer edge.

        The crack leaves the edge at the foot and climbs at `corner_crack_deg` from the vertical
        along both walls; displacements stay parallel to the bisector's plane. Of façade and return
        wall, the return wall without openings; the foot with the least multiplier is taken.
        """
        tangent = math.tan(math.radians(self.settings["corner_crack_deg"]))
        root, inset = math.sqrt(0.5), self.settings["hinge_inset_m"]
        depth = self.wall["thickness_m"]
        found = []
        for share in np.arange(0, HINGES) / (HINGES + 1.0):
            foot = float(share * self.height_m)
            front = self.masonry.faces(foot)[1]
            masses = [
                (w, -root * (x + front - y), z)
                for w, x, y, z in self.masonry.wedge(foot, tangent, side)
            ]
            masses += self._return_wedge(foot, tangent, depth, root)
            hinge = (-inset, foot)
            one = toppling("corner", masses, hinge, (hinge[0], self.height_m))
            found.append((one, foot))
        mechanism, foot = min(found, key=lambda item: item[0].multiplier())
        name = f"{'left' if side < 0 else 'right'} corner above {foot:.2f} m"
        place = self._place(foot, self.height_m)
        return Candidate(name, mechanism, foot, place, self.base_m + foot <= 0.0)

    def _return_wedge(self, foot_m, tangent, depth_m, root):
        """Its part of the return wall, behind the façade's thickness."""
        found = []
        for z, step in self.masonry.strips(foot_m):
            back, front = self.masonry.faces(z)
            reach = (z - foot_m) * tangent - (front - back)
            weight = reach * step * depth_m * self.masonry.unit_weight
            lever = front - back + 0.5 * reach + 0.5 * depth_m
            found.append((weight, -root * lever, z))
        return [row for row in found if row[0] > 0.0]

    def all(self):
        """Every mechanism, the whole façade first.

        Returns
        -------
        list of Candidate
            Those that stand at rest; what falls by its own weight raises a ValueError.
        """
        found = [self.part(z, name) for z, name in self.cuts().items()]
        spans = itertools.pairwise(self.levels())
        found += [self.span(low, high) for low, high in spans if self.bends(low, high)]
        if self.wall["count"] > 0:
            found += [self.corner(side) for side in (-1, 1)]
        for one in found:
            if one.mechanism.multiplier() <= 0.0:
                raise ValueError(f"{one.name}: does not stand under its own weight")
        return found
