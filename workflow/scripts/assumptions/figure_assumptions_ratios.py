"""Share of curves against the ratio of collapse intensities: each model over the reference."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.ticker import FormatStrFormatter, NullFormatter
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import MODELS

PARTS = {"ratio_collapse": "lowest collapse", "ratio_median": "half collapse"}


def main(job):
    table = pd.read_csv(job.input.table)
    reference = job.params.reference
    models = [name for name in table["model"].unique() if name != reference]
    figure, axes = plt.subplots(1, 2, figsize=(6.8, 2.9), sharey=True)
    for axis, (column, words) in zip(axes, PARTS.items(), strict=True):
        low, high = 1.0, 1.0
        for i, name in enumerate(models):
            ratio = np.sort(table.loc[table["model"] == name, column].dropna())
            if not ratio.size:
                continue
            share = (np.arange(ratio.size) + 0.5) / ratio.size
            colour = MODELS[name].colour if name in MODELS else "0.2"
            line = ("-", "--", "-.", ":")[i % 4]
            axis.plot(ratio, share, ls=line, marker=".", ms=3, color=colour, label=name)
            low, high = min(low, ratio[0]), max(high, ratio[-1])
        axis.axvline(1.0, color="k", lw=0.7)
        axis.set_xscale("log")
        axis.set_xlim(0.9 * low, 1.1 * high)
        ticks = [t for t in (0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0) if low <= t <= high]
        axis.set_xticks(ticks or [1.0])
        axis.xaxis.set_major_formatter(FormatStrFormatter("%g"))
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.set_title(words, loc="left")
        axis.set_xlabel(f"PGA over that of {reference} [-]")
    axes[0].set(ylabel="share of the curves", ylim=(0, 1))
    axes[0].annotate("safe side", (0.02, 0.93), xycoords="axes fraction", fontsize=7)
    axes[1].annotate("unsafe side", (0.98, 0.03), xycoords="axes fraction", fontsize=7, ha="right")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=max(1, len(labels)))
    style.save(figure, [job.output.png, job.output.pdf], job.input.facts)


run(main, globals())
