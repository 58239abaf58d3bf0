"""Figures of the study `overturning`."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures.panels import common_legend, intervals

from .study import HALVES

TITLES = {"geometry": "from geometry alone", "fitted": "two fitted numbers a block"}
COLOURS = dict(zip((*HALVES, ""), ("#0072B2", "#D55E00", "0.45"), strict=True))
ASIDE = 0.012  # between two halves with the same probability


def draw(table):
    """Draw the share that fell by predicted probability, with how many should have."""
    models = list(dict.fromkeys(table["model"]))
    size = (3.4 * len(models), 3.6)
    figure, axes = plt.subplots(1, len(models), figsize=size, squeeze=False, sharey=True)
    for axis, model in zip(axes.flat, models, strict=True):
        axis.plot([0, 1], [0, 1], "-", c="0.8", lw=0.8, zorder=0)
        halves = list(table.loc[table["model"] == model, "half"].fillna("").unique())
        for k, half in enumerate(halves):
            bins = table[(table["model"] == model) & (table["half"].fillna("") == half)]
            bins = bins[bins["tests"] > 0]
            _draw_half(axis, bins, half, ASIDE * (2 * k - len(halves) + 1))
        axis.set(title=TITLES.get(model, model), xlabel="predicted probability of a fall", aspect=1)
        axis.set(xlim=(-0.04, 1.04), ylim=(-0.04, 1.04))
    axes[0, 0].set_ylabel("share that fell")
    common_legend(figure, ncols=3, loc="outside lower center")
    return figure


def _draw_half(axis, bins, half, aside):
    """One bar a bin, of what should have fallen, and a dot for what did, hollow outside of it."""
    count, colour = bins["tests"].to_numpy(float), COLOURS[half]
    place = bins["foreseen"].to_numpy(float) / count + aside
    middle, low, high = (
        bins[name].to_numpy(float) / count for name in ("foreseen", "least", "most")
    )
    said = f" ({half})" if half else ""
    intervals(
        axis, place, middle, low, high, c=colour, lw=1.4, label=f"should have fallen, 90 %{said}"
    )
    fell = bins["fell"].to_numpy(float) / count
    if np.isnan(fell).all():
        return
    inside = (bins["within"] == "yes").to_numpy()
    for within, fill, word in ((True, colour, "fell"), (False, "none", "fell, outside of that")):
        mine = inside == within
        if mine.any():
            look = {"c": colour, "mfc": fill, "ms": 6, "label": f"{word}{said}"}
            axis.plot(place[mine], fell[mine], "o", **look)
