"""Efficiency of intensity measures: dispersion of the collapse intensity, model by model."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.curves.intensity_measures import MEASURES
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import MODELS


def main(job):
    table = pd.read_csv(job.input.measures)
    names = list(dict.fromkeys(table["im"]))
    models = list(dict.fromkeys(table["model"]))
    figure, axis = plt.subplots(figsize=(5.0, 2.8))
    width = 0.6 / len(models)
    for i, model in enumerate(models):
        part = table[table["model"] == model].set_index("im").loc[names]
        x = np.arange(len(names)) + (i - 0.5 * (len(models) - 1)) * width
        middle = part["dispersion"].to_numpy()
        error = np.abs(part[["ci_low", "ci_high"]].to_numpy().T - middle)
        axis.errorbar(
            x,
            middle,
            np.where(np.isfinite(error), error, 0.0),
            ls="",
            capsize=2,
            marker=MODELS[model].marker,
            color=MODELS[model].colour,
            label=model,
        )
    axis.set_xticks(range(len(names)), [MEASURES[name].symbol for name in names])
    axis.set(ylabel="dispersion β of collapse intensity [-]", xlim=(-0.6, len(names) - 0.4))
    axis.set_ylim(bottom=0)
    axis.legend(ncols=len(models), loc="best")
    records = int(table["n_records"].max())
    note = f"{records} records, {100 * job.params.confidence:g} % intervals"
    if records < job.params.min_records:
        note += "; too few for more than an indication"
    axis.set_title(note, loc="left")
    style.save(figure, job.output)


run(main, globals())
