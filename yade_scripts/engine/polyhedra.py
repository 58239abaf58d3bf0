"""The W1 façade with YADE's Polyhedra volumetric law, for comparison only.

Façade, base and return wall are polyhedra; force is proportional to the volume of
overlap. The law has no dashpot, so the damping is YADE's non-viscous one, and contacts
of flat faces are dropped by the intersection algorithm; both are why the project does
not use it.
"""

import itertools
import time
from typing import Any

import numpy as np

from yade_scripts.engine import adapter, drives, loop, simulate

SAMPLE_S, DAMPING = 0.005, 0.2  # between samples, and of the integrator


def _brick(omega, material, size, centre):
    """Append a box of these edges, a polyhedron; return it."""
    from yade import polyhedra_utils

    shape = list(itertools.product(*((-0.5 * edge, 0.5 * edge) for edge in size)))
    body = polyhedra_utils.polyhedra(material, v=shape, fixed=False)
    body.state.pos = tuple(centre)
    omega.bodies.append(body)
    return body


def _bodies(w, omega, scene):
    """Append the façade and what stands behind and below it; return it and these supports.

    The volumetric stiffness is the base's kn over b²w/2 a radian, that is jkn for a small rotation
    about the toe: force = jkn · volume of overlap.
    """
    facade, nodes = scene.blocks[scene.index(scene.monitor)], scene.nodes
    base = nodes.joint == 0
    jkn = float(nodes.kn_n_m[base].sum() / nodes.area_m2[base].sum())
    material = w.PolyhedraMat(
        density=1.0, young=jkn, poisson=1.0, frictionAngle=float(nodes.friction_rad[0])
    )
    omega.materials.append(material)
    lx, ly, lz = facade.size_m
    settle = facade.mass_kg * scene.gravity_m_s2 / (jkn * lx * ly)
    centre = np.array(facade.centre_m) - (0.0, 0.0, settle)
    block = _brick(omega, material, facade.size_m, centre)
    block.state.mass, block.state.inertia = facade.mass_kg, facade.inertia_kg_m2
    block.state.blockedDOFs = "xYZ"
    supports = [_brick(omega, material, (2.0 * lx, 8.0 * ly, 1.0), (0.0, 0.5 * ly, -0.5))]
    if len(scene.joints) > 1:
        wall = (lx, 1.0, 1.1 * lz)
        supports.append(_brick(omega, material, wall, (0.0, -0.5, 0.55 * lz)))
    return block, supports


def run(scene, motion, dt_s):
    """History of a W1 façade with the volumetric law, of which there is the last instant alone."""
    w = adapter.load_yade()
    omega = w.Omega()
    loop.reset(omega)
    block, supports = _bodies(w, omega, scene)
    facade = scene.blocks[scene.index(scene.monitor)]
    heavy = 1e9 * facade.mass_kg
    for support in supports:
        support.state.mass, support.state.inertia = heavy, (heavy,) * 3
        support.state.blockedDOFs = "xzXYZ"
        drives.set_back(support.state, 1, motion.acceleration_m_s2[0], dt_s)
    start = (block.state.pos[1], supports[0].state.pos[1])
    arm = np.subtract(scene.monitor_point_m, facade.centre_m)
    frame = block.state.ori
    seen: dict[str, Any] = {"peak": 0.0, "status": "ok"}

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
        w.NewtonIntegrator(damping=DAMPING, gravity=(0, 0, -scene.gravity_m_s2)),
        loop.runner(sample, round(SAMPLE_S / dt_s), at_start=False),
    ]
    omega.dt = dt_s
    began = time.perf_counter()
    loop.run(omega, int(np.ceil(motion.duration_s / dt_s)))
    wall = time.perf_counter() - began
    end, peak = np.array([omega.time]), seen["peak"] / scene.thickness_m
    still, steps = np.zeros(1), int(omega.iter)
    return simulate.YadeHistory(
        end, still, still, still, peak, seen["status"], "", dt_s, steps, wall
    )
