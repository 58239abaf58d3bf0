"""The mechanisms that a façade can fall by, over its real shape: they follow from what holds where.

A crack may open at any height, and what stands above it turns. What it takes to turn it is smooth
in that height except where the masonry changes (thickness, width, what the return walls hold) or
where a hold or a load is passed: each such height is a *foot* (`Family.feet`). They are read off
the masonry's edges, the holds and the loads, and not off lists of kinds: what is added to a façade
and holds it, loads it or changes it brings its foot along. Between two feet there may be a weaker
one (`weakest`): what counts is the PGA at which the check fails, which has the floor's shaking and
the displacement left in it, and not the multiplier alone.

Above a foot the virtual work is linear in the rates at which the blocks turn. Its least ratio then
lies where nothing above the foot is kept in place (*overturning*), or where one level that holds
is (*vertical bending* between foot and level, open at the height of the least multiplier). Holds
that are passed over pull with their capacity. So every pair of levels that hold, the base first,
has its bending, neighbours or not: a tie between them may be the weak one. Foot and hinge are those
of the least PGA.

Beside these plane mechanisms stand the corners. Loads of floors move with the part that they bear
on. What holds are ties and anchors; the friction of floors is left out, since nobody has verified
that it lasts until collapse.
"""

import math
from dataclasses import replace
from typing import NamedTuple

from rocking.mechanics.blocks import Edges, Held, bending, interlocking, leaned, toppling
from rocking.mechanics.closed_forms import Interlocked
from rocking.mechanics.mechanism import Mechanism, turning

from studies.assess import names, repertory, weakest
from studies.assess.checks import initial_period
from studies.assess.masonry import Masonry
from studies.assess.sites import CORNERS, LEAST_PART_M, WHOLE_PART
from yade_scripts.model.facades import ROWS, Facade
from yade_scripts.model.floors import place_of
from yade_scripts.model.holds import FRICTION, holds

FEET = 10  # heights from which a part may part with interlocked return walls
CRACKED = 0.5  # of the modulus, in T0
NEAR_M = 1e-6
LAST = ("joint", "change")  # told where nothing else is at that height


def stretched(section, factor):
    """Section facade with every height times a factor: floors, ties and openings move with it."""
    changed = {**section, "height_m": factor * section["height_m"]}
    for key in ("gable_height_m", "parapet_height_m"):
        changed[key] = factor * section[key]
    for rows in ROWS:
        changed[rows] = [
            {k: factor * v if k in ("height_m", "z_m") else v for k, v in row.items()}
            for row in section[rows]
        ]
    return changed


class Candidate(NamedTuple):
    """One mechanism and where it is; heights are over the façade's base."""

    mechanism: Mechanism
    foot_m: float  # of its hinge
    place: float  # of the middle of the line that holds it, over the building's height
    on_ground: bool  # its hinge
    t0_s: float = 0.0  # period before the onset, of an element free to vibrate; else 0
    hinge_m: float | None = None  # of vertical bending: where it opens
    held_m: float | None = None  # and the level that stays in place
    side: int = 0  # of a corner, −1 or 1; 0 turns over the whole width, as the dynamic models do
    part: str = ""  # short name of letters, digits, `_` and `.`, unique within a façade
    letter: Mechanism | None = None  # with the links that give way early, where these are left out
    crack_deg: float | None = None  # these five as of `sites.Site`
    left_m: float | None = None
    right_m: float | None = None
    middle_m: float | None = None
    top_m: float | None = None
    at_foot: str = ""  # keys of what is at its foot, see `names`

    @property
    def name(self):
        """Name in tables, which are in English."""
        return names.name(self)

    @property
    def plane(self):
        """Whether it turns over the whole width."""
        return not self.side and self.left_m is None

    @property
    def whole(self):
        """Whether it is the whole façade about its base, without a wedge."""
        alone = self.held_m is None and self.crack_deg is None
        return self.plane and self.foot_m == 0.0 and alone


def pulls_of(facade):
    """What holds a façade (a `Facade` or its section) as `Held`, rigid up to its capacity."""
    return [
        Held(hold.capacity_n, hold.height_m, hold.reach_m, False, max(hold.slack_m, 0.0))
        for hold in holds(Facade.of(facade))
        if hold.kind != FRICTION
    ]


