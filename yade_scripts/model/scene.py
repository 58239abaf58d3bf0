"""Scene description: rigid blocks, contact nodes, links and ties between them, as plain data.

A scene knows nothing of YADE. `engine` turns it into YADE bodies, `stiffness`
assembles its K, M and C from the same node list, drawings read its blocks.

Axes: x along the façade, y out of plane and positive outward, z up. SI units.
A contact node is a point of block `a`; block `b` stands opposite it as the
plane through that point with `normal` pointing from b into a. Penetration is
positive when a has moved against the normal; node force on a along the normal
is kn·penetration + β·kn·(its rate), never tensile unless the node is bonded. A node is

    DRY   compression and friction alone
    BOND  linear both ways, in shear too, until it reaches a strength; dry from then on
    TIE   as a bond, but it transmits no shear: a smooth joint that holds in tension
    WELD  linear both ways, and never breaks
"""

import json
import math
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any

import numpy as np

from yade_scripts.model.bars import Floor, Link, Tie
from yade_scripts.model.gravity import GRAVITY_M_S2

DRY, BOND, TIE, WELD = range(4)  # kinds of nodes
DOFS = "xyzXYZ"  # translations, then rotations about the same axes (YADE's letters)


@dataclass(frozen=True)
class Block:
    """One rigid block: its reference geometry, inertia, freedoms and drive."""

    name: str  #: unique within the scene
    centre_m: tuple  #: centroid in the reference position, where nodes and gaps are measured
    size_m: tuple  #: edge lengths along x, y, z
    mass_kg: float  #: of the part that is modelled (half, in a half model)
    inertia_kg_m2: tuple  #: principal moments about the centroid along x, y, z
    #: free degrees of freedom, letters of "xyzXYZ" (rotations in capitals); a support has none
    free: str = DOFS
    motion: str | None = None  #: name of the motion that drives a support along y, if any
    displacement_m: tuple = (0.0, 0.0, 0.0)  #: initial, of the centroid from the reference
    rotation_rad: tuple = (0.0, 0.0, 0.0)  #: initial rotation vector about the centroid
    velocity_m_s: tuple = (0.0, 0.0, 0.0)  #: initial, of the centroid
    angular_velocity_rad_s: tuple = (0.0, 0.0, 0.0)  #: initial
    #: inertia without weight, of a part whose joints are linear, so that its dead load only adds a
    #: static answer
    weightless: bool = False
    #: mass-proportional damping, a force −rate·m·v on the centroid, v relative to the frame
    drag_1_s: float = 0.0
    #: from the centroid out (y) and down (z) to the edge it rocks about; half its edges if None
    lever_m: tuple | None = None
    motion_x: str | None = None  #: name of the motion that drives it along x, if any

    @property
    def drives(self):
        """(axis, name) of the motions that drive it; axis 0 is x, 1 is y."""
        return [(i, name) for i, name in enumerate((self.motion_x, self.motion)) if name]

    @property
    def arms_m(self):
        """Distances out and down to the edge it rocks about [m]."""
        return self.lever_m or (0.5 * self.size_m[1], 0.5 * self.size_m[2])


def box_inertia(mass_kg, size_m):
    """Principal moments of a homogeneous box about its centroid, m(l_j² + l_k²)/12 [kg·m²]."""
    lx, ly, lz = size_m
    return (
        mass_kg * (ly**2 + lz**2) / 12.0,
        mass_kg * (lx**2 + lz**2) / 12.0,
        mass_kg * (lx**2 + ly**2) / 12.0,
    )


@dataclass
class Nodes:
    """Contact nodes as columns of equal length n."""

    a: np.ndarray  # index of the block that carries the node
    b: np.ndarray  # index of the block whose face the node touches
    joint: np.ndarray  # index into Scene.joints
    position_m: np.ndarray  # (n, 3) in the reference position
    normal: np.ndarray  # (n, 3) unit vector from b into a
    area_m2: np.ndarray  # tributary area
    kn_n_m: np.ndarray  # normal stiffness jkn·area
    ks_n_m: np.ndarray  # shear stiffness jks·area
    beta_s: np.ndarray  # stiffness-proportional damping: dashpots β·kn, β·ks
    drag: np.ndarray  # dashpot along the joint of a dry node over β·ks: 1, or 0 where it has none
    friction_rad: np.ndarray
    gap_m: np.ndarray  # clearance in the reference position; negative protrudes into b
    tension_n: np.ndarray  # tensile strength of a bond or tie
    cohesion_n: np.ndarray  # cohesive shear strength of a bond
    kind: np.ndarray  # DRY, BOND, TIE or WELD

    def __len__(self):
        """Return the number of nodes."""
        return len(self.a)

    def select(self, which, **others):
        """Return the nodes of a mask or slice, with some of their columns replaced."""
        return Nodes(**{name: column[which] for name, column in vars(self).items()} | others)

    @property
    def along(self):
        """Dashpot along the joint over β·ks before anything breaks, shape (n,)."""
        return np.where(self.kind == DRY, self.drag, 1.0)

    @property
    def welded(self):
        """Mask of the nodes that never break, shape (n,)."""
        return self.kind == WELD

    @property
    def bonded(self):
        """Mask of the nodes that start with a strength that they may reach, shape (n,)."""
        return (self.kind == BOND) | (self.kind == TIE)

    @property
    def tie(self):
        """Mask of the bonded nodes that transmit no shear, shape (n,)."""
        return self.kind == TIE


