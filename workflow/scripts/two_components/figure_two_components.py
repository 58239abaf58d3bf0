"""Collapse under both components over that of the planar scene, and what moves it."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import MODELS


def main(job):
    table = pd.read_csv(job.input.table)
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.4, 3.4))
    lines = (("-", ":"), ("--", "-."))
    for i, (model, part) in enumerate(table.groupby("model", sort=True)):
        look = {"color": MODELS[model].colour, "drawstyle": "steps-mid"}
        both, again = lines[i % len(lines)]
        for column, label, line in (("two_g", "both", both), ("again_g", "repeated", again)):
            ratio = np.sort((part[column] / part["one_g"]).dropna())
            shares = (np.arange(len(ratio)) + 0.5) / max(len(ratio), 1)
            left.plot(ratio, shares, ls=line, label=f"{model}, {label}", **look)
        right.plot(
            part["half_g"] * part["second_ratio"],
            part["d_two"] / part["d_one"],
            ls="",
            marker=MODELS[model].marker,
            ms=4,
            alpha=0.8,
            color=MODELS[model].colour,
            label=model,
        )
    left.set(
        xlabel="collapse PGA over that of one component [-]",
        ylabel="share of curves [-]",
        ylim=(0, 1),
    )
    right.set(
        xlabel="PGA along the façade [g]",
        ylabel="d/b, both over one component [-]",
        title="at half the planar collapse",
    )
    for axis, line in ((left, left.axvline), (right, right.axhline)):
        line(1.0, color=style.GREY, lw=0.8, zorder=0)
        axis.legend(loc="best", fontsize=7)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
