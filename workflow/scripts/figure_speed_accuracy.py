"""Error against wall time, a panel a model, with the Pareto front and the defaults marked."""

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter
from rocking.accuracy.study import pareto_front
from rocking.figures import style
from rocking.runtime.script import run

OTHERS = {
    "default": ("*", "black"),
    "lag not compensated": ("X", "#CC79A7"),
    "python drive": ("P", "#009E73"),
    "full 3D": ("D", "#E69F00"),
    "MuJoCo": ("s", "#56B4E9"),
    "Drake": ("h", "#8C510A"),
    "Polyhedra": ("v", "#D55E00"),
}
FIRST_CASE = ("lag not compensated", "python drive", "full 3D", "Polyhedra")  # run on it alone
NODES = ("o", "^", "<", ">", "p")


def panel(axis, table, model, markers):
    """Worst error over the cases of one model that repeat, against mean wall time."""
    part = table[(table["model"] == model) & (table["repeats"] == 1)].copy()
    part["cost"] = 1.0 / part["realtime_factor"]
    keys = ["method", "nodes", "dt_over_dt_crit"]
    points = part.groupby(keys, as_index=False, dropna=False).agg(
        cost=("cost", "mean"), error=("error", "max")
    )
    points = points.dropna(subset="error")
    points["error"] = points["error"].clip(lower=1e-4)
    grid = points[points["method"] == "nodes and step"]
    for nodes, group in grid.groupby("nodes"):
        axis.plot(
            group["cost"],
            100 * group["error"],
            markers[nodes],
            ls="",
            color="#0072B2",
            mfc="none",
            label=f"{nodes:g} nodes",
        )
    for method, (marker, colour) in OTHERS.items():
        group = points[points["method"] == method]
        if len(group):
            label = f"{method} (one case)" if method in FIRST_CASE else method
            axis.plot(
                group["cost"],
                100 * group["error"],
                marker,
                ls="",
                color=colour,
                ms=9 if method == "default" else 6,
                label=label,
                zorder=3,
            )
    points = points[~points["method"].isin(FIRST_CASE)]
    front = points[pareto_front(points["cost"], points["error"])].sort_values("cost")
    axis.step(front["cost"], 100 * front["error"], where="post", color=style.GREY, zorder=1)
    axis.axhline(1.0, color="0.4", lw=0.8, ls=":")
    axis.set(xscale="log", yscale="log", title=model, xlabel="wall time over simulated time (-)")
    axis.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    for side in (axis.xaxis, axis.yaxis):
        side.set_major_formatter(FormatStrFormatter("%g"))
        side.set_minor_formatter(NullFormatter())


def main(job):
    table = pd.read_csv(job.input.table)
    table["model"] = table["scene"].str.split().str[0]
    models = sorted(table["model"].unique())
    counts = sorted(table.loc[table["method"] == "nodes and step", "nodes"].unique())
    markers = {nodes: NODES[i % len(NODES)] for i, nodes in enumerate(counts)}
    figure, axes = plt.subplots(
        1,
        len(models),
        figsize=(3.6 * len(models) + 1.6, 3.8),
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    handles = {}
    for axis, model in zip(axes[0], models, strict=True):
        panel(axis, table, model, markers)
        lines, labels = axis.get_legend_handles_labels()
        handles.update(dict(zip(labels, lines, strict=True)))
    axes[0, 0].set_ylabel("worst error in peak d/b (%)")
    figure.legend(handles.values(), handles.keys(), loc="outside right upper", fontsize=7)
    style.save(figure, job.output)


run(main, globals())