@dataclass
class Scene:
    """Blocks, contact nodes and what the run needs to know about them."""

    blocks: list  #: of `Block`
    joints: list  #: names of the joints, for reports ("base", "return wall 2", …)
    nodes: Nodes
    monitor: str  #: name of the block whose top displacement is d
    #: the point of that block, in the reference position, that moves by d
    monitor_point_m: tuple
    #: name of the support, or of the block that masses carry, from which d is measured
    reference: str
    thickness_m: float  #: b of d/b
    gravity_m_s2: float = GRAVITY_M_S2  #: downward acceleration
    links: list = field(default_factory=list)  #: of `bars.Link`
    ties: list = field(default_factory=list)  #: of `bars.Tie`
    floors: list = field(default_factory=list)  #: of `bars.Floor`
    #: name of the ground motion in whose frame the scene is described, where supports without
    #: motion of their own stand still and every free block feels −m·a_g along y; None: an inertial
    #: frame
    shaking: str | None = None
    #: name of the vertical motion that supports and ground share. The scene is described in the
    #: frame that moves with it: nothing prescribed moves along z, and every block that is free
    #: along z feels −m·a_z. Exactly the same, since all that is prescribed moves together
    vertical: str | None = None
    #: what some scenes say beside. "motions" are weights of floor motions by name (see
    #: `floor_motions`); "watched", see below; "rims", "debris" and "partial", where contact ends
    #: (see `engine.faces`); "critical_step_s", where it is known; facts for tables
    notes: dict = field(default_factory=dict)

    def index(self, name):
        """Return the index of the block called `name`; KeyError names the known blocks."""
        for i, block in enumerate(self.blocks):
            if block.name == name:
                return i
        raise KeyError(f"no block '{name}'; the scene has {[b.name for b in self.blocks][:20]}")

    @property
    def watched(self):
        """Blocks and points of which the farthest moves by d, (name, point) of each.

        They are the monitored one and the tops of pieces below it, in the note "watched".
        """
        return [(self.monitor, self.monitor_point_m), *self.notes.get("watched", ())]

    @property
    def overturning_energy_j(self):
        """Energy that overturns the monitored block, m g (R − z), R from centroid to toe [J]."""
        block = self.blocks[self.index(self.monitor)]
        rise = math.hypot(*block.arms_m) - block.arms_m[1]
        return block.mass_kg * self.gravity_m_s2 * rise

    @property
    def motions(self):
        """Names of the motions that drive the scene, sorted."""
        names = {self.shaking, self.vertical}
        return sorted((names | {name for b in self.blocks for _, name in b.drives}) - {None})

    @property
    def two_components(self):
        """Whether supports move along the façade too."""
        return any(block.motion_x for block in self.blocks)


def held(tension_pa, cohesion_pa, friction_rad):
    """What holds the nodes of a joint with these strengths, as `NodeList.add_joint` takes it.

    Without strength it is dry; where nothing resists shear, neither cohesion nor friction, a tie.
    """
    kind = BOND if tension_pa > 0.0 or cohesion_pa > 0.0 else DRY
    if kind == BOND and cohesion_pa == 0.0 and friction_rad == 0.0:
        kind = TIE
    return {
        "kind": kind,
        "friction_rad": friction_rad,
        "tension_pa": tension_pa,
        "cohesion_pa": cohesion_pa,
    }


@dataclass(frozen=True)
class Interface:
    """What the two sides of a joint do to each other, per area.

    Stiffness [Pa/m] normal to it and along it, one value or one a node; β, the
    stiffness-proportional damping [s]; friction [rad] and gap [m], one value or one a node; kind
    and strengths [Pa] as of `held`.
    """

    jkn_pa_m: Any
    jks_pa_m: Any
    beta_s: float = 0.0
    friction_rad: Any = 0.0
    gap_m: Any = 0.0
    kind: int = DRY
    tension_pa: float = 0.0
    cohesion_pa: float = 0.0

    def fault(self):
        """What is wrong with it beside its stiffness, in words; "" where nothing is."""
        if self.kind == DRY and (self.tension_pa or self.cohesion_pa):
            return "a dry joint has no strength"
        if self.beta_s < 0.0:
            return f"β must not be negative, got {self.beta_s} s"
        return ""


