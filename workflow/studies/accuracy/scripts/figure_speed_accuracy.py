"""Error against wall time, a panel a model: every method on the same cases, with its spread."""

import numpy as np
from rocking.figures import style
from rocking.figures.panels import common_legend, panels, plain_log
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.accuracy.errors import (
    ADAPTIVE,
    COMPILED,
    GRID,
    pareto_front,
    reporting,
    same_cases,
    summary,
)

METHODS = {  # marker, colour
    GRID: ("o", "#0072B2"),
    COMPILED: ("^", "#009E73"),
    ADAPTIVE: ("d", "0.3"),
    "MuJoCo": ("s", "#56B4E9"),
    "Drake": ("h", "#8C510A"),
}
FLOOR = 1e-5  # smallest error drawn


def points(axis, group, marker, colour, label, **line):
    """Medians with a thick bar to the error 90 % keep and a thin one to the worst."""
    middle, high, worst = (
        100 * group[key].clip(lower=FLOOR, upper=1.0)
        for key in ("error_median", "error_90", "error_worst")
    )
    axis.vlines(group["cost"], middle, high, color=colour, lw=1.6, alpha=0.8)
    axis.vlines(group["cost"], high, worst, color=colour, lw=0.6)
    axis.plot(group["cost"], middle, marker, ls="", color=colour, ms=5, label=label, **line)
    axis.plot(group["cost"], worst, "_", ls="", color=colour, ms=5)


def panel(axis, table, cases, counts):
    """One model; `counts` are the node counts of the figure, by which markers are filled."""
    for method, (marker, colour) in METHODS.items():
        mine = table[table["method"] == method]
        for nodes, group in mine.groupby("nodes", dropna=False):
            name, face = "YADE" if method == GRID else method, {}
            if method in (GRID, COMPILED):
                name = f"{name}, {nodes:g} nodes"
                face = {"mfc": ("none", colour, "0.8")[counts.index(nodes) % 3]}
            points(axis, group, marker, colour, name, **face)
    default = table[table["default"] == 1]
    if len(default):
        points(axis, default, "*", "black", "default")
    front = table[pareto_front(table["cost"], table["error_90"])].sort_values("cost")
    axis.step(front["cost"], 100 * front["error_90"], where="post", color=style.GREY, zorder=1)
    axis.axhline(1.0, color="0.4", lw=0.8, ls=":")
    axis.set(xscale="log", yscale="log", xlabel="wall time over simulated time (-)")
    axis.set_title(f"{table['model'].iloc[0]}: {cases} histories, the same for all")
    plain_log(axis.xaxis)
    plain_log(axis.yaxis)


def main(job):
    table = read_frame(job.input.table)
    table["model"] = table["scene"].str.split().str[0]
    common = same_cases(reporting(table))
    cases = common.groupby("model")["scene"].nunique()
    spread = summary(common, keys=("model",)).replace(np.inf, 1.0)
    models = sorted(spread["model"].unique())
    figure, axes = panels(len(models), len(models), (3.6, 4.0), around=(2.0, 0.0), sharey=True)
    counts = sorted(spread.loc[spread["method"].isin([GRID, COMPILED]), "nodes"].unique())
    for axis, model in zip(axes.flat, models, strict=True):
        panel(axis, spread[spread["model"] == model], cases[model], counts)
    axes[0, 0].set_ylabel("error in peak d/b (%): median, 90 %, worst")
    common_legend(figure, loc="outside right upper", fontsize=7)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
