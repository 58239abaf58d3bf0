"""Figures of the study `base_compliance`."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.collapse.probability import KEY
from rocking.figures import style

from .study import BASES, CHOICE, FINE, HALF, STACK

LABELS = {"study": "rigid block, base E/h", "column": "rigid block, the column's base"}
COLOURS = {"study": "#c1440e", "column": "#1f6f8b"}
GRADED = "#2e7d32"


def _draw_static(axis, table):
    """Draw the static curves of the first façade."""
    part = table[table["facade"] == table["facade"].iloc[0]]
    d = part["d_over_b"]
    axis.plot(d, part["lambda_rigid"], ":", color=style.GREY, lw=1.0, label="rigid")
    axis.plot(d, part["lambda_wall"], "k-", lw=1.6, label="elastic column")
    axis.plot(d, part["lambda_courses"], "k+", ms=5, label=f"stack of {FINE} courses")
    for name in BASES:
        axis.plot(d, part[f"lambda_base_{name}"], "--", color=COLOURS[name], label=LABELS[name])
    axis.set(xlabel="top displacement over thickness d/b [-]", ylabel="static multiplier λ [-]")
    axis.set_xlim(0.0, 0.85)
    axis.set_ylim(0.0, None)
    axis.set_title("the study's façade", loc="left")
    axis.legend(fontsize=6.5, frameon=False, loc="upper right")


def _draw_collapse(axis, table):
    """Draw PGA of half collapse on either base against the wall's, a point a curve."""
    curve = [*KEY, "wall"]
    stack = table[table["facade"] == STACK].set_index(curve)
    most = 0.0
    for name in (*BASES, CHOICE):
        part = table[table["facade"] == name].set_index(curve)
        x = stack["pga_median_g"].reindex(part.index)
        mark, colour = ("o", COLOURS[name]) if name in BASES else ("s", GRADED)
        words = LABELS.get(name, f"stack of {name}")
        axis.plot(x, part["pga_median_g"], mark, ms=3, color=colour, label=words)
        most = np.nanmax([most, x.max(), part["pga_median_g"].max()])
    ends = np.array([0.0, 1.1 * most])
    axis.plot(ends, ends, "k-", lw=0.8, zorder=0, label="alike")
    axis.set(xlabel=f"collapse PGA, stack of {STACK} [g]", ylabel="collapse PGA of the model [g]")
    axis.set_xlim(ends)
    axis.set_ylim(ends)
    models = ", ".join(table["model"].unique())
    axis.set_title(f"half collapse, {models}", loc="left")
    axis.legend(fontsize=6.5, frameon=False, loc="upper left")


def _draw_cost(axis, table):
    """Draw the error of half collapse, median and 10 to 90 %, against processor time a curve."""
    others = table[~table["facade"].isin([STACK, HALF])]
    for name, part in others.groupby("facade", sort=False):
        low, middle, high = 100.0 * (part["ratio"].dropna().quantile([0.1, 0.5, 0.9]) - 1.0)
        at, graded = part["cpu_s"].median(), "," in name
        colour = COLOURS.get(name, GRADED if graded else "k")
        axis.plot([at, at], [low, high], "-", color=colour, lw=1.0)
        axis.plot(at, middle, "s" if graded else "o", ms=4, color=colour)
        words = {"study": "block, E/h", "column": "block, column"}.get(name, name)
        end, away = (low, -9) if name in BASES else (high, 3)  # names of neighbours lie apart
        axis.annotate(
            words, (at, end), (0, away), textcoords="offset points", fontsize=6, ha="center"
        )
    axis.axhline(0.0, color="k", lw=0.8, zorder=0)
    for side in (-15.0, 15.0):
        axis.axhline(side, color=style.GREY, lw=0.6, ls=":", zorder=0)
    axis.set_xscale("log")
    axis.margins(y=0.1)
    axis.set(xlabel="processor time of a curve [s]", ylabel="error of half collapse [%]")
    curves = len(table[table["facade"] == STACK])
    axis.xaxis.set_major_formatter("{x:g}")
    axis.xaxis.set_minor_formatter("{x:g}")
    axis.set_title(f"{curves} curves: median, 10 to 90 %; squares: thin at the foot", loc="left")


def draw(static, table):
    """Draw static curves of the study's façade, collapse by the wall's, and error by cost."""
    figure = plt.figure(figsize=(7.2, 6.4), layout="constrained")
    grid = figure.add_gridspec(2, 2)
    _draw_static(figure.add_subplot(grid[0, 0]), static)
    _draw_collapse(figure.add_subplot(grid[0, 1]), table)
    _draw_cost(figure.add_subplot(grid[1, :]), table)
    return figure
