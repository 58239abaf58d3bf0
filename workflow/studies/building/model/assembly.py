"""From a plan to a `Scene`: bricks, floors and ground as blocks, interfaces as bonded nodes."""

from dataclasses import dataclass

import numpy as np

from studies.building.model.bricks import Brick, Bricks, lay
from studies.building.model.contacts import KINDS, Interfaces, Joints, interfaces, weakened
from studies.building.model.floors import floor_boxes
from yade_scripts.model import floor_motions
from yade_scripts.model.building.plan import TOLERANCE_M, Plan, PlanError
from yade_scripts.model.scene import WELD, Block, Nodes, Scene, box_inertia

GROUND = "ground"
# Points of equal weight in a rectangle of half sides 1 with its zeroth, first and second moments
POINTS = np.sqrt([(0.0, 2 / 3), (1 / 2, 1 / 6), (1 / 2, 1 / 6)]) * [(1, 1), (1, -1), (-1, -1)]


@dataclass
class Building:
    """A building ready for analysis: its scene and what the drawings need.

    Blocks 0 … n_bricks − 1 are the bricks, then beams and panels floor by floor,
    the ground last. `floors` lists (first box, number of beams, beam axis).
    """

    plan: Plan
    brick: Brick
    bricks: Bricks
    interfaces: Interfaces
    scene: Scene
    floors: list

    @property
    def masonry_mass_kg(self):
        """Mass of all bricks [kg]."""
        return sum(b.mass_kg for b in self.scene.blocks[: len(self.bricks)])

    @property
    def mass_kg(self):
        """Mass of all free blocks [kg]."""
        return sum(b.mass_kg for b in self.scene.blocks if b.free)


def build(
    plan,
    *,
    brick=None,
    coarsening=1.0,
    joints=None,
    density_kg_m3=1800.0,
    timber_density_kg_m3=600.0,
):
    """Build the brick model of a plan; PlanError by name if a wall lacks support or a brick floats.

    Every interface becomes three points that carry a welded linear spring each, with the second
    moments of the rectangle: force and moments of a linearly varying relative displacement are
    exact. The ground is a support driven by the motion "ground". `joints` are stated for the real
    `brick`, which `coarsening` enlarges; joint stiffness times joint spacing and mass are kept. The
    masonry's density includes its joints, that of the timber is of beams and panels.
    """
    brick = brick or Brick()
    joints = joints or Joints()
    bricks = lay(plan, brick.coarsened(coarsening))
    timber = [floor_boxes(plan, floor, timber_density_kg_m3) for floor in plan.floors]
    low = np.concatenate([bricks.low_m, *(boxes.low_m for boxes in timber)])
    high = np.concatenate([bricks.high_m, *(boxes.high_m for boxes in timber)])
    floors, first = [], len(bricks)
    for floor, boxes in zip(plan.floors, timber, strict=True):
        floors.append((first, len(boxes.names) - 1, 1 - plan.wall(floor.walls[0]).axis))
        first += len(boxes.names)
    faces = interfaces(bricks, low, high, floors, joints, brick)
    faces = weakened(faces, bricks, [wall.facade for wall in plan.walls], plan.facade_bond)
    check_support(plan, bricks, faces, len(low))

    masonry = density_kg_m3 * (bricks.high_m - bricks.low_m).prod(axis=1)
    masses = np.concatenate([masonry, *(boxes.mass_kg for boxes in timber)])
    names = [bricks.name(i) for i in range(len(bricks))]
    names += [name for boxes in timber for name in boxes.names]
    blocks = _blocks(names, low, high, masses)
    monitor = _monitor(plan, blocks, floors)
    scene = Scene(
        blocks,
        list(KINDS),
        _nodes(faces, len(blocks) - 1),
        monitor.name,
        tuple(monitor.centre_m),
        GROUND,
        plan.walls[0].thickness_m,
        notes={"plan": plan.name, "coarsening": float(coarsening), "bricks": len(bricks)},
    )
    return Building(plan, brick.coarsened(coarsening), bricks, faces, scene, floors)


