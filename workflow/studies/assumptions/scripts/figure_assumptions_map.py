"""Map of the error of one-way coupling over mass ratio and T1, and what damping adds."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import heat_map
from rocking.runtime.script import run
from rocking.tables import read_frame

NUMBERS = ("median", "low", "high", "share_unsafe")
MEASURES = {"equivalent": "equivalent PGA", "collapse": "lowest collapse"}


def panel(axis, table, words):
    """One map: colour and first number the median ratio, 10 to 90 %, share on the unsafe side."""
    grid = table.pivot(index="period_s", columns="mass_ratio")
    numbers = zip(*(grid[name].to_numpy().flat for name in NUMBERS), strict=True)
    texts = [f"{m:.2f}\n{low:.2f}–{high:.2f}\n{100 * s:.0f} %" for m, low, high, s in numbers]
    texts = np.reshape(texts, grid["median"].shape)
    image = heat_map(axis, grid["median"], texts, cmap="PuOr", vmin=0.5, vmax=1.5)
    axis.set_xlabel("façade's mass / building's [-]")
    axis.set_title(words, loc="left")
    return image


def main(job):
    table = read_frame(job.input.table)
    p = job.params
    figure, axes = plt.subplots(1, 3, figsize=(9.4, 3.4), width_ratios=(1.3, 1.3, 1.0))
    at_damping = table[np.isclose(table["damping_ratio"], p.smdof["damping_ratio"])]
    for axis, (measure, words) in zip(axes, MEASURES.items(), strict=False):
        image = panel(axis, at_damping[at_damping["measure"] == measure], words)
    axes[0].set_ylabel("T1 of the building [s]")
    figure.colorbar(image, ax=axes[:2], label="one-way over two-way [-]", shrink=0.9)
    axis = axes[2]
    part = table[
        np.isclose(table["period_s"], p.smdof["period_s"]) & (table["measure"] == "equivalent")
    ]
    for (damping, group), look in zip(part.groupby("damping_ratio"), style.LOOKS, strict=False):
        group, (colour, line, marker) = group.sort_values("mass_ratio"), look
        x, label = group["mass_ratio"], f"{100 * damping:g} %"
        axis.plot(x, group["median"], line, marker=marker, color=colour, ms=3.5, label=label)
        for edge in ("low", "high"):  # thin: 10 and 90 % of the curves
            axis.plot(x, group[edge], line, color=colour, lw=0.6)
    axis.axhline(1.0, color="k", lw=0.7)
    axis.set(xlabel="façade's mass / building's [-]", xlim=(0, None), ylim=(0, None))
    axis.set_ylim(0, 1.05 * max(1.0, part["high"].max()))
    axis.set_title(f"equivalent PGA, T1 = {p.smdof['period_s']:g} s", loc="left")
    axis.legend(title="damping", loc="lower left")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
