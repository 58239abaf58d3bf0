"""Collapse probability against PGA of every model: a panel a record and direction."""

import itertools

import numpy as np
from rocking.figures import style
from rocking.figures.panels import lowest, panels
from rocking.runtime.script import run
from rocking.tables import read_frame

from yade_scripts.model.registry import COMPLETE, MODELS, Model

PANELS = 8  # of the first records; the table has them all
SINGLE = 3  # realisations at a level, below which the curve has symbols
LANE = 0.8  # height of a probability of one, in lanes
OTHERS = ["#8B4513", "#006400", "#4B4B4B", "#000080"]


def main(job):
    table = read_frame(job.input.probability)
    title = style.titles(job.input.facts)
    models = list(table["model"].unique())
    known = {**MODELS, **COMPLETE}
    unknown = [name for name in models if name not in known]
    colours = itertools.cycle(OTHERS)
    kinds = known | {name: Model(name, "", colour=next(colours)) for name in unknown}
    keys = list(table.groupby(["record", "direction"], sort=False).groups)[:PANELS]
    size = (3.4, 0.7 + 0.3 * len(models))
    figure, axes = panels(len(keys), 2, size, around=(0.0, 0.5), sharey=True)
    lanes = range(len(models))[::-1]  # the first model at the top
    for axis, (record, direction) in zip(axes.flat, keys, strict=False):
        mine = table[(table["record"] == record) & (table["direction"] == direction)]
        for base, name in zip(lanes, models, strict=True):
            part = mine[mine["model"] == name].sort_values("pga_g")
            share = base + LANE * part["probability"].fillna(part["probability_yade"])
            colour = kinds[name].colour
            axis.plot(part["pga_g"], share, color=colour, lw=0.8)
            axis.fill_between(part["pga_g"], base, share, color=colour, alpha=0.35, lw=0)
            runs = part["realisations"].fillna(part["realisations_yade"]).fillna(1.0)
            if runs.max() < SINGLE:
                axis.plot(part["pga_g"], share, ls="", marker=kinds[name].marker, ms=3, c=colour)
        axis.set_title(f"{title[record]}, {style.SIGNS[direction]}", loc="left")
        first = mine[mine["probability"] > 0].groupby("model")["pga_g"].min()
        last = mine[mine["probability"] < 1].groupby("model")["pga_g"].max()
        if len(first):
            end = max(1.15 * np.median(last) + 0.3 * last.max(), 1.15 * first.max())
            axis.set_xlim(0.7 * first.min(), end)
        axis.set_yticks(lanes, models)
        axis.set_ylim(-0.1, len(models))
    for axis in lowest(axes, len(keys)):
        axis.set_xlabel("PGA [g]")
    for axis in axes[:, 0]:
        axis.set_ylabel("P(collapse), 0 to 1 in a lane")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
