"""Collapse PGA with vertical motion over that without, as distribution and by its size."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.curves.vertical import ratios
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import MODELS

LINES = ("-", "--", "-.", ":")
SMALL = {"color": style.GREY, "lw": 0.9}
LOW, HIGH = 0.7, 1.4  # of the ratios that are drawn; further ones stand at the edge


def main(job):
    table = pd.read_csv(job.input.table)
    found = ratios(table)
    found = found[found["measure"] == "median"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.0, 3.4), layout="constrained")
    for i, model in enumerate(dict.fromkeys(found["model"])):
        kind, ls = MODELS[model], LINES[i % len(LINES)]
        of_model = found[found["model"] == model]
        for share, look, label in (
            ("hundredth", SMALL, f"{model}, a hundredth of it"),
            ("whole", {"color": kind.colour}, model),
        ):
            part = of_model[of_model["vertical"] == share].dropna(subset="ratio")
            ratio = np.clip(np.sort(part["ratio"]), LOW, HIGH)
            shares = (np.arange(len(ratio)) + 0.5) / len(ratio)
            left.plot(ratio, shares, ls=ls, drawstyle="steps-mid", label=label, **look)
        right.plot(
            part["vertical_over_horizontal"],
            np.clip(part["ratio"], LOW, HIGH),
            ls="",
            marker=kind.marker,
            ms=4,
            mfc="none" if i % 2 else kind.colour,
            color=kind.colour,
            label=model,
        )
    left.axvline(1.0, color=style.GREY, lw=0.8, zorder=0)
    right.axhline(1.0, color=style.GREY, lw=0.8, zorder=0)
    label = "collapse PGA, with over without vertical motion [-]"
    left.set(xscale="log", xlim=(LOW, HIGH), ylim=(0, 1), ylabel="share of curves [-]")
    right.set(
        yscale="log", ylim=(LOW / 1.03, HIGH * 1.03), xlabel="PGA, vertical over horizontal [-]"
    )
    ticks = (0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.4)
    for axis, name in ((left, "x"), (right, "y")):
        axis.minorticks_off()
        axis.set(**{f"{name}ticks": ticks, f"{name}ticklabels": [f"{t:g}" for t in ticks]})
        axis.set(**{f"{name}label": label})
    left.legend(loc="upper left", fontsize=7)
    right.legend(loc="upper right", fontsize=7)
    figure.suptitle(f"{table['record'].nunique()} components with their vertical motions")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
