"""What the search for the study's building reached: errors of SBDEM's periods, and its masses."""

import matplotlib.pyplot as plt
from rocking.building.case import PAPER_PERIODS_S
from rocking.building.search import READINGS, reached
from rocking.figures import style
from rocking.figures.panels import common_legend
from rocking.runtime.script import run
from rocking.tables import read_frame

LOOK = {"mass": ("o", "#0072B2"), "order": ("^", "#D55E00")}
TITLES = {
    "mass": "(a) read by mass: sway moves most mass along y",
    "order": "(b) read by order: first two modes with 5 % of it",
}
NEAR_S = 0.01
FRONT = {"s": 34, "facecolors": "#F0E442", "edgecolors": "k", "linewidths": 0.8, "zorder": 3}
FRONT["label"] = "of these, none nearer in all four"
GOAL = {"facecolor": "#BDE3C8", "edgecolor": "k", "lw": 0.6, "zorder": 1}
GOAL["label"] = "the study, ± 0.01 s"


def main(job):
    table = read_frame(job.input.search)
    figure, grid = plt.subplots(2, 2, figsize=(6.8, 5.6))
    axes = list(grid.flat)
    axes[3].set_axis_off()
    for axis, reading in zip(axes, READINGS, strict=False):
        part = table[table["reading"] == reading]
        met, best = reached(part, NEAR_S)
        marker, colour = LOOK[reading]
        symbols = {"marker": marker, "s": 11, "linewidths": 0.6}
        missed = {"facecolors": "none", "edgecolors": "0.75", "label": "CBDEM missed"}
        points(axis, part[~met], **symbols, **missed)
        points(axis, part[met], **symbols, color=colour, label="CBDEM within 0.01 s")
        points(axis, part[best], marker=marker, **FRONT)
        corner = [PAPER_PERIODS_S["SBDEM", kind] - NEAR_S for kind in ("y", "rz")]
        axis.add_patch(plt.Rectangle(corner, 2 * NEAR_S, 2 * NEAR_S, **GOAL))
        axis.set(xlabel="SBDEM, translation [s]", xlim=(0.16, 0.34), ylim=(0.08, 0.4))
        axis.set_xticks([0.20, 0.25, 0.30])
        axis.set_title(TITLES[reading], fontsize=8)
        look = {"facecolors": "none", "edgecolors": colour, "label": f"(c) read by {reading}"}
        axes[2].scatter(part["sbdem_y_mass_y"], part["largest_error_s"], **symbols, **look)
    for axis in (axes[0], axes[1]):
        axis.set_ylabel("SBDEM, rotation [s]")
    axes[2].axhline(NEAR_S, color="k", lw=0.7, ls="--", label="(c) 0.01 s")
    axes[2].set(xlabel="mass of SBDEM's translation [-]", ylabel="largest of four errors [s]")
    axes[2].set_yscale("log")
    axes[2].set_title("(c) how far each variant is off, by mass", fontsize=8)
    common_legend(figure, loc="center", bbox_to_anchor=(0.78, 0.25), fontsize=8)
    style.save(figure, job.output)


def points(axis, rows, **look):
    """Periods of SBDEM, translation and rotation."""
    axis.scatter(rows["sbdem_y_s"], rows["sbdem_rz_s"], **look)


run(main, globals())
