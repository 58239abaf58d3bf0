"""One panel of an incremental dynamic analysis: static curve, dense scan, YADE's runs, probability.

PGA goes up and the peak top displacement d/b across. Beside it stands a strip for each model, as
dark as the share that falls there: where outcomes alternate a line would be a zigzag.
"""

from pathlib import Path

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D

from rocking.collapse.ida import branches, curve_key
from rocking.figures.style import GREY
from rocking.mechanics.closed_forms import capacity_rigid
from rocking.mechanics.smoothing import smoothed
from rocking.tables import read_frame
from yade_scripts.model.registry import MODELS
from yade_scripts.model.shape import shape_of

HALF = 0.4  # of a strip's width; strips of models are 1 apart


def draw_pushover(axis, path, facade):
    """Static curve of a model in grey; without a table, the rigid block's."""
    grey = {"color": GREY, "lw": 1.6, "zorder": 1}
    if path is None:
        b, h = shape_of(facade).lever_m
        theta = np.linspace(0.0, np.arctan2(b, h), 50)
        d_over_b, value = h * np.sin(theta) / b, capacity_rigid(theta, h, b)
        axis.plot(d_over_b, value, label="static λ of a rigid block", **grey)
        return
    curve, kind = read_frame(path), MODELS[Path(path).stem]
    value = smoothed(curve, "lambda_dem") if kind.walls == "bricks" else curve["lambda_dem"]
    axis.plot(curve["d_over_b"], value, ls=kind.static, label=f"static λ, {kind.name}", **grey)


def draw_scan(axis, scan):
    """Outcomes of the dense scan, one faint dot each; where many differ, a cloud."""
    colour = MODELS[curve_key(scan)[0]].colour
    valid = scan[scan["status"] != "failed"]
    faint = {"color": colour, "ms": 2.2, "mew": 0, "alpha": 0.3, "zorder": 2}
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


def draw_probability(axis, place, table, row, top):
    """Collapse probability of a model as a strip about `place`, up to PGA `top`.

    White where nothing falls, in the model's colour where all does; hatched where that is not
    known. Symbols are shares of YADE's realisations, filled as the strip is coloured.
    """
    kind = MODELS[row["model"]]
    colour = np.array(to_rgb(kind.colour))
    dense = table[table["realisations"].notna() & table["probability_yade"].isna()]
    by_yade = table[table["probability_yade"].notna()]
    pga, share = dense["pga_g"].to_numpy(float), dense["probability"].to_numpy(float)
    side = (place - HALF, place + HALF)
    if len(pga):
        edges = np.r_[0.0, (pga[1:] + pga[:-1]) / 2.0, max(top, pga[-1])]
        faces = 1.0 - share[:, None] * (1.0 - colour)
        axis.pcolormesh(side, edges, faces[:, None, :])
    elif np.isfinite(row["pga_collapse_g"]):
        low, high = np.nan_to_num(row["pga_safe_g"]), row["pga_collapse_g"]
        axis.fill_betweenx((low, high), *side, fc="white", ec=colour, hatch="////", lw=0.0)
        axis.fill_betweenx((high, max(top, high)), *side, color=colour, lw=0.0)
    axis.plot((side[0],) * 2 + (side[1],) * 2, (top, 0.0, 0.0, top), color=kind.colour, lw=0.6)
    for _, run in by_yade.iterrows():
        face = 1.0 - run["probability_yade"] * (1.0 - colour)
        symbol = {"mfc": face, "mec": "k", "mew": 0.6, "zorder": 4, "clip_on": False}
        axis.plot(place, run["pga_g"], kind.marker, **symbol)


def symbols(scanned=True, shares=False):
    """What filled, open, small and black-edged symbols say, as {words: handle} for a legend."""
    grey: dict = {"color": "0.3", "ls": ""}
    words = {
        "YADE: stood": Line2D([], [], marker="o", **grey),
        "YADE: fell": Line2D([], [], marker="o", mfc="white", **grey),
    }
    if scanned:
        words["planar solver"] = Line2D([], [], marker=".", ms=3.0, mew=0, **grey)
    if shares:
        edge = {"mec": "k", "mew": 0.6, **grey}
        words["on strips: YADE's share"] = Line2D([], [], marker="o", mfc="0.6", **edge)
    return words
