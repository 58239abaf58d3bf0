"""Return walls behind a façade of one block: their blocks, and their joints with its back face.

One block up the height, or one for each lumped mass of the chain (PARTS of it where their motion is
interpolated). One-way coupled they are supports with a motion; two-way coupled they are masses of
the chain, or hang on them as `panels` says. Walls stand behind the façade alone: of a façade on
lower storeys, or below the top of its building, masses below its foot and above its top have none.
"""

import math

import numpy as np

from yade_scripts.model.chain import chain_links
from yade_scripts.model.facades import Facade
from yade_scripts.model.panels import Hanging, building_mass, mass_heights
from yade_scripts.model.quadrature import MIDDLE, gauss_lobatto, over_columns
from yade_scripts.model.scene import Block, Interface, held
from yade_scripts.model.wall_motion import PARTS, motion_of

WALL = "return wall"
PIECE_M = 0.25  # depth of wall that moves with the contact, where the masses are elsewhere


def back_jkn(config):
    """Stiffness of the joint with the return walls, E/L [Pa/m].

    Unless stated L = h/2, the mean length of the 45° triangle behind the crack.
    """
    facade = Facade.of(config["facade"])
    length = config["return_wall"]["length_m"] or 0.5 * facade.height_m
    return facade.e_mpa * 1e6 / length


def back_strength(wall, bonded):
    """Friction of the joint with the return walls, and its strengths if it is bonded."""
    friction = math.radians(wall["friction_deg"])
    if not bonded:
        return held(0.0, 0.0, friction)
    return held(wall["tension_mpa"] * 1e6, wall["cohesion_mpa"] * 1e6, friction)


def wall_strips(width_m, wall):
    """Where the return walls stand along the façade: (x0, x1) of each, evenly apart [m]."""
    half = 0.5 * wall["thickness_m"]
    if wall["count"] == 1:
        return [(-half, half)]
    spread = 0.5 * width_m - half
    return [(x - half, x + half) for x in np.linspace(-spread, spread, wall["count"]).tolist()]


def _middles(strips):
    """Places in x and weights of one column in the middle of each strip (x0, x1)."""
    width = np.array([b - a for a, b in strips])
    return np.array([0.5 * (a + b) for a, b in strips]), width / width.sum()


def _spans(count, facade, chain):
    """Number, foot and height of each block behind the façade, from the façade's base [m]."""
    raised, height, whole = facade.base_height_m, facade.height_m, facade.building_top_m
    for number in range(1, count + 1):
        low, tall = (number - 1) * whole / count, whole / count
        if not chain:
            low, tall = 0.0, height
        elif raised:  # of the building's height what is behind the façade
            low, tall = max(low, raised) - raised, min(tall, low + tall - raised)
        if low + tall > height + 1e-9:
            tall = height - low
        if tall > 1e-9:
            yield number, low, tall


def _contact(parts, tall_m, total_m, nodes_up, planar, slope=0.0):
    """Nodes of a block's contact with the façade, on each part of the back face before it.

    With a wedge they are on its crack, which goes back by the `slope` times the height.

    `parts` are those of `Shape.back_parts`, `total_m` is the thickness of all walls; `nodes_up` are
    those up a block whose contact is in one part, and up one that is cut into several. Each row is
    (middle_m, positions_m, areas_m2).
    """
    contacts, (whole, cut) = [], nodes_up
    for foot, length, y, lost, strips in parts:
        count = whole if len(parts) == 1 else max(3, 1 + math.ceil((cut - 1) * length / tall_m))
        points, weights = gauss_lobatto(count)
        middle = foot + 0.5 * length
        line = np.stack([0 * points, y + 0 * points, foot + points * length], axis=1)
        if slope:
            line[:, 1] -= slope * line[:, 2]
            length = length * math.hypot(1.0, slope)
        columns = MIDDLE if planar else _middles(strips)
        places, areas = over_columns(line, weights * length * (total_m - lost), columns)
        contacts.append((middle, places, areas))
    return contacts


