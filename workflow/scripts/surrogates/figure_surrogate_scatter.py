"""Collapse under draws of a surrogate that differ in their noise alone, and under the record."""

import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.figures.panels import common_legend, panels, plain_log
from rocking.runtime.script import run
from rocking.studies.surrogate_trust import pairs

from yade_scripts.model.registry import MODELS


def main(job):
    found = pairs(pd.read_csv(job.input.table))
    found["pulses"] = found["pulses"].fillna(-1)
    kinds, models = sorted(found["pulses"].unique()), list(dict.fromkeys(found["model"]))
    rows = list(dict.fromkeys(zip(found["record"], found["direction"], strict=True)))
    size, around = (2.4, 0.42 * len(rows)), (2.4, 1.0)
    figure, axes = panels(len(kinds), len(kinds), size, around, sharex=True, sharey=True)
    for axis, pulses in zip(axes.flat, kinds, strict=True):
        groups = found[found["pulses"] == pulses].groupby(["record", "direction", "model"])
        for (record, direction, model), group in groups:
            kind, place = MODELS[model], rows.index((record, direction))
            place += 0.36 * (models.index(model) - 0.5 * (len(models) - 1))
            half, most = group["pga_half_g"], group["pga_max_g"]
            look = {"color": kind.colour, "marker": kind.marker, "ls": "", "alpha": 0.6}
            for values, face in ((half, kind.colour), (most[half.isna()], "none")):
                label = f"{model}, draws" if face != "none" else None
                axis.plot(values, np.full(len(values), place), mfc=face, label=label, **look)
            recorded = group["recorded_g"].iloc[0]
            if np.isfinite(recorded):
                ends = place - 0.16, place + 0.16
                axis.vlines(recorded, *ends, color="k", lw=1.8, label="recorded")
            said = f"{np.log(half).std():.2f}"
            axis.annotate(
                said, (1.0, place), (2, 0), ("axes fraction", "data"), "offset points", va="center"
            )
        title = {-1: "parameters of the table", 0: "peaks alone"}
        axis.set_title(title.get(pulses, f"peaks and {pulses:g} pulses"), loc="left")
        axis.set(xscale="log", xlabel="collapse PGA [g]")
        plain_log(axis.xaxis, (1.0, 2.0, 3.0, 5.0))
    names = [f"{record} {style.SIGNS[direction]}" for record, direction in rows]
    axes[0, 0].set_yticks(range(len(rows)), names)
    axes[0, 0].invert_yaxis()
    common_legend(figure, loc="outside upper center", ncols=3)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
