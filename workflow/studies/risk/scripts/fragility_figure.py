"""Fragility curves with bands, a panel an intensity measure; dotted, the share that falls there."""

from itertools import cycle

import numpy as np
from rocking.figures import style
from rocking.figures.panels import band, panels, plain_log
from rocking.records.intensity_measures import MEASURES
from rocking.runtime.script import run
from rocking.stations import heading
from rocking.tables import read_frame

from yade_scripts.model.registry import MODELS

LINES = ("-", "--", "-.")
TICKS = ((50.0, (1.0, 2.0, 5.0)), (500.0, (1.0, 3.0)), (np.inf, (1.0,)))  # by the axis' range


def main(job):
    fits = read_frame(job.input.fragility)
    curves = read_frame(job.input.curves)
    brackets = read_frame(job.input.brackets)
    names = list(dict.fromkeys(fits["im"]))
    figure, axes = panels(len(names), 2, (3.5, 2.3), around=(0.0, 0.5), sharey=True)
    for axis, name in zip(axes.flat, names, strict=False):
        for (_, fit), line in zip(fits[fits["im"] == name].iterrows(), cycle(LINES), strict=False):
            colour = MODELS[fit["model"]].colour
            curve = curves[(curves["model"] == fit["model"]) & (curves["im"] == name)]
            if curve.empty:
                continue
            axis.plot(curve["intensity"], curve["share"], color=colour, lw=0.8, ls=":")
            label = f"{fit['model']}: {fit['median']:.3g}, β {fit['dispersion']:.2f}"
            drawn = (curve[key] for key in ("intensity", "probability", "band_low", "band_high"))
            band(axis, *drawn, colour, alpha=0.18, ls=line, label=label)
        axis.set_xscale("log")
        spread = curves.loc[
            (curves["im"] == name) & curves["probability"].between(0.005, 0.995), "intensity"
        ]
        if len(spread):
            axis.set_xlim(spread.min(), spread.max())
        low, high = axis.get_xlim()
        plain_log(axis.xaxis, next(steps for ratio, steps in TICKS if high < ratio * low))
        axis.set(xlabel=MEASURES[name].label, ylim=(0, 1))
        if axis.get_legend_handles_labels()[0]:
            title = f"median [{MEASURES[name].unit}], dispersion"
            axis.legend(loc="upper left", title=title, title_fontsize=7)
        else:
            axis.text(0.5, 0.5, "not determined", transform=axis.transAxes, ha="center")
    for axis in axes[:, 0]:
        axis.set_ylabel("probability of collapse [-]")
    many = brackets["record"].nunique(), brackets["station"].nunique()
    words = f"{100 * job.params.confidence:g} % bands"
    figure.suptitle(heading(*many, words, job.params.min_stations))
    style.save(figure, job.output, job.input.facts)


run(main, globals())
