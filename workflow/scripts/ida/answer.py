"""The run's answer: collapse probability over PGA, a line a model, and YADE's runs below it.

Each line is the mean over all motions and directions, the building's own dashed in grey. Below, the
runs of YADE: filled where it fell, open where it stood, crossed out where not as the scan said.
"""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import common_legend, ticks
from rocking.runtime.script import run
from rocking.tables import read_frame

from yade_scripts.model.registry import MODELS

FLAT, MARGIN = 0.02, 1.1  # a share; over the PGA of the last rise
BEYOND = 1.5  # times the PGA at which every line has come to 84 %
HEIGHTS = {"height_ratios": [4.0, 1.0]}


def main(job):
    names = ("answer", "curves", "checked")
    table, curves, checked = (read_frame(job.input[name]) for name in names)
    figure, (axis, strip) = plt.subplots(2, 1, figsize=(6.0, 4.8), sharex=True, gridspec_kw=HEIGHTS)
    for row in table.to_dict("records"):
        kind, curve = MODELS[row["model"]], curves[curves["model"] == row["model"]]
        half = row["pga_half_g"]
        value = f"half fall from {half:.2f} g" if np.isfinite(half) else "fewer than half fall"
        look = {"color": kind.colour, "lw": 1.6, "label": f"{kind.name}, {kind.moved}: {value}"}
        axis.plot(curve["pga_g"], curve["probability"], **look)
    known = curves.dropna(subset=["probability_building"])
    if len(known):
        curve = known[known["model"] == known["model"].iloc[0]]
        label = f"the building: a storey drifts {100 * job.params.drift:g} %"
        look = {"color": "0.45", "ls": "--", "lw": 1.2, "label": label}
        axis.plot(curve["pga_g"], curve["probability_building"], **look)
    axis.axhline(0.5, color="0.8", lw=0.7, zorder=0)
    axis.set(ylim=(0.0, 1.02), ylabel="probability of collapse [-]")
    common_legend(figure, loc="outside upper left", ncols=1)
    axis.set_title(job.params.about, loc="left", fontsize=7.5)
    names = list(table["model"])
    draw_checks(strip, names, checked)
    strip.set(xlim=(0.0, end_g(table, curves)), xlabel="PGA [g]")
    style.save(figure, job.output, job.input.facts)


def end_g(table, curves):
    """PGA up to which the lines are drawn: half as far again as most fall, if they rise so far."""
    most_g = table["pga_high_g"].max(skipna=False)
    rise_g = last_rise(curves)
    return min(BEYOND * most_g, rise_g) if np.isfinite(most_g) else rise_g


def last_rise(curves):
    """PGA up to which the lines rise, and a little more."""
    known = curves.dropna(subset=["probability"])
    end = known.groupby("model")["probability"].transform("last")
    rising = known.loc[known["probability"] < end - FLAT, "pga_g"]
    return MARGIN * rising.max() if len(rising) else curves["pga_g"].max()


def draw_checks(strip, names, checked):
    """YADE's runs of every model in a row of its own."""
    said = "YADE: filled where it stood, open where it fell" if len(checked) else "no run compared"
    if (checked["fell"] != checked["foretold"]).any():
        said += "; crossed out: not as foretold"
    strip.set_title(said, loc="left", fontsize=7.5)
    for place, name in enumerate(reversed(names)):
        kind, runs = MODELS[name], checked[checked["model"] == name]
        for fell, face in ((0, kind.colour), (1, "white")):
            rows = runs[runs["fell"] == fell]
            strip.plot(rows["pga_g"], [place] * len(rows), kind.marker, color=kind.colour, mfc=face)
        other = runs[runs["fell"] != runs["foretold"]]
        strip.plot(other["pga_g"], [place] * len(other), "x", color="black", ms=9)
    ticks(strip.yaxis, range(len(names)), list(reversed(names)))
    strip.set_ylim(-0.6, len(names) - 0.4)


run(main, globals())
