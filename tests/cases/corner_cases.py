"""A corner of two walls as one block on its two cracks, shaken along both walls; inside YADE.

Axes: y outward along the bisector, x across it, z up; the outer edge of the foot is the origin. The
façade's crack climbs at β from the vertical along one wall, the return wall's along the other. A
crack in masonry goes in steps: bed joints bear vertically and rub, head joints push along their
wall, each with the crack's own area projected. Two of each stand on every height, at the faces of
the wall.
"""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.engine import adapter, simulate
from yade_scripts.model import facade
from yade_scripts.model.motion import along
from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.scene import Block, Interface, NodeList, Scene, held

CELLS = 400  # of the height, for mass and moments
ROOT = math.sqrt(0.5)
NO_WEIGHT = 1e-6  # of a strip in plan [m/s²]


def turned(u, v, z):
    """Place by outward distances u along the façade's wall and v along the other: (x, y, z)."""
    return ROOT * (u - v), ROOT * (u + v), z


def body(corner):
    """Mass, centroid and moments about it (x, y, z axes) of a corner, by slices of its height.

    `corner`: height_m, thickness_m of both walls, crack_deg, density_kg_m3.
    """
    h, t = corner["height_m"], corner["thickness_m"]
    slope = math.tan(math.radians(corner["crack_deg"]))
    dz, mass, first, second = h / CELLS, 0.0, np.zeros(3), np.zeros((3, 3))
    for k in range(CELLS):
        z = (k + 0.5) * dz
        reach = z * slope
        boxes = [((-reach, 0.0), (-min(t, reach), 0.0))]
        if reach > t:
            boxes.append(((-t, 0.0), (-reach, -t)))
        for (u0, u1), (v0, v1) in boxes:
            m = corner["density_kg_m3"] * (u1 - u0) * (v1 - v0) * dz
            r = np.array(turned(0.5 * (u0 + u1), 0.5 * (v0 + v1), z))
            own = m / 12.0 * np.array([(u1 - u0) ** 2, (v1 - v0) ** 2, dz**2])
            level = 0.5 * (own[0] + own[1])  # each of x and y takes half of u and of v
            mass, first = mass + m, first + m * r
            second += m * np.outer(r, r) + np.diag([level, level, own[2]])
    centre = first / mass
    spread = np.diag(second) - mass * centre**2
    return mass, centre, spread.sum() - spread


def corner_scene(corner, count=7):
    """Scene of a corner on supports that move with the building along x and y."""
    mass, centre, inertia = body(corner)
    h, t, beta_s = corner["height_m"], corner["thickness_m"], corner["beta_s"]
    slope = math.tan(math.radians(corner["crack_deg"]))
    jkn = corner["e_pa"] / (0.5 * h)
    still = (1.0, 1.0, 1.0)
    driven = {"free": "", "motion": "floor", "motion_x": along("floor")}
    top = (0.0, 0.0, h)
    blocks = [
        Block("base", (0.0, -t, -0.5), (2.0, 2.0, 1.0), 1.0, still, **driven),
        Block(
            "façade",
            tuple(centre.tolist()),
            (2.0 * h * slope, h * slope, h),
            mass,
            tuple(inertia.tolist()),
            displacement_m=(0.0, 0.0, 0.0),
            lever_m=(-float(centre[1]), float(centre[2])),
        ),
    ]
    nodes, (points, weights) = NodeList(), gauss_lobatto(count)
    rubbing = {"beta_s": beta_s, **held(0.0, 0.0, math.radians(corner["friction_deg"]))}
    for name, way in (("façade's", 0), ("return wall's", 1)):
        places, areas = [], []
        for p, w in zip(points, weights, strict=True):
            for across in (0.0, -t):
                ends = (-p * h * slope, across) if way == 0 else (across, -p * h * slope)
                places.append(turned(*ends, p * h))
                areas.append(0.5 * w * h * t)
        areas = np.array(areas)
        outward = (ROOT, ROOT, 0.0) if way == 0 else (-ROOT, ROOT, 0.0)
        for kind, normal, share in (("head", outward, 1.0), ("bed", (0.0, 0.0, 1.0), slope)):
            own = (places, normal, share * areas, jkn, 0.33 * jkn)
            nodes.add_joint(f"{name} {kind} joints", 1, 0, *own, Interface(**rubbing))
    return Scene(
        blocks,
        nodes.joints,
        nodes.done(),
        monitor="façade",
        monitor_point_m=top,
        reference="base",
        thickness_m=h * -float(centre[1]) / float(centre[2]),
    )


def corners(corner, time_s, floor, beside, factors, fraction=0.3):
    """Peaks of d over the displacement at which the weight passes the edge, and how runs ended.

    `floor` and `beside` are accelerations along y and x; each factor scales both.
    """
    scene, time_s = corner_scene(corner), np.array(time_s)
    step, _ = simulate.choose_step(scene, {"step_fraction": fraction, "dt_s": None})
    found = []
    for factor in factors:
        motions = {
            "floor": adapter.SupportMotion(time_s, factor * np.array(floor)),
            along("floor"): adapter.SupportMotion(time_s, factor * np.array(beside)),
        }
        rules = simulate.StopRules(float(time_s[-1]), float(time_s[-1]) + 4.0)
        h = simulate.run(scene, motions, step, rules, sample_s=0.01)
        found.append(
            {
                "peak": h.peak_d_over_b,
                "status": h.status,
                "steps": h.steps,
                "wall_s": h.wall_s,
                **h.beside,
            }
        )
    return {"runs": found, "mass_kg": scene.blocks[1].mass_kg, "dt_s": step}


def strips(config, beta_s, time_s, pushes):
    """How pushes end on a façade without weight, as a strip that bends between its ends in plan."""
    scene = replace(facade.facade_scene(config, "W1", beta_s), gravity_m_s2=NO_WEIGHT)
    step, _ = simulate.choose_step(scene, config["numerics"])
    time_s, found = np.array(time_s), []
    for push in pushes:
        motions = {"ground": adapter.SupportMotion(time_s, np.array(push))}
        rules = simulate.StopRules(float(time_s[-1]), float(time_s[-1]) + 1.0)
        found.append(simulate.run(scene, motions, step, rules).status)
    return found
