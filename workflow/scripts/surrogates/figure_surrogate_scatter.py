"""Collapse under draws of a surrogate that differ in their noise alone, and under the record."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run
from rocking.studies.surrogate_trust import pairs

from yade_scripts.model.registry import MODELS


def main(job):
    found = pairs(pd.read_csv(job.input.table))
    found["pulses"] = found["pulses"].fillna(-1)
    kinds, models = sorted(found["pulses"].unique()), list(dict.fromkeys(found["model"]))
    rows = list(dict.fromkeys(zip(found["record"], found["direction"], strict=True)))
    figure, axes = plt.subplots(
        1,
        len(kinds),
        figsize=(2.4 + 2.4 * len(kinds), 1.0 + 0.42 * len(rows)),
        sharex=True,
        sharey=True,
        squeeze=False,
    )
    for axis, pulses in zip(axes.flat, kinds, strict=True):
        groups = found[found["pulses"] == pulses].groupby(["record", "direction", "model"])
        for (record, direction, model), group in groups:
            kind, place = MODELS[model], rows.index((record, direction))
            place += 0.36 * (models.index(model) - 0.5 * (len(models) - 1))
            half, most = group["pga_half_g"], group["pga_max_g"]
            for values, face in ((half, kind.colour), (most[half.isna()], "none")):
                axis.plot(
                    values,
                    np.full(len(values), place),
                    kind.marker,
                    color=kind.colour,
                    mfc=face,
                    ls="",
                    alpha=0.6,
                    label=f"{model}, draws" if face != "none" else None,
                )
            recorded = group["recorded_g"].iloc[0]
            axis.plot([recorded] * 2, [place - 0.16, place + 0.16], color="k", lw=1.8)
            said = f"{np.log(half).std():.2f}"
            axis.annotate(
                said, (1.0, place), (2, 0), ("axes fraction", "data"), "offset points", va="center"
            )
        title = {-1: "parameters of the table", 0: "peaks alone"}
        axis.set_title(title.get(pulses, f"peaks and {pulses:g} pulses"), loc="left")
        axis.set(xscale="log", xlabel="collapse PGA [g]")
        axis.xaxis.set_major_formatter(lambda v, _: f"{v:g}")
        axis.xaxis.set_minor_formatter(lambda v, _: f"{v:g}" if f"{v:.0e}"[0] in "235" else "")
    names = [f"{record} {style.SIGNS[direction]}" for record, direction in rows]
    axes[0, 0].set_yticks(range(len(rows)), names)
    axes[0, 0].invert_yaxis()
    handles = dict(zip(*reversed(axes[0, 0].get_legend_handles_labels()), strict=True))
    if found["recorded_g"].notna().any():
        handles["recorded"] = plt.Line2D([], [], color="k", lw=1.8)
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=3)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
