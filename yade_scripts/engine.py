"""The one place that turns a scene description into YADE bodies and engines.

YADE is imported as a library: neither its prompt nor its XML-RPC server starts,
so nothing listens on a port and no user session is needed. Each contact node is
a small sphere of the block that carries it, against a box that stands for the
opposite block's face. The spheres weigh nothing; mass and inertia sit on the
clump. Masks pair every node with its own face only.
"""

import glob
import os
import sys
from dataclasses import dataclass

import numpy as np

SUPPORT_MASS_RATIO = 1e9  # support mass over the heaviest block: drive error below 1e-9
PARTNER_STIFFNESS = 1e30  # materials combine in series; the face must not soften the node
NEEDED_CLASSES = (
    "Box", "Sphere", "ViscElMat", "Ip2_ViscElMat_ViscElMat_ViscElPhys", "Ig2_Box_Sphere_ScGeom",
    "Law2_ScGeom_ViscElPhys_Basic", "InterpolatingDirectedForceEngine", "NewtonIntegrator",
    "InsertionSortCollider", "PyRunner",
)  # fmt: skip


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
        stdout, sys.stdout = sys.stdout, open(os.devnull, "w")
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
class Motion:
    """A support's prescribed acceleration along y, linear between samples.

    Attributes
    ----------
    time_s, acceleration_m_s2 : ndarray, shape (n,)
    """

    time_s: np.ndarray
    acceleration_m_s2: np.ndarray

    @property
    def duration_s(self):
        """Time of the last sample [s]."""
        return float(self.time_s[-1])

    def peak_speed(self):
        """Largest |velocity| of the integrated motion [m/s]."""
        steps = np.diff(self.time_s) * 0.5
        a = self.acceleration_m_s2
        return float(np.max(np.abs(np.concatenate(([0.0], np.cumsum(steps * (a[1:] + a[:-1])))))))


@dataclass
class Built:
    """Handles of a scene built in YADE.

    Attributes
    ----------
    body : list of int
        YADE id of each block: the clump, or the first face of a support.
    node_body : list of int
        YADE id of each node's sphere.
    """

    omega: object
    body: list
    node_body: list


def _rotation_matrix(vector):
    """Rotation matrix of a rotation vector, shape (3, 3) (Rodrigues' formula)."""
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = np.asarray(vector) / angle
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * (k @ k)


