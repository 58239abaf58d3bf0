"""Tornado chart of a model: what each assumption moves, sorted, a panel a record."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run
from rocking.studies.assumptions import BASE
from rocking.tables import read_json

PANELS = 8
LIMIT = 1.1  # natural logarithm of a ratio; longer bars end in an arrow
BAR, LOWEST, BAND = "#56B4E9", "#D55E00", "0.25"


def main(job):
    table = pd.read_csv(job.input.table)
    table["level"] = table["level"].fillna("")
    facts = [read_json(path) for path in job.input.facts]
    title = {fact["name"]: style.provenance(fact) for fact in facts}
    levels = table[table["assumption"] != BASE].copy()
    levels["swing"] = np.abs(np.log(levels[["ratio_median", "ratio_collapse"]])).max(axis=1)
    # one order for all panels: the largest median swing of an assumption's levels at the top
    order = levels.groupby("assumption")["swing"].median().sort_values()
    rows = [
        (assumption, level)
        for assumption in order.index
        for level in levels.loc[levels["assumption"] == assumption, "level"].drop_duplicates()
    ]
    place = {row: i for i, row in enumerate(rows)}
    keys = list(levels.groupby(["record", "direction"], sort=False).groups)[:PANELS]
    columns = min(len(keys), 4)
    lines = -(-len(keys) // columns)
    size = (1.9 + 1.75 * columns, 0.9 + lines * (0.5 + 0.165 * len(rows)))
    figure, axes = plt.subplots(
        lines, columns, figsize=size, sharex=True, sharey=True, squeeze=False
    )
    ticks = [0.5, 0.7, 1.0, 1.4, 2.0]
    for axis, (record, direction) in zip(axes.flat, keys, strict=False):
        mine = table[(table["record"] == record) & (table["direction"] == direction)]
        base = mine[mine["assumption"] == BASE].iloc[0]
        axis.axvspan(*np.log([base["ratio_p10"], base["ratio_p90"]]), color="0.9", lw=0, zorder=0)
        axis.axvline(0.0, color="k", lw=0.7, zorder=1)
        for row in mine[mine["assumption"] != BASE].itertuples():
            y = place[row.assumption, row.level]
            middle, low, high, lowest = np.log(
                [row.ratio_median, row.ratio_p10, row.ratio_p90, row.ratio_collapse]
            )
            if np.isfinite(middle):
                axis.barh(y, np.clip(middle, -LIMIT, LIMIT), 0.62, color=BAR, zorder=2)
                axis.plot(np.clip([low, high], -LIMIT, LIMIT), [y, y], color=BAND, lw=1.0, zorder=3)
            if np.isfinite(lowest):
                mark = "d" if abs(lowest) < LIMIT else (">" if lowest > 0 else "<")
                spot = np.clip(lowest, -LIMIT, LIMIT)
                axis.plot(spot, y, mark, color=LOWEST, ms=3.6, mec="white", mew=0.4, zorder=4)
        sign = "+" if direction == "pos" else "−"
        names = f"{title[record]}, {sign}\np50 {base['pga_median_g']:.2f} g, "
        axis.set_title(f"{names}lowest {base['pga_collapse_g']:.2f} g", loc="left", fontsize=7)
        axis.set_xlim(-LIMIT, LIMIT)
        axis.set_xticks(np.log(ticks), [f"{t:g}" for t in ticks])
        axis.set_yticks(range(len(rows)), [f"{a}: {b}" for a, b in rows], fontsize=7)
        axis.set_ylim(-0.6, len(rows) - 0.4)
    for axis in axes.flat[len(keys) :]:
        axis.set_visible(False)
    figure.supxlabel("collapse PGA over that as configured [-]", fontsize=8)
    axes[0, 0].barh(np.nan, 0.0, color=BAR, label="half collapse (p50)")
    axes[0, 0].plot([], [], color=BAND, lw=1.0, label="p10 to p90 of amplitude scatter")
    axes[0, 0].plot([], [], "d", color=LOWEST, ms=3.6, label="lowest collapse")
    axes[0, 0].fill_between([], [], color="0.9", label="scatter as configured")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=2 if columns < 3 else 4)
    style.save(figure, [job.output.png, job.output.pdf], job.input.facts)


run(main, globals())
