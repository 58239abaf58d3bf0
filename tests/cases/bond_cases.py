"""Bonded nodes in YADE against hand calculations, on a block without weight.

A block is joined to a fixed support; a guide moves it slowly and the force is read
from YADE. Strengths and stiffness are round numbers, so the closed forms are exact.
"""

from dataclasses import replace

import numpy as np

from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.scene import Block, Interface, NodeList, Scene, box_inertia, held

JKN, JKS = 5.0e8, 2.0e8  # Pa/m
TENSION, COHESION = 7.0e4, 1.0e5  # Pa
AREA, HEIGHT = 0.5, 2.0  # m²; m, of the joint
BETA = 2e-4  # s
FRICTION = np.radians(30.0)


def bonded_scene(normal, nodes_up, *, free, gravity=0.0, tension=TENSION, cohesion=COHESION):
    """Block on a fixed support behind (normal y) or below (normal z); nodes along one edge."""
    points, weights = gauss_lobatto(nodes_up)
    upright = normal == (0, 1, 0)
    place = (points - (0.0 if upright else 0.5)) * HEIGHT
    line = np.stack(
        [0 * points, 0 * place if upright else place, place if upright else 0 * points], axis=1
    )
    centre = (0.0, 0.25, 0.5 * HEIGHT) if upright else (0.0, 0.0, 0.25)
    size = (1.0, 0.5, HEIGHT) if upright else (1.0, HEIGHT, 0.5)
    blocks = [  # the weight has settled
        Block("support", (0, -1, 1) if upright else (0, 0, -1), (2, 2, 2), 1.0, (1.0,) * 3, ""),
        Block(
            "block",
            centre,
            size,
            1000.0,
            box_inertia(1000.0, size),
            free,
            "push",
            displacement_m=(0.0, 0.0, -1000.0 * gravity / (JKN * AREA)),
        ),
    ]
    nodes = NodeList()
    nodes.add_joint(
        "joint",
        1,
        0,
        line,
        normal,
        weights * AREA,
        Interface(JKN, JKS, beta_s=BETA, **held(tension, cohesion, FRICTION)),
    )
    return Scene(blocks, nodes.joints, nodes.done(), "block", (0, 0, 0), "support", 1.0, gravity)


def pull(scene, speed, travel, samples=250):
    """Move the block along y at constant speed; return travel, force on the support, breaks."""
    from yade_scripts.engine import adapter, loop
    from yade_scripts.model import stiffness

    dt = 0.1 * stiffness.critical_step(scene)
    ramp = 0.02 * travel / abs(speed)
    time = np.array([0.0, ramp, 1.001 * ramp, 10.0])
    motion = adapter.SupportMotion(time, np.array([1.0, 1.0, 0.0, 0.0]) * speed / ramp)
    built = adapter.build(scene, {"push": motion}, dt)
    omega = built.omega
    support = [b.id for b in omega.bodies if type(b.shape).__name__ == "Box"]
    rows = []

    def sample():
        force = np.sum([list(omega.forces.f(i)) for i in support], axis=0)
        rows.append((omega.bodies[built.body[1]].state.pos[1], *force))

    each = max(1, int(travel / abs(speed) / dt / samples))
    omega.engines = [*omega.engines, loop.runner(sample, each, at_start=False)]
    loop.run(omega, int(travel / abs(speed) / dt))
    table = np.array(rows, float)
    # forces belong to the pose before the last step; the dashpot adds β·speed
    table[:, 0] -= scene.blocks[1].centre_m[1] + speed * dt - BETA * speed
    return table, built.bonds


def uniform_pull():
    for n in (3, 9):
        table, bonds = pull(bonded_scene((0, 1, 0), n, free="zX"), 0.01, 6e-4)
        y, force = table[:, 0], table[:, 2]
        elastic = (y < 0.95 * TENSION / JKN) & (y > 0.1 * TENSION / JKN)
        assert np.allclose(force[elastic], JKN * AREA * y[elastic], rtol=0.005)
        assert abs(force.max() / (TENSION * AREA) - 1.0) < 0.01
        assert np.all(np.abs(force[y > 1.05 * TENSION / JKN]) < 1.0)  # nothing left
        assert len(bonds.broken) == n


def elastic_both_ways():
    """In compression the stiffness is the same: the bond is not counted twice."""
    table, bonds = pull(bonded_scene((0, 1, 0), 3, free="zX"), -0.01, 1e-3)
    assert np.allclose(table[10:, 2], JKN * AREA * table[10:, 0], rtol=0.005)
    assert not bonds.broken


def pure_shear():
    for n in (3, 9):
        for gravity in (0.0, 9.81):
            weight = 1000.0 * gravity
            scene = bonded_scene((0, 0, 1), n, free="z", gravity=gravity)
            table, bonds = pull(scene, 0.01, 1.2e-3)
            y, force = table[:, 0], table[:, 2]
            k = int(np.argmax(force))  # N is read, since the block bounces a little
            peak = COHESION * AREA - table[k, 3] * np.tan(FRICTION)
            assert abs(force[k] / peak - 1.0) < 0.01, (n, gravity, force[k], peak)
            stiffness = np.polyfit(y[y < 4e-4], force[y < 4e-4], 1)[0]
            assert abs(stiffness / (JKS * AREA) - 1.0) < 0.01
            residual = table[y > 1e-3]  # no strength: friction of what presses, only
            assert np.allclose(residual[:, 2], -residual[:, 3] * np.tan(FRICTION), atol=1.0)
            assert np.isclose(residual[:, 3].mean(), -weight, atol=0.02 * weight + 1.0)
            assert len(bonds.broken) == n


