"""Collapse PGA with floor motions (W2) over that without (W1), by T1 and the façade's place."""

import itertools

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_json, write_table
from studies.capacity_reduction.study import capacities, ratios

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
MARKERS = "os^Dv<>"  # one more: both together repeat late
FROM_THE_GROUND = "façade from the ground up"


def main(job):
    given, p = job.input, job.params
    sources = {known["name"]: known["source"] for known in map(read_json, given.records)}
    alone = capacities(p.w1, given.w1_scans, given.w1, p.spread, p.hazard_slope)
    behind = capacities(p.w2, given.w2_scans, given.w2, p.spread, p.hazard_slope)
    table = ratios(alone, behind, given.facts, sources)
    write_table(table, job.output.table)

    used = table[table["ratio_equivalent"].notna()]
    figure, axis = plt.subplots(figsize=(5.4, 3.4))
    places = used.groupby("base_height_ratio")
    looks = zip(itertools.cycle(COLOURS), itertools.cycle(MARKERS), strict=True)
    for (place, part), (colour, mark) in zip(places, looks, strict=False):
        look = {"color": colour, "marker": mark}
        axis.plot(part["t1_s"], part["ratio_equivalent"], **look, ls="", ms=3, alpha=0.35, mew=0)
        groups = part.groupby("t1_s")["ratio_equivalent"]
        middle, low = groups.median(), groups.quantile(0.1)
        label = f"base at {100 * place:.0f} % of the height" if place else FROM_THE_GROUND
        axis.plot(middle.index, middle, **look, ls="-", ms=5, label=f"{label}: median")
        axis.plot(low.index, low, **look, ls=":", mfc="none", ms=5, label="10th percentile")
    axis.axhline(1.0, color="k", lw=0.7)
    axis.set(
        xlabel="first period of the building T1 [s]",
        ylabel="equivalent collapse PGA, W2 over W1 [-]",
    )
    axis.set_ylim(bottom=0)
    axis.set_xlim(left=0)
    axis.legend(loc="best", ncols=max(1, used["base_height_ratio"].nunique()), fontsize=7)
    sides = "both directions" if table["direction"].nunique() > 1 else "one direction"
    axis.set_title(f"{table['record'].nunique()} records, {sides}", loc="left")
    style.save(figure, job.output, job.input.records)


run(main, globals())