def add_return_walls(beds, kind, blocks, motions, shape, stands):
    """Append return walls and their joints with the façade, and the chain that carries them.

    Block 0 is the base, those after it are the façade's, as `shape` numbers its pieces; `beds` are
    `facade.Beds`. To `motions` the weights of mixed motions are added by name; without `stands` the
    chain alone is appended.

    Returned are indices of the walls' blocks, links between the masses, and indices of the masses
    from the lowest up; the last two empty where the chain is no part of the scene.
    """
    config, facade, wall = beds.config, beds.facade, beds.config["return_wall"]
    whole = facade.building_top_m
    total = wall["count"] * wall["thickness_m"]
    masses = config["smdof"]["n_dof"] if kind.chain else 1
    parts = _parts(kind, wall)
    count = masses * parts
    apart = kind.two_way and wall["motion"] != "top"  # else each block is a mass of the chain
    hanging = Hanging(config, blocks, beds.nodes, wall["count"], PIECE_M) if apart else None
    mass = 1.0
    if hanging:
        mass = facade.density_kg_m3 * total * PIECE_M * whole / count
    elif kind.two_way:
        mass = building_mass(config) / count
    walls: dict[int, int] = {}  # blocks by number
    for number, low, tall in _spans(count, facade, kind.chain) if stands else ():
        middle = low + 0.5 * tall
        motion = None if kind.two_way else blocks[0].motion
        if kind.chain and not kind.two_way:
            raised = facade.base_height_m
            motion = motion_of(wall["motion"], raised + middle, whole, masses, motions)
        block = walls[number] = len(blocks)
        blocks.append(
            Block(
                f"{WALL} {number}",
                (0.0, -0.5 * facade.height_m - facade.gap_m, middle),
                (total, facade.height_m, tall),
                mass * (tall / (whole / count) if hanging else 1.0),
                (1.0, 1.0, 1.0),
                free="y" if kind.two_way else "",
                motion=motion,
            )
        )
        if hanging:
            hanging.hang(block, 0.0)
        _join(beds, kind, block, blocks[block].name, shape, low, tall)
    behind = list(walls.values())
    if hanging:
        return behind, hanging.finish(behind), hanging.masses
    if not kind.two_way:
        return behind, [], []
    return behind, *_chain_of(walls, config, blocks, mass, (total, PIECE_M, 0.1))


def _parts(kind, wall):
    """Blocks behind the façade for each mass of the chain."""
    return PARTS if kind.chain and wall["motion"] == "interpolated" else 1


def _join(beds, kind, block, name, shape, low_m, tall_m):
    """Add the joints of a return wall's block, a span up the façade's height, with it."""
    config, facade, wall = beds.config, beds.facade, beds.config["return_wall"]
    cut = config["numerics"][kind.nodes_up]
    nodes_up = 1 + math.ceil((cut - 1) / _parts(kind, wall)), cut
    strips = wall_strips(facade.width_m, wall)
    total, jkn = wall["count"] * wall["thickness_m"], back_jkn(config)
    interface = Interface(
        jkn,
        facade.shear_stiffness_ratio * jkn,
        beta_s=beds.beta_s,
        gap_m=facade.gap_m,
        **back_strength(wall, kind.bonded),
    )
    cut_up = shape.back_parts(low_m, tall_m, strips)
    contact = _contact(cut_up, tall_m, total, nodes_up, beds.planar, shape.slope)
    for part, (at_m, places, areas) in enumerate(contact, 1):
        joint = name if len(contact) == 1 else f"{name} part {part}"
        piece = 1 + shape.piece_at(at_m)
        beds.nodes.add_joint(joint, piece, block, places, (0, 1, shape.slope), areas, interface)


def _chain_of(walls, config, blocks, mass_kg, size_m):
    """Links and masses of a chain, each the block of its number; without a wall it gets its own."""
    heights = mass_heights(config)
    for number, z in enumerate(heights, 1):
        if number in walls:
            heights[number - 1] = blocks[walls[number]].centre_m[2]
        else:
            place = (0.0, -2.0 * PIECE_M, z)
            walls[number] = len(blocks)
            blocks.append(Block(f"mass {number}", place, size_m, mass_kg, (1.0,) * 3, free="y"))
    masses = [walls[number] for number in sorted(walls)]
    return chain_links(config["smdof"], building_mass(config), masses, heights), masses
