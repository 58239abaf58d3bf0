"""Runs of the complete building, cracked and bonded, beside the two-way models' probability."""

import matplotlib.pyplot as plt
from rocking.collapse.ida import by_curve, read_curve
from rocking.collapse.probability import from_scan
from rocking.figures import style
from rocking.figures.panels import panels
from rocking.runtime.script import run

from yade_scripts.model.registry import COMPLETE, MODELS

WIDTH_IN = 7.2
KINDS = {**MODELS, **COMPLETE}
LINES = {False: "-", True: ":"}


def main(job):
    curves, scans = by_curve(job.input.ida, read_curve), by_curve(job.input.scans)
    cases = list(dict.fromkeys(key[1:] for key in curves))
    wide = WIDTH_IN / min(2, len(cases))
    figure, axes = panels(len(cases), 2, (wide, 2.6))
    for axis, (record, direction) in zip(axes.flat, cases, strict=False):
        for (model, *case), scan in scans.items():
            if case == [record, direction]:
                share, kind = from_scan(scan, job.params.spread), KINDS[model]
                look = {"ls": LINES[kind.bonded], "color": kind.colour, "lw": 0.9}
                axis.plot(share["pga_g"], share["probability"], **look)
        high = 0.0
        for model, kind in COMPLETE.items():
            curve = curves.get((model, record, direction))
            if curve is None:
                continue
            valid = curve[curve["status"] != "failed"]
            fell = valid["collapsed"] == 1
            peak = valid["d_over_b"].where(~fell, 1.0)
            high = max(high, valid["pga_g"].max())
            look = {"color": kind.colour, "marker": kind.marker, "ms": 5}
            axis.plot(valid["pga_g"], peak, color=kind.colour, lw=0.6, ls=LINES[kind.bonded])
            for mask, fill in ((fell, kind.colour), (~fell, "white")):
                axis.plot(valid["pga_g"][mask], peak[mask], ls="", mfc=fill, **look)
        axis.set(
            xlim=(0.0, 1.15 * high),
            ylim=(-0.03, 1.06),
            xlabel="PGA [g]",
            ylabel="d/b [-], probability [-]",
            title=f"{record} {direction}",
        )
    handles = [
        look_of(kind, f"{kind.name}: d/b, filled where it fell", marker=kind.marker)
        for kind in COMPLETE.values()
    ]
    models = dict.fromkeys(key[0] for key in scans)
    handles += [look_of(KINDS[model], f"{model}: collapse probability") for model in models]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    style.save(figure, job.output, job.input.facts)


def look_of(kind, label, **symbol):
    """Entry of the legend."""
    return plt.Line2D([], [], color=kind.colour, ls=LINES[kind.bonded], label=label, **symbol)


run(main, globals())
