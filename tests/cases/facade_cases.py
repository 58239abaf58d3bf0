"""Façade runs for tests; imported inside YADE's Python."""

import os
import sys

import numpy as np

from yade_scripts.commands import shaking
from yade_scripts.engine import adapter, loop, simulate
from yade_scripts.model import facade


def quiet(scene, duration_s=100.0):
    """Motions of supports that stay where they are."""
    still = adapter.SupportMotion(np.array([0.0, duration_s]), np.zeros(2))
    return dict.fromkeys(scene.motions, still)


def drive(config, time_s, acceleration_m_s2, dt_s, until_s=None):
    """Displacement of the driven base at `until_s` or its motion's end [m], façade on it."""
    scene = facade.facade_scene(config, "W1", 0.00276)
    motion = adapter.SupportMotion(np.array(time_s), np.array(acceleration_m_s2))
    kept = []
    until_s = until_s or time_s[-1]
    rules = simulate.StopRules(until_s, until_s, overturn_ratio=1e9)
    simulate.run(scene, {"ground": motion}, dt_s, rules, setup=kept.append)
    return kept[0].omega.bodies[kept[0].body[0]].state.pos[1] - scene.blocks[0].centre_m[1]


def contacts(config, model, beta_s):
    """Contact parameters in YADE beside those of the scene, every node pressed into its face."""
    scene = facade.facade_scene(config, model, beta_s)
    scene.nodes.gap_m = scene.nodes.gap_m - 1e-4
    built = adapter.build(scene, quiet(scene), 1e-7)
    loop.run(built.omega, 1)
    node_of = {body: node for node, body in enumerate(built.node_body)}
    out = [None] * len(scene.nodes)
    for c in built.omega.interactions:
        node = node_of[c.id1] if c.id1 in node_of else node_of[c.id2]
        p = c.phys
        out[node] = [p.kn, p.ks, p.cn, p.cs, p.tangensOfFrictionAngle, c.geom.penetrationDepth]
    n = scene.nodes
    expected = np.stack(
        [n.kn_n_m, n.ks_n_m, n.beta_s * n.kn_n_m, n.beta_s * n.ks_n_m, np.tan(n.friction_rad)]
    ).T
    return {"yade": out, "scene": expected.tolist()}


def release(config, beta_s, ratio, dt_s, limit_s, sample_s=0.001):
    """Outward rotation history of a free-rocking release."""
    scene = facade.facade_scene(config, "W1", beta_s, release_ratio=ratio)
    rules = simulate.StopRules(0.0, limit_s, overturn_ratio=1e9)
    h = simulate.run(scene, quiet(scene), dt_s, rules, sample_s=sample_s)
    return {"time_s": h.time_s.tolist(), "rotation_rad": h.rotation_rad.tolist()}


def rebound_histories(config, beta_s, ratio, limit_s, fractions):
    """Histories of a release, dashpots as YADE has them, by fraction of the critical step."""
    found = {}
    for fraction in fractions:
        scene = facade.facade_scene(config, "W1", beta_s, release_ratio=ratio)
        step, _ = simulate.choose_step(scene, {**config["numerics"], "step_fraction": fraction})
        rules = simulate.StopRules(limit_s, limit_s, overturn_ratio=1e9)
        h = simulate.run(
            scene,
            quiet(scene),
            step,
            rules,
            sample_s=limit_s / 2500,
            making=simulate.Making(compensate_lag=False),
        )
        found[str(fraction)] = [h.time_s.tolist(), h.rotation_rad.tolist()]
    return found


def shaken(config, model, beta_s, time_s, columns, factor, planar=True, two_components=False):
    """Peak d/b, status and reason of one earthquake run, twist and slide in three dimensions."""
    scene = facade.facade_scene(config, model, beta_s, planar=planar, two_components=two_components)
    columns = {name: np.array(values) for name, values in columns.items()}
    numerics = config["numerics"]
    h = shaking.set_up(scene, numerics, np.array(time_s), columns, factor).retried()
    said = {"peak": h.peak_d_over_b, "status": h.status, "reason": h.reason, "d": h.d_m.tolist()}
    return said | h.beside


def prompt_and_ports():
    """Whether YADE's prompt is loaded, and on how many TCP sockets it listens, after a step."""
    loop.run(adapter.load_yade().Omega(), 1)
    inodes = set()
    for fd in os.listdir("/proc/self/fd"):
        try:
            target = os.readlink(f"/proc/self/fd/{fd}")
        except OSError:
            continue
        if target.startswith("socket:["):
            inodes.add(target[8:-1])
    count = 0
    for name in ("tcp", "tcp6"):
        with open(f"/proc/net/{name}") as table:
            for line in list(table)[1:]:
                fields = line.split()
                count += fields[3] == "0A" and fields[9] in inodes
    return "IPython" in sys.modules, count
