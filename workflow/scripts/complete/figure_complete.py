"""Runs of the complete building, cracked and bonded, beside the two-way models' probability."""

import matplotlib.pyplot as plt
import pandas as pd
from rocking.collapse.ida import curve_key, read_curve
from rocking.collapse.probability import from_scan
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import COMPLETE, MODELS

SPREAD = 0.01  # of the scans' realisations
KINDS = {**MODELS, **COMPLETE}
LINES = {False: "-", True: ":"}


def main(job):
    curves = {curve_key(c): c for c in map(read_curve, job.input.ida) if len(c)}
    scans = {curve_key(s): s for s in map(pd.read_csv, job.input.scans) if len(s)}
    cases = list(dict.fromkeys(key[1:] for key in curves))
    columns = min(2, len(cases))
    figure, axes = plt.subplots(
        -(-len(cases) // columns),
        columns,
        figsize=(7.2, 2.6 * -(-len(cases) // columns)),
        squeeze=False,
    )
    for axis, (record, direction) in zip(axes.flat, cases, strict=False):
        for (model, *case), scan in scans.items():
            if case != [record, direction]:
                continue
            share, kind = from_scan(scan, SPREAD), KINDS[model]
            line = LINES[kind.bonded]
            axis.plot(share["pga_g"], share["probability"], line, color=kind.colour, lw=0.9)
        high = 0.0
        for model, kind in COMPLETE.items():
            curve = curves.get((model, record, direction))
            if curve is None:
                continue
            valid = curve[curve["status"] != "failed"]
            fell = valid["collapsed"] == 1
            peak = valid["d_over_b"].where(~fell, 1.0)
            high = max(high, valid["pga_g"].max())
            axis.plot(valid["pga_g"], peak, color=kind.colour, lw=0.6, ls=LINES[kind.bonded])
            for own, fill in ((fell, kind.colour), (~fell, "white")):
                axis.plot(
                    valid["pga_g"][own], peak[own], kind.marker, color=kind.colour, mfc=fill, ms=5
                )
        axis.set(
            xlim=(0.0, 1.15 * high),
            ylim=(-0.03, 1.06),
            xlabel="PGA [g]",
            ylabel="d/b [-], probability [-]",
            title=f"{record} {direction}",
        )
    for axis in axes.flat[len(cases) :]:
        axis.axis("off")
    handles = [
        plt.Line2D(
            [],
            [],
            color=k.colour,
            ls=LINES[k.bonded],
            marker=k.marker,
            label=f"{k.name}: d/b, filled where it fell",
        )
        for k in COMPLETE.values()
    ]
    handles += [
        plt.Line2D(
            [],
            [],
            color=KINDS[m].colour,
            ls=LINES[KINDS[m].bonded],
            label=f"{m}: collapse probability",
        )
        for m in dict.fromkeys(key[0] for key in scans)
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    style.save(figure, (job.output.png, job.output.pdf), job.input.facts)


run(main, globals())
