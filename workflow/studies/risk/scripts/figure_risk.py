"""Hazard curve above the fragility curves, and at which intensities the façade falls."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import intervals
from rocking.records.intensity_measures import MEASURES
from rocking.runtime.script import run
from rocking.stations import heading
from rocking.tables import read_frame
from studies.shared.hazard import read_hazard

from yade_scripts.model.registry import MODELS

LINES = ("-", "--", ":", "-.")


def interval(row):
    """Interval of a rate in brackets; nothing where too few records give none."""
    if not np.isfinite(row["rate_low"]):
        return ""
    return f" ({row['rate_low']:.2g} to {row['rate_high']:.2g})"


def main(job):
    risk = job.params.risk
    hazard = read_hazard(str(job.input.hazard), job.params.period_s, risk["site"])
    table = read_frame(job.input.table)
    parts = read_frame(job.input.deaggregation)
    curves = read_frame(job.input.curves)
    curves = curves[curves["im"] == hazard.measure]
    measure = MEASURES[hazard.measure]
    figure, axes = plt.subplots(
        3, 1, figsize=(5.2, 6.0), sharex=True, height_ratios=(1.0, 1.0, 1.2)
    )
    axes[0].loglog(hazard.intensity, hazard.annual_rate, color="k", marker=".", ms=3)
    axes[0].set_ylabel("rate of exceedance\n[1/year]")
    low, high = hazard.intensity[[0, -1]]
    models = list(dict.fromkeys(parts["model"]))
    for i, model in enumerate(models):
        colour = MODELS[model].colour
        row = table[table["model"] == model].iloc[0]
        curve = curves[curves["model"] == model]
        x = curve["intensity"]
        if np.isfinite(row["rate_low"]):
            band = curve["band_low"], curve["band_high"]
            axes[1].fill_between(x, *band, alpha=0.18, lw=0, color=colour)
        axes[1].plot(x, curve["probability"], ls=LINES[i % len(LINES)], color=colour)
        part = parts[parts["model"] == model].iloc[1:-1]  # the table's own intensities
        beside = (i - 0.5 * (len(models) - 1)) * 0.5 / len(models)
        ratio = (part["intensity_high"] / part["intensity_low"]) ** (0.5 + beside)
        label = f"{model}: {row['annual_rate']:.2g} a year{interval(row)},"
        label += f" {100 * row['probability']:.2g} % in {risk['years']:g} years"
        look = {"marker": MODELS[model].marker, "ms": 4, "color": colour, "label": label}
        shares = part["share"], part["share_low"], part["share_high"]
        intervals(axes[2], part["intensity_low"] * ratio, *shares, **look)
    axes[1].set(ylabel="probability\nof collapse [-]", ylim=(0, 1))
    axes[2].set(ylabel="share of the rate\nof collapse [-]", xlabel=measure.label, xlim=(low, high))
    axes[2].set_ylim(bottom=0)
    axes[2].xaxis.set_major_formatter(lambda v, _: f"{v:g}")
    if models:
        figure.legend(loc="outside lower center", fontsize=8)
    many = (int(table[name].max()) for name in ("n_records", "n_stations"))
    words = f"{100 * job.params.confidence:g} % intervals"
    said = heading(*many, words, job.params.min_stations)
    figure.suptitle(f"{said}\nhazard: {Path(str(job.input.hazard)).name}")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