class Family:
    """All mechanisms of one façade.

    Of sections facade, return_wall and assessment of a configuration. Feet, hinges and corners are
    those of the least `slv`, which takes a `Candidate` and returns the PGA at which its check fails
    (`slv.Slv`); without it those of the least α0, where no verdict is asked for.
    """

    def __init__(self, sections, slv=None):
        """Read shape, loads and ties."""
        self.slv = slv
        self.wall, self.settings = sections["return_wall"], sections["assessment"]
        facade = replace(Facade.of(sections["facade"]), courses=0)  # by hand it is one body
        self.facade, settings = facade, self.settings
        self.masonry = Masonry(facade)
        self.base_m = facade.base_height_m
        self.height_m = self.masonry.height_m
        inset = settings["hinge_inset_m"]
        if not 0.0 <= inset <= 0.5 * facade.thickness_m:
            raise ValueError(
                f"assessment.hinge_inset_m = {inset:g}: expected 0 to half of "
                f"facade.thickness_m = {facade.thickness_m:g} (m)"
            )
        self.lean_rad = math.radians(facade.tilt_deg)
        self.pulls = pulls_of(facade)
        self.loads = self._loads()
        self.thrusts = [(row.force_n, row.height_m) for row in facade.thrusts]
        self.pushes = [(1e3 * settings["pushing_kn"], self.height_m)]

    def _loads(self):
        """(weight_n, y_m, z_m) of what floors and roof bear on the façade."""
        load, arm = self.settings["roof_load_kn"], self.settings["roof_arm_m"]
        if load is None:
            shape = self.masonry.shape
            return [(row.load_n, *place_of(row, shape)[1:]) for row in self.facade.floors]
        back, front = self.masonry.faces(self.height_m, above=False)
        y = 0.5 * (back + front) if arm is None else back + arm
        return [(1e3 * load, y, self.height_m)] if load else []

    def _place(self, low_m, high_m):
        """Height of the middle of a line over the building's height."""
        share = (self.base_m + 0.5 * (low_m + high_m)) / self.facade.building_top_m
        return min(share, 1.0)

    def _edge(self, height_m, inset_m):
        """Outer edge about which what lies above turns, less the inset."""
        outer = self.masonry.faces(height_m)[1]
        if height_m > 0.0:
            outer = min(outer, self.masonry.faces(height_m, above=False)[1])
        return outer - inset_m

    def part(self, foot_m, at_foot="", part=None):
        """Overturning of what lies above a height, at which there is what the keys say."""
        name = part or (f"above_{float(round(foot_m, 6))}" if foot_m else WHOLE_PART)
        m, inset = self.masonry, self.settings["hinge_inset_m"]
        hinge = (self._edge(foot_m, inset), foot_m)
        pulls = [p for p in self.pulls if p.height_m > foot_m + NEAR_M]
        if self.settings["interlocking_course_m"] and foot_m < self.height_m - NEAR_M:
            pulls.append(self._interlocked(foot_m))
        loads = [row for row in self.loads if row[2] >= foot_m + (NEAR_M if foot_m else 0.0)]
        pushes = [row for row in self.pushes if row[1] > foot_m + NEAR_M]
        masses, thrusts = m.masses(foot_m, m.top_m), self.thrusting(foot_m)
        top = hinge[0], m.top_m
        mechanism = toppling(name, masses, hinge, top, loads, pulls, pushes, thrusts)
        mechanism = leaned(mechanism, self.lean_rad)
        free = foot_m >= self.height_m - NEAR_M  # above all that the return walls hold
        stated = self.settings["height_ratio"]
        place = self._place(foot_m, max(self.height_m, foot_m))
        if foot_m == 0.0 and stated is not None:
            place = stated
        t0 = self._period(foot_m, m.top_m) if free else 0.0
        on_ground = self.base_m + foot_m <= 0.0
        return Candidate(mechanism, foot_m, place, on_ground, t0, part=name, at_foot=at_foot)

    def thrusting(self, foot_m, below_m=math.inf):
        """Static thrusts between two heights: (force_n, height_m)."""
        return [row for row in self.thrusts if foot_m + NEAR_M < row[1] < below_m - NEAR_M]

    def _period(self, foot_m, top_m):
        back, front = self.masonry.faces(foot_m)
        e = CRACKED * 1e6 * self.facade.e_mpa
        return initial_period(top_m - foot_m, front - back, self.masonry.unit_weight, e)

    def _interlocked(self, foot_m):
        keys = ("course_m", "overlap_m", "friction")
        course, overlap, friction = (self.settings[f"interlocking_{key}"] for key in keys)
        bricks = Interlocked(
            course, overlap, self.wall["thickness_m"], friction, self.wall["count"]
        )
        held = interlocking(self.height_m - foot_m, bricks, self.masonry.unit_weight)
        return held._replace(height_m=foot_m + held.height_m)

    def changes(self):
        """Heights at which masonry, holds or loads change, keys of what is there, (z_m, keys)."""
        m = self.masonry
        foot = "gable" if m.gable_m > NEAR_M else "parapet"
        rows = [(self.height_m, foot)] if m.top_m > self.height_m else []
        rows += [(row.height_m, "tie") for row in self.facade.ties]
        rows += [(row.height_m, "floor") for row in self.facade.floors]
        rows += [(z, "thrust") for _, z in self.thrusts]
        rows += [(z0, "sill") for *_, z0, _ in m.shape.openings]
        rows += [(z1, "head") for *_, z1 in m.shape.openings]
        above = zip(m.shape.storeys, m.shape.storeys[1:], strict=False)
        slices = self.facade.slices_m  # what tapers changes at no height
        rows += [
            (up[0], "thickness") for low, up in above if low[2:] != up[2:] and up[0] not in slices
        ]
        every = [
            *(z for z in m.edges_m if z not in slices),
            *(p.height_m for p in self.pulls),
            *(row[2] for row in self.loads),
        ]
        rows += [(z, "change") for z in every]  # whatever it is that has no key above
        if self.settings["interlocking_course_m"]:
            rows += [(self.height_m * k / FEET, "joint") for k in range(1, FEET)]
        by_height: dict[float, list] = {}
        for z, key in rows:
            keys = by_height.setdefault(round(float(z), 6), [])
            if key not in keys and not (keys and key in LAST):
                keys.append(key)
        return sorted((z, names.AND.join(keys)) for z, keys in by_height.items())

    def feet(self):
        """Heights above which a part may turn, and keys of what is there."""
        last = self.masonry.top_m - LEAST_PART_M
        changes = {z: keys for z, keys in self.changes() if LEAST_PART_M <= z <= last}
        return {0.0: "base"} | changes

    def levels(self):
        """Heights at which anchored floors or ties hold the façade, the base first.

        A floor that holds by its friction alone is left out, as in all mechanisms. Of those nearer
        than `LEAST_PART_M`, as ties below a floor, the lowest.
        """
        levels = [0.0]
        for z in sorted({round(float(p.height_m), 6) for p in self.pulls if p.force_n > 0.0}):
            if z >= levels[-1] + LEAST_PART_M:
                levels.append(z)
        return levels

    def span(self, low_m, foot_m, hinge_m, high_m):
        """Vertical bending of a foot to a level that holds, open at a hinge.

        `low_m` is the level that holds below it, which may be the foot.
        """
        mechanism, place = self.bent(foot_m, hinge_m, high_m), self._place(foot_m, high_m)
        on_ground, part = self.base_m + foot_m <= 0.0, f"from_{float(low_m)}_to_{float(high_m)}"
        given = mechanism, foot_m, place, on_ground
        return Candidate(*given, hinge_m=hinge_m, held_m=high_m, part=part)

    def bent(self, low_m, hinge_m, high_m):
        """Two blocks between two levels that hold, all above bearing on them."""
        m, inset = self.masonry, self.settings["hinge_inset_m"]
        back = max(m.faces(hinge_m)[0], m.faces(hinge_m, above=False)[0])
        joint = (back + inset, hinge_m)
        outer = m.faces(high_m, above=False)[1]
        between = [row for row in self.loads if low_m < row[2] < high_m - NEAR_M]
        above = [row for row in self.loads if row[2] >= high_m - NEAR_M]
        if high_m < m.top_m - NEAR_M:
            above += m.masses(high_m, m.top_m)
        return bending(
            "vertical bending",
            self._leaned(m.masses(low_m, hinge_m)),
            self._leaned(m.masses(hinge_m, high_m)),
            Edges(
                *map(self.leaned_point, ((self._edge(low_m, inset), low_m), joint, (outer, high_m)))
            ),
            self._leaned(between),
            self._leaned(above),
            [p for p in self.pulls if low_m + NEAR_M < p.height_m < high_m - NEAR_M],
            self.thrusting(low_m, high_m),
        )

    def pieces(self, candidate):
        """Rigid pieces of a mechanism as (low_m, high_m, move) of the façade before it leans.

        One block's paths begin upright; those of a span begin where a leaning wall has its points.
        """
        pieces = candidate.mechanism.pieces
        if candidate.held_m is None or not self.lean_rad:
            return pieces
        ends = candidate.foot_m, candidate.hinge_m, candidate.held_m

        def of(move):
            return lambda point: move(self.leaned_point(point))

        moves = [of(move) for *_, move in pieces]
        return tuple(zip(ends, ends[1:], moves, strict=False))

    def leaned_point(self, point):
        """A point (y, z) of a wall that leans, turned about its outer edge at the base."""
        if not self.lean_rad:
            return point
        edge = self.masonry.faces(0.0)[1]
        return tuple(v.real for v in turning(point, (edge, 0.0))(self.lean_rad))

    def _leaned(self, masses):
        return [(w, *self.leaned_point((y, z))) for w, y, z in masses]

    def corner(self, side, foot_m):
        """A corner that turns about the bisector's normal through its outer edge.

        The crack leaves the edge at the foot and climbs at `corner_crack_deg` from the vertical
        along both walls; displacements stay parallel to the bisector's plane. Of façade and return
        wall, the return wall without openings.
        """
        masses, inset = self.corner_masses(side, foot_m), self.settings["hinge_inset_m"]
        thrust = self.settings["hip_thrust_kn"]
        hinge, top = (-inset, foot_m), (-inset, self.height_m)
        mechanism = toppling("corner", masses, hinge, top, thrusts=[(1e3 * thrust, self.height_m)])
        on_ground = self.base_m + foot_m <= 0.0
        given = mechanism, foot_m, self._place(foot_m, self.height_m), on_ground
        return Candidate(*given, side=side, part=f"{CORNERS[side]}_corner")

    def corner_masses(self, side, foot_m):
        """What a corner above a foot takes with it: (weight_n, y_m, z_m), y along its bisector."""
        tangent = math.tan(math.radians(self.settings["corner_crack_deg"]))
        front, root = self.masonry.faces(foot_m)[1], math.sqrt(0.5)
        masses = [
            (w, -root * (x + front - y), z)
            for w, x, y, z in self.masonry.wedge(foot_m, tangent, side)
        ]
        return masses + self._return_wedge(foot_m, tangent, self.wall["thickness_m"], root)

    def between(self, mechanism, foot_m, top_m, part, ends):
        """`Candidate` of a mechanism between two ends along the façade, held up to a height."""
        place, on_ground = self._place(foot_m, top_m), self.base_m + foot_m <= 0.0
        candidate = Candidate(mechanism, foot_m, place, on_ground, part=part)
        return candidate._replace(left_m=ends[0], right_m=ends[1])

    def _return_wedge(self, foot_m, tangent, depth_m, root):
        """Its part of the return wall, behind the façade; the crack counts from the foot's edge."""
        masses, edge = [], self.masonry.faces(foot_m)[1]
        for z, step in self.masonry.strips(foot_m):
            deep = edge - self.masonry.faces(z)[0]
            reach = (z - foot_m) * tangent - deep
            weight = reach * step * depth_m * self.masonry.unit_weight
            lever = deep + 0.5 * reach + 0.5 * depth_m
            masses.append((weight, -root * lever, z))
        return [row for row in masses if row[0] > 0.0]

    def at(self, site):
        """`Candidate` of a `Site`."""
        if site.crack_deg is not None or site.left_m is not None:
            return repertory.at(self, site)
        if site.side:
            return self.corner(site.side, site.foot_m)
        if site.held_m is not None:
            low = float(site.part.split("_")[1])
            return self.span(low, site.foot_m, site.hinge_m, site.held_m)
        at_foot = site.at_foot or self.feet().get(site.foot_m) or "between_feet"
        return self.part(site.foot_m, at_foot, site.part)

    def measure(self, site):
        """What a site is ranked by: the PGA at which its check fails, or α0 without `slv`."""
        candidate = self.at(site)
        if self.slv is not None:
            return self.slv(candidate)
        return candidate.mechanism.multiplier() if candidate.mechanism.falls() else math.inf

    def sites(self):
        """`Site` of every mechanism, the whole façade first."""
        plain = weakest.parts(self) + weakest.spans(self) + weakest.corners(self)
        return plain + repertory.sites(self)

    def all(self):
        """Every mechanism, the whole façade first; a ValueError where one falls at rest."""
        candidates = [self.at(site) for site in self.sites()]
        for candidate in candidates:
            if candidate.mechanism.multiplier() <= 0.0:
                raise ValueError(f"{candidate.name}: does not stand under its own weight")
        return candidates
