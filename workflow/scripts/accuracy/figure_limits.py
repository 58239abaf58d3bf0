"""Map of what becomes of each cell: refused, agreed upon, disagreed upon, not repeating."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch
from rocking.figures import style
from rocking.runtime.script import run
from rocking.studies.limits import ORDER

COLOURS = ("#c7e3d4", "#e3edc7", "#f2d184", "#d1603d", "#9d7bb5", "#4d4d4d", "#e4e4e4")
MARKS = dict(zip(ORDER, ("", "1", "~", "≠", "$", "×", "–"), strict=True))


def panel(axis, grid, across, up, labels):
    """One grid of verdicts as coloured squares with their marks."""
    codes = np.array([[ORDER.index(v) if v in ORDER else np.nan for v in row] for row in grid])
    axis.imshow(
        codes, origin="lower", aspect="auto", cmap=ListedColormap(COLOURS), vmin=-0.5, vmax=6.5
    )
    for (i, j), code in np.ndenumerate(codes):
        if np.isfinite(code):
            axis.text(j, i, MARKS[ORDER[int(code)]], ha="center", va="center", fontsize=7)
    axis.set_xticks(range(len(across)), [f"{v:g}" for v in across], fontsize=7)
    axis.set_yticks(range(len(up)), [v if isinstance(v, str) else f"{v:g}" for v in up])
    axis.tick_params(length=0)
    axis.grid(False)
    axis.set(**labels)


def main(job):
    table = pd.read_csv(job.input.table)
    plan = table[table["axis"] == "height [m]"]
    others = [name for name in dict.fromkeys(table["axis"]) if name != "height [m]"]
    figure = plt.figure(figsize=(7.2, 2.6 + 0.62 * len(others)), layout="constrained")
    top, bottom = figure.subfigures(2, 1, height_ratios=[2.4, 0.62 * len(others)])
    for axis, model in zip(top.subplots(1, 2, sharey=True), ("W1", "W2"), strict=True):
        part = plan[plan["model"] == model]
        grid = part.pivot(index="thickness_m", columns="value", values="verdict")
        labels = {"title": model, "xlabel": "height [m]", "ylabel": "thickness [m]"}
        panel(axis, grid.to_numpy(), grid.columns, grid.index, labels)
    for axis, name in zip(bottom.subplots(len(others), 1), others, strict=True):
        part = table[table["axis"] == name]
        grid = part.pivot(index="model", columns="value", values="verdict")
        values = grid.columns * {"gap [mm]": 1e3, "walls' mass [t]": 1e-3}.get(name, 1.0)
        panel(axis, grid.to_numpy(), values, grid.index, {})
        axis.set_ylabel(name, rotation=0, ha="right", va="center", labelpad=28)
    handles = [Patch(color=c, label=f"{v} {MARKS[v]}") for v, c in zip(ORDER, COLOURS, strict=True)]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=7)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