def slanted_shear():
    """Sheared along both tangents at once, bonds break where their resultant is the cohesion."""
    scene = bonded_scene((0, 0, 1), 3, free="z")
    scene.blocks[0] = replace(scene.blocks[0], motion="push", motion_x="push")
    scene.blocks[1] = replace(scene.blocks[1], motion=None)
    table, bonds = pull(scene, 0.01, 1.2e-3)
    pushed = np.abs(table[:, 1:3])
    assert np.allclose(pushed[:, 0], pushed[:, 1], atol=0.01 * COHESION * AREA)
    assert abs(np.hypot(*pushed.T).max() / (COHESION * AREA) - 1.0) < 0.01
    assert len(bonds.broken) == 3


def peeling():
    """Rotation about the foot, pushed at h/2: P·h/2 = σt·A·h/3 when the top edge cracks."""
    for n in (3, 5, 9, 17):
        scene = bonded_scene((0, 1, 0), n, free="X", cohesion=1e9)
        joints = NodeList()
        joints.add_joint(
            "joint",
            1,
            0,
            scene.nodes.position_m,
            (0, 1, 0),
            scene.nodes.area_m2,
            Interface(JKN, 1.0, beta_s=BETA, **held(TENSION, 1e9, FRICTION)),
        )
        # the foot is a stiff tie: it holds y and leaves the rotation free
        tie = held(1e15, 0.0, 0.0)
        joints.add_joint(
            "foot", 1, 0, [(0, 0, 0)], (0, 1, 0), [1.0], Interface(3e11, 1.0, beta_s=1e-5, **tie)
        )
        scene = Scene(
            scene.blocks, joints.joints, joints.done(), "block", (0, 0, 0), "support", 1.0, 0.0
        )
        table, bonds = pull(scene, 0.01, 3e-4, samples=600)
        y, force = table[:, 0], table[:, 2]
        crack = 2.0 / 3.0 * TENSION * AREA
        travel = 0.5 * TENSION / JKN  # of the centroid, when the top edge cracks
        assert abs(np.interp(0.97 * travel, y, force) / (0.97 * crack) - 1.0) < 0.01, (
            n,
            np.interp(0.97 * travel, y, force) / (0.97 * crack),
        )
        assert bonds.broken[0][1] == n - 1  # the top edge
        where = 0.01 * (bonds.broken[0][0] - 0.5 * 0.02 * 3e-4 / 0.01)
        assert abs(where / travel - 1.0) < 0.01, (n, where / travel)
        order = [node for _, node in bonds.broken]
        assert order == sorted(order, reverse=True)  # peels from the top down


def facade_loads():
    """W1c and W2c: the façade's back joint carries σt·A in a uniform pull, whatever the nodes."""
    from yade_scripts.model.facade import facade_scene

    config = {
        "facade": {
            "height_m": 6.48,
            "thickness_m": 0.375,
            "width_m": 4.4,
            "density_kg_m3": 1800.0,
            "e_mpa": 1800.0,
            "friction_deg": 30.0,
            "shear_stiffness_ratio": 0.33,
            "gap_m": 0.0,
            "tilt_deg": 0.0,
            "base_stiffness_pa_m": None,
        },
        "return_wall": {
            "count": 2,
            "thickness_m": 0.375,
            "length_m": None,
            "motion": "top",
            "friction_deg": 30.0,
            "cohesion_mpa": 0.1,
            "tension_mpa": 0.07,
        },
        "smdof": {"n_dof": 4, "damping_ratio": 0.05},
    }
    for model, nodes in (("W1c", 3), ("W1c", 9), ("W2c", 3), ("W2c", 9)):
        config["numerics"] = {"nodes_thickness": 5, "nodes_height": nodes, "nodes_per_block": nodes}
        columns = facade_scene(config, model, 0.00276).nodes
        back = columns.tension_n > 0.0
        assert np.isclose(columns.tension_n.sum(), 0.07e6 * 6.48 * 0.75)
        assert np.isclose(columns.cohesion_n.sum(), 0.1e6 * 6.48 * 0.75)
        # moment of the strengths about the base: σt·t·h²/2
        assert np.isclose(columns.tension_n @ columns.position_m[:, 2], 0.07e6 * 0.75 * 6.48**2 / 2)
        assert np.array_equal(back, columns.cohesion_n > 0.0)


def energy_is_kept():
    """Free vibration of a bonded façade without dashpots, on driven supports that rest.

    Bonds hold their preload inside the support: nothing leaks from it, and the sum of
    kinetic, potential and elastic energy stays, to second order in the step.
    """
    import energy_probe

    from yade_scripts.engine import adapter, simulate
    from yade_scripts.model import stiffness

    drift = []
    for fraction in (0.1, 0.05):
        scene = bonded_scene((0, 1, 0), 5, free="yzX", tension=1e9, cohesion=1e9)
        nodes = scene.nodes
        nodes.beta_s[:] = 0.0
        moving = dict(velocity_m_s=(0.0, 0.01, 0.005), angular_velocity_rad_s=(0.01, 0.0, 0.0))
        scene.blocks[0] = replace(scene.blocks[0], motion="ground")
        scene.blocks[1] = replace(scene.blocks[1], motion=None, **moving)
        still = adapter.SupportMotion(np.array([0.0, 10.0]), np.zeros(2))
        probe = energy_probe.EnergyProbe(scene, 0.002)
        step = fraction * stiffness.critical_step(scene)
        rules = simulate.StopRules(2.0, 2.0)
        simulate.run(scene, {"ground": still}, step, rules, setup=probe.attach)
        kinetic = probe.rows[0][1]
        drift.append(np.abs(probe.total - probe.total[0]).max() / kinetic)
    assert drift[0] < 0.02, drift
    assert drift[1] < 0.4 * drift[0], drift
