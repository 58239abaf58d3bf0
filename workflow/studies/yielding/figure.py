"""Figures of the study `yielding`."""

import numpy as np
from rocking.figures import style
from rocking.figures.panels import panels

from studies.yielding.study import ELASTIC
from yade_scripts.model.registry import MODELS

LINES = {"bilinear": "-", "peak_oriented": "--", "origin_oriented": ":", "flag": "-."}


def draw(summary):
    """Draw the loss from W1 against the building's strength, and what falls first."""
    of_period = _own_period(summary)
    models = list(dict.fromkeys(of_period["model"]))
    mapped = summary["period_s"].nunique() > 1
    count = len(models) + 1
    figure, axes = panels(count, count, (2.7, 2.7), around=(0.9, 0.9))
    for axis, model in zip(axes.flat, models, strict=False):
        _loss(axis, of_period[of_period["model"] == model], MODELS[model])
    lows, highs = zip(*(axis.get_ylim() for axis in axes.flat[: len(models)]), strict=True)
    for axis in axes.flat[: len(models)]:
        axis.set_ylim(min(lows), max(highs))
    last = axes.flat[len(models)]
    if mapped:
        _map(figure, last, summary[summary["model"] == models[-1]])
    else:
        _first(last, of_period, models)
    return figure


def _own_period(summary):
    """Rows at the period of the run, which W1 was run at too."""
    return summary[summary["own_period"] == 1]


def _loss(axis, part, kind):
    """Draw one model's loss against V/W, and the elastic one as a level."""
    elastic = part[part["loops"] == ELASTIC].iloc[0]
    low, high = 100.0 * elastic["loss_low"], 100.0 * elastic["loss_high"]
    axis.axhline(100.0 * elastic["loss"], color="0.3", lw=1.0, label="elastic")
    if np.isfinite(low):
        axis.axhspan(low, high, color="0.85", lw=0.0, zorder=0)
    for k, (loops, rows) in enumerate(part[part["loops"] != ELASTIC].groupby("loops", sort=False)):
        rows = rows.sort_values("base_shear_ratio")
        x = rows["base_shear_ratio"] * (1.0 + 0.02 * (k - 1))
        size = np.abs(
            100.0 * (rows[["loss_low", "loss_high"]].T.to_numpy() - rows["loss"].to_numpy())
        )
        form = {"color": kind.colour, "ls": LINES[loops], "marker": kind.marker, "ms": 4.0}
        axis.errorbar(
            x, 100.0 * rows["loss"], size, lw=1.2, elinewidth=0.6, label=_words(loops), **form
        )
    axis.set_xscale("log")
    ticks = sorted(set(part["base_shear_ratio"].dropna()))
    axis.set_xticks(ticks, [f"{x:g}" for x in ticks])
    axis.minorticks_off()
    axis.axhline(0.0, color=style.GREY, lw=0.6, zorder=0)
    axis.set(xlabel="strength of the building V/W [-]", ylabel="loss of PGA from W1 [%]")
    axis.set_title(kind.name, loc="left")
    axis.legend(fontsize=7, loc="lower left")


def _first(axis, of_period, models):
    """Draw the share of curves in which the building falls first, at the run's period."""
    for model in models:
        kind, part = (
            MODELS[model],
            of_period[(of_period["model"] == model) & (of_period["loops"] != ELASTIC)],
        )
        for loops, rows in part.groupby("loops", sort=False):
            rows = rows.sort_values("base_shear_ratio")
            form = {"color": kind.colour, "ls": LINES[loops], "marker": kind.marker, "ms": 4.0}
            x, y = rows["base_shear_ratio"], 100.0 * rows["building_first"]
            axis.plot(x, y, lw=1.0, label=f"{model}, {_words(loops)}", **form)
    axis.set_xscale("log")
    ticks = sorted(set(of_period["base_shear_ratio"].dropna()))
    axis.set_xticks(ticks, [f"{x:g}" for x in ticks])
    axis.minorticks_off()
    axis.set(xlabel="strength of the building V/W [-]", ylabel="building first [% of curves]")
    axis.set(ylim=(-3.0, 103.0))
    axis.set_title("which falls first", loc="left")
    axis.legend(fontsize=6)


def _map(figure, axis, part):
    """Draw the share of curves in which the building falls first, over V/W and T1.

    A line parts where that is more than half of them from where the façade is mostly first.
    """
    part = part[part["loops"] == part.loc[part["loops"] != ELASTIC, "loops"].iloc[0]]
    table = part.pivot_table(index="period_s", columns="base_shear_ratio", values="building_first")
    shown = axis.imshow(
        100.0 * table, origin="lower", aspect="auto", cmap="RdBu_r", vmin=0, vmax=100
    )
    axis.set_xticks(range(table.shape[1]), [f"{x:g}" for x in table.columns])
    axis.set_yticks(range(table.shape[0]), [f"{y:g}" for y in table.index])
    for (i, j), share in np.ndenumerate(table.to_numpy()):
        look = {"color": "w" if abs(share - 0.5) > 0.35 else "k", "fontsize": 7}
        axis.annotate(f"{100.0 * share:.0f}", (j, i), ha="center", va="center", **look)
    share = table.to_numpy()
    if share.min() < 0.5 < share.max():
        axis.contour(share, levels=[0.5], colors="k", linewidths=1.2)
    axis.grid(visible=False)
    axis.set(xlabel="strength of the building V/W [-]", ylabel="first period T1 [s]")
    axis.set_title(f"building first [% of curves], {part['model'].iloc[0]}", loc="left", fontsize=8)
    figure.colorbar(shown, ax=axis, shrink=0.8)


def _words(loops):
    return loops.replace("_", "-")
