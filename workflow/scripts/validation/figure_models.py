"""Peaks by run of every model of one test, a panel each: measured, another code, both solvers."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run
from rocking.studies import validation

ACROSS = 2
FALL = 2.0  # height of the mark of a fall, over the largest peak of any model


def main(job):
    models = [validation.read(Path(path).parent) for path in job.input.specimens]
    tables = [pd.read_csv(path) for path in job.input.tables]
    tables = [table[table["how"] == validation.ALONE] for table in tables]
    top = max(table[["peak_mm", "measured_mm"]].max().max() for table in tables)
    down = -(-len(models) // ACROSS)
    figure, axes = plt.subplots(
        down, ACROSS, figsize=(9.0, 2.9 * down), sharex=True, sharey=True, layout="constrained",
        squeeze=False,
    )  # fmt: skip
    for axis, model, table in zip(axes.flat, models, tables, strict=False):
        panel(axis, model, table, FALL * top)
    for axis in axes.flat[len(models) :]:
        axis.set_axis_off()
    about = models[0].specimen["observed"]
    for axis in axes[:, 0]:
        axis.set_ylabel(f"{about['quantity']}\n[{about['unit']}]", size=7)
    for axis in axes[-1]:
        axis.set_xlabel("run")
    figure.supxlabel(f"motions: {validation.motions_of(pd.concat(tables))}", size=8)
    style.save(figure, job.output)


def panel(axis, model, table, fallen_mm):
    """One model: its readings by the planar solver as lines, by YADE as open triangles."""
    measured = table.drop_duplicates("run")
    axis.plot(measured["run"], measured["measured_mm"], "k-o", ms=4, lw=1.6, label="measured")
    if "another_mm" in measured:
        code = model.specimen["another"]
        axis.plot(measured["run"], measured["another_mm"], "kx", ms=5, label=code)
    for number, (variant, part) in enumerate(table.groupby("variant", sort=False)):
        again, place = divmod(number, len(style.LOOKS))  # a colour comes back with another line
        colour, line = style.LOOKS[place][0], style.LOOKS[(place + again) % len(style.LOOKS)][1]
        plane, yade = (part[part["solver"] == solver] for solver in ("planar", "YADE"))
        peaks = plane["peak_mm"].where(plane["status"] == "ok", np.nan)
        axis.plot(plane["run"], peaks, ls=line, marker=".", ms=3, lw=1.2, c=colour, label=variant)
        if "p10_mm" in plane and plane["p10_mm"].notna().any():
            band = plane["p10_mm"], plane["p90_mm"].clip(upper=fallen_mm)
            axis.fill_between(plane["run"], *band, color=colour, alpha=0.15, lw=0)
        axis.plot(yade["run"], yade["peak_mm"], "^", c=colour, ms=4, mfc="none")
        fell = plane[plane["status"] != "ok"]
        axis.plot(fell["run"], np.full(len(fell), fallen_mm), "*", c=colour, ms=7)
    for sign, label, shown in (
        ("^", "YADE", (table["solver"] == "YADE").any()),
        ("*", "fell", (table["status"] != "ok").any()),
    ):
        if shown:
            axis.plot(
                [], [], sign, c="0.4", ms=5, mfc="none" if sign == "^" else "0.4", label=label
            )
    axis.set(yscale="log", xticks=list(measured["run"])[::2])
    axis.set_title(model.specimen["title"], fontsize=8)
    axis.legend(fontsize=6, ncols=2, loc="upper left")


run(main, globals())
