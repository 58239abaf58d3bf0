"""The one place that turns a scene description into YADE bodies and engines.

YADE is imported as a library (`library`): neither its prompt nor its XML-RPC server
starts, so nothing listens on a port and no user session is needed. What blocks are
made of stands in `parts`; masks pair every node with its own face only (`faces`).
Nodes that never break are pairs of spheres (`welds`).
"""

from dataclasses import dataclass

from yade_scripts.engine import drives, loop
from yade_scripts.engine.attached import Attached
from yade_scripts.engine.bonds import Bonds
from yade_scripts.engine.faces import NODE_BITS, Faces
from yade_scripts.engine.floors import Floors
from yade_scripts.engine.guide import GUIDE_INTERVAL_S, Guide
from yade_scripts.engine.library import EngineError, load_yade
from yade_scripts.engine.links import Links
from yade_scripts.engine.parts import SceneParts
from yade_scripts.engine.releases import Releases
from yade_scripts.engine.ties import Ties
from yade_scripts.engine.welds import Welds
from yade_scripts.lists import listed
from yade_scripts.model.motion import SupportMotion
from yade_scripts.model.scene import DOFS

__all__ = ["Built", "EngineError", "SupportMotion", "build", "load_yade"]

# A node and a face so near are looked at in every step. A larger distance costs more of that than
# it spares of sorting, which YADE does anew once a body has moved so far.
BESIDE_M = 5e-3
SUPPORT_MASS_RATIO = 1e9  # support mass over the heaviest block: drive error below 1e-9


@dataclass
class Built:
    """Handles of a scene built in YADE, which are its ids.

    `body` has that of each block, the clump or the first face of a support; `node_body` of each
    node's sphere, the dry one of bonded nodes; `unturned`, by free block, the inverse of its
    clump's orientation in the reference position. `linked` has the parts of links by block, `ties`
    the two ends of each tie, `floors` each floor's spheres on the façade and on its carrier, or
    None. `bonds`, `guide` and `releases` follow bonded nodes, driven blocks and nodes past their
    rim, where there are any.
    """

    omega: object
    body: list
    node_body: list
    unturned: dict
    linked: dict
    links: list
    ties: list
    floors: list
    bonds: Bonds | None = None
    guide: Guide | None = None
    releases: Releases | None = None


def build(scene, motions, dt_s, *, node_radius_m=1e-3, full_rotation=False):
    """Reset YADE and build a scene in it, with a motion for each name in `scene.motions`.

    The caller has compared the step with the critical one. The face of a node stays at its position
    whatever the radius of the spheres. `full_rotation` integrates rotations of aspherical bodies
    exactly. EngineError if a motion is missing.
    """
    w = load_yade()
    from yade import utils

    missing = [name for name in scene.motions if name not in motions]
    if missing:
        raise EngineError(f"no motion given for {listed(missing)}")
    omega = w.Omega()
    loop.reset(omega)
    faces = Faces(scene)
    parts = SceneParts(w, utils, omega, scene, faces, node_radius_m)
    given = w, utils, omega, scene
    linked, tied, held, welded = Links(*given), Ties(*given), Floors(*given), Welds(*given)
    attached: list[Attached] = [linked, tied, held, welded]
    body, unturned, driven = _blocks(w, utils, scene, parts, attached, full_rotation)
    omega.dt = dt_s
    interactions = w.InteractionLoop(
        sum((kind.geometry for kind in attached), [w.Ig2_Box_Sphere_ScGeom()]),
        sum((kind.physics for kind in attached), [w.Ip2_ViscElMat_ViscElMat_ViscElPhys()]),
        sum((kind.law for kind in attached), [w.Law2_ScGeom_ViscElPhys_Basic()]),
    )
    weighing, gravity = _weight(w, scene, body)
    engines = [
        w.ForceResetter(),
        _collider(w, faces),
        interactions,
        *welded.drag,
        *_moving(w, omega, scene, motions, body, driven),
        *weighing,
        *held.loads(motions.get(scene.vertical)),
        w.NewtonIntegrator(damping=0.0, gravity=gravity, exactAsphericalRot=full_rotation),
    ]
    _place_members(w, omega)
    omega.engines, omega.dt = engines, dt_s
    for kind in attached:
        kind.join()
    built = Built(
        omega, body, parts.node_body, unturned, linked.members, scene.links, tied.pairs, held.pairs
    )
    _attach(scene, motions, built, parts.bonded, faces)
    return built


