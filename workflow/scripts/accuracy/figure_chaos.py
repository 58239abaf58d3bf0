"""Perturbed ensembles: d/b of every realisation with median and band, and the share that collapses.

Behind the shares stands the collapse probability of the dense scan, where there is one; below, the
level where it first reaches one half.
"""

import matplotlib.pyplot as plt
import pandas as pd
from rocking.collapse.ensemble import bands
from rocking.collapse.ida import curve_key
from rocking.collapse.probability import first_crossing, from_scan
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import MODELS


def main(job):
    tables = [pd.read_csv(path) for path in job.input.ensembles]
    tables = [t for t in tables if len(t)]
    scans = {curve_key(pd.read_csv(path, nrows=1)): path for path in job.input.scans}
    percentiles = job.params.percentiles
    count = max(1, len(tables))
    figure, axes = plt.subplots(
        2,
        count,
        figsize=(2.6 * count + 1.2, 4.6),
        squeeze=False,
        sharex="col",
        sharey="row",
        layout="constrained",
    )
    for (top, bottom), table in zip(axes.T, tables, strict=False):
        model, record, direction = table.iloc[0][["model", "record", "direction"]]
        colour = MODELS[model].colour
        band = bands(table, percentiles)
        stood = table[table["status"] == "ok"]
        top.plot(
            stood["pga_g"], stood["d_over_b"], ".", color=style.GREY, ms=3, label="realisation"
        )
        top.fill_between(
            band["pga_g"],
            band["d_over_b_low"],
            band["d_over_b_high"],
            color=colour,
            alpha=0.25,
            lw=0,
            label="10–90 %",
        )
        top.plot(band["pga_g"], band["d_over_b_median"], "o-", color=colour, label="median")
        top.set_title(f"{model} {record} {'+' if direction == 'pos' else '−'}")
        bottom.plot(
            band["pga_g"],
            band["probability"],
            "o",
            color=colour,
            label="YADE, share of realisations",
        )
        known = band
        if scan := scans.get((model, record, direction)):
            known = from_scan(pd.read_csv(scan), job.params.spread)
            near = known["pga_g"].between(0.8 * band["pga_g"].min(), 1.25 * band["pga_g"].max())
            known = known[near]
            bottom.plot(
                known["pga_g"], known["probability"], color="0.3", lw=0.8, label="dense scan"
            )
        half = first_crossing(known["pga_g"].to_numpy(), known["probability"].to_numpy(), 0.5)
        bottom.axvline(half, color="0.4", lw=0.8, ls=":", label="first reaches ½")
        bottom.set_xlabel("PGA (g)")
    if not tables:
        axes[0, 0].set_title("every history repeats: no ensemble was needed")
    else:
        found = [axis.get_legend_handles_labels() for axis in axes[:, 0]]
        lines, labels = ([*upper, *lower] for upper, lower in zip(*found, strict=True))
        figure.legend(lines, labels, loc="outside right upper", fontsize=7)
    axes[0, 0].set(ylabel="peak d/b (-)", ylim=(0.0, 1.05))
    axes[1, 0].set(ylabel="collapsed realisations (-)", ylim=(-0.03, 1.03))
    style.save(figure, job.output, job.input.facts)


run(main, globals())
