"""The one place that turns a scene description into YADE bodies and engines.

YADE is imported as a library: neither its prompt nor its XML-RPC server starts,
so nothing listens on a port and no user session is needed. Each contact node is
a small sphere of the block that carries it, against a box that stands for the
opposite block's face. The spheres weigh nothing; mass and inertia sit on the
clump. Masks pair every node with its own face only. Bonded nodes are explained
in `bonds`.
"""

import glob
import io
import math
import os
import sys
from dataclasses import dataclass

import numpy as np

from yade_scripts.engine import links, loop
from yade_scripts.engine.bonds import PRELOAD_M, Bonds, is_tie
from yade_scripts.engine.faces import RELEASE_CHECK_S, FaceError, Faces, Releases
from yade_scripts.engine.guide import GUIDE_INTERVAL_S, Guide
from yade_scripts.model.motion import Motion

__all__ = ["Built", "EngineError", "FaceError", "Motion", "build", "load_yade"]

SUPPORT_MASS_RATIO = 1e9  # support mass over the heaviest block: drive error below 1e-9
LEAST_BETA_S = 1e-15  # a dashpot of exactly 0 in series with the face would become the face's
PARTNER_STIFFNESS = 1e30  # materials combine in series; the face must not soften the node
UNLIMITED_FRICTION = 1.57  # rad
NEEDED_CLASSES = (
    "Box",
    "Sphere",
    "ViscElMat",
    "Ip2_ViscElMat_ViscElMat_ViscElPhys",
    "Ig2_Box_Sphere_ScGeom",
    "Law2_ScGeom_ViscElPhys_Basic",
    "InterpolatingDirectedForceEngine",
    "NewtonIntegrator",
    "InsertionSortCollider",
    "PyRunner",
)


class EngineError(RuntimeError):
    """YADE is absent, lacks a class, or a scene cannot be turned into it."""


def load_yade():
    """Import YADE's library without its prompt and return its wrapper module.

    Looks below YADE_PREFIX (default /usr) for the double-precision build.

    Raises
    ------
    EngineError
        One line when YADE is not installed or lacks a needed class.
    """
    if "yade.wrapper" not in sys.modules:
        prefix = os.environ.get("YADE_PREFIX", "/usr")
        found = sorted(glob.glob(f"{prefix}/lib/*/yade*/py/yade/__init__.py"))
        plain = [p for p in found if "/yade-double/" in p or "/yade/py/" in p]
        if not plain:
            raise EngineError(
                f"YADE not found below {prefix}/lib: install Debian's package 'yade' "
                "or set YADE_PREFIX"
            )
        sys.path.insert(1, os.path.dirname(os.path.dirname(plain[0])))
        os.environ["OMP_NUM_THREADS"] = "1"
        # The library greets on standard output, which belongs to our own results.
        stdout, sys.stdout = sys.stdout, io.StringIO()
        try:
            import yade  # noqa: F401
        except ImportError as error:
            raise EngineError(f"YADE's library does not load in this Python: {error}") from error
        finally:
            sys.stdout.close()
            sys.stdout = stdout
    import yade.wrapper as wrapper

    missing = [name for name in NEEDED_CLASSES if not hasattr(wrapper, name)]
    if missing:
        raise EngineError(f"this YADE lacks the class(es) {', '.join(missing)}")
    return wrapper


@dataclass
class Built:
    """Handles of a scene built in YADE.

    Attributes
    ----------
    body : list of int
        YADE id of each block: the clump, or the first face of a support.
    node_body : list of int
        YADE id of each node's sphere (the dry one, for bonded nodes).
    unturned : dict of int to quaternion
        By free block, the inverse of its clump's orientation in the reference position.
    bonds : bonds.Bonds or None
        Follows the bonded nodes, if there are any.
    guide : guide.Guide or None
        Moves the blocks that are driven along y but free otherwise, if there are any.
    releases : faces.Releases or None
        Lets go of nodes that have slid past their rim, if faces have rims.
    linked : dict of int to list of int
        YADE ids of the parts of links, by block.
    links : list of Link
        As built.
    """

    omega: object
    body: list
    node_body: list
    unturned: dict
    bonds: Bonds | None = None
    guide: Guide | None = None
    releases: Releases | None = None
    linked: dict | None = None
    links: list | None = None


