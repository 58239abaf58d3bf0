"""The formula as a chart for design: PGA against height, by slenderness and period."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.formula.law import said

SLENDERNESS, PERIODS_S = (10.0, 14.0, 18.0), (0.15, 0.27, 0.45)
BAND = f"two thirds of motions, h/b {SLENDERNESS[1]:g}, T1 {PERIODS_S[1]:g} s"
COMMON = {  # of the lines; what hardly matters stands in the middle of its limits
    "e_mpa": 1700.0,
    "density_kg_m3": 1800.0,
    "friction_deg": 30.0,
    "mass_ratio": 8.0,
    "contact_damping": 1.0,
    "storeys": 4,
}


def lines(law, model, points=40):
    """Heights [m], and the formula's median and dispersion along them by slenderness and period."""
    low, high = law["limits"]["height_m"]
    heights = np.linspace(low, high, points)
    curves = {}
    for slender in SLENDERNESS:
        for period in PERIODS_S[1:2] if model == "W1" else PERIODS_S:
            row = {**COMMON, "slenderness": slender, "period_s": period}
            values = [said({**row, "height_m": h}, model, law=law) for h in heights]
            curves[slender, period] = (np.array([v[0] for v in values]), values[0][1])
    return heights, curves


def draw(formula):
    """Draw a panel a model: lines of slenderness (colour) and period (dash), one with its band."""
    models = list(formula["models"])
    figure, axes = plt.subplots(1, len(models), figsize=(7.2, 3.5), sharey=True, squeeze=False)
    colours = dict(zip(SLENDERNESS, ("#1f6f8b", "#c1440e", "#5b8c3a"), strict=True))
    dashes = dict(zip(PERIODS_S, (":", "-", "--"), strict=True))
    for axis, model in zip(axes[0], models, strict=True):
        heights, curves = lines(formula, model)
        for (slender, period), (median, spread) in curves.items():
            colour = colours[slender]
            axis.plot(heights, median, dashes[period], color=colour, lw=1.4)
            if (slender, period) == (SLENDERNESS[1], PERIODS_S[1]):
                band = (median * np.exp(-spread), median * np.exp(spread))
                axis.fill_between(heights, *band, color=colour, alpha=0.13, lw=0)
        axis.set_title(model, loc="left")
        axis.set_xlabel("height h [m]")
        axis.set_yscale("log")
        axis.grid(visible=True, which="both", lw=0.3, alpha=0.6)
    ticks = [0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5]
    axes[0, 0].set_yticks(ticks, [f"{t:g}" for t in ticks])
    axes[0, 0].yaxis.minorticks_off()
    axes[0, 0].set_ylabel("median PGA of half collapse [g]")
    handles: list = [plt.Line2D([], [], color=c, label=f"h/b {s:g}") for s, c in colours.items()]
    handles += [plt.Line2D([], [], color="k", ls=d, label=f"T1 {t:g} s") for t, d in dashes.items()]
    handles.append(plt.Rectangle((0, 0), 1, 1, color=colours[SLENDERNESS[1]], alpha=0.13, lw=0))
    handles[-1].set_label(BAND)
    figure.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=7)
    return figure
