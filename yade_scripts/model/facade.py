"""Façade scenes: one rigid block on a compliant base against return walls.

Models by boundary condition (design words)::

    free  no return walls (two-sided rocking, 2SR)
    W1    one return-wall block up the height, driven with the base
    W2    one return-wall block per lumped mass of the chain, block j driven by floor j
    W1c, W2c  the same with cohesion and tensile strength on the back joint
    W2m, W2cm  as W2 and W2c, but each block is a mass of the chain, joined to the others by its
          springs and dashpots, and feels the façade; in the frame of the ground

What a block takes from the masses is the rule of `wall_motion`; by default block j is mass j's.

The façade fills 0 ≤ y ≤ b, 0 ≤ z ≤ h; the return walls stand at y < 0. It
rocks outward about its front toe (y = b, z = 0). A planar scene has one column
of nodes at x = 0 and the freedoms y, z and rotation about x: façade and motion
are symmetric in x, so nothing else can move. A full scene spreads the nodes over the
rectangle of the base, edges and corners included, and over the faces of the return walls, and
frees all six; under two components its supports also move along x, which the façade feels by
friction at its base and at the walls that it touches.
"""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.model import registry
from yade_scripts.model.base import base_jkn, shares
from yade_scripts.model.chain import chain_links, chain_matrices
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.floors import facade_floors, level_loads
from yade_scripts.model.hinges import hinge_stiffness, pieces
from yade_scripts.model.motion import along
from yade_scripts.model.panels import Hanging, building_mass
from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.rest import at_rest
from yade_scripts.model.scene import Block, NodeList, Scene
from yade_scripts.model.shape import is_plain, shape_of
from yade_scripts.model.ties import facade_ties
from yade_scripts.model.wall_motion import PARTS, motion_of

BASE = "base"
FACADE = "façade"
WALL = "return wall"
MIDDLE = np.array([0.0]), np.array([1.0])  # the column of nodes of a planar scene
NO_SHEAR = 1e-6  # jks/jkn of a joint that slides freely
PIECE_M = 0.25  # depth of wall that moves with the contact, where the masses are elsewhere


def joint_stiffness(config):
    """Joint stiffnesses of base and back joint [Pa/m], paper section 3.

    That of the base is `base.base_jkn`, over which `base.shares` says where it sits; E/L at the
    return walls with L = h/2, the mean length of the 45° triangle behind the crack, unless stated.

    Returns
    -------
    base, back : float
    """
    facade, wall = config["facade"], config["return_wall"]
    e_pa = facade["e_mpa"] * 1e6
    return base_jkn(facade), e_pa / (wall["length_m"] or 0.5 * facade["height_m"])