def _blocks(w, utils, scene, parts, attached, full_rotation):
    """Append all blocks; return `body` and `unturned` of `Built`, and bodies by motion and axis."""
    body: list[int] = []
    unturned: dict[int, object] = {}
    driven: dict[tuple, list[int]] = {}
    for index, block in enumerate(scene.blocks):
        if block.free:
            members = parts.members(index)
            for kind in attached:
                members += kind.members.get(index, [])
            clump, unturned[index] = parts.clump(block, members, full_rotation)
            body.append(clump)
            continue
        ids = _support(w, utils, scene, index, parts, attached)
        for axis, name in block.drives:
            driven.setdefault((name, axis), []).extend(ids)
        body.append(ids[0])
    return body, unturned, driven


def _support(w, utils, scene, index, parts, attached):
    """Append the bodies of a support; return their ids."""
    omega, block = w.Omega(), scene.blocks[index]
    linked, tied, held, _ = (kind.members.get(index, []) for kind in attached)
    ids = parts.faces_of(index)
    if block.motion is not None:
        ids += linked
    if not ids:
        ids = [omega.bodies.append(utils.box((0, 0, 0), (1, 1, 1), mask=0))]
    if len(ids) > 1 and block.drives:
        ids = [parts.joined(block, ids)]
    ids += tied + held
    freedoms = [DOFS[axis] for axis, _ in block.drives]
    heaviest = max([b.mass_kg for b in scene.blocks if b.free] or [1.0])
    for i in ids:
        state = omega.bodies[i].state
        state.mass = SUPPORT_MASS_RATIO * heaviest
        state.inertia = (state.mass,) * 3
        state.blockedDOFs = "".join(dof for dof in DOFS if dof not in freedoms)
    return ids


def _collider(w, faces):
    """Engine that finds what is near each other."""
    bounds = [w.Bo1_Sphere_Aabb(), w.Bo1_Box_Aabb()]
    collider = w.InsertionSortCollider(bounds, verletDist=BESIDE_M)
    if faces.box_bit:  # nodes of neighbouring blocks must not touch each other
        collider.avoidSelfInteractionMask = NODE_BITS
    return collider


def _moving(w, omega, scene, motions, body, driven):
    """Engines of the motions of supports and of the frames that the scene stands in."""
    engines = []
    for (name, axis), ids in sorted(driven.items()):
        motion = motions[name]
        engines.append(drives.force(w, motion, omega.bodies[ids[0]].state.mass, axis, ids))
        for i in ids:
            state = omega.bodies[i].state
            drives.set_back(state, axis, motion.acceleration_m_s2[0], omega.dt)
    for name, axis in ((scene.shaking, 1), (scene.vertical, 2)):
        if name:
            engines += drives.shake(w, scene, motions[name], body, omega, axis)
    return engines


def _weight(w, scene, body):
    """Engines for the weight of single blocks, needed where some are weightless; gravity of all."""
    free = [i for i, block in enumerate(scene.blocks) if block.free]
    if not any(scene.blocks[i].weightless for i in free):
        return [], (0, 0, -scene.gravity_m_s2)
    heavy = [i for i in free if not scene.blocks[i].weightless]
    force = [(0, 0, -scene.blocks[i].mass_kg * scene.gravity_m_s2) for i in heavy]
    engines = [w.ForceEngine(force=f, ids=[body[i]]) for i, f in zip(heavy, force, strict=True)]
    return engines, (0, 0, 0)


def _place_members(w, omega):
    """Bring the members of all clumps to their clump's pose, which only a step does.

    Without it the first contacts would be found in the reference position. A step of no length
    moves nothing else.
    """
    omega.engines = [w.ForceResetter(), w.NewtonIntegrator(damping=0.0)]
    omega.dt = 0.0
    omega.step()
    omega.resetTime()


def _attach(scene, motions, built, bonded, faces):
    """Add what moves guided blocks, breaks bonds and lets go of nodes, where the scene has any."""
    omega = built.omega
    guided = [i for i, block in enumerate(scene.blocks) if block.free and block.motion]
    if guided:
        period = max(1, round(GUIDE_INTERVAL_S / omega.dt))
        built.guide = Guide(scene, omega, built.body, guided, motions, period)
        loop.between(built.guide, period)
    if bonded:
        plain = {i: faces.plain[i] for i in bonded}
        partners = {i: (faces.body[key], faces.bit[key]) for i, key in plain.items()}
        built.bonds = Bonds(scene, omega, built.body, bonded, partners)
        built.bonds.visit = loop.between(built.bonds, 1, first=1)
    if scene.notes.get("rims"):
        built.releases = Releases(scene, omega, built.body, built.node_body, built.bonds)
        period = built.releases.period
        built.releases.visit = loop.between(built.releases, period, first=1 + period)
