"""One panel of an incremental dynamic analysis: static curve, dense scan, YADE's runs, probability.

PGA goes up and the peak top displacement d/b across; the probability stands on an axes of its own.
"""

from pathlib import Path

import numpy as np
import pandas as pd

from rocking.collapse.ida import branches, curve_key
from rocking.figures.style import GREY
from rocking.mechanics.closed_forms import capacity_rigid
from rocking.studies.pushover import smoothed
from yade_scripts.model.registry import MODELS
from yade_scripts.model.shape import shape_of


def draw_pushover(axis, path, facade):
    """Static curve of a model in grey; without a table, the rigid block's."""
    grey = {"color": GREY, "lw": 1.6, "zorder": 1}
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