def facade_scene(
    config, model, beta_s, *, planar=True, release_ratio=0.0, width_nodes=5, two_components=False
):
    """Build the scene of a façade with one of the single-block boundary conditions.

    Parameters
    ----------
    config : dict
        Resolved configuration; sections facade, return_wall, smdof, numerics.
    model : str
        Name of a model whose only free block is the façade, see `registry`.
    beta_s : float
        Stiffness-proportional damping β [s].
    planar : bool
        One column of nodes and planar freedoms, or three dimensions.
    release_ratio : float
        θ₀/α of a free-rocking release: the façade starts rotated outward about
        its front toe, at rest, with the base nodes around the toe carrying its weight.
    width_nodes : int
        Columns of nodes along each pier of the base of a full scene, its ends included.
    two_components : bool
        Supports of a full scene are driven along x too, by the motions `motion.along`.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For an unknown model, a release that is not within 0 ≤ θ₀/α < 1, ties and floors that
        meet no return wall, or two components with masses that are not driven.
    """
    kind = registry.model(model)
    if not kind.single_block:
        raise ValueError(f"façade model '{model}' has an assembly of its own")
    if not 0.0 <= release_ratio < 1.0:
        raise ValueError(f"release θ0/α must lie in [0, 1), got {release_ratio}")
    facade, numerics = config["facade"], config["numerics"]
    h, b, width = facade["height_m"], facade["thickness_m"], facade["width_m"]
    shape, raised = shape_of(facade), facade.get("base_height_m", 0.0)
    if raised and kind.two_way:
        raise ValueError(
            f"facade.base_height_m = {raised:g}: expected 0 (m) with model {model}, whose masses "
            "are not driven"
        )
    if two_components and (planar or kind.two_way or shape.hinges_m):
        raise ValueError(f"{model}: two components need a full scene, one block, driven supports")
    jkn_base, jkn_back = joint_stiffness(config)
    motions: dict = {}
    ground = GROUND
    if raised:
        whole = raised + h
        ground = motion_of("interpolated", raised, whole, config["smdof"]["n_dof"], motions)

    blocks = [
        Block(
            BASE,
            (0.0, 0.5 * b, -0.5),
            (2 * width, 4 * h, 1.0),
            1.0,
            (1.0, 1.0, 1.0),
            free="",
            motion=None if kind.two_way else ground,
        )
    ]
    nodes = NodeList()
    points, weights = gauss_lobatto(numerics["nodes_thickness"])
    # Debris under the base (tilt) belongs to the block as protruding nodes: it
    # rests rotated by φ about its front toe and cannot come back to the vertical.
    protrusion = (1.0 - points) * b * math.tan(math.radians(facade["tilt_deg"]))
    # index 1 is the façade, appended to `blocks` below
    columns = None if planar else _columns(shape.base_strips, width_nodes)
    add_base(config, beta_s, nodes, 1, 0, planar=planar, protrusion_m=protrusion, columns=columns)
    walls_stand = kind.walls != "none" and facade.get("sides") != "two"
    kn = shares(facade, weights) * b * (width - shape.base_lost_m) * jkn_base
    displacement, rotation = at_rest(facade, shape, kn, points, release_ratio, walls_stand)
    upright = Block(
        FACADE,
        shape.centre_m,
        shape.size_m,
        shape.mass_kg,
        tuple(np.diag(shape.tensor_kg_m2).tolist()),
        free="yzX" if planar else "xyzXYZ",
        displacement_m=displacement,
        rotation_rad=rotation,
        lever_m=shape.lever_m,
    )
    blocks += pieces(facade, shape, upright) if shape.hinges_m else [upright]
    stiffness = hinge_stiffness(facade, shape)
    for k, z in enumerate(shape.hinges_m, 1):
        joint = (f"hinge {k}", float(stiffness[k - 1]))
        add_base(config, beta_s, nodes, k + 1, k, planar=planar, height_m=z, joint=joint)
    tops = [(blocks[k].name, (0.0, 0.5 * b, z)) for k, z in enumerate(shape.hinges_m, 1)]
    links: list = []
    if walls_stand:
        links = _add_return_walls(
            config, kind, beta_s, blocks, nodes, jkn_back, planar, motions, shape
        )
    if two_components:
        blocks = [b if b.free else replace(b, motion_x=along(b.motion)) for b in blocks]
        motions |= {
            along(name): {along(floor): share for floor, share in mix.items()}
            for name, mix in list(motions.items())
        }
    walls = [i for i, block in enumerate(blocks) if block.name.startswith(WALL)]

    def lay(above, below, name, jkn):
        joint = (name, jkn)
        given = {"planar": planar, "height_m": shape.height_m, "joint": joint, "slides": True}
        add_base(config, beta_s, nodes, above, below, **given)

    level_loads(facade, shape, blocks, walls, lay)
    floors, springs = facade_floors(
        facade.get("floors", ()), walls, blocks, shape, config["smdof"]["damping_ratio"]
    )
    return Scene(
        blocks,
        nodes.joints,
        nodes.done(),
        monitor=blocks[1 + len(tops)].name,
        monitor_point_m=(0.0, 0.5 * sum(shape.storeys[-1][2:]), shape.top_m),
        reference=BASE,
        thickness_m=shape.overturning_m if not is_plain(facade) else b,
        links=[*links, *springs],
        ties=facade_ties(facade.get("ties", ()), walls, blocks, shape),
        floors=floors,
        shaking=GROUND if kind.two_way else None,
        notes={
            **({"motions": motions} if motions else {}),
            **({"watched": tops} if tops else {}),
        },
    )


