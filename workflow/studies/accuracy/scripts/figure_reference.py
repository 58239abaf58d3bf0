"""Reported collapse probability over the reference solver's, a panel a curve."""

import math

import numpy as np
from matplotlib.ticker import MaxNLocator
from rocking.collapse import probability
from rocking.figures import style
from rocking.figures.panels import panels
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.accuracy.coverage import KEY

from yade_scripts.model.registry import MODELS

COLUMNS = 4


def draw(axis, key, scan, row, reported, spread):
    """One curve: reference solver in black, what is reported in the model's colour."""
    colour = MODELS[key[0]].colour
    valid = scan[scan["status"] != "failed"].sort_values("pga_g")
    share, _ = probability.probability(valid["pga_g"], valid["collapsed"], valid["pga_g"], spread)
    axis.plot(valid["pga_g"], share, color="0.1", lw=0.8)
    axis.plot(reported["pga_g"], reported["probability"], ".", color=colour, ms=3, mew=0)
    for outcome, place in ((0, -0.1), (1, 1.1)):
        there = valid.loc[valid["collapsed"] == outcome, "pga_g"]
        axis.plot(there, np.full(len(there), place), "|", color="0.4", ms=3, mew=0.4)
    low, high = row["pga_p10_g"], row["pga_p90_g"]
    high = valid["pga_g"].max() if math.isnan(high) else high
    axis.plot([low, high], [0.5, 0.5], color=colour, lw=4, alpha=0.35, solid_capstyle="butt")
    axis.plot(row["pga_collapse_g"], -0.1, marker="^", color=colour, ms=5, clip_on=False)
    name = f"{key[0]} {key[1]} {style.SIGNS[key[2]]}"
    axis.set_title(f"{name}: {row['coverage']:.2f}", fontsize=8)
    fell = valid.loc[valid["collapsed"] == 1, "pga_g"]
    stood = valid.loc[valid["collapsed"] == 0, "pga_g"]
    if len(fell):
        axis.set_xlim(0.9 * fell.min(), 1.1 * max(stood.max(), fell.min()))
    axis.xaxis.set_major_locator(MaxNLocator(4))
    axis.set_ylim(-0.18, 1.18)


def main(job):
    scans = dict(list(read_frame(job.input.scan).groupby(KEY, sort=False)))
    bands = read_frame(job.input.bands).set_index(KEY)
    known = dict(list(read_frame(job.input.probability).groupby(KEY)))
    figure, axes = panels(len(scans), COLUMNS, (2.5, 1.6), around=(0.0, 0.5), sharey=True)
    for axis, (key, scan) in zip(axes.flat, scans.items(), strict=False):
        draw(axis, key, scan, bands.loc[key], known[key], job.params.spread)
    figure.supxlabel("PGA (g)")
    figure.supylabel("collapse probability (-)")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
