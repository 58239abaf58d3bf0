"""Collapse PGA with floor motions (W2) over that without (W1), by T1 and the façade's place."""

import itertools
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.collapse import probability
from rocking.collapse.ida import curve_key, read_curve
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_json, write_table

COLUMNS = [
    "record",
    "source",
    "direction",
    "t1_s",
    "base_height_ratio",
    "pga_w1_g",
    "pga_w2_g",
    "ratio",
    "censored",
]
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
MARKERS = "os^Dv<>"  # one more: both together repeat late


def capacity(curve, scan, spread):
    """PGA at which half collapse, or the highest intensity that stood; and whether it is that."""
    row = probability.summary(scan, curve, (), spread)
    censored = np.isnan(row["pga_median_g"])
    return row["pga_safe_g"] if censored else row["pga_median_g"], bool(censored)


def main(job):
    source = {}
    for path in job.input.records:
        facts = read_json(path)
        source[facts["name"]] = facts["source"]
    reference = {}
    spread = job.params.spread
    confirmed = {path: read_curve(path) for path in (*job.input.w1, *job.input.w2)}
    for path, at in zip(job.params.w1, job.input.w1_scans, strict=True):
        key = curve_key(scan := pd.read_csv(at))
        reference[key[1:]] = capacity(confirmed.get(path, ()), scan, spread)
    cases = {str(Path(path).parent): read_json(path) for path in job.input.facts}
    peaks = {path: read_json(path) for path in job.input.facts}
    rows = []
    for path, at in zip(job.params.w2, job.input.w2_scans, strict=True):
        _, record, direction = curve_key(scan := pd.read_csv(at))
        case = cases[str(Path(path).parent)]
        peak = peaks[str(Path(path).with_name(f"{record}.json"))]
        # the analysis scales by the peak at the façade's base
        of_base, open2 = capacity(confirmed.get(path, ()), scan, spread)
        w1, open1 = reference[record, direction]
        if np.isnan(of_base) or np.isnan(w1):
            continue  # every run failed
        w2 = of_base * peak["pga_g"] / peak["base_peak_g"]
        rows.append(
            (
                record,
                source[record],
                direction,
                case["t1_s"],
                case["base_height_ratio"],
                w1,
                w2,
                w2 / w1,
                int(open1 or open2),
            )
        )
    table = pd.DataFrame(rows, columns=COLUMNS)
    write_table(table, job.output.table)

    used = table[table["censored"] == 0]
    figure, axis = plt.subplots(figsize=(5.4, 3.4))
    places = used.groupby("base_height_ratio")
    looks = zip(itertools.cycle(COLOURS), itertools.cycle(MARKERS), strict=True)
    for (place, part), (colour, mark) in zip(places, looks, strict=False):
        look = {"color": colour, "marker": mark}
        axis.plot(part["t1_s"], part["ratio"], **look, ls="", ms=3, alpha=0.35, mew=0)
        groups = part.groupby("t1_s")["ratio"]
        middle, low = groups.median(), groups.quantile(0.1)
        label = (
            "façade from the ground up"
            if place == 0
            else f"base at {100 * place:.0f} % of the height"
        )
        axis.plot(middle.index, middle, **look, ls="-", ms=5, label=f"{label}: median")
        axis.plot(low.index, low, **look, ls=":", mfc="none", ms=5, label="10th percentile")
    axis.axhline(1.0, color="k", lw=0.7)
    axis.set(xlabel="first period of the building T1 [s]", ylabel="collapse PGA, W2 over W1 [-]")
    axis.set_ylim(bottom=0)
    axis.set_xlim(left=0)
    axis.legend(loc="best", ncols=max(1, used["base_height_ratio"].nunique()), fontsize=7)
    sides = "both directions" if table["direction"].nunique() > 1 else "one direction"
    axis.set_title(f"{table['record'].nunique()} records, {sides}", loc="left")
    style.save(figure, [job.output.png, job.output.pdf], job.input.records)


run(main, globals())
