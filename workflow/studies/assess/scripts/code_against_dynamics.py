"""Ratios of every check to the dynamic answer, over the façades of the study, table and figure."""

import json

import numpy as np
from rocking.figures import style
from rocking.figures.panels import intervals, panels, ticks
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.assess.catalogue import SAY
from studies.assess.code_checks import CHECKS
from studies.assess.comparison import compare, gather

from yade_scripts.model.registry import MODELS


def main(job):
    table = gather(json.loads(job.params.runs))
    write_table(table, job.output.ratios)
    comparison = compare(table, job.params.resamples, job.params.seed)
    write_table(comparison, job.output.table)
    draw(comparison, job.output, job.input.facts)


def draw(table, output, facts):
    """A panel a model: median ratio with one logarithmic deviation, unsafe share beside."""
    table = table[table["level"] == "median"]
    models = list(dict.fromkeys(table["model"]))
    figure, axes = panels(len(models), len(models), (2.6, 4.0), around=(2.2, 0.0), sharey=True)
    keys = [k for k in CHECKS if (table["check"] == k).any()]
    for axis, model in zip(axes.flat, models, strict=True):
        rows = table[table["model"] == model].set_index("check").reindex(keys)
        y = np.arange(len(keys))[::-1]
        middle, spread = rows["median_ratio"], np.exp(rows["log_scatter"])
        axis.axvspan(1.0, 100.0, color="0.92", lw=0)
        axis.axvline(1.0, color="0.3", lw=0.8)
        look = {"marker": MODELS[model].marker, "color": "0.1", "ms": 4, "lw": 0.9}
        intervals(axis, y, middle, middle / spread, middle * spread, along="x", **look)
        for at, (_, row) in zip(y, rows.iterrows(), strict=True):
            words = f"{100 * row['unsafe_share']:.0f} %"
            axis.text(1.02, at, words, transform=axis.get_yaxis_transform(), va="center", size=7)
        axis.set(xscale="log", xlim=(0.02, 15.0), ylim=(-0.7, len(keys) - 0.3))
        ticks(axis.xaxis, (0.1, 0.3, 1.0, 3.0, 10.0))
        axis.set_title(f"{model}; right: share unsafe", size=8)
        axis.set_xlabel("PGA check / PGA collapse [-]")
        axis.set_yticks(y, [SAY(f"table.check.{k}") for k in keys])
    style.save(figure, output, facts)


run(main, globals())
