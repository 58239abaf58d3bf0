"""Figures of the study `surrogates`."""

import numpy as np
from rocking.figures import style
from rocking.figures.panels import common_legend, distribution, panels, plain_log, ticks

from yade_scripts.model.registry import MODELS

from .study import pairs, sides


def _draw_title(pulses):
    """Say which surrogates a panel has; a number below zero: of a table's parameters."""
    if pulses < 0:
        return "parameters of the table"
    return "peaks alone" if pulses == 0 else f"peaks and {pulses:g} pulses"


def draw(table, summary):
    """Draw collapse of surrogates over that of their records, and the weak sides of both."""
    found = pairs(table)
    trust = summary[summary["half"] == "all"].set_index(["model", "pulses"])
    kinds = sorted(found["pulses"].unique())
    models = list(dict.fromkeys(found["model"]))
    both = found["direction"].nunique() > 1  # else no side is the weak one
    size, around = (2.2, 3.0 if not both else 2.7), (2.2, 0.0)
    count = (1 + both) * len(kinds)
    figure, axes = panels(count, len(kinds), size, around, sharex="row", sharey="row")
    for column, pulses in enumerate(kinds):
        top = axes[0, column]
        for i, model in enumerate(models):
            kind = MODELS[model]
            part = found[(found["pulses"] == pulses) & (found["model"] == model)]
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
    records = found["record"].nunique()
    figure.suptitle(f"recorded components: {records}\nand surrogates of theirs")
    return figure


def draw_scatter(table):
    """Draw collapse under draws that differ in their noise alone, and under the record."""
    found = pairs(table)
    found["pulses"] = found["pulses"].fillna(-1)
    kinds, models = sorted(found["pulses"].unique()), list(dict.fromkeys(found["model"]))
    rows = list(dict.fromkeys(zip(found["record"], found["direction"], strict=True)))
    size, around = (2.4, 0.42 * len(rows)), (2.4, 1.0)
    figure, axes = panels(len(kinds), len(kinds), size, around, sharex=True, sharey=True)
    for axis, pulses in zip(axes.flat, kinds, strict=True):
        groups = found[found["pulses"] == pulses].groupby(["record", "direction", "model"])
        for (record, direction, model), group in groups:
            kind, beside = MODELS[model], models.index(model) - 0.5 * (len(models) - 1)
            place = rows.index((record, direction)) + 0.36 * beside
            half, most = group["pga_half_g"], group["pga_max_g"]
            look = {"color": kind.colour, "marker": kind.marker, "ls": "", "alpha": 0.6}
            for values, face in ((half, kind.colour), (most[half.isna()], "none")):
                label = f"{model}, draws" if face != "none" else None
                axis.plot(values, np.full(len(values), place), mfc=face, label=label, **look)
            recorded = group["recorded_g"].iloc[0]
            if np.isfinite(recorded):
                ends = place - 0.16, place + 0.16
                axis.vlines(recorded, *ends, color="k", lw=1.8, label="recorded")
            said = f"{np.log(half).std():.2f}"
            axis.annotate(
                said, (1.0, place), (2, 0), ("axes fraction", "data"), "offset points", va="center"
            )
        axis.set_title(_draw_title(pulses), loc="left")
        axis.set(xscale="log", xlabel="collapse PGA [g]")
        plain_log(axis.xaxis, (1.0, 2.0, 3.0, 5.0))
    names = [f"{record} {style.SIGNS[direction]}" for record, direction in rows]
    axes[0, 0].set_yticks(range(len(rows)), names)
    axes[0, 0].invert_yaxis()
    common_legend(figure, loc="outside upper center", ncols=3)
    return figure
