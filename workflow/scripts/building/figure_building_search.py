"""What the search for the study's building reached: errors of SBDEM's periods, and its masses."""

import matplotlib.pyplot as plt
import pandas as pd
from rocking.building.case import PAPER_PERIODS_S
from rocking.building.search import READINGS, WANTED, not_dominated
from rocking.figures import style
from rocking.runtime.script import run

LOOK = {"mass": ("o", "#0072B2"), "order": ("^", "#D55E00")}
TITLES = {
    "mass": "(a) sway: largest mass along y",
    "order": "(b) first two modes with 5 % of mass",
}
NEAR_S = 0.01


def main(job):
    table = pd.read_csv(job.input.search)
    figure, axes = plt.subplots(1, 3, figsize=(7.4, 3.3), width_ratios=(1.0, 1.0, 1.0))
    for axis, reading in zip(axes, READINGS, strict=False):
        part = table[table["reading"] == reading]
        errors = pd.DataFrame(
            {key: (part[f"{key[0].lower()}_{key[1]}_s"] - PAPER_PERIODS_S[key]) for key in WANTED}
        )
        met = (errors[[("CBDEM", "y"), ("CBDEM", "rz")]].abs() <= NEAR_S).all(axis=1)
        marker, colour = LOOK[reading]
        for rows, look in (
            (~met, {"facecolors": "none", "edgecolors": style.GREY, "label": "CBDEM missed"}),
            (met, {"color": colour, "label": "CBDEM within 0.01 s"}),
        ):
            axis.scatter(
                part.loc[rows, "sbdem_y_s"],
                part.loc[rows, "sbdem_rz_s"],
                marker=marker,
                s=11,
                linewidths=0.6,
                **look,
            )
        front = not_dominated(errors[met].abs()) if met.any() else []
        best = part[met][front].sort_values("sbdem_y_s") if met.any() else part[met]
        axis.scatter(
            best["sbdem_y_s"],
            best["sbdem_rz_s"],
            marker="s",
            s=20,
            facecolors="none",
            edgecolors="k",
            linewidths=0.5,
            label="of these, not bettered in all four",
        )
        goal = PAPER_PERIODS_S["SBDEM", "y"], PAPER_PERIODS_S["SBDEM", "rz"]
        axis.add_patch(
            plt.Rectangle(
                (goal[0] - NEAR_S, goal[1] - NEAR_S),
                2 * NEAR_S,
                2 * NEAR_S,
                facecolor="0.85",
                edgecolor="k",
                lw=0.6,
                zorder=0,
            )
        )
        axis.set(
            xlabel="SBDEM, translation [s]",
            xlim=(0.16, 0.34),
            ylim=(0.08, 0.4),
            title=TITLES[reading],
        )
        axis.title.set_fontsize(6.5)
    axes[0].set_ylabel("SBDEM, rotation [s]")
    handles, labels = axes[0].get_legend_handles_labels()
    for reading in READINGS:
        part = table[table["reading"] == reading]
        marker, colour = LOOK[reading]
        axes[2].scatter(
            part["sbdem_y_mass_y"],
            part["largest_error_s"],
            marker=marker,
            s=11,
            facecolors="none",
            edgecolors=colour,
            linewidths=0.6,
            label=f"read by {reading}",
        )
    axes[2].axhline(NEAR_S, color="k", lw=0.7, ls="--")
    axes[2].set(
        xlabel="mass of SBDEM's translation [-]",
        ylabel="largest of four errors [s]",
        yscale="log",
        title="(c) periods and mass",
    )
    axes[2].title.set_fontsize(6.5)
    more, words = axes[2].get_legend_handles_labels()
    figure.legend(handles + more, labels + words, loc="outside lower center", ncols=3, fontsize=6.5)
    style.save(figure, [job.output.png, job.output.pdf])


run(main, globals())
