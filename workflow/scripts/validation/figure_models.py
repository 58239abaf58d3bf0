"""Peaks by run of every model of one test, a panel each: measured, another code, both solvers."""

from pathlib import Path

import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.figures.panels import common_legend, lowest, panels
from rocking.runtime.script import run
from rocking.studies import validation

ACROSS = 2
FALL = 2.0  # height of the mark of a fall, over the largest peak of any model


def main(job):
    models = [validation.read(Path(path).parent) for path in job.input.specimens]
    tables = [pd.read_csv(path) for path in job.input.tables]
    tables = [table[table["how"] == validation.ALONE] for table in tables]
    whole = pd.concat(tables)
    fallen_mm = FALL * whole[["peak_mm", "measured_mm"]].max().max()
    size, around = (4.5, 2.6), (0.0, 1.2)
    figure, axes = panels(len(models), ACROSS, size, around, sharex=True, sharey=True)
    looks = {name: look(i) for i, name in enumerate(whole["variant"].unique())}
    for axis, model, table in zip(axes.flat, models, tables, strict=False):
        panel(axis, model, table, looks, fallen_mm)
    about = models[0].specimen["observed"]
    figure.supylabel(f"{about['quantity']} [{about['unit']}]", size=8)
    for axis in lowest(axes, len(models)):
        axis.set_xlabel("run")
    signs = {"ls": "", "ms": 5, "c": "0.4"}
    last = axes[0, 0]
    if (whole["solver"] == "YADE").any():
        last.plot([], [], "^", mfc="none", label="YADE, colour of its planar line", **signs)
    if "p10_mm" in whole and whole["p10_mm"].notna().any():
        band = "10 to 90 % of amplitudes near the stated one"
        last.fill_between([], [], color="0.4", alpha=0.15, lw=0, label=band)
    if (whole["status"] != "ok").any():
        last.plot([], [], "*", label="fell", **signs)
    title = f"motions: {validation.motions_of(whole)}; lines: planar solver"
    common_legend(figure, last=looks, loc="outside lower center", ncols=3, title=title)
    style.save(figure, job.output)


def look(number):
    """Colour and line of a variant, in every panel alike; a colour comes back with another line."""
    again, place = divmod(number, len(style.LOOKS))
    return style.LOOKS[place][0], style.LOOKS[(place + again) % len(style.LOOKS)][1]


def panel(axis, model, table, looks, fallen_mm):
    """One model: its readings by the planar solver as lines, by YADE as open triangles."""
    measured = table.drop_duplicates("run")
    axis.plot(measured["run"], measured["measured_mm"], "k-o", ms=4, lw=1.6, label="measured")
    if "another_mm" in measured:
        code = model.specimen["another"]
        axis.plot(measured["run"], measured["another_mm"], "kx", ms=5, label=code)
    for variant, part in table.groupby("variant", sort=False):
        colour, line = looks[variant]
        plane, yade = (part[part["solver"] == solver] for solver in ("planar", "YADE"))
        peaks = plane["peak_mm"].where(plane["status"] == "ok", np.nan)
        axis.plot(plane["run"], peaks, ls=line, marker=".", ms=3, lw=1.2, c=colour, label=variant)
        if "p10_mm" in plane and plane["p10_mm"].notna().any():
            band = plane["p10_mm"], plane["p90_mm"].clip(upper=fallen_mm)
            axis.fill_between(plane["run"], *band, color=colour, alpha=0.15, lw=0)
        axis.plot(yade["run"], yade["peak_mm"], "^", c=colour, ms=4, mfc="none")
        fell = plane[plane["status"] != "ok"]
        axis.plot(fell["run"], np.full(len(fell), fallen_mm), "*", c=colour, ms=7)
    axis.set(yscale="log", xticks=list(measured["run"])[::2])
    axis.set_title(model.specimen["title"], fontsize=8)


run(main, globals())
