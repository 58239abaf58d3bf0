"""Collapse of surrogates over that of their records, and whether the weak side is the same."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run
from rocking.studies.surrogate_trust import pairs, sides

from yade_scripts.model.registry import MODELS


def title(pulses):
    return "peaks alone" if pulses == 0 else f"peaks and {pulses:g} pulses"


def main(job):
    table = pd.read_csv(job.input.table)
    found = pairs(table)
    trust = pd.read_csv(job.input.summary)
    trust = trust[trust["half"] == "all"].set_index(["model", "pulses"])
    kinds = sorted(found["pulses"].unique())
    models = list(dict.fromkeys(found["model"]))
    both = found["direction"].nunique() > 1  # else no side is the weak one
    figure, axes = plt.subplots(
        1 + both,
        len(kinds),
        figsize=(2.2 + 2.2 * len(kinds), 3.0 + 2.4 * both),
        sharex="row",
        sharey="row",
        squeeze=False,
    )
    for column, pulses in enumerate(kinds):
        top = axes[0, column]
        for i, model in enumerate(models):
            colour = MODELS[model].colour
            part = found[(found["pulses"] == pulses) & (found["model"] == model)]
            ratio = np.sort(part["ratio"].dropna())
            facts = trust.loc[model, pulses]
            label = f"{model}: {facts['ratio_median']:.2f}, scatter {facts['scatter']:.2f}"
            shares = (np.arange(len(ratio)) + 0.5) / len(ratio)
            look = {"color": colour, "ls": ("-", "--")[i % 2], "drawstyle": "steps-mid"}
            top.plot(ratio, shares, label=label, **look)
            known = sides(part)
            if known is None:
                continue
            x, y = (known[name] / np.log(2.0) for name in ("recorded", "surrogate"))
            marker = MODELS[model].marker
            axes[1, column].plot(
                x, y, ls="", marker=marker, ms=4, alpha=0.8, label=model, color=colour
            )
        top.axvline(1.0, color=style.GREY, lw=0.8, zorder=0)
        top.set(xscale="log", title=title(pulses), ylim=(0, 1))
        top.set_xticks([0.33, 0.5, 1.0, 2.0, 3.0], ["1/3", "1/2", "1", "2", "3"])
        top.minorticks_off()
        top.set_xlabel("collapse PGA, surrogate / recorded [-]")
        top.legend(loc="lower right", fontsize=7)
        for bottom in axes[1:, column]:
            for line in (bottom.axhline, bottom.axvline):
                line(0.0, color=style.GREY, lw=0.8, zorder=0)
            bottom.set_xlabel("log₂(pos/neg), recorded [-]")
    axes[0, 0].set_ylabel("share of curves [-]")
    if both:
        axes[1, 0].set_ylabel("log₂(pos/neg), surrogate [-]")
        axes[1, 0].legend(loc="lower right", fontsize=7)
    records = found["record"].nunique()
    figure.suptitle(f"{records} recorded components\nand surrogates of theirs")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
