"""Measured and computed peaks of a shake-table experiment by run."""

import json
from itertools import cycle
from pathlib import Path

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.validation import study as validation
from studies.validation.study import ALONE, SEQUENCE

SOLVERS = {"planar": ("#0072B2", "s"), "YADE": ("#D55E00", "^")}


def main(job):
    experiment = validation.read(Path(job.input.files[0]).parent)
    about = experiment.specimen
    table = read_frame(job.input.table, numbers=["run"])
    variants = list(dict.fromkeys(table["variant"]))
    shown = variants[: json.loads(job.params.settings)["validation"]["main_variants"]]
    figure, axes = plt.subplots(
        len(shown) + 1, 1, figsize=(7.0, 2.6 * (len(shown) + 1)), sharex=True
    )
    measured = table.drop_duplicates("run")
    for axis in axes:
        axis.plot(measured["run"], measured["measured_mm"], "k-o", ms=4, lw=1.2, label="measured")
        if "another_mm" in measured:
            axis.plot(
                measured["run"], measured["another_mm"], "x", c="0.45", ms=5, label=about["another"]
            )
    for axis, variant in zip(axes, shown, strict=False):
        for solver, (colour, marker) in SOLVERS.items():
            part = table[(table["variant"] == variant) & (table["solver"] == solver)]
            alone, after = (part[part["how"] == how] for how in (ALONE, SEQUENCE))
            axis.plot(alone["run"], alone["peak_mm"], marker, c=colour, ms=4, mfc="none",
                      label=f"{solver}, alone")  # fmt: skip
            axis.plot(after["run"], after["peak_mm"], ":", c=colour, lw=1.0,
                      label=f"{solver}, in sequence")  # fmt: skip
            if solver == "planar" and alone["p10_mm"].notna().any():
                top = alone["p90_mm"].clip(upper=2e3 * thickness(about))
                axis.fill_between(alone["run"], alone["p10_mm"], top, color=colour, alpha=0.2,
                                  lw=0, label="planar, 10–90 % of the band")  # fmt: skip
        bearings(axis, table, variant, 2e3 * thickness(about))
        axis.set_title(variant, fontsize=8)
    others = variants[len(shown) :]
    for variant, (colour, line, marker) in zip(others, cycle(style.LOOKS), strict=False):
        part = table[(table["variant"] == variant) & (table["solver"] == "planar")]
        part = part[part["how"] == ALONE]
        axes[-1].plot(part["run"], part["peak_mm"], marker, ls=line, c=colour, ms=3, label=variant)
    axes[-1].set_title("other readings, planar, alone", fontsize=8)
    fallen = table[(table["status"] != "ok") & (table["how"] == ALONE)]
    for axis, names in zip(axes, [*([variant] for variant in shown), others], strict=True):
        mine = fallen[fallen["variant"].isin(names)]
        axis.plot(mine["run"], [1e3 * thickness(about)] * len(mine), "k*", ms=6, label="fell")
        axis.set(yscale="log", ylabel=f"{about['observed']['quantity']}\n[{experiment.unit}]")
        axis.yaxis.label.set_size(7)
        axis.legend(fontsize=6, ncols=2, loc="upper left")
    axes[-1].set(
        xlabel=f"run; motions: {validation.motions_of(table)}", xticks=list(measured["run"])
    )
    figure.suptitle(about["title"], fontsize=9)
    style.save(figure, job.output)


def bearings(axis, table, variant, fell_mm):
    """Between the level top and the one that may turn: which of the two there was is not known."""
    level = variant.removesuffix(validation.TURNING)
    mine = table[(table["solver"] == "planar") & (table["how"] == ALONE)].set_index("run")
    level_mm, turning_mm = (
        mine[mine["variant"] == name]["peak_mm"].fillna(fell_mm)
        for name in (level, level + validation.TURNING)
    )
    if len(turning_mm) and len(level_mm):
        runs, turned = level_mm.index, turning_mm.loc[level_mm.index]
        axis.fill_between(runs, level_mm, turned, color="0.6", alpha=0.3, lw=0,
                          label="planar, between the bearings")  # fmt: skip


def thickness(about):
    return about["sections"]["facade"]["thickness_m"]


run(main, globals())
