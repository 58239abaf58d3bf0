"""Running bond: the bricks of a plan, as boxes.

A course runs through all walls at the same heights, so that walls interlock:
at a corner or junction the wall along x passes on even courses and the wall
along y on odd ones. Even courses have head joints at the points of a grid that
divides each strip between openings and corners into equal bricks; odd courses
have theirs half-way between, which leaves half bricks at the jambs and ends.
Courses and grids close exactly on openings, floors and wall tops, so brick size
can change without changing the building; the joint stiffness follows from the
actual spacing (see `contacts`).
"""

import itertools
from dataclasses import dataclass

import numpy as np

from yade_scripts.model.building.plan import (
    TOLERANCE_M,
    PlanError,
    overlap_in_height,
    overlap_in_plan,
)
from yade_scripts.model.intervals import without


@dataclass(frozen=True)
class Brick:
    """Size of the nominal brick: along the wall, in height, through the thickness [m]."""

    length_m: float = 0.24
    height_m: float = 0.06
    width_m: float = 0.12

    def coarsened(self, factor):
        """Return the brick enlarged `factor` times in each direction; factor ≥ 0."""
        if not factor > 0.0:
            raise PlanError(f"the coarsening factor must be positive, got {factor!r}")
        return Brick(factor * self.length_m, factor * self.height_m, factor * self.width_m)


@dataclass
class Bricks:
    """Bricks as columns: lower and upper corners (n, 3) and where each one lies.

    `length_axis` is 0 or 1 (x or y); `wall`, `course`, `wythe` and `place` are
    indices, the last counting along the course.
    """

    low_m: np.ndarray
    high_m: np.ndarray
    length_axis: np.ndarray
    wall: np.ndarray
    course: np.ndarray
    wythe: np.ndarray
    place: np.ndarray
    wall_names: list

    def __len__(self):
        """Return the number of bricks."""
        return len(self.low_m)

    def name(self, i):
        """Return a unique name that tells where brick `i` lies, e.g. 'left/c12/w1/b3'."""
        wall = self.wall_names[self.wall[i]]
        return f"{wall}/c{self.course[i]}/w{self.wythe[i]}/b{self.place[i]}"


def divide(breaks, spacing):
    """Ascending points that divide intervals between breaks into equal parts of about a spacing."""
    breaks = unique(breaks)
    points = [breaks[:1]]
    for low, high in itertools.pairwise(breaks):
        parts = max(1, int(np.floor((high - low) / spacing + 0.5)))
        points.append(np.linspace(low, high, parts + 1)[1:])
    return np.concatenate(points)


def unique(values):
    """Return sorted values with those closer than the tolerance merged."""
    values = np.sort(np.asarray(list(values), float))
    keep = np.concatenate(([True], np.diff(values) > TOLERANCE_M))
    return values[keep]


def course_lines(plan, height_m):
    """Heights of the bed joints, shared by all walls of the plan [m]."""
    breaks = []
    for wall in plan.walls:
        breaks += [wall.base_m, wall.top_m]
        for opening in wall.openings:
            breaks += [opening.sill_m, opening.head_m]
    for floor in plan.floors:
        breaks += [floor.level_m, floor.level_m + floor.beam_height_m]
    return divide(breaks, height_m)


def recesses(plan, wall):
    """Beam recesses of a wall: list of (floor, span along it, side), side ±1 inner face."""
    out = []
    for floor in plan.floors:
        if wall.name not in floor.walls:
            continue
        other = plan.wall(floor.walls[1 - floor.walls.index(wall.name)])
        span = tuple(v - wall.origin_m for v in floor.extent_m)
        out.append((floor, span, 1 if other.offset_m > wall.offset_m else -1))
    return out


def _crossings(plan, wall):
    """Return (other wall, span along `wall`) of the walls that cross it."""
    out = []
    for other in plan.walls:
        crosses = other.axis != wall.axis and overlap_in_plan(wall, other)
        if crosses and overlap_in_height(wall, other):
            low, high = (v - wall.origin_m for v in other.footprint()[wall.axis])
            out.append((other, (max(0.0, low), min(wall.length_m, high))))
    return out


def _between(low, high, bottom, top):
    """Whether what reaches from `low` to `high` lies beside a course."""
    return low < top - TOLERANCE_M and high > bottom + TOLERANCE_M


def _course_cuts(wall, grid, course, bottom, top, crossings, cavities):
    """Return the brick ends (low, high) along one course of a wall."""
    holes = [wall.span(o) for o in wall.openings if _between(o.sill_m, o.head_m, bottom, top)]
    if wall.axis != course % 2:
        holes += [span for w, span in crossings if _between(w.base_m, w.top_m, bottom, top)]
    joints = grid if course % 2 == 0 else 0.5 * (grid[:-1] + grid[1:])
    bricks: list[tuple] = []
    for low, high in without([(0.0, wall.length_m)], holes, TOLERANCE_M):
        inside = joints[(joints > low + TOLERANCE_M) & (joints < high - TOLERANCE_M)]
        recessed = [s for _, span, _ in cavities for s in span if low < s < high]
        bricks += itertools.pairwise(unique([low, high, *inside, *recessed]))
    return bricks


def lay(plan, brick):
    """Lay the bricks of a plan in running bond, sorted by wall, course, place along it and wythe.

    `brick` is the nominal one; the bricks of a strip differ from it so that the strip closes.
    """
    lines = course_lines(plan, brick.height_m)
    low, high, labels = [], [], []
    for w, wall in enumerate(plan.walls):
        crossings, cavities = _crossings(plan, wall), recesses(plan, wall)
        breaks = [0.0, wall.length_m]
        for opening in wall.openings:
            breaks += wall.span(opening)
        for _, span in crossings:
            breaks += span
        grid = divide(breaks, brick.length_m)
        half = wall.thickness_m / 2.0
        for course, (bottom, top) in enumerate(itertools.pairwise(lines)):
            if top <= wall.base_m + TOLERANCE_M or bottom >= wall.top_m - TOLERANCE_M:
                continue
            active = [
                c
                for c in cavities
                if _between(c[0].level_m, c[0].level_m + c[0].beam_height_m, bottom, top)
            ]
            ends = _course_cuts(wall, grid, course, bottom, top, crossings, active)
            for place, (s0, s1) in enumerate(ends):
                near, far = -half, half
                for floor, span, side in active:
                    if span[0] - TOLERANCE_M <= s0 and s1 <= span[1] + TOLERANCE_M:
                        if side > 0:
                            far = half - floor.bearing_m
                        else:
                            near = -half + floor.bearing_m
                faces = wall.offset_m + divide((near, far), brick.width_m)
                for wythe, (t0, t1) in enumerate(itertools.pairwise(faces)):
                    along = (wall.origin_m + s0, wall.origin_m + s1)
                    x, y = (along, (t0, t1)) if wall.axis == 0 else ((t0, t1), along)
                    low.append((x[0], y[0], bottom))
                    high.append((x[1], y[1], top))
                    labels.append((wall.axis, w, course, wythe, place))
    axis, of_wall, of_course, of_wythe, of_place = np.array(labels, int).T
    names = [wall.name for wall in plan.walls]
    corners = np.array(low), np.array(high)
    return Bricks(*corners, axis, of_wall, of_course, of_wythe, of_place, names)
