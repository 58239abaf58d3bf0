"""Collapse probability against PGA of every model: a panel a record and direction."""

import itertools
import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import COMPLETE, MODELS, Model

PANELS = 8  # of the first records; the table has them all
LINES = ["-", "--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)), (0, (8, 2))]
OTHERS = ["#8B4513", "#006400", "#4B4B4B", "#000080"]


def main(job):
    table = pd.read_csv(job.input.probability)
    facts = [json.loads(Path(path).read_text()) for path in job.input.facts]
    title = {fact["name"]: style.provenance(fact) for fact in facts}
    models = list(table["model"].unique())
    known = {**MODELS, **COMPLETE}
    unknown = [name for name in models if name not in known]
    colours = itertools.cycle(OTHERS)
    kinds = known | {name: Model(name, "", colour=next(colours)) for name in unknown}
    keys = list(table.groupby(["record", "direction"], sort=False).groups)[:PANELS]
    columns = 2 if len(keys) > 1 else 1
    rows = -(-len(keys) // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(3.4 * columns, 0.7 + 1.9 * rows), squeeze=False, sharey=True
    )
    for axis, (record, direction) in zip(axes.flat, keys, strict=False):
        mine = table[(table["record"] == record) & (table["direction"] == direction)]
        for i, name in enumerate(models):
            part = mine[mine["model"] == name].sort_values("pga_g")
            share = part["probability"].fillna(part["probability_yade"])
            single = part["members"].fillna(part["members_yade"]).fillna(1.0).max() < 3
            look = {"color": kinds[name].colour, "label": name}
            if single:  # single runs: one outcome an amplitude, lifted apart to be told apart
                look |= {"ls": "", "marker": kinds[name].marker, "mfc": "none", "ms": 4}
                share = 0.03 * (i + 1) + share * (1.0 - 0.06 * (i + 1))
            else:
                look |= {"ls": LINES[i % len(LINES)], "lw": 1.3}
            axis.plot(part["pga_g"], share, **look)
        axis.set_title(f"{title[record]}, {'+' if direction == 'pos' else '−'}", loc="left")
        first = mine[mine["probability"] > 0].groupby("model")["pga_g"].min()
        last = mine[mine["probability"] < 1].groupby("model")["pga_g"].max()
        if len(first):
            axis.set_xlim(0.7 * first.min(), 1.15 * np.median(last) + 0.3 * last.max())
        axis.set(ylim=(-0.03, 1.03))
    for axis in axes[-1]:
        axis.set_xlabel("PGA [g]")
    for axis in axes[:, 0]:
        axis.set_ylabel("P(collapse)")
    for axis in axes.flat[len(keys) :]:
        axis.set_visible(False)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=min(len(labels), 5))
    style.save(figure, [job.output.png, job.output.pdf], job.input.facts)


run(main, globals())
