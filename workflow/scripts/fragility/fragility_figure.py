"""Fragility curves with bands, a panel an intensity measure; steps are the records themselves."""

from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib import ticker
from rocking.figures import style
from rocking.records.intensity_measures import MEASURES
from rocking.runtime.script import run
from rocking.stations import heading
from scipy import stats

from yade_scripts.model.registry import MODELS

LINES = ("-", "--", "-.")


def steps(part):
    """Kaplan–Meier estimate over the middles of the brackets; None without a collapse."""
    collapsed = np.isfinite(part["high"]) & (part["low"] > 0)
    if not collapsed.any():
        return None
    middle = np.sqrt(part["low"][collapsed] * part["high"][collapsed])
    never = part["low"][np.isinf(part["high"])]
    return stats.ecdf(stats.CensoredData(uncensored=middle, right=never)).cdf


def main(job):
    fits = pd.read_csv(job.input.fragility)
    curves = pd.read_csv(job.input.curves)
    brackets = pd.read_csv(job.input.brackets)
    names = list(dict.fromkeys(fits["im"]))
    columns = min(2, len(names))
    rows = -(-len(names) // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(3.5 * columns, 0.5 + 2.3 * rows), squeeze=False, sharey=True
    )
    for axis, name in zip(axes.flat, names, strict=False):
        for (_, fit), line in zip(fits[fits["im"] == name].iterrows(), cycle(LINES), strict=False):
            colour = MODELS[fit["model"]].colour
            of_fit = (curves["model"] == fit["model"]) & (curves["im"] == name)
            curve = curves[of_fit]
            data = steps(brackets[(brackets["model"] == fit["model"]) & (brackets["im"] == name)])
            if data is not None:
                axis.step(
                    data.quantiles, data.probabilities, where="post", color=colour, lw=0.8, ls=":"
                )
            if curve.empty:
                continue
            axis.fill_between(
                curve["intensity"],
                curve["band_low"],
                curve["band_high"],
                color=colour,
                alpha=0.18,
                lw=0,
            )
            label = f"{fit['model']}: {fit['median']:.3g}, β {fit['dispersion']:.2f}"
            axis.plot(curve["intensity"], curve["probability"], line, color=colour, label=label)
        axis.set_xscale("log")
        spread = curves.loc[
            (curves["im"] == name) & curves["probability"].between(0.005, 0.995), "intensity"
        ]
        if len(spread):
            axis.set_xlim(spread.min(), spread.max())
        plain(axis)
        axis.set(xlabel=MEASURES[name].label, ylim=(0, 1))
        if axis.get_legend_handles_labels()[0]:
            axis.legend(
                loc="upper left",
                title=f"median [{MEASURES[name].unit}], dispersion",
                title_fontsize=7,
            )
        else:
            axis.text(0.5, 0.5, "not determined", transform=axis.transAxes, ha="center")
    for axis in list(axes.flat)[len(names) :]:
        axis.remove()
    for axis in axes[:, 0]:
        axis.set_ylabel("probability of collapse [-]")
    many = brackets["record"].nunique(), brackets["station"].nunique()
    words = f"{100 * job.params.confidence:g} % bands"
    figure.suptitle(heading(*many, words, job.params.min_stations))
    style.save(figure, job.output, job.input.facts)


def plain(axis):
    """Label a short logarithmic axis with plain numbers at 1, 2 and 5."""
    axis.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.xaxis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:g}"))
    axis.xaxis.set_minor_formatter(ticker.NullFormatter())


run(main, globals())
