"""The W1 cases of the accuracy study in Drake, for comparison.

Configured as its manual allows: the same contact nodes as spheres against half spaces, compliant
point contact in its convex (SAP) solver, whose linear dissipation has a relaxation time that is
β, and whose near-rigid limit is switched off so that the stated stiffness is kept. Its friction
has no shear spring. Its steps are implicit and may be longer than our critical one. The scene
is solved in the base's frame: an actuator along y carries −m a_g from a source inside the engine.
"""

import time

import numpy as np
from outside import AFTER_S, SAMPLE_S, Peak

NAME, PACKAGE = "Drake", "pydrake"
STEPS = (2.0, 1.0, 0.5)  # over the critical one of our own scheme
RADIUS_M = 1e-3
FACE_STIFFNESS = 1e20  # N/m: in series with the node's own


def _contact(stiffness_n_m, relaxation_s, friction):
    """Proximity properties of a node or a face."""
    from pydrake.geometry import AddContactMaterial, ProximityProperties
    from pydrake.multibody.plant import CoulombFriction

    properties = ProximityProperties()
    AddContactMaterial(None, stiffness_n_m, CoulombFriction(friction, friction), properties)
    properties.AddProperty("material", "relaxation_time", relaxation_s)
    return properties


def _add_contacts(plant, body, scene):
    """Half spaces of base and return walls, node spheres on the façade; pairs that may touch."""
    from pydrake.geometry import HalfSpace, Sphere
    from pydrake.math import RigidTransform

    centre = np.array(scene.blocks[scene.index(scene.monitor)].centre_m)
    nodes, pairs = scene.nodes, []
    for axis in (1, 2):
        mine = np.flatnonzero(nodes.normal[:, axis] > 0.5)
        if len(mine) == 0:
            continue
        face = plant.RegisterCollisionGeometry(
            plant.world_body(),
            HalfSpace.MakePose(np.eye(3)[axis], nodes.position_m[mine[0]]),
            HalfSpace(),
            f"face {axis}",
            _contact(FACE_STIFFNESS, 0.0, 1e6),
        )
        spheres = []
        for i in mine:
            friction = np.tan(nodes.friction_rad[i])
            at = nodes.position_m[i] - centre + RADIUS_M * nodes.normal[i]
            spheres.append(
                plant.RegisterCollisionGeometry(
                    body,
                    RigidTransform(at),
                    Sphere(RADIUS_M),
                    f"node {i}",
                    # two frictions combine as 2μ₁μ₂/(μ₁ + μ₂): half of it against a rough face
                    _contact(nodes.kn_n_m[i], nodes.beta_s[i], 0.5 * friction),
                )
            )
        pairs.append((face, spheres))
    return pairs


def build(scene, time_s, acceleration, dt_s):
    """Diagram, plant and body of a planar façade scene."""
    from pydrake.geometry import CollisionFilterDeclaration, GeometrySet
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, DiscreteContactApproximation
    from pydrake.multibody.tree import PrismaticJoint, RevoluteJoint, SpatialInertia, UnitInertia
    from pydrake.systems.framework import DiagramBuilder
    from pydrake.systems.primitives import TrajectorySource
    from pydrake.trajectories import PiecewisePolynomial

    block = scene.blocks[scene.index(scene.monitor)]
    builder = DiagramBuilder()
    plant, graph = AddMultibodyPlantSceneGraph(builder, dt_s)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.set_sap_near_rigid_threshold(0.0)
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -scene.gravity_m_s2])
    carriers = [plant.AddRigidBody(n, SpatialInertia.Zero()) for n in ("carrier y", "carrier z")]
    inertia = UnitInertia(*(np.array(block.inertia_kg_m2) / block.mass_kg))
    facade = plant.AddRigidBody("facade", SpatialInertia(block.mass_kg, np.zeros(3), inertia))
    slide = plant.AddJoint(
        PrismaticJoint("y", plant.world_frame(), carriers[0].body_frame(), [0, 1, 0])
    )
    lift = plant.AddJoint(
        PrismaticJoint("z", carriers[0].body_frame(), carriers[1].body_frame(), [0, 0, 1])
    )
    turn = plant.AddJoint(
        RevoluteJoint("turn", carriers[1].body_frame(), facade.body_frame(), [1, 0, 0])
    )
    plant.AddJointActuator("ground", slide)
    pairs = _add_contacts(plant, facade, scene)
    plant.Finalize()
    rules = CollisionFilterDeclaration()
    for face, _ in pairs:
        for other, spheres in pairs:
            if other != face:
                rules.ExcludeBetween(GeometrySet(face), GeometrySet(spheres))
    graph.collision_filter_manager().Apply(rules)
    force = -block.mass_kg * np.append(acceleration, [0.0, 0.0])
    end = time_s[-1] + (time_s[1] - time_s[0])
    times = np.append(time_s, [end, end + AFTER_S + 1.0])
    drive = builder.AddSystem(
        TrajectorySource(PiecewisePolynomial.FirstOrderHold(times, force[None, :]))
    )
    builder.Connect(drive.get_output_port(), plant.get_actuation_input_port())
    return builder.Build(), plant, (slide, lift, turn), block


def run_case(scene, time_s, acceleration, dt_s):
    """Peak of one history, simulated and wall time; see `outside.compare`."""
    from pydrake.systems.analysis import Simulator

    diagram, plant, (slide, lift, turn), block = build(scene, time_s, acceleration, dt_s)
    simulator = Simulator(diagram)
    state = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    slide.set_translation(state, block.centre_m[1] + block.displacement_m[1])
    lift.set_translation(state, block.centre_m[2] + block.displacement_m[2])
    simulator.Initialize()
    peak, t = Peak(scene), 0.0
    home = block.centre_m[1] + block.displacement_m[1]
    began = time.perf_counter()
    while t < time_s[-1] + AFTER_S:
        t += SAMPLE_S
        simulator.AdvanceTo(t)
        if peak.add(slide.get_translation(state) - home, turn.get_angle(state)):
            break
    return peak, t, time.perf_counter() - began
