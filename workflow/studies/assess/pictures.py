"""Pictures of the assessment report, readable without colour; each draws into a (sub)figure."""

import numpy as np
from rocking.figures.panels import ticks

from studies.assess.verdict import as_stated
from yade_scripts.model.registry import MODELS

LOOKS = (("-", "0.0"), ("--", "0.35"), ("-.", "0.5"))  # line and grey
DRY = [name for name, model in MODELS.items() if model.compiled and not model.bonded]
LINES = dict(zip(DRY, LOOKS, strict=True))


def capacity(curves, mechanisms, figure):
    """Capacity curves of the mechanisms, with the displacements of SLV and SLC."""
    reached = as_stated(mechanisms).set_index("mechanism")["d_slv_m"]
    axis = figure.subplots()
    styles = zip(("-", "--"), ("0.0", "0.4"), strict=True)
    for (name, curve), (line, shade) in zip(
        curves.groupby("mechanism", sort=False), styles, strict=False
    ):
        axis.plot(curve["d_m"], curve["multiplier"], line, color=shade, label=name)
        d0 = float(curve["d_m"].iloc[-1])
        for words, d, mark in (("d_SLV", reached[name], "s"), ("d_SLC", 0.6 * d0, "D")):
            y = np.interp(d, curve["d_m"], curve["multiplier"])
            axis.plot(d, y, mark, color=shade, mfc="white", ms=5)
            if line == "-":  # the other curve has the same marks
                at = {"textcoords": "offset points", "size": 7}
                axis.annotate(words, (d, y), (4, 5), **at)
    axis.set(xlabel="displacement of the control point [m]", ylabel="multiplier α [-]")
    axis.set(xlim=(0.0, None), ylim=(0.0, None))
    axis.legend(fontsize=6.5)


def selected(table, figure):
    """Spectra of the selected motions, their mean and the demand, with the code's bounds."""
    axis = figure.subplots()
    t = table["period_s"]
    for name in table.columns[3:]:
        axis.plot(t, table[name], color="0.8", lw=0.6)
    axis.plot(t, table["target_g"], color="0.0", lw=1.5, label="demand")
    axis.plot(t, table["mean_g"], "--", color="0.0", lw=1.2, label="mean")
    axis.plot(t, 0.9 * table["target_g"], ":", color="0.4", lw=0.8, label="−10 %, +30 %")
    axis.plot(t, 1.3 * table["target_g"], ":", color="0.4", lw=0.8)
    axis.set(xlabel="period [s]", ylabel="spectral acceleration [g]", xlim=(0, None))
    axis.set_ylim(0, 2.0 * float(table["target_g"].max()))
    axis.legend(fontsize=6.5)


def spectra(table, figure):
    """Demand on the ground and on the floor, formula beside the exact chain."""
    axis = figure.subplots()
    t = table["period_s"]
    axis.fill_between(
        t,
        table["floor_chain_p16_g"],
        table["floor_chain_p84_g"],
        color="0.88",
        lw=0,
        label="chain under the suite, 16 to 84 %",
    )
    axis.plot(t, table["floor_chain_p50_g"], "-.", color="0.45", label="its median")
    axis.plot(t, table["floor_formula_g"], "--", color="0.0", label="floor, formula")
    axis.plot(t, table["ground_g"], "-", color="0.0", lw=1.6, label="ground, demand")
    axis.plot(t, table["ground_suite_p50_g"], ":", color="0.3", label="ground, suite's median")
    axis.set(xscale="log", yscale="log", xlabel="period [s]", ylabel="spectral acceleration [g]")
    ticks(axis.xaxis, (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0))
    axis.minorticks_off()
    axis.legend(loc="lower left", fontsize=6.5)


def fragility(curves, dynamic, mechanisms, figure):
    """Probability of collapse of each model with its band; PGA of demand and kinematic check."""
    axis = figure.subplots()
    for model, part in curves.groupby("model", sort=False):
        line, shade = LINES[model]
        axis.fill_between(
            part["pga_g"], part["band_low"], part["band_high"], color=shade, alpha=0.15, lw=0
        )
        axis.plot(part["pga_g"], part["probability"], line, color=shade, label=model)
    demand = dynamic["pga_demand_g"].iloc[0]
    axis.axvline(demand, color="0.0", lw=0.8)
    axis.text(demand, 1.02, "demand", size=7, ha="center", transform=axis.get_xaxis_transform())
    label, x = "non-linear SLV check, weakest", as_stated(mechanisms)["pga_fails_g"].iloc[0]
    axis.plot([x], [0.5], "D", color="0.0", mfc="white", ms=5, label=label, ls="")
    axis.set(xscale="log", xlabel="PGA [g]", ylabel="probability of collapse [-]", ylim=(0, 1))
    low = 0.5 * min(curves["pga_g"].quantile(0.2), demand)
    ticks(axis.xaxis, [v for v in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0) if v > low])
    axis.set_xlim(low, 1.5 * max(curves["pga_g"].quantile(0.8), demand))
    axis.legend(loc="upper left", fontsize=6.5, bbox_to_anchor=(1.0, 1.0))


def tornado(table, base, label, figure):
    """Bars of what a key does down and up, about the value as stated, the factors at their ends.

    The table has key, factor and value.
    """
    axis = figure.subplots()
    by_key = table.groupby("key", sort=False)["value"]
    ends = by_key.agg(low=lambda v: min(v.min(), base), high=lambda v: max(v.max(), base))
    keys = list(ends[ends["high"] - ends["low"] > 1e-9].index)  # without those that do nothing
    for y, key in enumerate(keys[::-1]):
        part = table[table["key"] == key].sort_values("factor")
        low, high = ends.loc[key, "low"], ends.loc[key, "high"]
        axis.barh(y, high - low, left=low, height=0.5, fc="0.85", ec="0.3", lw=0.6)
        for _, row in part.iterrows():
            right = row["value"] > base
            axis.annotate(
                f"×{row['factor']:g}",
                (row["value"], y),
                (4 if right else -4, 0),
                textcoords="offset points",
                ha="left" if right else "right",
                va="center",
                size=6.5,
            )
    axis.axvline(base, color="0.0", lw=0.8)
    axis.set_yticks(range(len(keys)), [key.split(".")[-1] for key in keys[::-1]])
    axis.use_sticky_edges = False
    axis.margins(x=0.25)
    axis.set_xlabel(label)
