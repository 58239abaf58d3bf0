"""Share of curves against the ratio of collapse intensities: each model over the reference."""

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.figures.panels import common_legend, distribution, ticks
from rocking.runtime.script import run
from rocking.tables import read_frame

from yade_scripts.model.registry import MODELS

PARTS = {"ratio_collapse": "lowest collapse", "ratio_equivalent": "equivalent PGA"}
LINES = ("-", "--", "-.", ":")
TICKS = (0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0)


def main(job):
    table = read_frame(job.input.table)
    reference = job.params.reference
    models = [name for name in table["model"].unique() if name != reference]
    figure, axes = plt.subplots(1, 2, figsize=(6.8, 2.9), sharey=True)
    for axis, (column, words) in zip(axes, PARTS.items(), strict=True):
        for i, name in enumerate(models):
            look = {"color": MODELS[name].colour if name in MODELS else "0.2", "label": name}
            ratio = table.loc[table["model"] == name, column]
            distribution(axis, ratio, ls=LINES[i % len(LINES)], marker=".", ms=3, **look)
        axis.axvline(1.0, color="k", lw=0.7)
        known = [1.0, *table[column].dropna()]
        low, high = min(known), max(known)
        axis.set(xscale="log", xlim=(0.9 * low, 1.1 * high))
        ticks(axis.xaxis, [t for t in TICKS if low <= t <= high])
        axis.set_title(words, loc="left")
        axis.set_xlabel(f"PGA over that of {reference} [-]")
    axes[0].set(ylabel="share of the curves", ylim=(0, 1))
    axes[0].annotate("safe side", (0.02, 0.93), xycoords="axes fraction", fontsize=7)
    axes[1].annotate("unsafe side", (0.98, 0.03), xycoords="axes fraction", fontsize=7, ha="right")
    common_legend(figure, loc="outside upper center", ncols=len(MODELS))
    style.save(figure, job.output, job.input.facts)


run(main, globals())
