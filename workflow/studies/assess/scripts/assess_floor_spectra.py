"""The code's floor spectrum over the exact one of the chain, over the run's records."""

import json

import matplotlib.pyplot as plt
import pandas as pd
from rocking.figures import style
from rocking.figures.panels import ticks
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.assess.floor_spectra import VARIANTS, formula_and_exact, spread


def main(job):
    settings = json.loads(job.params.settings)
    chain = settings["smdof"]
    records = (load_as(settings, name, job.params.table) for name in job.params.records)
    parts = [formula_and_exact(record, chain) for record in records]
    table = spread(pd.concat(parts, ignore_index=True))
    write_table(table, job.output.table)
    figure, axes = plt.subplots(1, len(VARIANTS), figsize=(8.6, 2.9), sharey=True)
    floors = sorted({1, (chain["n_dof"] + 1) // 2, chain["n_dof"]})
    for axis, variant in zip(axes, VARIANTS, strict=True):
        for i, floor in enumerate(floors):
            own = table[(table["variant"] == variant) & (table["floor"] == floor)]
            axis.plot(
                own["t_over_t1"],
                own["ratio_median"],
                ("-", "--", "-.")[i],
                marker=("o", "s", "^")[i],
                ms=3,
                color=str(0.25 * i),
                label=f"floor {floor} of {chain['n_dof']}",
            )
            if floor == floors[-1]:
                axis.fill_between(
                    own["t_over_t1"],
                    own["ratio_p16"],
                    own["ratio_p84"],
                    color="0.85",
                    lw=0,
                    label="16 to 84 %, top floor",
                )
        axis.axhline(1.0, color="0.3", lw=0.8)
        axis.set(xscale="log", yscale="log", ylim=(0.1, 5.0), xlabel="T/T1 [-]")
        axis.set_title(variant, size=8)
        ticks(axis.xaxis, (0.1, 0.3, 1, 3, 8))
        ticks(axis.yaxis, (0.1, 0.2, 0.5, 1, 2, 5))
    axes[0].set_ylabel("formula / exact [-]")
    axes[0].legend(loc="lower left", fontsize=7)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
