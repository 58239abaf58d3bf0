"""The plan of a masonry building as data: walls, openings, floors, and their checks.

A plan is read from a mapping (one YAML or JSON file) and refused, with the name
of the offending part, before any brick is laid. Walls run along x or y; x is
along the façade, y out of plane, z up; lengths in metres.
"""

from dataclasses import MISSING, dataclass, fields, replace

TOLERANCE_M = 1e-6


class PlanError(ValueError):
    """A plan that cannot be built; the text names the part and what was expected."""


@dataclass(frozen=True)
class Opening:
    """A door or window: distance of its near jamb from the wall's start, sill above z = 0."""

    name: str
    from_start_m: float
    width_m: float
    sill_m: float
    height_m: float

    @property
    def end_m(self):
        """Distance of the far jamb from the wall's start [m]."""
        return self.from_start_m + self.width_m

    @property
    def head_m(self):
        """Height of the opening's head above z = 0 [m]."""
        return self.sill_m + self.height_m


@dataclass(frozen=True)
class PlanWall:
    """A straight wall: ends of its centre line, thickness, base and top above z = 0."""

    name: str
    start_m: tuple
    end_m: tuple
    thickness_m: float
    height_m: float
    base_m: float = 0.0
    facade: bool = False
    openings: tuple = ()

    @property
    def axis(self):
        """Direction of the wall's length: 0 for x, 1 for y."""
        return 0 if abs(self.end_m[0] - self.start_m[0]) > TOLERANCE_M else 1

    @property
    def length_m(self):
        """Length between the ends of the centre line [m]."""
        return abs(self.end_m[self.axis] - self.start_m[self.axis])

    @property
    def top_m(self):
        """Height of the wall's top above z = 0 [m]."""
        return self.base_m + self.height_m

    @property
    def origin_m(self):
        """Smaller coordinate along the wall's axis; distances count from here."""
        return min(self.start_m[self.axis], self.end_m[self.axis])

    @property
    def offset_m(self):
        """Coordinate of the centre line across the wall."""
        return self.start_m[1 - self.axis]

    def span(self, opening):
        """Return the reach of an opening along the wall, counted from `origin_m` [m]."""
        if self.start_m[self.axis] > self.end_m[self.axis]:
            return self.length_m - opening.end_m, self.length_m - opening.from_start_m
        return opening.from_start_m, opening.end_m

    def footprint(self):
        """Return ((x0, x1), (y0, y1)) of the wall in plan [m]."""
        along = (self.origin_m, self.origin_m + self.length_m)
        half = self.thickness_m / 2.0
        across = (self.offset_m - half, self.offset_m + half)
        return (along, across) if self.axis == 0 else (across, along)


@dataclass(frozen=True)
class TimberFloor:
    """A timber floor: rigid beams from wall to wall and a rigid panel on top of them.

    `level_m` is the seat of the beams, `walls` the two parallel walls that carry
    them, `extent_m` the reach of the floor along those walls (global coordinate),
    `bearing_m` the depth of the recess in each wall's inner face.
    """

    name: str
    level_m: float
    walls: tuple
    extent_m: tuple
    beam_spacing_m: float = 0.5
    beam_width_m: float = 0.12
    beam_height_m: float = 0.18
    bearing_m: float = 0.12
    panel_thickness_m: float = 0.03
    load_kg_m2: float = 0.0


@dataclass(frozen=True)
class Plan:
    """Walls and floors of one building.

    `facade_bond` is the stiffness of the joints between a façade and the walls that cross it, over
    that of bonded masonry.
    """

    name: str
    walls: tuple
    floors: tuple = ()
    monitor_floor: str | None = None
    facade_bond: float = 1.0

    def wall(self, name):
        """Return the wall called `name`; PlanError lists the known ones."""
        for wall in self.walls:
            if wall.name == name:
                return wall
        raise PlanError(f"no wall '{name}'; the plan has {[w.name for w in self.walls]}")

    def without_facades(self):
        """Return the simplified building, without façades."""
        return replace(self, walls=tuple(w for w in self.walls if not w.facade))

    def with_floor_load(self, load_kg_m2):
        """Return the plan with one floor load [kg/m²] on every floor."""
        return replace(
            self, floors=tuple(replace(f, load_kg_m2=float(load_kg_m2)) for f in self.floors)
        )


