"""Collapse of surrogates over that of their records, and whether the weak side is the same."""

import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.figures.panels import distribution, panels, ticks
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
    size, around = (2.2, 3.0 if not both else 2.7), (2.2, 0.0)
    count = (1 + both) * len(kinds)
    figure, axes = panels(count, len(kinds), size, around, sharex="row", sharey="row")
    for column, pulses in enumerate(kinds):
        top = axes[0, column]
        for i, model in enumerate(models):
            colour = MODELS[model].colour
            part = found[(found["pulses"] == pulses) & (found["model"] == model)]
            facts = trust.loc[model, pulses]
            label = f"{model}: {facts['ratio_median']:.2f}, scatter {facts['scatter']:.2f}"
            look = {"color": colour, "ls": ("-", "--")[i % 2], "drawstyle": "steps-mid"}
            distribution(top, part["ratio"], label=label, **look)
            known = sides(part)
            if known is None:
                continue
            x, y = (known[name] / np.log(2.0) for name in ("recorded", "surrogate"))
            look = {"marker": MODELS[model].marker, "ms": 4, "alpha": 0.8, "color": colour}
            axes[1, column].plot(x, y, ls="", label=model, **look)
        top.axvline(1.0, color=style.GREY, lw=0.8, zorder=0)
        top.set(xscale="log", title=title(pulses), ylim=(0, 1))
        ticks(top.xaxis, (0.33, 0.5, 1.0, 2.0, 3.0), ("1/3", "1/2", "1", "2", "3"))
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
