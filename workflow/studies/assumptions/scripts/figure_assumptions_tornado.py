"""Tornado chart of a model: what each assumption moves, sorted, a panel a record."""

import numpy as np
from rocking.figures import style
from rocking.figures.panels import common_legend, panels, ticks
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.assumptions.study import BASE

PANELS, COLUMNS = 8, 4
TICKS = (0.5, 0.7, 1.0, 1.4, 2.0)
LIMIT = 1.1  # natural logarithm of a ratio; longer bars end in an arrow
BAR, LOWEST, BAND = "#56B4E9", "#D55E00", "0.25"


def main(job):
    table = read_frame(job.input.table)
    table["level"] = table["level"].fillna("")
    title = style.titles(job.input.facts)
    levels = table[table["assumption"] != BASE].copy()
    levels["swing"] = np.abs(np.log(levels[["ratio_equivalent", "ratio_collapse"]])).max(axis=1)
    # one order for all panels: the largest median swing of an assumption's levels at the top
    order = levels.groupby("assumption")["swing"].median().sort_values()
    rows = [
        (assumption, level)
        for assumption in order.index
        for level in levels.loc[levels["assumption"] == assumption, "level"].drop_duplicates()
    ]
    place = {row: i for i, row in enumerate(rows)}
    keys = list(levels.groupby(["record", "direction"], sort=False).groups)[:PANELS]
    size, around = (1.75, 0.5 + 0.165 * len(rows)), (1.9, 0.9)
    figure, axes = panels(len(keys), COLUMNS, size, around, sharex=True, sharey=True)
    for axis, (record, direction) in zip(axes.flat, keys, strict=False):
        mine = table[(table["record"] == record) & (table["direction"] == direction)]
        base = mine[mine["assumption"] == BASE].iloc[0]
        axis.axvspan(*np.log([base["ratio_p10"], base["ratio_p90"]]), color="0.9", lw=0, zorder=0)
        axis.axvline(0.0, color="k", lw=0.7, zorder=1)
        for row in mine[mine["assumption"] != BASE].itertuples():
            y = place[row.assumption, row.level]
            middle, half, low, high, lowest = np.log(
                [row.ratio_equivalent, row.ratio_median, row.ratio_p10, row.ratio_p90,
                 row.ratio_collapse]
            )  # fmt: skip
            if np.isfinite(middle):
                axis.barh(y, np.clip(middle, -LIMIT, LIMIT), 0.62, color=BAR, zorder=2)
                axis.plot(np.clip([low, high], -LIMIT, LIMIT), [y, y], color=BAND, lw=1.0, zorder=3)
                axis.plot(np.clip(half, -LIMIT, LIMIT), y, "|", color=BAND, ms=6, zorder=3)
            if np.isfinite(lowest):
                mark = "d" if abs(lowest) < LIMIT else (">" if lowest > 0 else "<")
                spot = np.clip(lowest, -LIMIT, LIMIT)
                axis.plot(spot, y, mark, color=LOWEST, ms=3.6, mec="white", mew=0.4, zorder=4)
        intensities_g = [base[f"pga_{name}_g"] for name in ("equivalent", "median")]
        names = f"{title[record]}, {style.SIGNS[direction]}\n"
        names += "equivalent {:.2f} g, p50 {:.2f} g".format(*intensities_g)
        axis.set_title(names, loc="left", fontsize=7)
        ticks(axis.xaxis, np.log(TICKS), [f"{t:g}" for t in TICKS])
        axis.set_yticks(range(len(rows)), [f"{a}: {b}" for a, b in rows], fontsize=7)
        axis.set(xlim=(-LIMIT, LIMIT), ylim=(-0.6, len(rows) - 0.4))
    figure.supxlabel("collapse PGA over that as configured [-]", fontsize=8)
    axes[0, 0].barh(np.nan, 0.0, color=BAR, label="equivalent PGA")
    axes[0, 0].plot([], [], color=BAND, marker="|", lw=1.0, label="p50, p10 to p90")
    axes[0, 0].plot([], [], "d", color=LOWEST, ms=3.6, label="lowest collapse")
    axes[0, 0].fill_between([], [], color="0.9", label="scatter as configured")
    common_legend(figure, loc="outside upper center", ncols=2 if axes.shape[1] < 3 else 4)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