def shortened(wall, start_m, end_m):
    """Return a wall between two coordinates along its axis, its openings where they were."""
    ends = [list(end) for end in sorted((wall.start_m, wall.end_m))]
    ends[0][wall.axis], ends[1][wall.axis] = start_m, end_m
    cut = start_m - wall.origin_m
    openings = tuple(replace(o, from_start_m=wall.span(o)[0] - cut) for o in wall.openings)
    return replace(wall, start_m=tuple(ends[0]), end_m=tuple(ends[1]), openings=openings)


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _record(cls, data, where, convert):
    """Build dataclass `cls` from mapping `data`; unknown, missing or ill-typed keys are named.

    `convert` has functions of value and `where` for the keys that are neither a number nor a pair.
    """
    if not isinstance(data, dict):
        raise PlanError(f"{where}: expected a mapping of keys, got {data!r}")
    known = {f.name: f for f in fields(cls)}
    for key in data:
        if key not in known:
            raise PlanError(f"{where}: unknown key '{key}'; known keys are {sorted(known)}")
    values = {}
    for key, spec in known.items():
        if key not in data:
            if spec.default is MISSING:
                raise PlanError(f"{where}: key '{key}' is missing")
            continue
        value = data[key]
        if key in convert:
            value = convert[key](value, where)
        elif key in ("start_m", "end_m", "extent_m"):
            pair = isinstance(value, (list, tuple)) and len(value) == 2
            if not (pair and all(map(_is_number, value))):
                raise PlanError(f"{where}: {key} must be two numbers in metres, got {value!r}")
            value = tuple(map(float, value))
        elif key.endswith(("_m", "_m2")):
            if not _is_number(value):
                raise PlanError(f"{where}: {key} must be a number, got {value!r}")
            value = float(value)
        values[key] = value
    return cls(**values)


def _records(cls, rows, where, kind, convert):
    """Build what `rows` describe; an error line calls each by its name, or else by its number."""
    if not isinstance(rows, (list, tuple)):
        raise PlanError(f"{where}: {kind}s must be a list, got {rows!r}")
    records = []
    for number, row in enumerate(rows, 1):
        name = f"number {number}"
        if isinstance(row, dict):
            name = row.get("name", name)
        records.append(_record(cls, row, f"{where}, {kind} '{name}'", convert))
    return tuple(records)


def plan_from_dict(data, source="plan"):
    """Build and check a `Plan` from nested mappings; keys are the fields of the dataclasses here.

    PlanError begins with `source`, the file, and names the part: an unknown key, an opening outside
    its wall, walls that are neither along x nor y, a floor on walls that cannot carry it.
    """
    if not isinstance(data, dict) or not data.get("walls"):
        raise PlanError(f"{source}: a plan needs a list 'walls' with at least one wall")

    def openings(rows, wall):
        return _records(Opening, rows or (), wall, "opening", {})

    def carriers(names, floor):
        return tuple(names) if isinstance(names, (list, tuple)) else ()

    walls = _records(PlanWall, data["walls"], source, "wall", {"openings": openings})
    rows = data.get("floors") or ()
    floors = _records(TimberFloor, rows, source, "floor", {"walls": carriers})
    plan = _record(Plan, data | {"walls": walls, "floors": floors}, source, {})
    check(plan, source)
    return plan


def _check_wall(wall, where):
    dx, dy = (abs(wall.end_m[i] - wall.start_m[i]) for i in (0, 1))
    if min(dx, dy) > TOLERANCE_M or max(dx, dy) <= TOLERANCE_M:
        raise PlanError(f"{where}: start_m and end_m must differ along x or along y, not both")
    for key in ("thickness_m", "height_m"):
        if getattr(wall, key) <= 0.0:
            raise PlanError(f"{where}: {key} must be positive, got {getattr(wall, key)}")
    if wall.base_m < -TOLERANCE_M:
        raise PlanError(f"{where}: base_m must not lie below the ground, got {wall.base_m}")
    for opening in wall.openings:
        name = f"{where}, opening '{opening.name}'"
        if opening.width_m <= 0.0 or opening.height_m <= 0.0:
            raise PlanError(f"{name}: width_m and height_m must be positive")
        if opening.from_start_m < -TOLERANCE_M or opening.end_m > wall.length_m + TOLERANCE_M:
            raise PlanError(
                f"{name}: spans {opening.from_start_m:g} to {opening.end_m:g} m, outside the"
                f" wall's length of 0 to {wall.length_m:g} m"
            )
        if opening.sill_m < wall.base_m - TOLERANCE_M or opening.head_m > wall.top_m + TOLERANCE_M:
            raise PlanError(
                f"{name}: spans {opening.sill_m:g} to {opening.head_m:g} m in height, outside"
                f" the wall's {wall.base_m:g} to {wall.top_m:g} m"
            )
    for i, first in enumerate(wall.openings):
        for second in wall.openings[i + 1 :]:
            apart = (
                first.end_m <= second.from_start_m + TOLERANCE_M
                or second.end_m <= first.from_start_m + TOLERANCE_M
                or first.head_m <= second.sill_m + TOLERANCE_M
                or second.head_m <= first.sill_m + TOLERANCE_M
            )
            if not apart:
                raise PlanError(f"{where}: openings '{first.name}' and '{second.name}' overlap")


