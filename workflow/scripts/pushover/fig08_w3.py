"""Figure 8: elements of W3, the façade parting from the wall, capacity curves, joint forces."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.patches import Polygon
from rocking.figures import style
from rocking.runtime.script import run
from rocking.studies.pushover import (
    DRAWN,
    closed_form,
    complete_curve,
    friction_moment_ratio,
    joint_forces,
    smoothed,
    theta_of,
)
from rocking.tables import read_json

from yade_scripts.model.facade import FACADE
from yade_scripts.model.interlocking import interlocking_scene
from yade_scripts.model.registry import MODELS

RULE_LINES = {
    "rigid": {"color": "#D55E00", "ls": "-"},
    "bonded": {"color": "#E69F00", "ls": "--"},
    "sliding": {"color": "#0072B2", "ls": "-."},
    "hinged": {"color": "#009E73", "ls": "-", "lw": 2.0},
    "study": {"color": "k", "ls": ":", "lw": 1.6},
}
FILLS = {"façade": "0.85", "header": "#E69F00", "brick": "#56B4E9", "half": "#9ad0ee"}
WORDS = ("façade", "header", "return brick", "its half brick")
SCHEME_D = 0.3
SHOWN_D = 0.05  # d/b at which the joints are compared


def corners(y, z, dy, dz):
    """Corners of a rectangle about (y, z)."""
    return np.array([[y - dy, z - dz], [y + dy, z - dz], [y + dy, z + dz], [y - dy, z + dz]])


def turned(points, theta, pivot):
    """Points turned outward by θ about the pivot."""
    c, s = np.cos(theta), np.sin(theta)
    r = points - pivot
    return pivot + np.stack([c * r[:, 0] + s * r[:, 1], -s * r[:, 0] + c * r[:, 1]], axis=1)


def draw_blocks(axis, scene, config, theta=0.0):
    """Side view of a scene; headers move with the façade but stay level (rule hinged)."""
    w3, h = config["w3"], config["facade"]["height_m"]
    pivot = np.array([config["facade"]["thickness_m"], 0.0])
    rear = w3["brick_length_m"] - w3["overlap_m"]
    for block in scene.blocks:
        _, y, z = block.centre_m
        dy, dz = 0.5 * block.size_m[1], 0.5 * block.size_m[2]
        if block.name == FACADE:
            shape, kind = turned(corners(y, z, dy, dz), theta, pivot), "façade"
        elif " header " in block.name:
            shape, kind = corners(y + np.sin(theta) * z, z, dy, dz), "header"
        elif block.name.endswith(" front"):
            shape, kind = corners(y, z, dy, dz), "brick"
        elif " brick " in block.name:
            course = int(block.name.split()[-1])
            low = (course - 1) * w3["course_height_m"]
            shape = corners(dy - w3["brick_length_m"], low + dz, dy, dz)
            kind = "brick"
            if low + 4 * dz <= h + 1e-9:
                half = corners(-w3["overlap_m"] - 0.5 * rear, low + 3 * dz, 0.5 * rear, dz)
                axis.add_patch(Polygon(half, fc=FILLS["half"], ec="k", lw=0.4))
        else:
            continue
        over = 2 + (kind == "header")
        axis.add_patch(Polygon(shape, fc=FILLS[kind], ec="k", lw=0.4, zorder=over))
    axis.axhline(0.0, color="k", lw=0.8)
    right = (1.6 + SCHEME_D) * config["facade"]["thickness_m"]
    axis.set(xlim=(-0.1 - w3["brick_length_m"], right), ylim=(-0.15, h + 0.25))
    axis.set(aspect="equal", xlabel="y [m]")


def draw_elements(axes, scene, config):
    draw_blocks(axes[0], scene, config)
    axes[0].set(ylabel="z [m]")
    axes[0].set_title("(a) elements", loc="left")
    for fill, text in zip(FILLS.values(), WORDS, strict=True):
        axes[1].add_patch(Polygon([[9, 9]] * 3, fc=fill, ec="k", lw=0.4, label=text))
    draw_blocks(axes[1], scene, config, theta=float(theta_of(SCHEME_D, config["facade"])))
    axes[1].set_title(f"(b) d/b = {SCHEME_D:g}", loc="left")


def draw_capacity(axis, curve, config):
    d = np.linspace(1e-4, 1.0, 400)
    upper, lower, shift = closed_form(d, config, "W3")
    grey, label = {"color": style.GREY, "alpha": 0.5, "lw": 0}, "kinematic bounds, rigid base"
    axis.fill_between(d, lower, upper, **grey, label=label)
    axis.plot(d, upper + shift, color="k", ls="--", lw=0.8, label="bounds, compliant base")
    axis.plot(d, lower + shift, color="k", ls="--", lw=0.8)
    colour = MODELS["W3"].colour
    for name, line, label in (("", "-", "YADE"), ("_corrected", ":", "YADE, base corrected")):
        value = smoothed(curve, f"lambda_dem{name}")
        axis.plot(curve["d_over_b"], value, color=colour, ls=line, label=label)
    upper_block = closed_form(d, config, "free")[0]
    axis.plot(d, upper_block, color=style.GREY, lw=1, label="bare façade, tan(α − θ)")
    axis.set(xlim=(0, 1), ylim=(0, 0.32), xlabel="d/b [-]", ylabel="λ [-]")
    axis.set_title("(c) capacity, default rules", loc="left")
    axis.legend(fontsize=6.5)


def draw_rules(axes, cases):
    for rule in DRAWN:
        curve, joints = cases[rule]
        line = RULE_LINES[rule]
        part = curve[curve["d_over_b"] > 0.002]
        value = np.maximum(smoothed(part, "lambda_dem"), 1e-3)
        axes[0].semilogy(part["d_over_b"], value, label=rule, **line)
        nearest = joints["d_over_b"].unique()
        nearest = nearest[np.argmin(np.abs(nearest - SHOWN_D))]
        at = joints[joints["d_over_b"] == nearest]
        axes[1].plot(at["normal_n"] / 1e3, at["z_m"], marker="o", ms=2.5, label=rule, **line)
        ratio = friction_moment_ratio(joints)
        ratio = ratio[(ratio.index > 0.002) & (ratio.index <= 1.0)]
        axes[2].semilogy(ratio.index, np.maximum(ratio, 1e-2), label=rule, **line)
    axes[1].plot(at["weight_n"] / 1e3, at["z_m"], color="k", ls="--", label="γ·t$_s$·v·h$_b$·i")
    axes[1].set(xscale="symlog", xlabel="normal force of the joint [kN]", ylabel="z [m]")
    axes[1].set_title(f"(e) bed joints at d/b = {SHOWN_D:g}", loc="left")
    axes[0].set(xlim=(0, 1), ylim=(0.02, 5), xlabel="d/b [-]", ylabel="λ [-]")
    axes[0].set_title("(d) header rules, level joints", loc="left")
    axes[2].axhline(1.0, color="k", ls="--", lw=0.8)
    axes[2].set(xlim=(0, 1), xlabel="d/b [-]", ylabel="ΣN·z / Σγt$_s$vh$_b$i·z [-]")
    axes[2].set_title("(f) what friction has to work with", loc="left")
    axes[0].legend(fontsize=6.5, title="header joint", title_fontsize=6.5)
    axes[1].legend(fontsize=6.5)


def main(job):
    configs, cases = [read_json(p) for p in job.input.scenes], {}
    files = zip(configs, job.input.raw, job.input.forces, strict=True)
    for name, (config, raw, forces) in zip([*DRAWN, "default"], files, strict=True):
        curve = complete_curve(pd.read_csv(raw), config, "W3")
        cases[name] = curve, joint_forces(pd.read_csv(forces), config)
    figure = plt.figure(figsize=(9.2, 7.4))
    above, below = figure.subfigures(2, 1, height_ratios=(1.15, 1.0))
    top = above.subplots(1, 3, width_ratios=(1.0, 1.0, 3.6))
    low = below.subplots(1, 3)
    draw_elements(top[:2], interlocking_scene(configs[-1], configs[-1]["beta_s"]), configs[-1])
    above.legend(*top[1].get_legend_handles_labels(), loc="outside lower left", ncols=4)
    draw_capacity(top[2], cases["default"][0], configs[-1])
    draw_rules(low, cases)
    style.save(figure, job.output)


run(main, globals())