class _Faces:
    """Groups nodes by the face (block, normal, plane) they touch; one mask bit a face."""

    def __init__(self, scene):
        nodes = scene.nodes
        self.key_of_node, self.planes = [], {}
        for i in range(len(nodes)):
            normal = nodes.normal[i]
            level = float(normal @ nodes.position_m[i] - nodes.gap_m[i])
            key = (int(nodes.b[i]), tuple(np.round(normal, 12)), round(level, 9))
            self.planes.setdefault(key, []).append(i)
            self.key_of_node.append(key)
        self.bit = {key: 1 << n for n, key in enumerate(self.planes)}
        if len(self.bit) > 30:
            raise EngineError(f"{len(self.bit)} contact faces, but YADE's masks hold 30")

    def box(self, scene, key, reach_m, material):
        """Return the YADE box whose surface is the face `key`, in the reference position."""
        _, normal, level = key
        normal = np.array(normal)
        middle = np.mean(scene.nodes.position_m[self.planes[key]], axis=0)
        on_face = middle + (level - normal @ middle) * normal
        # Oversized on purpose: masks decide who touches it, and a node at the rim
        # of the real face must meet a flat face, not the edge of a box.
        centre = on_face - reach_m * normal
        from yade import minieigenHP, utils

        axis_to = minieigenHP.Quaternion()
        axis_to.setFromTwoVectors(minieigenHP.Vector3(0, 0, 1), minieigenHP.Vector3(*normal))
        return utils.box(
            center=tuple(centre), extents=(reach_m, reach_m, reach_m), orientation=axis_to,
            fixed=False, wire=True, material=material, mask=self.bit[key],
        )  # fmt: skip


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
    omega.reset()
    faces = _Faces(scene)
    nodes = scene.nodes
    reach = 4.0 * max(max(b.size_m) for b in scene.blocks)
    rigid = w.ViscElMat(
        density=1e-12, kn=PARTNER_STIFFNESS, ks=PARTNER_STIFFNESS,
        cn=PARTNER_STIFFNESS, cs=PARTNER_STIFFNESS, frictionAngle=1.57,
    )  # fmt: skip
    omega.materials.append(rigid)
    materials = {}

    def node_material(i):
        key = tuple(float(v[i]) for v in (nodes.kn_n_m, nodes.ks_n_m, nodes.beta_s,
                                          nodes.friction_rad))  # fmt: skip
        if key not in materials:
            kn, ks, beta, friction = key
            materials[key] = w.ViscElMat(
                density=1e-12, kn=kn, ks=ks, cn=beta * kn, cs=beta * ks, frictionAngle=friction
            )
            omega.materials.append(materials[key])
        return materials[key]

    body, node_body, drives = [], [-1] * len(nodes), {}
    heaviest = max([b.mass_kg for b in scene.blocks if b.free] or [1.0])
    for index, block in enumerate(scene.blocks):
        keys = [key for key in faces.planes if key[0] == index]
        if not block.free:
            ids = [omega.bodies.append(faces.box(scene, key, reach, rigid)) for key in keys]
            if not ids:
                ids = [omega.bodies.append(utils.box((0, 0, 0), (1, 1, 1), mask=0))]
            for i in ids:
                state = omega.bodies[i].state
                state.mass = SUPPORT_MASS_RATIO * heaviest
                state.inertia = (state.mass,) * 3
                state.blockedDOFs = "xyzXYZ" if block.motion is None else "xzXYZ"
            if block.motion is not None:
                drives.setdefault(block.motion, []).extend(ids)
            body.append(ids[0])
            continue
        members = _members(utils, omega, scene, index, faces, keys, reach, rigid,
                           node_material, node_radius_m, node_body)  # fmt: skip
        body.append(_clump(omega, block, members, full_rotation))

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
                times=[float(t) for t in motion.time_s],
                magnitudes=[float(mass * a) for a in motion.acceleration_m_s2],
                direction=(0, 1, 0),
                ids=ids,
                wrap=False,
            )  # fmt: skip
        )
        for i in ids:  # velocities live at half steps: start half a step back
            omega.bodies[i].state.vel = (0, -0.5 * dt_s * float(motion.acceleration_m_s2[0]), 0)
    engines.append(
        w.NewtonIntegrator(
            damping=0.0, gravity=(0, 0, -scene.gravity_m_s2), exactAsphericalRot=full_rotation
        )
    )
    omega.engines = engines
    omega.dt = dt_s
    return Built(omega, body, node_body)


def _members(utils, omega, scene, index, faces, keys, reach, rigid, node_material,
             radius_m, node_body):  # fmt: skip
    """Append carrier, node spheres and faces of a free block; return their ids."""
    block, nodes = scene.blocks[index], scene.nodes
    centre = np.array(block.centre_m)
    carrier = utils.box(
        center=tuple(centre), extents=tuple(0.5 * s for s in block.size_m),
        fixed=False, wire=True, material=rigid, mask=0,
    )  # fmt: skip
    ids = [omega.bodies.append(carrier)]
    state = omega.bodies[ids[0]].state
    state.mass = block.mass_kg
    # A clump's frame is its principal frame, axes in the order of the moments.
    # Ascending stand-in moments keep that frame on x, y, z; the real ones follow.
    state.inertia = (1.0, 2.0, 3.0)
    for i in np.flatnonzero(nodes.a == index):
        position = nodes.position_m[i] + radius_m * nodes.normal[i]
        sphere = utils.sphere(
            tuple(position), radius_m, material=node_material(i),
            mask=faces.bit[faces.key_of_node[i]],
        )  # fmt: skip
        node_body[i] = omega.bodies.append(sphere)
        member = omega.bodies[node_body[i]].state
        member.mass, member.inertia = 0.0, (0.0, 0.0, 0.0)
        ids.append(node_body[i])
    for key in keys:
        i = omega.bodies.append(faces.box(scene, key, reach, rigid))
        member = omega.bodies[i].state
        member.mass, member.inertia = 0.0, (0.0, 0.0, 0.0)
        ids.append(i)
    return ids


def _clump(omega, block, members, full_rotation):
    """Join members to a clump with the block's mass, freedoms and initial pose; return its id."""
    from yade import minieigenHP

    clump = omega.bodies.clump(members)
    state = omega.bodies[clump].state
    frame = np.array([list(row) for row in state.ori.toRotationMatrix()])
    if not np.allclose(np.abs(np.diag(frame)), 1.0, atol=1e-9):
        raise EngineError(f"YADE turned the frame of block '{block.name}'")
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
    return clump