def _check_floor(plan, floor, where):
    if len(floor.walls) != 2:
        raise PlanError(f"{where}: walls must name the two walls that carry the beams")
    try:
        first, second = (plan.wall(name) for name in floor.walls)
    except PlanError as error:
        raise PlanError(f"{where}: {error}") from None
    if first.axis != second.axis:
        raise PlanError(f"{where}: walls '{first.name}' and '{second.name}' are not parallel")
    clear = abs(second.offset_m - first.offset_m) - (first.thickness_m + second.thickness_m) / 2.0
    if clear <= 0.0:
        raise PlanError(f"{where}: no clear span between '{first.name}' and '{second.name}'")
    for key in (
        "beam_spacing_m",
        "beam_width_m",
        "beam_height_m",
        "bearing_m",
        "panel_thickness_m",
    ):
        if getattr(floor, key) <= 0.0:
            raise PlanError(f"{where}: {key} must be positive, got {getattr(floor, key)}")
    if floor.load_kg_m2 < 0.0:
        raise PlanError(f"{where}: load_kg_m2 must not be negative, got {floor.load_kg_m2:g}")
    for wall in (first, second):
        low, high = floor.extent_m
        if low < wall.origin_m - TOLERANCE_M or high > wall.origin_m + wall.length_m + TOLERANCE_M:
            raise PlanError(f"{where}: extent_m {low:g} to {high:g} leaves wall '{wall.name}'")
        if high - low < floor.beam_width_m:
            raise PlanError(f"{where}: extent_m {low:g} to {high:g} holds no beam")
        if floor.bearing_m >= wall.thickness_m - TOLERANCE_M:
            raise PlanError(
                f"{where}: bearing_m {floor.bearing_m:g} is not less than the thickness of wall"
                f" '{wall.name}' ({wall.thickness_m:g} m)"
            )
        if not wall.base_m < floor.level_m <= wall.top_m - floor.beam_height_m + TOLERANCE_M:
            raise PlanError(
                f"{where}: level_m {floor.level_m:g} with beams of {floor.beam_height_m:g} m does"
                f" not fit wall '{wall.name}' ({wall.base_m:g} to {wall.top_m:g} m)"
            )
        for opening in wall.openings:
            overlap = (
                opening.sill_m < floor.level_m + floor.beam_height_m - TOLERANCE_M
                and opening.head_m > floor.level_m + TOLERANCE_M
            )
            if overlap:
                raise PlanError(
                    f"{where}: the beams cross opening '{opening.name}' of wall '{wall.name}'"
                )


def check(plan, source):
    """Refuse, by name, a plan that cannot be built; see `plan_from_dict`."""
    for kind, parts in (("wall", plan.walls), ("floor", plan.floors)):
        names = [p.name for p in parts]
        for name in names:
            if names.count(name) > 1:
                raise PlanError(f"{source}: two {kind}s are called '{name}'")
    for wall in plan.walls:
        _check_wall(wall, f"{source}, wall '{wall.name}'")
    for i, first in enumerate(plan.walls):
        for second in plan.walls[i + 1 :]:
            if (
                first.axis == second.axis
                and overlap_in_plan(first, second)
                and overlap_in_height(first, second)
            ):
                raise PlanError(f"{source}: walls '{first.name}' and '{second.name}' overlap")
    for floor in plan.floors:
        _check_floor(plan, floor, f"{source}, floor '{floor.name}'")
    bond = plan.facade_bond
    if not (_is_number(bond) and 0.0 < bond <= 1.0):
        raise PlanError(f"{source}: facade_bond must be above 0 and at most 1, got {bond!r}")
    if plan.monitor_floor is not None and plan.monitor_floor not in [f.name for f in plan.floors]:
        raise PlanError(f"{source}: monitor_floor '{plan.monitor_floor}' is not a floor")


def overlap_in_plan(first, second):
    """Return True if the footprints of two walls share an area."""
    return all(
        min(p[1], q[1]) - max(p[0], q[0]) > TOLERANCE_M
        for p, q in zip(first.footprint(), second.footprint(), strict=True)
    )


def overlap_in_height(first, second):
    """Return True if two walls share a range of heights."""
    return min(first.top_m, second.top_m) - max(first.base_m, second.base_m) > TOLERANCE_M