def add_base(
    config,
    beta_s,
    nodes,
    facade,
    ground,
    *,
    planar,
    origin=(0.0, 0.0),
    protrusion_m=0.0,
    columns=None,
    height_m=0.0,
    joint=None,
    slides=False,
):
    """Add the joint between a façade's base and the ground, or between two of its pieces.

    Parameters
    ----------
    config, beta_s
        See `facade_scene`.
    nodes : NodeList
    facade, ground : int
        Indices of the blocks.
    planar : bool
    origin : tuple of 2 floats
        x of the façade's middle and y of its back face [m].
    protrusion_m : float or ndarray
        Of each node across the thickness below the base.
    columns : tuple of 2 ndarrays or None
        Places in x and weights; None: the middle of a planar scene, else two Gauss points.
    height_m : float
        Of the joint above the base.
    joint : (str, float) or None
        Its name and jkn [Pa/m]; None for the base's own.
    slides : bool
        It transmits no shear.
    """
    section = config["facade"]
    b, width = section["thickness_m"], section["width_m"]
    name, jkn = joint or (BASE, joint_stiffness(config)[0])
    points, weights = gauss_lobatto(config["numerics"]["nodes_thickness"])
    stiff = np.ones(weights.shape) if joint else shares(section, weights) / weights
    protrusion = np.broadcast_to(protrusion_m, points.shape)
    line = np.stack([origin[0] + 0 * points, origin[1] + points * b, height_m - protrusion], axis=1)
    gauss = np.array([-0.5, 0.5]) * (width / math.sqrt(3.0)), np.array([0.5, 0.5])
    columns, column_weights = MIDDLE if planar else columns or gauss
    standing = width - (0.0 if joint else shape_of(section).base_lost_m)
    positions, areas, gaps = _spread(
        line, weights * b * standing, columns, column_weights, gap_m=-protrusion
    )
    jkn = jkn * np.tile(stiff, len(columns))
    nodes.add_joint(
        name,
        facade,
        ground,
        positions,
        (0, 0, 1),
        areas,
        jkn,
        (NO_SHEAR if slides else section["shear_stiffness_ratio"]) * jkn,
        beta_s=beta_s,
        friction_rad=0.0 if slides else math.radians(section["friction_deg"]),
        gap_m=gaps,
    )


def wall_strips(width_m, wall):
    """Where the return walls stand along the façade: (x0, x1) of each, evenly apart [m]."""
    half = 0.5 * wall["thickness_m"]
    if wall["count"] == 1:
        return [(-half, half)]
    spread = 0.5 * width_m - half
    return [(x - half, x + half) for x in np.linspace(-spread, spread, wall["count"]).tolist()]


def _columns(strips, count):
    """Places in x and weights of so many columns along each strip (x0, x1), ends included."""
    points, weights = gauss_lobatto(count)
    whole = sum(b - a for a, b in strips)
    return (
        np.concatenate([a + points * (b - a) for a, b in strips]),
        np.concatenate([weights * (b - a) / whole for a, b in strips]),
    )


def _middles(strips):
    """Places in x and weights of one column in the middle of each strip (x0, x1)."""
    width = np.array([b - a for a, b in strips])
    return np.array([0.5 * (a + b) for a, b in strips]), width / width.sum()


def _spread(line_xyz, areas, columns, column_weights, gap_m=0.0):
    """Repeat a line of nodes at x = 0 over the columns; return positions, areas and gaps."""
    gaps = np.broadcast_to(gap_m, areas.shape)
    positions = np.concatenate([line_xyz + np.array([x, 0.0, 0.0]) for x in columns])
    return (
        positions,
        np.concatenate([areas * share for share in column_weights]),
        np.concatenate([gaps for _ in columns]),
    )


