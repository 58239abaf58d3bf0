"""Figures of the study `limits`."""

import matplotlib.pyplot as plt
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch
from rocking.figures.panels import heat_map

from .study import ORDER

COLOURS = ("#c7e3d4", "#e3edc7", "#f2d184", "#d1603d", "#9d7bb5", "#4d4d4d", "#e4e4e4")
MARKS = dict(zip(ORDER, ("", "1", "~", "≠", "$", "×", "–"), strict=True))
UNITS = {"gap [mm]": 1e3, "walls' mass [t]": 1e-3}  # of an axis, as factors


def _draw_panel(axis, grid, **labels):
    """Draw one grid of verdicts as coloured squares with their marks."""

    codes = grid.map(lambda v: ORDER.index(v) if v in ORDER else float("nan"))
    marks = grid.map(lambda v: MARKS.get(v, ""))
    heat_map(axis, codes, marks, cmap=ListedColormap(COLOURS), vmin=-0.5, vmax=6.5)
    axis.set(**labels)


def draw(table):
    """Draw what becomes of each cell: refused, agreed upon, disagreed upon, not repeating."""
    plan = table[table["axis"] == "height [m]"]
    others = [name for name in dict.fromkeys(table["axis"]) if name != "height [m]"]
    figure = plt.figure(figsize=(7.2, 2.6 + 0.62 * len(others)))
    heights = [2.4, 0.62 * len(others)]
    (top,), (bottom,) = figure.subfigures(2, 1, squeeze=False, height_ratios=heights)
    for axis, model in zip(top.subplots(1, 2, sharey=True), ("W1", "W2"), strict=True):
        part = plan[plan["model"] == model]
        grid = part.pivot(index="thickness_m", columns="value", values="verdict")
        _draw_panel(axis, grid, title=model, xlabel="height [m]", ylabel="thickness [m]")
    for axis, name in zip(bottom.subplots(len(others), 1), others, strict=True):
        part = table[table["axis"] == name]
        part = part.assign(value=part["value"] * UNITS.get(name, 1.0))
        _draw_panel(axis, part.pivot(index="model", columns="value", values="verdict"))
        axis.set_ylabel(name, rotation=0, ha="right", va="center", labelpad=28)
    handles = [Patch(color=c, label=f"{v} {MARKS[v]}") for v, c in zip(ORDER, COLOURS, strict=True)]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=7)
    return figure
