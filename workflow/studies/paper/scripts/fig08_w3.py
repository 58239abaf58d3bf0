"""Figure 8: elements of W3, the façade parting from the wall, capacity curves, joint forces."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Patch
from rocking.figures import style
from rocking.mechanics.smoothing import smoothed
from rocking.pushover import (
    DRAWN,
    closed_form,
    complete_curve,
    friction_moment_ratio,
    joint_forces,
    theta_of,
)
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json
from studies.shared.drawings import FILLS, side_view

from yade_scripts.model.interlocking import interlocking_scene
from yade_scripts.model.registry import MODELS

RULE_LINES = {
    "rigid": {"color": "#D55E00", "ls": "-"},
    "bonded": {"color": "#E69F00", "ls": "--"},
    "sliding": {"color": "#0072B2", "ls": "-."},
    "hinged": {"color": "#009E73", "ls": "-", "lw": 2.0},
    "study": {"color": "k", "ls": ":", "lw": 1.6},
}
SCHEME_D = 0.3
TITLES = ("(a) elements", f"(b) d/b = {SCHEME_D:g}")
SHOWN_D = 0.05  # d/b at which the joints are compared


def draw_elements(axes, config):
    """(a), (b) Side views as built and at SCHEME_D."""
    scene = interlocking_scene(config, config["beta_s"])
    ahead = (1.6 + SCHEME_D) * config["facade"]["thickness_m"]
    for axis, d, title in zip(axes, (0.0, SCHEME_D), TITLES, strict=True):
        side_view(axis, scene, config, float(theta_of(d, config["facade"])))
        axis.axhline(0.0, color="k", lw=0.8)
        axis.set(xlim=(-0.1 - config["w3"]["brick_length_m"], ahead), xlabel="y [m]")
        axis.set(ylim=(-0.15, config["facade"]["height_m"] + 0.25), aspect="equal")
        axis.set_title(title, loc="left")
    axes[0].set(ylabel="z [m]")


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
    configs, cases = [read_json(p) for p in job.input.cases], {}
    files = zip(configs, job.input.raw, job.input.forces, strict=True)
    for name, (config, raw, forces) in zip([*DRAWN, "default"], files, strict=True):
        curve = complete_curve(read_frame(raw), config, "W3")
        cases[name] = curve, joint_forces(read_frame(forces), config)
    figure = plt.figure(figsize=(9.2, 7.4))
    above, below = figure.subfigures(2, 1, height_ratios=(1.15, 1.0))
    top = above.subplots(1, 3, width_ratios=(1.0, 1.0, 3.6))
    low = below.subplots(1, 3)
    draw_elements(top[:2], configs[-1])
    elements = [Patch(fc=fill, ec="k", lw=0.4, label=name) for name, fill in FILLS.items()]
    above.legend(handles=elements, loc="outside lower left", ncols=4)
    draw_capacity(top[2], cases["default"][0], configs[-1])
    draw_rules(low, cases)
    style.save(figure, job.output)


run(main, globals())
