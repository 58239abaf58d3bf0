"""Façade scenes: one rigid block on a compliant base against return walls.

Models by boundary condition (design words)::

    free  no return walls (two-sided rocking, 2SR)
    W1    one return-wall block up the height, driven with the base
    W2    one return-wall block per lumped mass of the chain, block j driven by floor j
    W1c, W2c  the same with cohesion and tensile strength on the back joint
    W2m, W2cm  as W2 and W2c, but each block is a mass of the chain, joined to the others by its
          springs and dashpots, and feels the façade; in the frame of the ground

A façade on a base above the ground moves with the chain there, by height; its base is driven, and
with W2m and W2cm carried by the masses below and above it, which feel what stands on it. A
free-standing façade has none of the walls, the chain of W2m and its base as they are.

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
from yade_scripts.model.base import BASE, base_jkn, shares, total
from yade_scripts.model.chain import yields
from yade_scripts.model.facades import Facade
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.floors import facade_floors, level_loads
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.hinges import hinge_stiffness, pieces
from yade_scripts.model.motion import along
from yade_scripts.model.panels import base_block, building_mass, hang_base
from yade_scripts.model.quadrature import MIDDLE, gauss_lobatto, over_columns
from yade_scripts.model.rest import at_rest, held_as_it_leans
from yade_scripts.model.return_walls import WALL, add_return_walls, back_jkn
from yade_scripts.model.scene import (
    DOFS,
    DRY,
    NO_DRAG,
    Block,
    Interface,
    NodeList,
    Scene,
    box_inertia,
    held,
)
from yade_scripts.model.shape import shape_of
from yade_scripts.model.statics import resting
from yade_scripts.model.storeys import sliders
from yade_scripts.model.thrusts import thrust_ties
from yade_scripts.model.ties import anchor_ties, facade_ties
from yade_scripts.model.wall_motion import motion_of

FACADE, UNDER = "façade", "ground"  # that under the masses, where the base hangs on them
NO_SHEAR = 1e-6  # jks/jkn of a joint that slides freely


def joint_stiffness(config):
    """Stiffness of base and back joint [Pa/m], paper section 3; see `base.shares`, `back_jkn`."""
    return base_jkn(config["facade"]), back_jkn(config)


def ground_block(facade, motion):
    """The base that a façade stands on, at rest or driven."""
    b = facade.thickness_m
    size = (2 * facade.width_m, 4 * facade.height_m, 1.0)
    still = (1.0, 1.0, 1.0)
    return Block(BASE, (0.0, 0.5 * b, -0.5), size, 1.0, still, free="", motion=motion)


def plain_block(facade, free, x_m=0.0, back_m=0.0):
    """A plain façade settled on its base, the middle of its back face at x and y."""
    h, b, width = facade.height_m, facade.thickness_m, facade.width_m
    mass = facade.density_kg_m3 * h * b * width
    sunk = mass * GRAVITY_M_S2 / (total(facade) * base_jkn(facade) * b * width)
    size = (width, b, h)
    return Block(
        FACADE,
        (x_m, back_m + 0.5 * b, 0.5 * h),
        size,
        mass,
        box_inertia(mass, size),
        free=free,
        displacement_m=(0.0, 0.0, -sunk),
    )


def facade_scene(
    config, model, beta_s, *, planar=True, release_ratio=0.0, width_nodes=5, two_components=False
):
    """Build the scene of a façade with one of the single-block boundary conditions.

    `config` has sections facade, return_wall, smdof, numerics. A scene is planar, or full with
    `width_nodes` columns along each pier of the base, its ends included; with `two_components` its
    supports are driven along x too, by the motions `motion.along`. A `release_ratio` θ₀/α is that
    of free rocking: the façade starts rotated outward about its front toe, at rest, with the base
    nodes around the toe carrying its weight.

    `thickness_m` of the scene is what the whole façade's top moves by as its weight line passes the
    toe, b for a plain one. d is measured from the base; of pieces it is the largest of any top.

    ValueError of one line for an unknown model, a release not within 0 ≤ θ₀/α < 1, what meets no
    return wall, two components with masses that are not driven, a base on a building without mass.
    """
    kind, facade = registry.model(model), Facade.of(config["facade"])
    config, shape = {**config, "facade": facade}, shape_of(facade)
    _refuse(model, kind, release_ratio)
    if two_components and (planar or kind.two_way or shape.hinges_m):
        raise ValueError(f"{model}: two components need a full scene, one block, driven supports")
    motions, hangs = dict[str, dict](), kind.two_way and bool(facade.base_height_m)
    blocks, nodes = [ground_block(facade, _base_motion(config, kind, motions))], NodeList()
    walls_stand = kind.walls != "none" and not facade.is_free
    columns = None if planar else _columns(shape.base_strips, width_nodes)
    base = 2 + len(shape.hinges_m) if hangs else 0
    beds = Beds(config, beta_s, nodes, planar=planar)
    _stand(beds, blocks, shape, columns, release_ratio, walls_stand, base)
    tops = _tops(blocks, shape)
    if hangs:
        blocks.append(base_block(config, blocks[0]))
        blocks[0] = replace(blocks[0], name=UNDER)
    walls, links, masses = [], [], []
    if walls_stand or hangs:
        walls, links, masses = add_return_walls(beds, kind, blocks, motions, shape, walls_stand)
        if hangs:
            hang_base(config, blocks, nodes, base, masses)
    if two_components:
        blocks = _along_the_facade(blocks, motions)
    pressing = level_loads(shape, blocks, walls, beds)
    behind = walls, blocks, shape
    floors, springs = facade_floors(facade.floors, *behind, config["smdof"]["damping_ratio"])
    even = _even(nodes.joints, tops) if facade.courses else []
    notes = {"motions": motions, "watched": tops, "even": even}
    scene = Scene(
        blocks,
        nodes.joints,
        _without_drag(nodes, even),
        monitor=blocks[1 + len(tops)].name,
        monitor_point_m=(0.0, 0.5 * sum(shape.storeys[-1][2:]), shape.top_m),
        reference=BASE,
        thickness_m=facade.thickness_m if facade.is_plain else shape.overturning_m,
        links=[*links, *springs],
        ties=held_as_it_leans(_ties(facade, *behind), facade),
        floors=held_as_it_leans(floors + pressing, facade) + _storeys(config, blocks, masses),
        shaking=GROUND if kind.two_way else None,
        notes={key: value for key, value in notes.items() if value},
    )
    return resting(scene) if shape.hinges_m else scene


def _refuse(model, kind, release_ratio):
    """ValueError of one line for a model of another assembly, or a release that is none."""
    if not kind.single_block:
        raise ValueError(f"façade model '{model}' has an assembly of its own")
    if not 0.0 <= release_ratio < 1.0:
        raise ValueError(f"release θ0/α must lie in [0, 1), got {release_ratio}")


def _tops(blocks, shape):
    """Name of each piece below the highest, and the middle of its top (x, y, z)."""
    middle = [(0.0, 0.5 * sum(shape.faces_at(z)), z) for z in shape.hinges_m]
    return [(blocks[k].name, point) for k, point in enumerate(middle, 1)]


def _ties(facade, walls, blocks, shape):
    """Ties, anchors of floors and thrusts of a façade."""
    behind = walls, blocks, shape
    ties = facade_ties(facade.ties, *behind) + anchor_ties(facade.floors, *behind)
    return ties + thrust_ties(facade.thrusts, *behind)


def _storeys(config, blocks, masses):
    """What yields between the masses of the chain, where these are part of the scene."""
    if not masses or not yields(config["smdof"]):
        return []
    heights = [blocks[i].centre_m[2] for i in masses]
    chain, whole_m = config["smdof"], config["facade"].building_top_m
    return sliders(chain, whole_m / chain["n_dof"], building_mass(config), masses, heights)


def _base_motion(config, kind, motions):
    """Motion of a driven base, by name: the ground's, further up the chain's by height; or None."""
    facade = config["facade"]
    if kind.two_way:
        return None
    if not facade.base_height_m:
        return GROUND
    whole, n = facade.building_top_m, config["smdof"]["n_dof"]
    return motion_of("interpolated", facade.base_height_m, whole, n, motions)


def _along_the_facade(blocks, motions):
    """Blocks whose supports are driven along x too; to `motions` mixed ones along x are added."""
    motions |= {
        along(name): {along(floor): share for floor, share in mix.items()}
        for name, mix in motions.items()
    }
    return [b if b.free else replace(b, motion_x=along(b.motion)) for b in blocks]


def _without_drag(nodes, even):
    """`Nodes` of a list, without dashpots along dry joints of these names."""
    columns = nodes.done()
    of_courses = np.isin(columns.joint, [nodes.joints.index(name) for name in even])
    columns.drag[of_courses & (columns.kind == DRY)] = NO_DRAG
    return columns


def _even(joints, tops):
    """Names of the joints between courses, under them and behind them, whose springs are even."""
    return [name for k, name in enumerate(joints) if k <= len(tops) or name.startswith(WALL)]


def _stand(beds, blocks, shape, columns, release_ratio, walls_stand, base):
    """Append the façade, whole or in pieces, and the joints that it stands on, on block `base`."""
    facade = beds.facade
    b, width = facade.thickness_m, facade.width_m
    # Debris under the base (tilt) belongs to the block as protruding nodes: it
    # rests rotated by φ about its front toe and cannot come back to the vertical.
    protrusion = (1.0 - beds.points) * b * math.tan(math.radians(facade.tilt_deg))
    beds.base(1, base, protrusion_m=protrusion, columns=columns)
    kn = shares(facade, beds.weights) * b * (width - shape.base_lost_m) * base_jkn(facade)
    displacement, rotation = at_rest(facade, shape, kn, beds.points, release_ratio, walls_stand)
    upright = Block(
        FACADE,
        shape.centre_m,
        shape.size_m,
        shape.mass_kg,
        tuple(np.diag(shape.tensor_kg_m2).tolist()),
        free="yzX" if columns is None else DOFS,
        displacement_m=displacement,
        rotation_rad=rotation,
        lever_m=shape.lever_m,
    )
    stiffness = hinge_stiffness(facade.e_mpa, shape)
    tilt = math.radians(facade.tilt_deg)
    cut = shape.hinges_m
    blocks += pieces(facade.floors, stiffness, shape, upright, tilt) if cut else [upright]
    for k, z in enumerate(shape.hinges_m, 1):
        beds.bed(f"hinge {k}", k + 1, k, z, float(stiffness[k - 1]), meets=shape.joint_at(z))


class Beds:
    """Level joints of a façade: its base, between its pieces, and under loads that lie on it."""

    def __init__(self, config, beta_s, nodes, *, planar):
        """Of a façade of this configuration; its joints are added to `nodes`."""
        self.config, self.planar = config, planar
        self.facade, self.beta_s, self.nodes = Facade.of(config["facade"]), beta_s, nodes
        self.points, self.weights = gauss_lobatto(config["numerics"]["nodes_thickness"])
        gauss = np.array([-0.5, 0.5]) * (self.facade.width_m / math.sqrt(3.0))
        self.columns = MIDDLE if planar else (gauss, np.array([0.5, 0.5]))  # x and weights

    def base(self, block, ground, *, origin=(0.0, 0.0), protrusion_m=0.0, columns=None):
        """Add the joint between the façade's base and the ground, blocks by their indices.

        `origin` is x of the façade's middle and y of its back face, `protrusion_m` how far each
        node across the thickness stands below the base; `columns` are other places in x and
        weights than those of the joints above it.
        """
        facade, points, weights = self.facade, self.points, self.weights
        b, standing = facade.thickness_m, facade.width_m - shape_of(facade).base_lost_m
        low = np.broadcast_to(protrusion_m, points.shape)
        line = np.stack([origin[0] + 0 * points, origin[1] + points * b, 0 * points - low], axis=1)
        columns = columns or self.columns
        places, areas = over_columns(line, weights * b * standing, columns)
        gaps = np.tile(-low, len(columns[0]))
        jkn = base_jkn(facade) * np.tile(shares(facade, weights) / weights, len(columns[0]))
        jks = facade.shear_stiffness_ratio * jkn
        held_by = {"beta_s": self.beta_s, **bond(facade), "gap_m": gaps}
        self.nodes.add_joint(
            BASE, block, ground, places, (0, 0, 1), areas, Interface(jkn, jks, **held_by)
        )

    def bed(self, name, upper, lower, height_m, jkn, *, load="", meets=None):
        """Add the joint at a height between two pieces, or between the façade and a load on it.

        A `load` lies "flat" on the whole thickness, or on a "point" in the middle of it, and
        transmits no shear. Else the joint has the base's friction and bond. `meets` are faces
        (y0, y1) and lost width, see `Shape.joint_at`; None: the whole thickness and width.
        """
        facade = self.facade
        y0, y1, lost = meets or (0.0, facade.thickness_m, 0.0)
        b, width = y1 - y0, facade.width_m - lost
        points, weights = self.points, self.weights
        if load == "point":
            points, weights = np.array([0.5]), np.array([1.0])
        line = np.stack([0 * points, y0 + points * b, height_m + 0 * points], axis=1)
        places, areas = over_columns(line, weights * b * width, self.columns)
        jks = (NO_SHEAR if load else facade.shear_stiffness_ratio) * jkn
        held_by = {"beta_s": self.beta_s, **(held(0.0, 0.0, 0.0) if load else bond(facade))}
        self.nodes.add_joint(
            name, upper, lower, places, (0, 0, 1), areas, Interface(jkn, jks, **held_by)
        )


def bond(facade):
    """What holds base and hinges of a façade, as `NodeList.add_joint` takes it."""
    tension, cohesion = facade.bond_tension_mpa, facade.bond_cohesion_mpa
    return held(tension * 1e6, cohesion * 1e6, math.radians(facade.friction_deg))


def _columns(strips, count):
    """Places in x and weights of so many columns along each strip (x0, x1), ends included."""
    points, weights = gauss_lobatto(count)
    whole = sum(b - a for a, b in strips)
    return (
        np.concatenate([a + points * (b - a) for a, b in strips]),
        np.concatenate([weights * (b - a) / whole for a, b in strips]),
    )
