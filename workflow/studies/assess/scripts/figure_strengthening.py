"""Collapse probability against tie force at one intensity, and collapse PGA against tie force."""

import json

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import band, ticks
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json

TICKS_KN = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)


def place(force_kn, first):
    """Where a force stands on the logarithmic axis; no tie, a step before the weakest."""
    return np.where(force_kn > 0.0, force_kn, 0.6 * first)


def main(job):
    settings = json.loads(job.params.settings)["strengthening"]
    table, least = read_frame(job.input.search), read_frame(job.input.least)
    curve, yade = read_frame(job.input.curve), read_frame(job.input.yade)
    facts = read_json(job.input.facts)
    first = settings["forces_kn"][0]
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.3))
    for k, (height, part) in enumerate(table.groupby("height_m")):
        colour, line, marker = style.LOOKS[k % len(style.LOOKS)]
        x = place(part["force_kn"], first)
        share = height / job.params.height_m
        label = f"tie at {height:.2f} m ({share:.0%} of the height)"
        look = {"ls": line, "marker": marker, "ms": 2.5, "label": label}
        band(left, x, part["probability"], part["low"], part["high"], colour, **look)
    for force, part in yade[yade["status"] != "failed"].groupby("force_kn"):
        label = f"YADE, {len(part)} realisations" if force == yade["force_kn"].max() else None
        at = place(force, first), part["collapsed"].mean()
        left.plot(*at, "k*", ms=9, mfc="none", label=label)
    left.axhline(settings["probability"], color="k", lw=0.7)
    left.set(ylabel=f"collapse probability at {settings['pga_g']:g} g [-]", ylim=(-0.03, 1.03))
    left.legend(loc="best", fontsize=7)

    x, height = place(curve["force_kn"], first), curve["height_m"].iloc[0]
    low, high = curve["pga_p10_g"], curve["pga_p90_g"].fillna(curve["pga_max_g"])
    right.fill_between(x, low, high, color="#0072B2", alpha=0.2, lw=0, label="10 to 90 % collapse")
    right.plot(x, curve["pga_median_g"], "o-", ms=3, color="#0072B2", label="50 %")
    right.plot(x, curve["pga_collapse_g"], "v:", ms=3, color="#D55E00", label="lowest collapse")
    right.axhline(settings["pga_g"], color="k", lw=0.7)
    right.set(ylabel="collapse PGA [g]", ylim=(0.0, None))
    right.set_title(f"tie at {height:.2f} m", loc="left")
    right.legend(loc="best", fontsize=7)
    held = least.dropna(subset="force_kn")
    for axis in (left, right):
        axis.set_xscale("log")
        axis.set_xlabel("force of the row of ties at yield [kN]")
        forces = [t for t in TICKS_KN if first <= t <= settings["forces_kn"][1]]
        ticks(axis.xaxis, [0.6 * first, *forces], ["none", *(f"{t:g}" for t in forces)])
    found = "no tie tried holds"
    if len(held):
        found = f"least tie {held['force_kn'].min():.3g} kN"
        found = found if held["force_kn"].min() > 0.0 else "it stands without a tie"
    left.set_title(
        f"{table['model'].iloc[0]}, {style.provenance(facts)} "
        f"{style.SIGNS[table['direction'].iloc[0]]}: {found}",
        loc="left",
    )
    style.save(figure, job.output, job.input.facts)


run(main, globals())
