"""Pictures of the assessment report, readable without colour; each draws into a (sub)figure."""

import numpy as np
from rocking.figures.panels import ticks

from studies.assess.verdict import as_stated
from yade_scripts.model.registry import MODELS

LOOKS = (("-", "0.0"), ("--", "0.35"), ("-.", "0.5"))  # line and grey
DRY = [name for name, model in MODELS.items() if model.compiled and not model.bonded]
NEAR = 0.15  # of a chart's width: labels of one bar are one label there
LINES = dict(zip(DRY, LOOKS, strict=True))


def capacity(say, curves, mechanisms, names, figure):
    """Capacity curves of the mechanisms, with the displacements of SLV and SLC; names by part."""
    reached = as_stated(mechanisms).set_index("part")["d_slv_m"]
    axis = figure.subplots()
    styles = zip(("-", "--"), ("0.0", "0.4"), strict=True)
    for (part, curve), (line, shade) in zip(
        curves.groupby("part", sort=False), styles, strict=False
    ):
        axis.plot(curve["d_m"], curve["multiplier"], line, color=shade, label=names[part])
        d0 = float(curve["d_m"].iloc[-1])
        for symbol, d, mark in (("d_SLV", reached[part], "s"), ("d_SLC", 0.6 * d0, "D")):
            y = np.interp(d, curve["d_m"], curve["multiplier"])
            axis.plot(d, y, mark, color=shade, mfc="white", ms=5)
            if line == "-":  # the other curve has the same marks
                at = {"textcoords": "offset points", "size": 7}
                axis.annotate(symbol, (d, y), (4, 5), **at)
    axis.set(xlabel=say("figure.displacement"), ylabel=say("figure.multiplier"))
    axis.set(xlim=(0.0, None), ylim=(0.0, None))
    axis.legend(fontsize=6.5)


def selected(say, table, figure):
    """Spectra of the selected motions, their mean and the demand, with the code's bounds."""
    axis = figure.subplots()
    t = table["period_s"]
    for name in table.columns[3:]:
        axis.plot(t, table[name], color="0.8", lw=0.6)
    axis.plot(t, table["target_g"], color="0.0", lw=1.5, label=say("figure.demand"))
    axis.plot(t, table["mean_g"], "--", color="0.0", lw=1.2, label=say("figure.mean"))
    bounds = say("figure.bounds")
    axis.plot(t, 0.9 * table["target_g"], ":", color="0.4", lw=0.8, label=bounds)
    axis.plot(t, 1.3 * table["target_g"], ":", color="0.4", lw=0.8)
    axis.set(xlabel=say("figure.period"), ylabel=say("figure.acceleration"), xlim=(0, None))
    axis.set_ylim(0, 2.0 * float(table["target_g"].max()))
    axis.legend(fontsize=6.5)


def spectra(say, table, figure):
    """Demand on the ground and on the floor, formula beside the exact chain."""
    axis = figure.subplots()
    t = table["period_s"]
    axis.fill_between(
        t,
        table["floor_chain_p16_g"],
        table["floor_chain_p84_g"],
        color="0.88",
        lw=0,
        label=say("figure.chain"),
    )
    for column, key, line, shade, width in (
        ("floor_chain_p50_g", "chain_median", "-.", "0.45", 1.2),
        ("floor_formula_g", "floor_formula", "--", "0.0", 1.2),
        ("ground_g", "ground_demand", "-", "0.0", 1.6),
        ("ground_suite_p50_g", "ground_suite", ":", "0.3", 1.2),
    ):
        label = say(f"figure.{key}")
        axis.plot(t, table[column], line, color=shade, lw=width, label=label)
    axis.set(xscale="log", yscale="log")
    axis.set(xlabel=say("figure.period"), ylabel=say("figure.acceleration"))
    ticks(axis.xaxis, (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0))
    axis.minorticks_off()
    axis.legend(loc="lower left", fontsize=6.5)


def fragility(say, curves, dynamic, mechanisms, figure):
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
    told = say("figure.demand")
    axis.text(demand, 1.02, told, size=7, ha="center", transform=axis.get_xaxis_transform())
    label, x = say("figure.weakest"), as_stated(mechanisms)["pga_fails_g"].iloc[0]
    axis.plot([x], [0.5], "D", color="0.0", mfc="white", ms=5, label=label, ls="")
    axis.set(xscale="log", ylim=(0, 1))
    axis.set(xlabel=say("figure.pga"), ylabel=say("figure.probability"))
    low = 0.5 * min(curves["pga_g"].quantile(0.2), demand)
    ticks(axis.xaxis, [v for v in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0) if v > low])
    axis.set_xlim(low, 1.5 * max(curves["pga_g"].quantile(0.8), demand))
    axis.legend(loc="upper left", fontsize=6.5, bbox_to_anchor=(1.0, 1.0))


def tornado(say, table, base, figure):
    """Bars of what a key does down and up, about the value as stated, the factors at their ends.

    The table has key, factor and value.
    """
    axis = figure.subplots()
    by_key = table.groupby("key", sort=False)["value"]
    ends = by_key.agg(low=lambda v: min(v.min(), base), high=lambda v: max(v.max(), base))
    keys = list(ends[ends["high"] - ends["low"] > 1e-9].index)  # without those that do nothing
    near = NEAR * float(ends["high"].max() - ends["low"].min())
    for y, key in enumerate(keys[::-1]):
        part = table[table["key"] == key].sort_values("factor")
        low, high = ends.loc[key, "low"], ends.loc[key, "high"]
        axis.barh(y, high - low, left=low, height=0.5, fc="0.85", ec="0.3", lw=0.6)
        for value, factors in _together(part, base, near):
            right = value > base
            axis.annotate(
                " ".join(f"×{say.number(factor, 'g')}" for factor in factors),
                (value, y),
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
    axis.set_xlabel(say("table.sensitivity.label"))


def _together(part, base, near):
    """Labels of one bar: (value, factors); those on one side that are `near` each other as one."""
    labels: list[tuple] = []
    for right in (False, True):
        side = part[(part["value"] > base) == right].sort_values("value", ascending=right)
        for row in side.itertuples():
            if labels and (labels[-1][0] > base) == right and abs(row.value - labels[-1][0]) < near:
                value, factors = labels.pop()
                labels.append(
                    (row.value, [*factors, row.factor] if right else [row.factor, *factors])
                )
            else:
                labels.append((row.value, [row.factor]))
    return labels
