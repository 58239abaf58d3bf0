"""Figure of the study `surrogates`."""

import numpy as np
from rocking.figures import style
from rocking.figures.panels import distribution, panels, ticks

from yade_scripts.model.registry import MODELS

from .study import pairs, sides


def _draw_title(pulses):
    """Say which surrogates a panel has."""
    return "peaks alone" if pulses == 0 else f"peaks and {pulses:g} pulses"


def draw(table, summary):
    """Draw collapse of surrogates over that of their records, and the weak sides of both."""
    surrogates = pairs(table)
    trust = summary[summary["half"] == "all"].set_index(["model", "pulses"])
    kinds = sorted(surrogates["pulses"].unique())
    models = list(dict.fromkeys(surrogates["model"]))
    both = surrogates["direction"].nunique() > 1  # else no side is the weak one
    size, around = (2.2, 3.0 if not both else 2.7), (2.2, 0.0)
    count = (1 + both) * len(kinds)
    figure, axes = panels(count, len(kinds), size, around, sharex="row", sharey="row")
    for column, pulses in enumerate(kinds):
        top = axes[0, column]
        for i, model in enumerate(models):
            kind = MODELS[model]
            part = surrogates[(surrogates["pulses"] == pulses) & (surrogates["model"] == model)]
            facts = trust.loc[model, pulses]
            label = f"{model}: {facts['ratio_median']:.2f}, scatter {facts['scatter']:.2f}"
            look = {"color": kind.colour, "ls": ("-", "--")[i % 2], "drawstyle": "steps-mid"}
            distribution(top, part["ratio"], label=label, **look)
            known = sides(part)
            if known is None:
                continue
            x, y = (known[name] / np.log(2.0) for name in ("recorded", "surrogate"))
            look = {"color": kind.colour, "label": model}
            axes[1, column].plot(x, y, kind.marker, ms=4, alpha=0.8, **look)
        top.axvline(1.0, color=style.GREY, lw=0.8, zorder=0)
        top.set(xscale="log", title=_draw_title(pulses), ylim=(0, 1))
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
    records = surrogates["record"].nunique()
    figure.suptitle(f"recorded components: {records}\nand surrogates of theirs")
    return figure
