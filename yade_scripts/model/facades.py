"""A façade as its configuration states it: size, masonry, shape, what holds and what loads it.

A `Facade` is made once of section facade, by `Facade.of`, and handed on; scene, hand calculation,
drawing and formula take what they need of it by name. Names, units and defaults are those of
`workflow/schemas/facade.schema.yaml`, which describes each.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields

STUDY, COLUMN = "study", "column"  # forms of the base
TRIANGLE = "triangle"  # outline of a gable by itself
SLICES = 10  # of a wall that tapers
OWN_KEYS = (  # of a shape
    *("thickness_steps", "openings", "gable_height_m", "parapet_height_m"),
    *("wedge_deg", "cornices", "top_thickness_m"),
)
FLAT = "flat"  # bearing of a load that lies on the whole thickness
ACROSS, ALONG = "across", "along"  # which way joists run: onto the façade, or beside it


@dataclass(frozen=True)
class Step:
    """From a height above the base on, a thickness [m]."""

    z_m: float
    thickness_m: float


@dataclass(frozen=True)
class Hole:
    """A hole through the façade: its middle along it, its sill above the base, its size [m]."""

    x_m: float
    z_m: float
    width_m: float
    height_m: float


@dataclass(frozen=True)
class Cornice:
    """Masonry before the outer face: lower edge above the base, height, how far it projects [m]."""

    z_m: float
    height_m: float
    projection_m: float


@dataclass(frozen=True)
class Rods:
    """A row of equal rods at a height above the base; `anchor_kn` None: it holds whatever it is.

    `x_m` are their places from the middle of the façade, None: evenly spread (`ties.rods_at`);
    `pretension_kn` is what each pulls before anything moves.
    """

    height_m: float
    count: int
    diameter_mm: float
    length_m: float
    e_mpa: float
    yield_mpa: float
    elongation: float
    x_m: tuple[float, ...] | None = None
    pretension_kn: float = 0.0
    slack_mm: float = 0.0
    anchor_kn: float | None = None

    def __post_init__(self):
        """Keep the places as values."""
        if self.x_m is not None:
            object.__setattr__(self, "x_m", tuple(self.x_m))

    @property
    def rod(self):
        """Stiffness n E A/L [N/m], capacity n min(A f_y, F_a) [N] and elongation [m] of the row."""
        area = math.pi / 4.0 * (1e-3 * self.diameter_mm) ** 2
        stiffness = self.count * self.e_mpa * 1e6 * area / self.length_m
        steel = self.count * self.yield_mpa * 1e6 * area
        anchor = math.inf if self.anchor_kn is None else self.count * self.anchor_kn * 1e3
        if anchor <= steel:
            return stiffness, anchor, anchor / stiffness
        return stiffness, steel, max(self.elongation * self.length_m, steel / stiffness)


@dataclass(frozen=True)
class Thrust:
    """A static horizontal thrust on the façade at a height above its base, outward."""

    height_m: float
    force_kn: float

    @property
    def force_n(self):
        """It on the whole width [N]."""
        return 1e3 * self.force_kn


@dataclass(frozen=True)
class FloorRow:
    """A floor at a height above the base: its load, and what friction and anchors hold."""

    height_m: float
    load_kn: float
    friction: float
    anchor_kn: float
    anchor_reach_m: float
    stiffness_kn_m: float
    mass_t: float
    period_s: float
    arm_m: float | None = None
    joists: str = ACROSS
    bearing: str = "point"
    load_inertia: bool | None = None

    @property
    def load_n(self):
        """Weight that it lays on the façade [N]."""
        return 1e3 * self.load_kn

    @property
    def is_flat(self):
        """Whether its load lies on the whole thickness and stays level."""
        return self.bearing == FLAT

    @property
    def has_inertia(self):
        """Whether its load moves up and down with its mass; by its bearing if not stated."""
        return self.is_flat if self.load_inertia is None else self.load_inertia

    @property
    def is_block(self):
        """Whether its load is a block of its own."""
        return self.load_kn > 0.0 and (self.is_flat or self.has_inertia)


@dataclass(frozen=True)
class Facade:
    """Section facade as values; two of the same values are equal and have the same hash."""

    height_m: float
    thickness_m: float
    width_m: float
    density_kg_m3: float
    e_mpa: float
    friction_deg: float
    shear_stiffness_ratio: float
    base_stiffness_pa_m: float | None
    gap_m: float
    tilt_deg: float
    bond_tension_mpa: float = 0.0
    bond_cohesion_mpa: float = 0.0
    base: str = STUDY
    courses: int = 0
    courses_growth: float = 1.0
    sides: str = "one"
    outline: str = "box"
    thickness_steps: tuple[Step, ...] = ()
    top_thickness_m: float | None = None
    flush_face: str = "outer"
    cornices: tuple[Cornice, ...] = ()
    wedge_deg: float = 0.0
    wedge_thickness_m: float | None = None
    openings: tuple[Hole, ...] = ()
    gable_height_m: float = 0.0
    parapet_height_m: float = 0.0
    parapet_thickness_m: float | None = None
    base_height_m: float = 0.0
    building_height_m: float | None = None
    hinges_m: tuple[float, ...] | str = ()
    ties: tuple[Rods, ...] = ()
    thrusts: tuple[Thrust, ...] = ()
    floors: tuple[FloorRow, ...] = ()

    @classmethod
    def of(cls, section):
        """Façade of a section of the configuration, or of a case file; a façade as it is.

        ValueError of one line for a key that is missing or that a façade has not.
        """
        if isinstance(section, cls):
            return section
        given = _known(cls, section, "facade")
        for key, row in ROWS.items():
            stated = given.get(key, ())
            given[key] = tuple(
                entry
                if isinstance(entry, row)
                else row(**_known(row, entry, f"facade.{key}[{number}]"))
                for number, entry in enumerate(stated, 1)
            )
        hinges = given.get("hinges_m", ())
        given["hinges_m"] = hinges if isinstance(hinges, str) else tuple(hinges)
        return cls(**given)

    @property
    def is_free(self):
        """Whether it stands free, without return walls."""
        return self.sides == "two"

    @property
    def is_plain(self):
        """Whether it is a homogeneous box from ground to top of its building."""
        shaped = any(getattr(self, key) for key in OWN_KEYS) or self.outline == TRIANGLE
        whole = self.building_height_m or self.height_m
        return not (shaped or self.base_height_m or whole != self.height_m)

    @property
    def building_top_m(self):
        """Height of the building whose masses move the walls behind it [m]."""
        return self.building_height_m or self.base_height_m + self.height_m

    @property
    def slices_m(self):
        """Heights between the boxes, of the thickness at their middles, that stand for a taper.

        Its mass is exact, its centroid and moments to a ten thousandth.
        """
        if not self.top_thickness_m:
            return []
        return [self.height_m * k / SLICES for k in range(1, SLICES)]

    def tapered_m(self, height_m):
        """Thickness at a height of a wall that tapers in a straight line [m]."""
        b, top = self.thickness_m, self.top_thickness_m or self.thickness_m
        return b + (top - b) * height_m / self.height_m

    @property
    def wedge_slope(self):
        """Tangent of the crack's angle of its return walls' wedge; 0 without one."""
        return math.tan(math.radians(self.wedge_deg))

    def refuse(self, what, held=False):
        """Raise a ValueError of one line if it is no plain box on the ground, in one piece.

        With `held` also if ties, floors or a bond hold it.
        """
        keys = [*OWN_KEYS, "base_height_m", "building_height_m", "hinges_m", "courses"]
        if held:
            keys += ["ties", "floors", "thrusts", "bond_tension_mpa", "bond_cohesion_mpa"]
        given = [key for key in keys if getattr(self, key)]
        given += ["outline"] if self.outline == TRIANGLE else []
        if given:
            raise ValueError(
                f"facade.{given[0]}: {what} knows a plain façade on the ground alone; expected none"
            )

    def refuse_bonds(self, what):
        """Raise a ValueError of one line if its own joints are bonded."""
        for key in ("bond_tension_mpa", "bond_cohesion_mpa"):
            if value := getattr(self, key):
                raise ValueError(
                    f"facade.{key} = {value:g}: {what} knows dry joints alone; expected 0 (MPa)"
                )


ROWS = {
    "thickness_steps": Step,
    "cornices": Cornice,
    "openings": Hole,
    "ties": Rods,
    "thrusts": Thrust,
    "floors": FloorRow,
}
NAMES = {kind: {field.name for field in fields(kind)} for kind in (Facade, *ROWS.values())}
NEEDED = {
    kind: {field.name for field in fields(kind) if field.default is field.default_factory}
    for kind in NAMES
}


def _known(kind, section, where):
    """Values by key of a section, if they are those of a kind."""
    if not isinstance(section, Mapping):
        raise ValueError(f"{where} = {section!r}: expected keys and values")
    if missing := NEEDED[kind] - section.keys():
        raise ValueError(f"{where}.{sorted(missing)[0]}: expected a value, found none")
    if other := section.keys() - NAMES[kind]:
        raise ValueError(f"{where}.{sorted(other)[0]}: expected one of {sorted(NAMES[kind])}")
    return dict(section)