def build(scene, motions, dt_s, *, node_radius_m=1e-3, full_rotation=False):
    """Reset YADE and build a scene in it.

    Parameters
    ----------
    scene : Scene
    motions : dict of str to Motion
        One for each name in `scene.motions`.
    dt_s : float
        Time step; the caller has compared it with the critical one.
    node_radius_m : float
        Radius of the node spheres; the face stays at the stated position whatever it is.
    full_rotation : bool
        Integrate rotations of aspherical bodies exactly (three-dimensional runs).

    Returns
    -------
    Built

    Raises
    ------
    EngineError
        If a motion is missing or the scene needs more faces than YADE has masks.
    """
    w = load_yade()
    from yade import utils

    missing = [name for name in scene.motions if name not in motions]
    if missing:
        raise EngineError(f"no motion given for {', '.join(missing)}")
    omega = w.Omega()
    loop.reset(omega)
    faces = Faces(scene)
    nodes = scene.nodes
    reach = 4.0 * max(max(b.size_m) for b in scene.blocks)
    rigid = w.ViscElMat(
        density=1e-12,
        kn=PARTNER_STIFFNESS,
        ks=PARTNER_STIFFNESS,
        cn=PARTNER_STIFFNESS,
        cs=PARTNER_STIFFNESS,
        frictionAngle=UNLIMITED_FRICTION,
    )
    omega.materials.append(rigid)
    materials = {}

    def node_material(i):
        key = tuple(
            float(v[i]) for v in (nodes.kn_n_m, nodes.ks_n_m, nodes.beta_s, nodes.friction_rad)
        )
        return viscoelastic(key)

    def bond_material(i):  # half a node; the shear of a tie slips freely
        angle = 0.0 if is_tie(nodes, i) else UNLIMITED_FRICTION
        return viscoelastic(
            (
                float(0.5 * nodes.kn_n_m[i]),
                float(0.5 * nodes.ks_n_m[i]),
                float(nodes.beta_s[i]),
                angle,
            )
        )

    def viscoelastic(key):
        if key not in materials:
            kn, ks, beta, friction = key
            beta = max(beta, LEAST_BETA_S)
            materials[key] = w.ViscElMat(
                density=1e-12, kn=kn, ks=ks, cn=beta * kn, cs=beta * ks, frictionAngle=friction
            )
            omega.materials.append(materials[key])
        return materials[key]

    body: list[int] = []
    node_body = [-1] * len(nodes)
    drives: dict[str, list[int]] = {}
    bonded: dict[int, tuple] = {}
    unturned: dict[int, object] = {}
    linked = links.place(w, utils, omega, scene)
    heaviest = max([b.mass_kg for b in scene.blocks if b.free] or [1.0])
    for index, block in enumerate(scene.blocks):
        keys = faces.of_block(index)
        if not block.free:
            ids = [faces.append(omega, key, reach, rigid) for key in keys]
            if not ids:
                ids = [omega.bodies.append(utils.box((0, 0, 0), (1, 1, 1), mask=0))]
            if len(ids) > 1 and block.motion is not None:
                ids = [_joined(utils, omega, block, ids, rigid)]
            for i in ids:
                state = omega.bodies[i].state
                state.mass = SUPPORT_MASS_RATIO * heaviest
                state.inertia = (state.mass,) * 3
                state.blockedDOFs = "xyzXYZ" if block.motion is None else "xzXYZ"
            if block.motion is not None:
                drives.setdefault(block.motion, []).extend(ids)
            body.append(ids[0])
            continue
        members = _members(
            utils,
            omega,
            scene,
            index,
            faces,
            keys,
            reach,
            rigid,
            node_material,
            bond_material,
            node_radius_m,
            node_body,
            bonded,
        )
        members += linked.get(index, [])
        clump, unturned[index] = _clump(omega, block, members, full_rotation)
        body.append(clump)

    engines = [
        w.ForceResetter(),
        w.InsertionSortCollider([w.Bo1_Sphere_Aabb(), w.Bo1_Box_Aabb()], verletDist=0.05),
        w.InteractionLoop(
            [w.Ig2_Box_Sphere_ScGeom()],
            [w.Ip2_ViscElMat_ViscElMat_ViscElPhys()],
            [w.Law2_ScGeom_ViscElPhys_Basic()],
        ),
    ]
    for name, ids in sorted(drives.items()):
        motion = motions[name]
        mass = omega.bodies[ids[0]].state.mass
        engines.append(
            w.InterpolatingDirectedForceEngine(
                times=motion.time_s.tolist(),
                magnitudes=(mass * motion.acceleration_m_s2).tolist(),
                direction=(0, 1, 0),
                ids=ids,
                wrap=False,
            )
        )
        for i in ids:  # velocities live at half steps: start half a step back
            omega.bodies[i].state.vel = (0, -0.5 * dt_s * float(motion.acceleration_m_s2[0]), 0)
    omega.dt = dt_s
    if scene.shaking:
        engines += links.shake(w, scene, motions[scene.shaking], body, omega)
    engines.append(
        w.NewtonIntegrator(
            damping=0.0, gravity=(0, 0, -scene.gravity_m_s2), exactAsphericalRot=full_rotation
        )
    )
    _place_members(w, omega)
    omega.engines, omega.dt = engines, dt_s
    built = Built(omega, body, node_body, unturned, linked=linked, links=scene.links)
    _attach(scene, motions, built, bonded, faces)
    return built


