"""Figures of the study `vertical`."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import distribution, ticks

from yade_scripts.model.registry import MODELS

from .study import ratios

LINES = ("-", "--", "-.", ":")
LEAST = 1.4  # the axes of ratios reach so far to both sides of one, or to the last ratio
TICKS = (0.1, 0.2, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.4, 1.7, 2.0, 3.0, 5.0, 10.0)


def draw(table):
    """Draw collapse PGA with over without vertical motion: its distribution, and by its size."""

    curves = ratios(table)
    curves = curves[curves["measure"] == "median"]
    reach = max(LEAST, 1.03 * float(np.exp(np.log(curves["ratio"]).abs().max())))
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.0, 3.4))
    for i, model in enumerate(dict.fromkeys(curves["model"])):
        kind, ls = MODELS[model], LINES[i % len(LINES)]
        of_model = curves[curves["model"] == model]
        for share, look, label in (
            ("hundredth", {"color": style.GREY, "lw": 0.9}, f"{model}, a hundredth of it"),
            ("whole", {"color": kind.colour}, model),
        ):
            part = of_model[of_model["vertical"] == share]
            look = {"ls": ls, "drawstyle": "steps-mid", "label": label, **look}
            distribution(left, part["ratio"], **look)
        look = {"color": kind.colour, "mfc": "none" if i % 2 else kind.colour, "label": model}
        x, y = part["vertical_over_horizontal"], part["ratio"]
        right.plot(x, y, ls="", marker=kind.marker, ms=4, **look)
    left.axvline(1.0, color=style.GREY, lw=0.8, zorder=0)
    right.axhline(1.0, color=style.GREY, lw=0.8, zorder=0)
    label = "collapse PGA, with over without vertical motion [-]"
    left.set(ylim=(0, 1), ylabel="share of curves [-]")
    right.set(xlabel="PGA, vertical over horizontal [-]")
    left.set(xscale="log", xlim=(1.0 / reach, reach), xlabel=label)
    right.set(yscale="log", ylim=(1.0 / reach, reach), ylabel=label)
    for side in (left.xaxis, right.yaxis):
        ticks(side, [t for t in TICKS if 1.0 / reach < t < reach])
    left.legend(loc="upper left", fontsize=7)
    right.legend(loc="upper right", fontsize=7)
    figure.suptitle(f"components with their vertical motions: {table['record'].nunique()}")
    return figure
