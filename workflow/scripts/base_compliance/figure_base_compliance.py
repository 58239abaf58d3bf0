"""Static curves of the study's façade, and collapse of the rigid block beside the stack's."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.collapse.probability import KEY
from rocking.figures import style
from rocking.runtime.script import run
from rocking.studies.base_compliance import BASES, STACK

LABELS = {"study": "rigid block, base E/h", "column": "rigid block, the column's base"}
COLOURS = {"study": "#c1440e", "column": "#1f6f8b"}


def static_curves(axis, table):
    part = table[table["facade"] == table["facade"].iloc[0]]
    d = part["d_over_b"]
    axis.plot(d, part["lambda_rigid"], ":", color=style.GREY, lw=1.0, label="rigid")
    axis.plot(d, part["lambda_wall"], "k-", lw=1.6, label="elastic column")
    axis.plot(d, part["lambda_courses"], "k+", ms=5, label="stack of 20 courses")
    for name in BASES:
        axis.plot(d, part[f"lambda_base_{name}"], "--", color=COLOURS[name], label=LABELS[name])
    axis.set(xlabel="top displacement over thickness d/b [-]", ylabel="static multiplier λ [-]")
    axis.set_xlim(0.0, 0.85)
    axis.set_ylim(0.0, None)
    axis.set_title("the study's façade", loc="left")
    axis.legend(fontsize=6.5, frameon=False, loc="upper right")


def collapses(axis, table):
    stack = table[table["facade"] == STACK].set_index(KEY)
    most = 0.0
    for name in BASES:
        part = table[table["facade"] == name].set_index(KEY)
        x = stack["pga_median_g"].reindex(part.index)
        axis.plot(x, part["pga_median_g"], "o", ms=4, color=COLOURS[name], label=LABELS[name])
        most = np.nanmax([most, x.max(), part["pga_median_g"].max()])
    ends = np.array([0.0, 1.1 * most])
    axis.plot(ends, ends, "k-", lw=0.8, zorder=0)
    axis.set(xlabel="collapse PGA, stack of courses [g]", ylabel="collapse PGA, rigid block [g]")
    axis.set_xlim(ends)
    axis.set_ylim(ends)
    models = ", ".join(table["model"].unique())
    axis.set_title(f"half collapse, {models}; colours as on the left", loc="left")


def main(job):
    figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.4))
    static_curves(axes[0], pd.read_csv(job.input.static))
    collapses(axes[1], pd.read_csv(job.input.table))
    style.save(figure, job.output, job.input.facts)


run(main, globals())