def _place_members(w, omega):
    """Bring the members of all clumps to their clump's pose, which only a step does.

    Without it the first contacts would be found in the reference position. A step of
    no length moves nothing else.
    """
    omega.engines = [w.ForceResetter(), w.NewtonIntegrator(damping=0.0)]
    omega.dt = 0.0
    omega.step()
    omega.resetTime()


def planar_turn(state, unturned):
    """Rotation of a free block about x since the reference position [rad], for planar motion.

    Parameters
    ----------
    state : State
        YADE's state of the block.
    unturned : quaternion
        Of the block, from `Built.unturned`.
    """
    q = state.ori * unturned
    sign = 1.0 if q[3] >= 0.0 else -1.0  # q and −q are the same rotation
    return 2.0 * math.atan2(sign * q[0], sign * q[3])


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
        period = round(RELEASE_CHECK_S / omega.dt)
        loop.between(built.releases, period, first=1 + period)


def _joined(utils, omega, block, faces, rigid):
    """Clump the faces of a driven support, so that preloads between them stay inside it."""
    carrier = omega.bodies.append(
        utils.box(tuple(block.centre_m), (0.1, 0.1, 0.1), fixed=False, mask=0, material=rigid)
    )
    state = omega.bodies[carrier].state
    state.mass, state.inertia = 1.0, (1.0, 2.0, 3.0)  # see _members
    for face in faces:
        member = omega.bodies[face].state
        member.mass, member.inertia = 0.0, (0.0, 0.0, 0.0)
    return omega.bodies.clump([carrier, *faces])


def _members(
    utils,
    omega,
    scene,
    index,
    faces,
    keys,
    reach,
    rigid,
    node_material,
    bond_material,
    radius_m,
    node_body,
    bonded,
):
    """Append carrier, node spheres and faces of a free block; return their ids."""
    block, nodes = scene.blocks[index], scene.nodes
    centre = np.array(block.centre_m)
    carrier = utils.box(
        center=tuple(centre),
        extents=tuple(0.5 * s for s in block.size_m),
        fixed=False,
        wire=True,
        material=rigid,
        mask=0,
    )
    ids = [omega.bodies.append(carrier)]
    state = omega.bodies[ids[0]].state
    state.mass = block.mass_kg
    # A clump's frame is its principal frame, axes in the order of the moments.
    # Ascending stand-in moments keep that frame on x, y, z; the real ones follow.
    state.inertia = (1.0, 2.0, 3.0)
    for i in np.flatnonzero(nodes.a == index):
        position = nodes.position_m[i] + radius_m * nodes.normal[i]
        is_bonded = faces.press[i] is not None
        sphere = utils.sphere(
            tuple(position),
            radius_m,
            material=node_material(i),
            mask=0 if is_bonded else faces.bit[faces.plain[i]],
        )
        node_body[i] = omega.bodies.append(sphere)
        new = [node_body[i]]
        if is_bonded:
            halves = [
                omega.bodies.append(
                    utils.sphere(
                        tuple(nodes.position_m[i]),
                        PRELOAD_M,
                        material=bond_material(i),
                        mask=faces.bit[key],
                    )
                )
                for key in (faces.press[i], faces.hook[i])
            ]
            bonded[int(i)] = (*halves, node_body[i])
            new += halves
        for member_id in new:
            member = omega.bodies[member_id].state
            member.mass, member.inertia = 0.0, (0.0, 0.0, 0.0)
        ids.extend(new)
    for key in keys:
        i = faces.append(omega, key, reach, rigid)
        member = omega.bodies[i].state
        member.mass, member.inertia = 0.0, (0.0, 0.0, 0.0)
        ids.append(i)
    return ids


def _clump(omega, block, members, full_rotation):
    """Join members to a clump with the block's mass, freedoms and initial pose.

    Returns its id and the inverse of its frame: YADE may start a clump turned by 180°.
    """
    from yade import minieigenHP

    clump = omega.bodies.clump(members)
    state = omega.bodies[clump].state
    frame = np.array([list(row) for row in state.ori.toRotationMatrix()])
    if not np.allclose(np.abs(np.diag(frame)), 1.0, atol=1e-9):
        raise EngineError(f"YADE turned the frame of block '{block.name}'")
    unturned = state.ori.inverse()
    state.mass = block.mass_kg
    state.inertia = tuple(block.inertia_kg_m2)
    state.blockedDOFs = "".join(d for d in "xyzXYZ" if d not in block.free)
    omega.bodies[clump].aspherical = full_rotation
    rotation = np.array(block.rotation_rad)
    angle = float(np.linalg.norm(rotation))
    state.pos = tuple(np.array(block.centre_m) + np.array(block.displacement_m))
    if angle > 0.0:
        turn = minieigenHP.Quaternion(minieigenHP.Vector3(*(rotation / angle)), angle)
        state.ori = turn * state.ori
    state.vel = tuple(block.velocity_m_s)
    state.angVel = tuple(block.angular_velocity_rad_s)
    return clump, unturned