def _add_return_walls(config, kind, beta_s, blocks, nodes, jkn_back, planar, motions, shape):
    """Append return walls, one-way or two-way coupled, and back joints; return the links."""
    facade, wall, numerics = config["facade"], config["return_wall"], config["numerics"]
    h, width = facade["height_m"], facade["width_m"]
    total = wall["count"] * wall["thickness_m"]
    masses = config["smdof"]["n_dof"] if kind.chain else 1
    parts = PARTS if kind.chain and wall["motion"] == "interpolated" else 1
    count = masses * parts
    nodes_up = numerics[kind.nodes_up]
    points, weights = gauss_lobatto(
        1 + math.ceil((nodes_up - 1) / parts) if parts > 1 else nodes_up
    )
    apart = kind.two_way and wall["motion"] != "top"  # else each block is a mass of the chain
    hanging = Hanging(config, blocks, nodes, wall["count"], PIECE_M) if apart else None
    mass, motion, own = 1.0, None, []
    if kind.two_way:
        light = facade["density_kg_m3"] * total * PIECE_M * h / count
        mass = light if hanging else building_mass(config) / count
    raised = facade.get("base_height_m", 0.0)
    whole = raised + h
    strips = wall_strips(width, wall)
    for j in range(1, count + 1):
        low, tall = (j - 1) * whole / count, whole / count
        if raised and kind.chain:  # of the building's height what is behind the façade
            low, tall = max(low, raised) - raised, min(tall, low + tall - raised)
            if tall <= 1e-9:
                continue
        elif raised:
            low, tall = 0.0, h
        middle = low + 0.5 * tall
        name = f"{WALL} {j}"
        if not kind.two_way:
            motion = blocks[0].motion
            if kind.chain:
                motion = motion_of(wall["motion"], raised + middle, whole, masses, motions)
        blocks.append(
            Block(
                name,
                (0.0, -0.5 * h - facade["gap_m"], middle),
                (total, h, tall),
                mass,
                (1.0, 1.0, 1.0),
                free="y" if kind.two_way else "",
                motion=motion,
            )
        )
        own.append(len(blocks) - 1)
        if hanging:
            hanging.hang(own[-1], 0.0)
        pieces = shape.back_parts(low, tall, strips)
        for number, (foot, length, y, lost, own_strips) in enumerate(pieces, 1):
            columns, column_weights = MIDDLE if planar else _middles(own_strips)
            at, share = points, weights
            if len(pieces) > 1:
                fewer = 1 + math.ceil((nodes_up - 1) * length / tall)
                at, share = gauss_lobatto(max(3, fewer))
            line = np.stack([0 * at, y + 0 * at, foot + at * length], axis=1)
            areas = share * length * (total - lost)
            positions, areas, _ = _spread(line, areas, columns, column_weights)
            nodes.add_joint(
                name if len(pieces) == 1 else f"{name} part {number}",
                1 + shape.piece_at(foot + 0.5 * length),
                own[-1],
                positions,
                (0, 1, 0),
                areas,
                jkn_back,
                facade["shear_stiffness_ratio"] * jkn_back,
                beta_s=beta_s,
                friction_rad=math.radians(wall["friction_deg"]),
                gap_m=facade["gap_m"],
                tension_pa=wall["tension_mpa"] * 1e6 if kind.bonded else 0.0,
                cohesion_pa=wall["cohesion_mpa"] * 1e6 if kind.bonded else 0.0,
            )
    if hanging:
        return hanging.finish(own)
    if not kind.two_way:
        return []
    _, stiffness, damping = chain_matrices(config["smdof"], building_mass(config))
    return chain_links(stiffness, damping, own, 0, [blocks[i].centre_m[2] for i in own])
