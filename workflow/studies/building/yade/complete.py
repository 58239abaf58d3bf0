"""The complete building: a brick building, and before it a façade that rocks against its walls.

The crack runs along the inner face of the front façade. Behind it everything is the brick model
with its linear joints, side walls that now end at the crack in every course, floors and the rear
façade; nothing drives it but the ground. Before it stands the façade of the other models, one
rigid block on a compliant base, so that nothing differs from W2m but what it rocks against. Where
the bricks of the side walls end, Gauss points up each course touch its back: unilateral and dry
(CB), or with tension and cohesion from the start (CBc). (Nodes on the edges would be shared by two
bricks, and pivots lie on no brick's edge here but on the base, whose nodes are Gauss–Lobatto's.)

The scene stands in the frame of the ground. The bricks are weightless: their joints are linear, so
their dead load adds a static answer and no more. The plan need not be symmetric, and the study's
is not, so the whole building is modelled and the façade moves in space.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from yade_scripts.model.building.plan import TOLERANCE_M, PlanError, PlanWall, shortened
from yade_scripts.model.facade import FACADE, Beds, plain_block
from yade_scripts.model.facades import Facade
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.return_walls import back_jkn, back_strength
from yade_scripts.model.scene import DOFS, Interface, NodeList, Scene


def front_wall(plan):
    """Return the façade wall along x that lies farthest outward; PlanError if the plan has none."""
    facades = [wall for wall in plan.walls if wall.facade and wall.axis == 0]
    if not facades:
        raise PlanError(f"plan '{plan.name}': expected a wall along x with facade: true")
    return max(facades, key=lambda wall: wall.offset_m)


def behind(plan):
    """Return the plan without its front façade, and y of the crack [m].

    Walls along y that reached into the façade end at its inner face. PlanError if there is no
    façade, or no wall meets it.
    """
    front = front_wall(plan)
    crack = front.offset_m - 0.5 * front.thickness_m
    walls: list[PlanWall] = []
    met = False
    for wall in plan.walls:
        if wall is front:
            continue
        end = wall.origin_m + wall.length_m
        if wall.axis == 1 and end >= crack - TOLERANCE_M:
            met = True
            wall = shortened(wall, wall.origin_m, crack)
            _refuse_across(wall)
        walls.append(wall)
    if not met:
        raise PlanError(f"plan '{plan.name}': no wall along y meets the façade '{front.name}'")
    return replace(plan, walls=tuple(walls)), crack


def _refuse_across(wall):
    """Refuse a wall that was cut through one of its openings."""
    for opening in wall.openings:
        if opening.from_start_m < -TOLERANCE_M or opening.end_m > wall.length_m + TOLERANCE_M:
            raise PlanError(f"wall '{wall.name}', opening '{opening.name}' lies across the crack")


def complete_scene(config, building, crack_m, beta_s, *, bonded, masonry, rate_1_s):
    """Scene of the complete building; its notes tell the mass behind the crack [kg].

    The `building` is what `behind` left, built, and has a mass-proportional damping of `rate_1_s`;
    `masonry` is the real brick, and the joints that are stated for it. β is that of the façade's
    base and back face; `bonded`, the back joint starts with the strengths of section return_wall.
    The back joint's jkn is that of the half brick there, 2E/s: what yields is the bricks alone. The
    dashpots are β·E/L, for that is the stiffness whose β is calibrated. ValueError if no brick ends
    at the crack behind the façade.
    """
    front = Facade.of(config["facade"])
    front.refuse("the complete building", held=True)
    h, b, width = front.height_m, front.thickness_m, front.width_m
    bricks, base = building.bricks, with_rigid_floors(building)
    ends = np.flatnonzero(np.abs(bricks.high_m[:, 1] - crack_m) < TOLERANCE_M)
    blocks = [
        replace(block, weightless=True, drag_1_s=rate_1_s) if block.free else block
        for block in base.blocks
    ]
    ground = len(blocks) - 1
    blocks[ground] = replace(blocks[ground], motion=None)
    if not len(ends):
        raise ValueError("the complete building: no brick ends at the crack")
    middle = 0.5 * float(bricks.low_m[ends, 0].min() + bricks.high_m[ends, 0].max())
    facade = len(blocks)
    back = crack_m + front.gap_m
    blocks.append(plain_block(front, DOFS, middle, back))
    nodes = NodeList(scene=base)
    Beds(config, beta_s, nodes, planar=False).base(facade, ground, origin=(middle, back))
    brick, joints = masonry
    back_joints = _BackJoints(
        nodes,
        config,
        facade,
        (middle - 0.5 * width, middle + 0.5 * width, crack_m),
        beta_s,
        bonded,
        joints.moduli(brick)[0],  # of the head joints
    )
    before = len(nodes.joints)
    for i in ends:
        back_joints.touch(bricks, int(i))
    if len(nodes.joints) == before:
        raise ValueError("the complete building: no brick ends at the crack behind the façade")
    return Scene(
        blocks,
        nodes.joints,
        nodes.done(),
        monitor=FACADE,
        monitor_point_m=(middle, back + 0.5 * b, h),
        reference=blocks[ground].name,
        thickness_m=b,
        shaking=GROUND,
        notes={**base.notes, "mass_behind_kg": building.mass_kg, "top": base.monitor},
    )


@dataclass(frozen=True)
class _BackJoints:
    """The joints of a façade, a block by its index, with the bricks that end behind it.

    `face` is x of the façade's edges and y of the crack [m]; `moduli` those of the half brick
    behind a joint, normal and shear [Pa].
    """

    nodes: NodeList
    config: Mapping
    facade: int
    face: tuple
    beta_s: float
    bonded: bool
    moduli: tuple

    def touch(self, bricks, brick):
        """Add the joint of one brick that ends at the crack, if it ends behind the façade."""
        front, config = Facade.of(self.config["facade"]), self.config
        (x0, y0, z0), (x1, _, z1) = bricks.low_m[brick], bricks.high_m[brick]
        left_m, right_m, crack_m = self.face
        z1 = min(z1, front.height_m)
        x0, x1 = max(x0, left_m), min(x1, right_m)
        if z1 - z0 <= TOLERANCE_M or x1 - x0 <= TOLERANCE_M:
            return
        points, weights = np.polynomial.legendre.leggauss(config["complete"]["nodes_per_course"])
        points, weights = 0.5 + 0.5 * points, 0.5 * weights
        line = np.stack(
            [0 * points + 0.5 * (x0 + x1), 0 * points + crack_m, z0 + points * (z1 - z0)], axis=1
        )
        jkn, jks = (2.0 * e / (crack_m - y0) for e in self.moduli)
        self.nodes.add_joint(
            bricks.name(brick),
            brick,
            self.facade,
            line,
            (0, -1, 0),
            weights * (z1 - z0) * (x1 - x0),
            Interface(
                jkn,
                jks,
                beta_s=self.beta_s * back_jkn(config) / jkn,
                gap_m=front.gap_m,
                **back_strength(config["return_wall"], self.bonded),
            ),
        )


def with_rigid_floors(building):
    """Return a building's scene with the beams and the panel of each floor as one rigid block.

    Bricks come first in the scene, the ground last. Beams are light and their joints with the panel
    stiff, so alone they would halve the critical step; the first periods change by 0.1 %.
    """
    scene = building.scene
    blocks, index = list(scene.blocks), np.arange(len(scene.blocks))
    gone: set[int] = set()
    for first, count, _ in building.floors:
        parts, panel = range(first, first + count + 1), first + count
        mass = np.array([blocks[i].mass_kg for i in parts])
        centres = np.array([blocks[i].centre_m for i in parts])
        centre = mass @ centres / mass.sum()
        arm = centres - centre
        about_centres = np.array([blocks[i].inertia_kg_m2 for i in parts]).sum(axis=0)
        inertia = about_centres + mass @ ((arm**2).sum(axis=1)[:, None] - arm**2)
        blocks[panel] = replace(
            blocks[panel],
            centre_m=tuple(centre.tolist()),
            mass_kg=float(mass.sum()),
            inertia_kg_m2=tuple(inertia.tolist()),
        )
        gone.update(parts[:-1])
        index[list(parts)] = panel
    kept = np.array([i for i in range(len(blocks)) if i not in gone])
    place = np.full(len(blocks), -1)
    place[kept] = np.arange(len(kept))
    nodes = scene.nodes
    a, b = place[index[nodes.a]], place[index[nodes.b]]
    between = a != b
    nodes = nodes.select(between, a=a[between], b=b[between])
    return replace(scene, blocks=[blocks[i] for i in kept], nodes=nodes)


def apart(scene):
    """Return the scene without the nodes between façade and building: each stands alone."""
    facade = scene.index(scene.monitor)
    return replace(scene, nodes=scene.nodes.select(scene.nodes.b != facade))
