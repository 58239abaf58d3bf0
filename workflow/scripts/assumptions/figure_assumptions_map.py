"""Map of the error of one-way coupling over mass ratio and T1, and what damping adds."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run

MEASURES = {"median": "half collapse", "collapse": "lowest collapse"}


def panel(axis, table, words):
    """One map: colour and first number the median ratio, 10 to 90 %, share on the unsafe side."""
    names = ("median", "low", "high", "share_unsafe")
    wide, *others = (
        table.pivot(index="period_s", columns="mass_ratio", values=name) for name in names
    )
    image = axis.imshow(wide, cmap="PuOr", vmin=0.5, vmax=1.5, origin="lower", aspect="auto")
    for (i, j), value in np.ndenumerate(wide.to_numpy()):
        low, high, share = (other.to_numpy()[i, j] for other in others)
        text = f"{value:.2f}\n{low:.2f}–{high:.2f}\n{100 * share:.0f} %"
        colour = "white" if abs(value - 1.0) > 0.33 else "black"
        axis.text(j, i, text, ha="center", va="center", fontsize=6.5, color=colour)
    axis.set_xticks(range(wide.shape[1]), [f"{value:g}" for value in wide.columns])
    axis.set_yticks(range(wide.shape[0]), [f"{value:g}" for value in wide.index])
    axis.grid(False)
    axis.set_xlabel("façade's mass / building's [-]")
    axis.set_title(words, loc="left")
    return image


def main(job):
    table = pd.read_csv(job.input.table)
    p = job.params
    figure, axes = plt.subplots(
        1, 3, figsize=(9.4, 3.4), width_ratios=(1.3, 1.3, 1.0), layout="constrained"
    )
    own = table[np.isclose(table["damping_ratio"], p.smdof["damping_ratio"])]
    for axis, (measure, words) in zip(axes, MEASURES.items(), strict=False):
        image = panel(axis, own[own["measure"] == measure], words)
    axes[0].set_ylabel("T1 of the building [s]")
    figure.colorbar(image, ax=axes[:2], label="one-way over two-way [-]", shrink=0.9)
    axis = axes[2]
    part = table[
        np.isclose(table["period_s"], p.smdof["period_s"]) & (table["measure"] == "median")
    ]
    looks = zip(
        ("o-", "s--", "^-.", "v:"), ("#D55E00", "#0072B2", "#009E73", "#CC79A7"), strict=True
    )
    for (damping, group), (line, colour) in zip(part.groupby("damping_ratio"), looks, strict=False):
        group = group.sort_values("mass_ratio")
        axis.plot(group["mass_ratio"], group["median"], line, color=colour, ms=3.5)
        for edge in ("low", "high"):  # thin: 10 and 90 % of the curves
            axis.plot(group["mass_ratio"], group[edge], line[1:], color=colour, lw=0.6)
        axis.plot([], [], line, color=colour, ms=3.5, label=f"{100 * damping:g} %")
    axis.axhline(1.0, color="k", lw=0.7)
    axis.set(xlabel="façade's mass / building's [-]", xlim=(0, None), ylim=(0, None))
    axis.set_ylim(0, 1.05 * max(1.0, part["high"].max()))
    axis.set_title(f"half collapse, T1 = {p.smdof['period_s']:g} s", loc="left")
    axis.legend(title="damping", loc="lower left")
    style.save(figure, [job.output.png, job.output.pdf], job.input.facts)


run(main, globals())
