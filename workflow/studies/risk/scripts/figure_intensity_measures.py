"""Efficiency and sufficiency of intensity measures, model by model."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import intervals
from rocking.records.intensity_measures import MEASURES
from rocking.runtime.script import run
from rocking.stations import heading
from rocking.tables import read_frame
from studies.shared.sufficiency import PROPERTIES

from yade_scripts.model.registry import MODELS


def beside(axis, table, names, value):
    """Values with their intervals, a group a measure, a symbol a model."""
    models = list(dict.fromkeys(table["model"]))
    width = 0.6 / len(models)
    for i, model in enumerate(models):
        part = table[table["model"] == model].set_index("im").loc[names]
        x = np.arange(len(names)) + (i - 0.5 * (len(models) - 1)) * width
        look = {"marker": MODELS[model].marker, "color": MODELS[model].colour, "label": model}
        intervals(axis, x, part[value], part["ci_low"], part["ci_high"], **look)
    axis.set_xlim(-0.6, len(names) - 0.4)


def main(job):
    table = read_frame(job.input.measures)
    slopes = read_frame(job.input.sufficiency)
    names = list(dict.fromkeys(table["im"]))
    figure, axes = plt.subplots(
        1 + len(PROPERTIES), 1, figsize=(5.6, 2.6 + 1.7 * len(PROPERTIES)), sharex=True
    )
    beside(axes[0], table, names, "dispersion")
    axes[0].set_ylabel("dispersion β of\ncollapse intensity [-]")
    axes[0].set_ylim(bottom=0)
    for axis, (against, words) in zip(axes[1:], PROPERTIES.items(), strict=True):
        beside(axis, slopes[slopes["against"] == against], names, "slope")
        axis.axhline(0.0, color=style.GREY, lw=0.8, zorder=0)
        axis.set_ylabel(f"slope on\n{words} [-]")
    axes[-1].set_xticks(range(len(names)), [MEASURES[name].symbol for name in names])
    axes[0].legend(ncols=table["model"].nunique(), loc="best")
    many = (int(table[name].max()) for name in ("n_records", "n_stations"))
    words = f"{100 * job.params.confidence:g} % intervals"
    axes[0].set_title(heading(*many, words, job.params.min_stations), loc="left")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