def _blocks(names, low, high, masses):
    """Boxes as blocks, and below them the ground, a support driven by its motion."""
    sizes, centres = (high - low).tolist(), (0.5 * (low + high)).tolist()
    blocks = [
        Block(name, tuple(centre), tuple(size), mass, box_inertia(mass, size))
        for name, centre, size, mass in zip(names, centres, sizes, masses.tolist(), strict=True)
    ]
    extent = high.max(axis=0) - low.min(axis=0)
    middle = 0.5 * (high.max(axis=0) + low.min(axis=0))
    place, size = (middle[0], middle[1], -0.1), (extent[0], extent[1], 0.2)
    blocks.append(Block(GROUND, place, size, 1e9, (1e9,) * 3, free="", motion=floor_motions.GROUND))
    return blocks


def _monitor(plan, blocks, floors):
    """Return the block whose motion stands for the top: a floor's panel, else the highest brick."""
    if floors:
        number = len(floors) - 1
        if plan.monitor_floor is not None:
            number = [f.name for f in plan.floors].index(plan.monitor_floor)
        first, count, _ = floors[number]
        return blocks[first + count]
    return max(blocks[:-1], key=lambda b: b.centre_m[2])


def _nodes(faces, ground):
    """Return the welded nodes of the interfaces, three points each, as `Nodes`."""
    n = len(faces)
    first = np.where(faces.axis == 0, 1, 0)  # the two in-plane directions of each interface
    second = np.where(faces.axis == 2, 1, 2)
    rows = np.arange(n)
    count = len(POINTS)
    position = np.repeat(faces.centre_m[:, None, :], count, axis=1)
    for k, (u, v) in enumerate(POINTS):
        position[rows, k, first] += u * faces.half_m[rows, first]
        position[rows, k, second] += v * faces.half_m[rows, second]
    area = np.repeat(faces.area_m2 / count, count)
    b = np.where(faces.b < 0, ground, faces.b)
    none = ("beta_s", "friction_rad", "gap_m", "tension_n", "cohesion_n")
    return Nodes(
        a=np.repeat(faces.a, count),
        b=np.repeat(b, count),
        joint=np.repeat(faces.kind, count),
        position_m=position.reshape(-1, 3),
        normal=np.repeat(np.eye(3)[faces.axis], count, axis=0),
        area_m2=area,
        kn_n_m=np.repeat(faces.jkn_pa_m, count) * area,
        ks_n_m=np.repeat(faces.jks_pa_m, count) * area,
        drag=np.ones(count * n),
        kind=np.full(count * n, WELD),
        **{name: np.zeros(count * n) for name in none},
    )


def check_support(plan, bricks, faces, count):
    """Refuse walls without support and floating bricks, by name.

    A wall is supported if a brick of its lowest course rests on the ground or on another wall's
    brick. A brick floats if no chain of interfaces ties it to the ground.
    """
    bed = (faces.axis == 2) & (faces.a < len(bricks))
    held_by = faces.b[bed]
    upper_wall = bricks.wall[faces.a[bed]]
    is_brick = (held_by >= 0) & (held_by < len(bricks))
    other = np.full(len(held_by), -1)
    other[is_brick] = bricks.wall[held_by[is_brick]]
    low = bricks.low_m[faces.a[bed], 2]
    for w, wall in enumerate(plan.walls):
        lowest = (upper_wall == w) & (np.abs(low - wall.base_m) < TOLERANCE_M) & (other != w)
        if not np.any(lowest):
            raise PlanError(
                f"wall '{wall.name}' has no support: nothing lies under its lowest course"
                f" at {wall.base_m:g} m"
            )
    reached = np.zeros(count + 1, bool)  # the ground is entry `count`
    reached[count] = True
    a, b = faces.a, np.where(faces.b < 0, count, faces.b)
    before = 0
    while before != reached.sum():
        before = reached.sum()
        reached[a[reached[b]]] = True
        reached[b[reached[a]]] = True
    loose = np.flatnonzero(~reached[: len(bricks)])
    if len(loose):
        centre = 0.5 * (bricks.low_m[loose[0]] + bricks.high_m[loose[0]])
        raise PlanError(
            f"brick '{bricks.name(loose[0])}' at x, y, z = {np.round(centre, 3).tolist()} m floats:"
            f" no joint ties it to the ground ({len(loose)} such bricks)"
        )
