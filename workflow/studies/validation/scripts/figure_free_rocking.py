"""Restitution of blocks that rock freely, by height or by impact: measured and computed."""

from itertools import cycle
from pathlib import Path

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.figures.panels import intervals
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.validation import study as validation


def main(job):
    experiment = validation.read(Path(job.input.files[0]).parent)
    table = read_frame(job.input.table, numbers=["run"])
    trials = experiment.measured.merge(experiment.runs, on="run")
    once = table.drop_duplicates("run")
    one_height = once["height_m"].nunique() == 1
    x, label = ("impact", "impact") if one_height else ("height_m", "height [m]")
    figure, axis = plt.subplots(figsize=(7.0, 4.0))
    if len(trials) > len(once):
        axis.plot(trials[x], trials["measured_-"], ".", c="0.7", ms=3, label="trials")
    look = {"marker": "o", "color": "k", "ms": 4, "lw": 1.0, "capsize": 3}
    look["label"] = "measured, median and quartiles or range"
    intervals(axis, once[x], once["median"], once["p25"], once["p75"], **look)
    axis.plot(once[x], once["closed_form"], "k--", lw=1.0, label="closed form of a rigid block")
    for (variant, part), (colour, line, marker) in zip(
        table.groupby("variant", sort=False), cycle(style.LOOKS), strict=False
    ):
        plane, yade = (part[part["solver"] == s] for s in ("planar", "YADE"))
        axis.plot(plane[x], plane["ratio"], ls=line, c=colour, label=f"planar, {variant}")
        look = {"c": colour, "ms": 4, "mfc": "none", "label": f"YADE, {variant}"}
        axis.plot(yade[x], yade["ratio"], marker, **look)
    axis.set(xlabel=label, ylabel=f"{experiment.specimen['observed']['quantity']} [-]")
    if one_height:
        axis.set_xticks(sorted(once[x]))
    axis.legend(fontsize=7, ncols=2, loc="lower right")
    axis.set_title(experiment.specimen["title"], fontsize=9)
    style.save(figure, job.output)


run(main, globals())
