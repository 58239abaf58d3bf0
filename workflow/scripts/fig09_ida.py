"""Figure 9: IDA curves of every model, a panel a record and direction, static capacity in grey."""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter
from rocking.curves.ensemble import bands
from rocking.curves.ida import branches, curve_key, read_curve
from rocking.curves.pushover import smoothed
from rocking.figures import style
from rocking.runtime.script import run

from yade_scripts.model.registry import MODELS


def rigid_pushover(h, b):
    """Rigid block about its toe: λ(θ) = tan(α − θ) against d/b = h sin θ / b."""
    alpha = np.arctan2(b, h)
    theta = np.linspace(0.0, alpha, 50)
    return h * np.sin(theta) / b, np.tan(alpha - theta)


LOG_RATIO = 8.0  # between the strongest and the weakest model of a record


def draw_pushover(axis, path, h, b):
    """Static curve of a model in grey; without a table, the rigid block's."""
    if path is None:
        axis.plot(*rigid_pushover(h, b), color=style.GREY, lw=2, label="pushover, rigid block")
        return
    curve, model = pd.read_csv(path), Path(path).stem
    kind = MODELS[model]
    value = smoothed(curve, "lambda_dem") if kind.walls == "bricks" else curve["lambda_dem"]
    axis.plot(
        curve["d_over_b"],
        value,
        color=style.GREY,
        lw=1.6,
        ls=kind.static,
        label=f"pushover {model}",
        zorder=1,
    )


def draw(axis, curve, model, top, origin):
    """Draw one curve up to PGA `top`; runs that overturned sit at d/b = 1 with open symbols.

    The line starts at `origin`: at rest, or nowhere on a logarithmic axis.
    """
    stood, fell = branches(curve)
    colour, marker = MODELS[model].colour, MODELS[model].marker
    joined = curve[curve["status"] != "failed"]
    first = fell["pga_g"].min() if len(fell) else np.inf
    line = joined[joined["pga_g"] <= first]
    axis.plot([*origin, *line["d_over_b"]], [*origin, *line["pga_g"]], color=colour, zorder=2)
    axis.plot(stood["d_over_b"], stood["pga_g"], marker, color=colour, ls="", label=model, zorder=3)
    fell = fell[fell["pga_g"] <= top]  # the frame does not clip symbols at d/b = 1
    axis.plot(
        fell["d_over_b"],
        fell["pga_g"],
        marker,
        color=colour,
        mfc="white",
        ls="",
        clip_on=False,
        zorder=4,
    )


def draw_band(axis, ensemble, percentiles):
    """Shade the ensemble's percentile band of d/b."""
    table = bands(ensemble, percentiles)
    colour = MODELS[curve_key(ensemble)[0]].colour
    axis.fill_betweenx(
        table["pga_g"],
        table["d_over_b_low"].clip(upper=1.0),
        table["d_over_b_high"].clip(upper=1.0),
        color=colour,
        alpha=0.22,
        lw=0,
        zorder=1,
    )


def doubtful(sensitivity, ensembles):
    """Points of a curve that do not repeat and have no ensemble: one history says little.

    Parameters
    ----------
    sensitivity : DataFrame
        Sensitivity table of the curve; it may be empty.
    ensembles : list of DataFrame
        Ensembles that were run.
    """
    if sensitivity.empty or curve_key(sensitivity) in [curve_key(e) for e in ensembles]:
        return sensitivity.iloc[:0]
    return sensitivity[(sensitivity["repeats"] == 0) & (sensitivity["d_over_b"] < 1.0)]


def shown_pga(curve):
    """Largest intensity worth showing: the first collapse, or a run that stands above it."""
    stood, fell = branches(curve)
    return max(fell["pga_g"].min() if len(fell) else 0.0, stood["pga_g"].max())


def main(job):
    p = job.params
    facade = json.loads(p.facade)["facade"]
    facts = {f["name"]: f for f in (json.loads(Path(path).read_text()) for path in job.input.facts)}
    curves = [read_curve(path) for path in job.input.ida]
    ensembles = [pd.read_csv(path) for path in getattr(job.input, "ensemble", [])]
    ensembles = [table for table in ensembles if len(table)]
    sensitivities = [pd.read_csv(path) for path in getattr(job.input, "sensitivity", [])]
    doubts = [doubtful(table, ensembles) for table in sensitivities]
    shape = (len(p.records), len(p.directions))
    figure, axes = plt.subplots(
        *shape, figsize=(max(5.0, 3.5 * shape[1]), 0.9 + 2.0 * shape[0]), squeeze=False, sharex=True
    )
    pushovers = list(getattr(job.input, "pushover", [])) or [None]
    shown = {r: [shown_pga(c) for c in curves if curve_key(c)[1] == r] for r in p.records}
    # bonded façades may stand so much that the others vanish
    logarithmic = any(max(values) > LOG_RATIO * min(values) for values in shown.values())
    for i, record in enumerate(p.records):
        top, weakest = 1.15 * max(shown[record]), min(shown[record])
        for j, direction in enumerate(p.directions):
            axis = axes[i, j]
            for path in pushovers:
                draw_pushover(axis, path, facade["height_m"], facade["thickness_m"])
            for ensemble in ensembles:
                if curve_key(ensemble)[1:] == (record, direction):
                    draw_band(axis, ensemble, p.percentiles)
            for curve in curves:
                if curve_key(curve)[1:] == (record, direction):
                    draw(axis, curve, curve_key(curve)[0], top, () if logarithmic else (0.0,))
            for points in doubts:
                if len(points) and curve_key(points)[1:] == (record, direction):
                    axis.plot(
                        points["d_over_b"],
                        points["pga_g"],
                        "o",
                        ls="",
                        ms=8,
                        mfc="none",
                        mec="0.3",
                        mew=0.7,
                        label="does not repeat",
                        zorder=5,
                    )
            sign = {"pos": "+", "neg": "−"}[direction]
            axis.set_title(f"{style.provenance(facts[record])}, direction {sign}", loc="left")
            axis.set(xlim=(0, 1.0), ylabel="PGA [g]")
            axis.set_ylim(0, top)
            if logarithmic:
                axis.set_yscale("log")
                axis.set_ylim(0.2 * weakest, 1.1 * top)
                axis.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
                axis.yaxis.set_major_formatter(FormatStrFormatter("%g"))
                axis.yaxis.set_minor_formatter(NullFormatter())
    for axis in axes[-1]:
        axis.set_xlabel("peak top displacement d/b [-]")
    legend = {}
    for axis in axes.flat:
        for handle, label in zip(*axis.get_legend_handles_labels(), strict=True):
            legend.setdefault(label, handle)
    figure.legend(
        legend.values(), legend.keys(), loc="outside upper center", ncols=min(len(legend), 5)
    )
    style.save(figure, job.output)


run(main, globals())
