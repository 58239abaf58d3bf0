"""The run's answer: collapse probability over PGA, a line a model, and YADE's runs below it.

Each line is the mean over all motions and directions, the building's own dashed in grey. Below, the
runs of YADE: filled where it fell, open where it stood, crossed out where not as the scan said.
"""

import matplotlib.pyplot as plt
import numpy as np
from rocking.collapse import answer
from rocking.collapse.probability import KEY
from rocking.figures import style
from rocking.figures.panels import ticks
from rocking.runtime.script import run
from rocking.tables import read_frame

from yade_scripts.model.registry import MODELS

HEIGHTS = {"height_ratios": [4.0, 1.0]}


def main(job):
    table, checked = (read_frame(path) for path in (job.input.answer, job.input.checked))
    probability = dict(list(read_frame(job.input.probability).groupby(KEY)))
    figure, (axis, strip) = plt.subplots(2, 1, figsize=(5.2, 4.2), sharex=True, gridspec_kw=HEIGHTS)
    at_g = answer.grid(probability.values())
    building = []
    for one in table.to_dict("records"):
        own = [rows for key, rows in probability.items() if key[0] == one["model"]]
        kind, share = MODELS[one["model"]], answer.over_curves(own, at_g)
        half = one["pga_half_g"]
        value = f"half fall from {half:.2f} g" if np.isfinite(half) else "fewer than half fall"
        axis.plot(at_g, share, color=kind.colour, lw=1.6, label=f"{kind.name}: {value}")
        building.append(answer.over_curves(own, at_g, "probability_building"))
    known = [row for row in building if not np.isnan(row).any()]
    if known:
        label = f"the building: a storey drifts {100 * job.params.drift:g} %"
        axis.plot(at_g, known[-1], color="0.45", ls="--", lw=1.2, label=label)
    axis.axhline(0.5, color="0.8", lw=0.7, zorder=0)
    axis.set(ylim=(0.0, 1.02), ylabel="probability of collapse [-]")
    axis.legend(loc="lower right")
    axis.set_title(job.params.about, loc="left", fontsize=7.5)
    names = list(table["model"])
    draw_checks(strip, names, checked)
    strip.set(xlim=(0.0, at_g[-1]), xlabel="PGA [g]")
    style.save(figure, job.output, job.input.facts)


def draw_checks(strip, names, checked):
    """YADE's runs of every model in a row of its own."""
    said = "YADE: filled where it fell, open where it stood"
    if (checked["fell"] != checked["foretold"]).any():
        said += "; crossed out: not as foretold"
    strip.set_title(said, loc="left", fontsize=7.5)
    for place, name in enumerate(reversed(names)):
        kind, own = MODELS[name], checked[checked["model"] == name]
        for fell, face in ((1, kind.colour), (0, "white")):
            rows = own[own["fell"] == fell]
            strip.plot(rows["pga_g"], [place] * len(rows), kind.marker, color=kind.colour, mfc=face)
        other = own[own["fell"] != own["foretold"]]
        strip.plot(other["pga_g"], [place] * len(other), "x", color="black", ms=9)
    ticks(strip.yaxis, range(len(names)), list(reversed(names)))
    strip.set_ylim(-0.6, len(names) - 0.4)


run(main, globals())