NO_DRAG = 0.0  # no dashpots along dry joints: YADE's law would not bound them by friction
INTEGERS, VECTORS = ("a", "b", "joint", "kind"), ("position_m", "normal")  # columns of nodes


class NodeList:
    """Collects the nodes of a scene joint by joint; `done()` gives the columns."""

    def __init__(self, drag=1.0, scene=None):
        """Start without joints, or after those of a scene; `drag` is that of all new nodes."""
        self.joints, self.drag = [*scene.joints] if scene else [], drag
        none = {
            column.name: np.empty((0, 3) if column.name in VECTORS else 0)
            for column in fields(Nodes)
        }
        self._rows = {k: [v] for k, v in (vars(scene.nodes) if scene else none).items()}

    def add_joint(self, name, a, b, positions_m, normal, areas_m2, interface):
        """Add the nodes of one joint, carried by block `a` against block `b` (their indices).

        Positions are (n, 3), the normal from b into a is normalised here. Areas are tributary, one
        value or one a node; the `Interface` is per area.

        Raises
        ------
        ValueError
            If a position is not finite, or an area or stiffness is not positive.
        """
        positions = np.atleast_2d(np.asarray(positions_m, float))
        count = len(positions)
        areas = np.broadcast_to(np.asarray(areas_m2, float), (count,))
        for label, value in (
            ("area", areas),
            ("jkn", interface.jkn_pa_m),
            ("jks", interface.jks_pa_m),
        ):
            if not (np.all(np.isfinite(value)) and np.all(np.asarray(value) > 0.0)):
                raise ValueError(f"joint '{name}': {label} must be positive and finite")
        if not np.all(np.isfinite(positions)):
            raise ValueError(f"joint '{name}': node positions must be finite")
        if fault := interface.fault():
            raise ValueError(f"joint '{name}': {fault}")
        self.joints.append(name)
        columns = {
            "a": a,
            "b": b,
            "joint": len(self.joints) - 1,
            "position_m": positions,
            "normal": np.asarray(normal, float) / np.linalg.norm(normal),
            "area_m2": areas,
            "kn_n_m": interface.jkn_pa_m * areas,
            "ks_n_m": interface.jks_pa_m * areas,
            "beta_s": interface.beta_s,
            "drag": self.drag,
            "friction_rad": interface.friction_rad,
            "gap_m": interface.gap_m,
            "tension_n": interface.tension_pa * areas,
            "cohesion_n": interface.cohesion_pa * areas,
            "kind": interface.kind,
        }
        for key, value in columns.items():
            shape = (count, 3) if key in VECTORS else (count,)
            self._rows[key].append(np.broadcast_to(value, shape))

    def done(self):
        """Return the collected `Nodes`."""
        return Nodes(
            **{
                key: np.concatenate(rows).astype(int if key in INTEGERS else float)
                for key, rows in self._rows.items()
            }
        )


def observed_at(scene, height_m):
    """The scene with d measured at a height of the façade, at the middle of its thickness.

    Raises
    ------
    ValueError
        One line, if no piece of the façade is at that height.
    """
    for name, _ in sorted(scene.watched, key=lambda part: part[1][2]):
        block = scene.blocks[scene.index(name)]
        if abs(height_m - block.centre_m[2]) <= 0.5 * block.size_m[2] + 1e-9:
            notes = {key: value for key, value in scene.notes.items() if key != "watched"}
            point = (0.0, block.centre_m[1], float(height_m))
            return replace(scene, monitor=name, monitor_point_m=point, notes=notes)
    raise ValueError(f"height_m = {height_m:g}: expected a height of the façade (m)")


def from_dict(data):
    """Return the scene that `to_json` wrote, from its parsed text."""
    nodes = Nodes(**{k: np.array(v) for k, v in data["nodes"].items()})
    kinds: dict[str, Any] = {"blocks": Block, "links": Link, "ties": Tie, "floors": Floor}
    parts: dict[str, Any] = {
        key: [
            kind(**{k: tuple(v) if isinstance(v, list) else v for k, v in part.items()})
            for part in data[key]
        ]
        for key, kind in kinds.items()
    }
    rest = {k: v for k, v in data.items() if k not in ("nodes", *kinds)}
    rest["monitor_point_m"] = tuple(rest["monitor_point_m"])
    return Scene(nodes=nodes, **parts, **rest)


def to_json(scene):
    """Serialise a scene; equal scenes give equal text, so it serves as a cache key."""
    data = asdict(scene)
    data["nodes"] = {k: np.asarray(v).tolist() for k, v in data["nodes"].items()}
    return json.dumps(data, sort_keys=True)
