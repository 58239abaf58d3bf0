"""Figure 9: a panel a record and direction, with its collapse probability beside it.

Behind stand the outcomes of the dense scan, before them YADE's runs, and beside them the share
that falls: one sees where one answer exists and where a distribution does.
"""

import json

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.collapse import probability
from rocking.collapse.ida import by_curve, highest, read_curve
from rocking.figures import style
from rocking.figures.ida import draw_curve, draw_probability, draw_pushover, draw_scan, symbols
from rocking.figures.panels import common_legend, plain_log, ticks
from rocking.runtime.script import run
from rocking.tables import read_frame

LOG_RATIO = 4.0  # between the strongest and the weakest model of a panel: the others are squeezed
LABEL = "PGA [g]"
STATIC = "; static λ [-]"  # on the same axis: the acceleration, over g, that holds the façade there
BESIDE = (1.06, 0.0, 0.2, 1.0)  # place of the probability, over the panel's width and height


def main(job):
    p = job.params
    facade = json.loads(p.facade)["facade"]
    titles = style.titles(job.input.facts)
    scans, curves = by_curve(job.input.scans), by_curve(job.input.ida, read_curve)
    collapse = read_frame(job.input.collapse).to_dict("records")
    rows = {tuple(r[k] for k in probability.KEY): r for r in collapse}
    tables = dict(list(read_frame(job.input.probability).groupby(probability.KEY)))
    shape = (len(p.records), len(p.directions))
    size = (max(5.0, 4.0 * shape[1]), 0.9 + 2.0 * shape[0])
    figure, axes = plt.subplots(*shape, figsize=size, squeeze=False, sharex=True)
    blank = pd.DataFrame(columns=probability.PROBABILITY_COLUMNS)
    pushovers = list(job.input.pushover) or (
        [] if facade["hinges_m"] or facade["courses"] else [None]
    )
    label = LABEL + (STATIC if pushovers else "")
    for i, record in enumerate(p.records):
        for j, direction in enumerate(p.directions):
            axis, panel = axes[i, j], (record, direction)
            shown = [highest(row) for key, row in rows.items() if key[1:] == panel]
            shown = [g for g in shown if np.isfinite(g)] or [1.0]
            top = 1.08 * max(shown)
            beside = axis.inset_axes(BESIDE, sharey=axis)
            for path in pushovers:
                draw_pushover(axis, path, facade)
            models = [key[0] for key in rows if key[1:] == (record, direction)]
            for place, key in enumerate((model, record, direction) for model in models):
                if key in scans:
                    draw_scan(axis, scans[key])
                if key in curves:
                    draw_curve(axis, curves[key], top, joined=key not in scans)
                draw_probability(beside, place, tables.get(key, blank), rows[key], 1.1 * top)
            sign = style.SIGNS[direction]
            axis.set_title(f"{titles[record]}, direction {sign}", loc="left")
            axis.set(xlim=(0, 1.0), ylim=(0, top), ylabel=label if j == 0 else None)
            # bonded façades may stand so much that the others vanish
            if max(shown) > LOG_RATIO * min(shown):
                axis.set_yscale("log")
                axis.set_ylim(0.85 * lowest(panel, scans, curves, min(shown)), 1.1 * top)
                plain_log(axis.yaxis, (1.0, 2.0, 5.0))
            beside.set(xlim=(-0.6, len(models) - 0.4))
            beside.grid(False)
            ticks(beside.xaxis, range(len(models)), [])
            beside.tick_params(labelleft=False)
            if i == shape[0] - 1:
                axis.set_xlabel("peak top displacement d/b [-]")
                beside.set_xlabel("share that falls:\nwhite 0, full 1")
                ticks(beside.xaxis, range(len(models)), models)
                beside.tick_params("x", labelsize=6.5, rotation=90 if len(models) > 2 else 0)
    shares = any(
        len(table) and table["probability_yade"].notna().any() for table in tables.values()
    )
    more = symbols(bool(scans), shares)
    common_legend(figure, more=more, loc="outside upper center", ncols=3 if shape[1] == 1 else 6)
    style.save(figure, job.output, job.input.facts)


def lowest(panel, scans, curves, least):
    """Lowest PGA that was run in a panel, by either solver; a fifth of `least` without one."""
    tables = [table for key, table in (*scans.items(), *curves.items()) if key[1:] == panel]
    return min((table["pga_g"].min() for table in tables), default=0.2 * least)


run(main, globals())
