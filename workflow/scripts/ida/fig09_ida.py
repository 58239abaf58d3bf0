"""Figure 9: a panel a record and direction, with its collapse probability beside it.

Behind stand the outcomes of the dense scan, before them YADE's runs: one sees where one answer
exists and where a distribution does.
"""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter
from rocking.collapse import probability
from rocking.collapse.ida import branches, curve_key, read_curve
from rocking.figures import style
from rocking.mechanics.closed_forms import capacity_rigid
from rocking.runtime.script import run
from rocking.studies.pushover import smoothed
from rocking.tables import read_json

from yade_scripts.model.registry import MODELS
from yade_scripts.model.shape import shape_of

LOG_RATIO = 8.0  # between the strongest and the weakest model of a record
BESIDE = (1.06, 0.0, 0.2, 1.0)  # place of the probability, over the panel's width and height


def draw_pushover(axis, path, facade):
    """Static curve of a model in grey; without a table, the rigid block's."""
    grey = {"color": style.GREY, "lw": 1.6, "zorder": 1}
    if path is None:
        b, h = shape_of(facade).lever_m
        theta = np.linspace(0.0, np.arctan2(b, h), 50)
        d_over_b, value = h * np.sin(theta) / b, capacity_rigid(theta, h, b)
        axis.plot(d_over_b, value, label="pushover, rigid block", **grey)
        return
    curve, kind = pd.read_csv(path), MODELS[Path(path).stem]
    value = smoothed(curve, "lambda_dem") if kind.walls == "bricks" else curve["lambda_dem"]
    axis.plot(curve["d_over_b"], value, ls=kind.static, label=f"pushover {kind.name}", **grey)


def draw_scan(axis, scan):
    """Outcomes of the dense scan, one faint dot each; where many differ, a cloud."""
    colour = MODELS[curve_key(scan)[0]].colour
    valid = scan[scan["status"] != "failed"]
    faint = {"color": colour, "ms": 2.2, "mew": 0, "alpha": 0.3, "zorder": 2, "rasterized": True}
    axis.plot(valid["d_over_b"], valid["pga_g"], ".", **faint)


def draw_curve(axis, curve, top, joined):
    """YADE's runs up to PGA `top`: filled where the façade stood, open at d/b = 1 where it fell.

    `joined`: no dense scan shows the way between them, so a line does.
    """
    stood, fell = branches(curve)
    kind = MODELS[curve_key(curve)[0]]
    first = fell["pga_g"].min() if len(fell) else np.inf
    line = stood[stood["pga_g"] < first]
    if joined:
        axis.plot(line["d_over_b"], line["pga_g"], color=kind.colour, lw=0.8, zorder=3)
    symbol = {"color": kind.colour, "ls": "", "zorder": 4, "clip_on": False}
    for rows, face in ((stood, kind.colour), (fell, "white")):
        rows = rows[rows["pga_g"] <= top]
        label = kind.name if face != "white" else None
        if not len(rows):
            continue  # an empty line without a clip lies in the corner and bends the layout
        axis.plot(rows["d_over_b"], rows["pga_g"], kind.marker, mfc=face, label=label, **symbol)


def draw_probability(axis, table, row):
    """Collapse probability: a line, of the scan or, without one, of YADE's runs; else symbols."""
    kind = MODELS[row["model"]]
    dense = table[table["realisations"].notna() & table["probability_yade"].isna()]
    known = dense["probability"]
    if len(dense):
        symbol = {"color": kind.colour, "mfc": "none"}
        axis.plot(table["probability_yade"], table["pga_g"], kind.marker, **symbol)
    else:  # no scan: of YADE's own runs
        dense, known = table, table["probability_yade"]
    axis.plot(known, dense["pga_g"], color=kind.colour, lw=0.9)
    if not len(dense) and np.isfinite(row["pga_collapse_g"]):
        edge = (row["pga_safe_g"], row["pga_collapse_g"])
        axis.plot((0.0, 1.0), edge, color=kind.colour, lw=0.9, ls=":")


def highest(row):
    """Largest intensity worth showing for a curve: where all collapse, or what was reached.

    NaN where every run failed.
    """
    known = [row[f"pga_{name}_g"] for name in ("all", "collapse", "max")]
    return next((g for g in known if np.isfinite(g)), np.nan)


def main(job):
    p = job.params
    facade = json.loads(p.facade)["facade"]
    facts = {f["name"]: f for f in (read_json(path) for path in job.input.facts)}
    scans = {curve_key(table): table for table in map(pd.read_csv, job.input.scans)}
    curves = {curve_key(table): table for table in map(read_curve, job.input.ida)}
    collapse = pd.read_csv(job.input.collapse).to_dict("records")
    rows = {tuple(r[k] for k in probability.KEY): r for r in collapse}
    tables = dict(list(pd.read_csv(job.input.probability).groupby(probability.KEY)))
    shape = (len(p.records), len(p.directions))
    size = (max(5.0, 4.0 * shape[1]), 0.9 + 2.0 * shape[0])
    figure, axes = plt.subplots(*shape, figsize=size, squeeze=False, sharex=True)
    blank = pd.DataFrame(columns=probability.PROBABILITY_COLUMNS)
    pushovers = list(job.input.pushover) or (
        [] if facade["hinges_m"] or facade["courses"] else [None]
    )
    shown = {r: [highest(row) for key, row in rows.items() if key[1] == r] for r in p.records}
    shown = {r: [g for g in values if np.isfinite(g)] or [1.0] for r, values in shown.items()}
    # bonded façades may stand so much that the others vanish
    logarithmic = any(max(values) > LOG_RATIO * min(values) for values in shown.values())
    for i, record in enumerate(p.records):
        top = 1.08 * max(shown[record])
        own = [table["pga_g"].min() for key, table in curves.items() if key[1] == record]
        least = min(own, default=0.2 * min(shown[record]))
        for j, direction in enumerate(p.directions):
            axis = axes[i, j]
            beside = axis.inset_axes(BESIDE, sharey=axis)
            for path in pushovers:
                draw_pushover(axis, path, facade)
            for key in (key for key in rows if key[1:] == (record, direction)):
                if key in scans:
                    draw_scan(axis, scans[key])
                if key in curves:
                    draw_curve(axis, curves[key], top, joined=key not in scans)
                draw_probability(beside, tables.get(key, blank), rows[key])
            sign = style.SIGNS[direction]
            axis.set_title(f"{style.provenance(facts[record])}, direction {sign}", loc="left")
            axis.set(xlim=(0, 1.0), ylim=(0, top), ylabel="PGA [g]" if j == 0 else None)
            if logarithmic:
                axis.set_yscale("log")
                axis.set_ylim(0.85 * least, 1.1 * top)
                axis.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
                axis.yaxis.set_major_formatter(FormatStrFormatter("%g"))
                axis.yaxis.set_minor_formatter(NullFormatter())
            beside.set(xlim=(-0.05, 1.05), xticks=(0, 1))
            beside.tick_params(labelleft=False)
            if i == shape[0] - 1:
                axis.set_xlabel("peak top displacement d/b [-]")
                beside.set_xlabel("P(collapse)")
    legend = {}
    for axis in axes.flat:
        for handle, label in zip(*axis.get_legend_handles_labels(), strict=True):
            legend.setdefault(label, handle)
    ncols = min(len(legend), 5)
    figure.legend(legend.values(), legend.keys(), loc="outside upper center", ncols=ncols)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
