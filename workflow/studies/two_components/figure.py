"""Figures of the study `two_components`."""

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.figures.panels import distribution

from yade_scripts.model.registry import MODELS


def draw(table):
    """Draw collapse under both components over that of the planar scene, and what moves it."""

    figure, (left, right) = plt.subplots(1, 2, figsize=(7.4, 3.4))
    lines = (("-", ":"), ("--", "-."))
    for i, (model, part) in enumerate(table.groupby("model", sort=True)):
        kind = MODELS[model]
        look = {"color": kind.colour, "drawstyle": "steps-mid"}
        both, again = lines[i % len(lines)]
        for column, label, line in (("two_g", "both", both), ("again_g", "repeated", again)):
            ratio = part[column] / part["one_g"]
            distribution(left, ratio, ls=line, label=f"{model}, {label}", **look)
        x, y = part["half_g"] * part["second_ratio"], part["d_two"] / part["d_one"]
        right.plot(x, y, kind.marker, color=kind.colour, alpha=0.8, ms=4, label=model)
    left.set(xlabel="collapse PGA over that of one component [-]")
    left.set(ylabel="share of curves [-]", ylim=(0, 1))
    right.set(xlabel="PGA along the façade [g]", ylabel="d/b, both over one component [-]")
    right.set_title("at half the planar collapse")
    for axis, line in ((left, left.axvline), (right, right.axhline)):
        line(1.0, color=style.GREY, lw=0.8, zorder=0)
        axis.legend(loc="best", fontsize=7)
    return figure
