"""The W1 façade with YADE's Polyhedra volumetric law, for comparison only.

Façade, base and return wall are polyhedra; force is proportional to the volume of
overlap. The law has no dashpot, so the damping is YADE's non-viscous one, and contacts
of flat faces are dropped by the intersection algorithm; both are why the project does
not use it.
"""

import time

import numpy as np

from yade_scripts.engine import adapter, drives, loop


def run(scene, motion, dt_s, limit_s, *, sample_s=0.005, damping=0.2):
    """Peak |d|/b of a W1 façade with the volumetric law, status, simulated and wall time, steps.

    The volumetric stiffness is the base's kn over b²w/2 a radian, that is jkn for a small rotation
    about the toe: force = jkn · volume of overlap. `damping` is the integrator's non-viscous one.
    """
    w = adapter.load_yade()
    from yade import polyhedra_utils

    omega = w.Omega()
    loop.reset(omega)
    facade = scene.blocks[scene.index(scene.monitor)]
    nodes = scene.nodes
    base = nodes.joint == 0
    jkn = float(nodes.kn_n_m[base].sum() / nodes.area_m2[base].sum())
    material = w.PolyhedraMat(
        density=1.0, young=jkn, poisson=1.0, frictionAngle=float(nodes.friction_rad[0])
    )
    omega.materials.append(material)

    def brick(size, centre, fixed):
        corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
        shape = [tuple(c * s for c, s in zip(corner, size, strict=True)) for corner in corners]
        body = polyhedra_utils.polyhedra(material, v=shape, fixed=fixed)
        body.state.pos = tuple(centre)
        omega.bodies.append(body)
        return body

    lx, ly, lz = facade.size_m
    settle = facade.mass_kg * scene.gravity_m_s2 / (jkn * lx * ly)
    block = brick(facade.size_m, np.array(facade.centre_m) - (0.0, 0.0, settle), False)
    block.state.mass, block.state.inertia = facade.mass_kg, facade.inertia_kg_m2
    block.state.blockedDOFs = "xYZ"
    supports = [brick((2.0 * lx, 8.0 * ly, 1.0), (0.0, 0.5 * ly, -0.5), False)]
    if len(scene.joints) > 1:
        supports.append(brick((lx, 1.0, 1.1 * lz), (0.0, -0.5, 0.55 * lz), False))
    heavy = 1e9 * facade.mass_kg
    for support in supports:
        support.state.mass, support.state.inertia = heavy, (heavy,) * 3
        support.state.blockedDOFs = "xzXYZ"
        drives.set_back(support.state, 1, motion.acceleration_m_s2[0], dt_s)
    start = (block.state.pos[1], supports[0].state.pos[1])
    arm = np.subtract(scene.monitor_point_m, facade.centre_m)
    frame = block.state.ori
    seen = {"peak": 0.0, "status": "ok"}

    def sample():
        turn = block.state.ori * frame.inverse()
        top = np.array([list(row) for row in turn.toRotationMatrix()]) @ arm - arm
        d = (block.state.pos[1] - start[0]) + top[1] - (supports[0].state.pos[1] - start[1])
        seen["peak"] = max(seen["peak"], abs(d)) if np.isfinite(d) else float("nan")
        if not seen["peak"] < scene.thickness_m:
            seen["status"] = "overturned" if np.isfinite(d) else "failed"
            loop.stop()

    omega.engines = [
        w.ForceResetter(),
        w.InsertionSortCollider([w.Bo1_Polyhedra_Aabb()], verletDist=0.05),
        w.InteractionLoop(
            [w.Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
            [w.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
            [w.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()],
        ),
        drives.force(w, motion, heavy, 1, [s.id for s in supports]),
        w.NewtonIntegrator(damping=damping, gravity=(0, 0, -scene.gravity_m_s2)),
        loop.runner(sample, round(sample_s / dt_s), at_start=False),
    ]
    omega.dt = dt_s
    began = time.perf_counter()
    loop.run(omega, int(np.ceil(limit_s / dt_s)))
    wall = time.perf_counter() - began
    return seen["peak"] / scene.thickness_m, seen["status"], omega.time, wall, int(omega.iter)
