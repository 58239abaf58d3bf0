"""Figures of the study `sequence`."""

import numpy as np
from rocking.figures import style
from rocking.figures.panels import panels

from yade_scripts.model.registry import MODELS


def draw(table):
    """Draw collapse PGA after the first shock over that without, against the first shock's PGA."""
    models = list(dict.fromkeys(table["model"]))
    figure, axes = panels(len(models), 3, (2.3, 2.3), around=(0.8, 0.5), sharey=True)
    levels = sorted(set(table["first_pga_g"]))
    at = {level: k for k, level in enumerate(levels)}
    for axis, model in zip(axes.flat, models, strict=True):
        part, kind = table[table["model"] == model], MODELS[model]
        for (_, _, direction), curve in part.groupby(["record", "first", "direction"]):
            x, face = curve["first_pga_g"].map(at), kind.colour if direction == "pos" else "white"
            axis.plot(x, curve["ratio"], color=kind.colour, lw=0.8, alpha=0.6, zorder=2)
            axis.plot(x, curve["ratio"], kind.marker, color=kind.colour, mfc=face, ms=3.5, zorder=3)
        for level in levels[1:]:
            fell = int(part.loc[part["first_pga_g"] == level, "fell_first"].sum())
            if fell:
                axis.annotate(f"{fell}\nfell", (at[level], 0.02), ha="center", fontsize=8)
        axis.axhline(1.0, color=style.GREY, lw=0.8, zorder=0)
        axis.set_title(model, loc="left")
        axis.set_xticks(range(len(levels)), [f"{level:g}" for level in levels])
        axis.set_xlim(-0.3, len(levels) - 0.7)
    top = 1.1 * max(1.0, float(np.nanmax(table["ratio"], initial=1.0)))
    axes[0, 0].set_ylim(0.0, top)
    figure.supylabel("collapse PGA, after over before [-]", fontsize=9)
    figure.supxlabel("PGA of the first shock [g]; direction +: filled, −: open", fontsize=9)
    return figure
