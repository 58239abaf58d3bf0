"""Peaks by run of every model of one test, a panel each: measured, another code, both solvers.

Of each model its first variant and the same under the other bearing, where it has that, with what
lies between them: which of the two there was is not known. All other variants stand in the tables.
"""

from pathlib import Path

import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.figures.panels import common_legend, lowest, panels
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.validation import study as validation

ACROSS = 2
FALL = 2.0  # height of the mark of a fall, over the largest peak of any model
LOOKS = (("level top", style.LOOKS[0][0], "-"), ("top that may turn", style.LOOKS[1][0], "--"))


def main(job):
    models = [validation.read(Path(path).parent) for path in job.input.specimens]
    tables = [shown(read_frame(path, numbers=["run"])) for path in job.input.tables]
    whole = pd.concat(tables)
    fallen_mm = FALL * whole[["peak_mm", "measured_mm"]].max().max()
    size, around = (3.5, 2.5), (0.0, 0.9)
    figure, axes = panels(len(models), ACROSS, size, around, sharex=True, sharey=True)
    for axis, model, table in zip(axes.flat, models, tables, strict=False):
        panel(axis, model, table, fallen_mm)
    about = models[0].specimen["observed"]
    figure.supylabel(f"{about['quantity']} [{about['unit']}]", size=8)
    for axis in lowest(axes, len(models)):
        axis.set_xlabel("run")
    last, signs = axes[0, 0], {"ls": "", "ms": 5, "c": "0.4"}
    if (whole["solver"] == "YADE").any():
        last.plot([], [], "^", mfc="none", label="YADE", **signs)
    if (whole["status"] != "ok").any():
        last.plot([], [], "*", label="fell", **signs)
    title = f"motions: {validation.motions_of(whole)}; lines: planar solver, each run alone"
    common_legend(figure, loc="outside lower center", ncols=4, title=title)
    style.save(figure, job.output)


def shown(table):
    """Rows of each run alone, of the first variant and of the same under the other bearing."""
    first = table["variant"].iloc[0]
    both = [first, first + validation.TURNING]
    return table[(table["how"] == validation.ALONE) & table["variant"].isin(both)]


def panel(axis, model, table, fallen_mm):
    """One model: its bearings by the planar solver as lines, by YADE as open triangles."""
    measured = table.drop_duplicates("run")
    axis.plot(measured["run"], measured["measured_mm"], "k-o", ms=4, lw=1.6, label="measured")
    if "another_mm" in measured:
        code = model.specimen["another"]
        axis.plot(measured["run"], measured["another_mm"], "kx", ms=5, label=code)
    drawn = []
    for (label, colour, line), (_, part) in zip(
        LOOKS, table.groupby("variant", sort=False), strict=False
    ):
        plane, yade = (part[part["solver"] == solver] for solver in ("planar", "YADE"))
        stood = plane["status"] == "ok"
        peaks = plane["peak_mm"].where(stood, np.nan)
        axis.plot(plane["run"], peaks, ls=line, marker=".", ms=3, lw=1.2, c=colour, label=label)
        axis.plot(yade["run"], yade["peak_mm"], "^", c=colour, ms=4, mfc="none")
        fell = plane[~stood]
        axis.plot(fell["run"], np.full(len(fell), fallen_mm), "*", c=colour, ms=7)
        drawn.append(plane["peak_mm"].where(stood, fallen_mm).to_numpy())
    if len(drawn) > 1:
        about = {"color": "0.5", "alpha": 0.25, "lw": 0, "label": "between the bearings"}
        axis.fill_between(measured["run"], *drawn, **about)
    axis.set(yscale="log", xticks=list(measured["run"])[::3])
    axis.set_title(model.specimen["title"], fontsize=8)


run(main, globals())
