"""Floors and roof on a façade: their load, and what friction and anchors hold.

A floor presses with P on the façade, s from its inner face, and holds it against the return wall
behind, whose motion it has, by a spring k that slides at μ P, outward and inward alike. What its
anchors hold, F_a, are ties beside that (`ties.anchor_ties`). P is a dead load that goes where its
point goes; its vertical inertia is left out. With a mass m of its own the floor moves along y on a
spring m (2π/T)² and a dashpot 2 ζ m (2π/T) against that wall, and it is this mass to which the
façade is joined, by one spring k that slides at μ P + F_a. Of a free-standing façade the base
stands for the wall.

A load with a flat bearing is a block that lies on the whole thickness of the top and stays level:
it moves along z alone, with its mass P/g, and along y with what holds it. Where the top turns
under it, it bears on one edge. Its nodes have no friction, since the floor is what holds. Whether a
load has vertical inertia may be stated apart from how it lies: on a point with inertia it is such a
block on one node; flat without, a block of LIGHT of its mass that the rest of P presses on.
"""

import math

from yade_scripts.model.bars import Floor, Link
from yade_scripts.model.base import BASE
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.holds import FRICTION, of_floor
from yade_scripts.model.scene import Block

DEPTH_M = 0.2  # of a roof's block, for drawings
LIGHT = 0.02  # mass of a level load without inertia, over P/g: its bounce needs some


def loaded(rows, shape):
    """Weight of a façade with its floors' loads [N], and its lever, see `Shape.lever_m`."""
    weights, levers = [shape.mass_kg * GRAVITY_M_S2], [shape.lever_m]
    for row in rows:
        weights.append(row.load_n)
        levers.append((shape.thickness_m - place_of(row, shape)[1], row.height_m))
    total = sum(weights)
    arm, height = (
        sum(w * part for w, part in zip(weights, parts, strict=True)) / total
        for parts in zip(*levers, strict=True)
    )
    return total, (arm, height)


def place_of(row, shape):
    """Point of a floor on the façade: s from its inner face, or the middle of its thickness."""
    back, front = shape.tapered_faces_at(row.height_m)
    y = 0.5 * (back + front) if row.arm_m is None else back + row.arm_m
    return 0.0, y, row.height_m


def lever_of(row, thickness_m):
    """Arm s of a load in a mechanism that turns the top inward, from the inner face [m].

    What stays level then bears on the outer edge.
    """
    if row.is_flat:
        return thickness_m
    return 0.5 * thickness_m if row.arm_m is None else row.arm_m


def level_loads(shape, blocks, walls, beds):
    """Append the blocks of loads that are flat or have inertia, at rest on the façade's top.

    Returned are floors that press on those without inertia. `beds` are the façade's `facade.Beds`,
    `walls` as of `facade_floors`.
    """
    pressing, facade = [], beds.facade
    top = 1 + len(shape.hinges_m)
    upper = shape.height_m - max([0.0, *shape.hinges_m])
    jkn = facade.base_stiffness_pa_m or facade.e_mpa * 1e6 / (0.5 * upper)
    size = (shape.width_m, shape.thickness_m, DEPTH_M)
    for number, row in enumerate(facade.floors, 1):
        if not row.is_block:
            continue
        load, share = row.load_n, 1.0 if row.has_inertia else LIGHT
        carrier = wall_behind(f"floors[{number}].height_m", row.height_m, walls, blocks)
        sunk = load / (jkn * shape.thickness_m * shape.width_m) - blocks[top].displacement_m[2]
        block = len(blocks)
        blocks.append(
            Block(
                f"load {number}",
                (0.0, 0.5 * shape.thickness_m, shape.height_m + 0.5 * DEPTH_M),
                size,
                share * load / GRAVITY_M_S2,
                (1.0, 1.0, 1.0),
                free="z",
                motion=blocks[carrier].motion,
                displacement_m=(0.0, 0.0, -sunk),
            )
        )
        lies = "flat" if row.is_flat else "point"
        beds.bed(f"bearing {number}", block, top, shape.height_m, jkn, load=lies)
        if share < 1.0:
            place, rest = blocks[block].centre_m, (1.0 - share) * load
            pressing.append(Floor(f"weight {number}", block, carrier, place, rest, 1.0, 0.0))
    return pressing


def wall_behind(what, height_m, walls, blocks):
    """Index of the return wall at a height of the façade, the lower of two; without any its base.

    ValueError of one line that begins with `what`, if there is none.
    """
    if not walls:
        return next(i for i, block in enumerate(blocks) if block.name == BASE)
    for i in walls:
        if abs(height_m - blocks[i].centre_m[2]) <= 0.5 * blocks[i].size_m[2] + 1e-9:
            return i
    raise ValueError(
        f"{what} = {height_m:g}: expected a height at which the façade has a return wall (m)"
    )


def facade_floors(rows, walls, blocks, shape, damping_ratio):
    """Floors of a façade and links of those with a mass, whose blocks are appended to `blocks`.

    `rows` are `Facade.floors`; `walls` are indices of the return walls' blocks, none: the
    base carries the floors. Block 1 and those after it are the façade's, as `shape` numbers its
    pieces; the damping ratio is that of a floor on its spring. ValueError of one line, if a floor
    meets no return wall.
    """
    floors, links = [], []
    for number, row in enumerate(rows, 1):
        z, name = row.height_m, f"floor {number}"
        carrier = wall_behind(f"floors[{number}].height_m", z, walls, blocks)
        if row.mass_t > 0.0:
            mass, omega = 1e3 * row.mass_t, 2.0 * math.pi / row.period_s
            size = (shape.width_m, blocks[carrier].size_m[1], DEPTH_M)
            place = (0.0, -0.5 * size[1], z)
            spring, dashpot = mass * omega**2, 2.0 * damping_ratio * mass * omega
            links.append(Link(name, len(blocks), carrier, spring, dashpot, place))
            carrier = len(blocks)
            blocks.append(Block(name, place, size, mass, (1.0,) * 3, free="y"))
        load = 0.0 if row.is_block else row.load_n
        slides = [hold for hold in of_floor(row) if hold.kind == FRICTION or row.mass_t]
        capacity = sum(hold.capacity_n for hold in slides)
        if load or capacity:
            piece, place = 1 + shape.piece_at(z), place_of(row, shape)
            stiffness = 1e3 * row.stiffness_kn_m
            floors.append(Floor(name, piece, carrier, place, load, stiffness, capacity))
    return floors, links
