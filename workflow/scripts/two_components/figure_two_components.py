"""Collapse under both components over that of the planar scene, and what moves it."""

import matplotlib.pyplot as plt
import pandas as pd
from rocking.figures import style
from rocking.figures.panels import distribution
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
            ratio = part[column] / part["one_g"]
            distribution(left, ratio, ls=line, label=f"{model}, {label}", **look)
        look = {"color": MODELS[model].colour, "marker": MODELS[model].marker, "alpha": 0.8}
        x, y = part["half_g"] * part["second_ratio"], part["d_two"] / part["d_one"]
        right.plot(x, y, ls="", ms=4, label=model, **look)
    left.set(xlabel="collapse PGA over that of one component [-]")
    left.set(ylabel="share of curves [-]", ylim=(0, 1))
    right.set(xlabel="PGA along the façade [g]", ylabel="d/b, both over one component [-]")
    right.set_title("at half the planar collapse")
    for axis, line in ((left, left.axvline), (right, right.axhline)):
        line(1.0, color=style.GREY, lw=0.8, zorder=0)
        axis.legend(loc="best", fontsize=7)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
