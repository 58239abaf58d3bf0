"""Ratios of every check to the dynamic answer, over the façades of the study, table and figures."""

import json

import numpy as np
from rocking.assessment.code_checks import CHECKS
from rocking.assessment.comparison import compare, gather
from rocking.figures import style
from rocking.figures.panels import common_legend, intervals, panels, ticks
from rocking.runtime.script import run
from rocking.tables import write_table

from yade_scripts.model.registry import MODELS

GROUPS = {"height": "height [m]", "slenderness": "h/b [-]", "T1": "T1 [s]"}
GROUPS |= {"pulse share": "pulse share [-]", "PGV/PGA": "PGV/PGA [s]"}
SHOWN = {"linear_ground": "o", "slv_ground": "s", "slv_both": "^", "slc_both": "D"}


def draw_ratios(table, output, facts):
    """A panel a model: median ratio with one logarithmic deviation, unsafe share beside."""
    table = table[(table["group"] == "all") & (table["level"] == "median")]
    models = list(dict.fromkeys(table["model"]))
    figure, axes = panels(len(models), len(models), (2.6, 4.0), around=(2.2, 0.0), sharey=True)
    keys = [k for k in CHECKS if (table["check"] == k).any()]
    for axis, model in zip(axes.flat, models, strict=True):
        own = table[table["model"] == model].set_index("check").reindex(keys)
        y = np.arange(len(keys))[::-1]
        middle, spread = own["median_ratio"], np.exp(own["log_scatter"])
        axis.axvspan(1.0, 100.0, color="0.92", lw=0)
        axis.axvline(1.0, color="0.3", lw=0.8)
        look = {"marker": MODELS[model].marker, "color": "0.1", "ms": 4, "lw": 0.9}
        intervals(axis, y, middle, middle / spread, middle * spread, along="x", **look)
        for at, (_, row) in zip(y, own.iterrows(), strict=True):
            words = f"{100 * row['unsafe_share']:.0f} %"
            axis.text(1.02, at, words, transform=axis.get_yaxis_transform(), va="center", size=7)
        axis.set(xscale="log", xlim=(0.02, 15.0), ylim=(-0.7, len(keys) - 0.3))
        ticks(axis.xaxis, (0.1, 0.3, 1.0, 3.0, 10.0))
        axis.set_title(f"{model}; right: share unsafe", size=8)
        axis.set_xlabel("PGA check / PGA collapse [-]")
        axis.set_yticks(y, [CHECKS[k] for k in keys])
    style.save(figure, output, facts)


def draw_groups(table, output, facts):
    """Share on the unsafe side by what façades and records have in common."""
    table = table[table["level"] == "median"]
    models = list(dict.fromkeys(table["model"]))
    count = len(models) * len(GROUPS)
    figure, axes = panels(count, len(GROUPS), (1.8, 1.7), around=(0.0, 0.9), sharey=True)
    for row, model in zip(axes, models, strict=True):
        row[0].set_ylabel(f"{model}: unsafe [%]")
        for axis, group in zip(row, GROUPS, strict=True):
            own = table[(table["model"] == model) & (table["group"] == group)]
            values = list(dict.fromkeys(own["value"]))
            if not values:
                axis.set_axis_off()
                axis.text(0.5, 50.0, f"{model} has no {group}", ha="center", size=7)
                continue
            for i, (check, mark) in enumerate(SHOWN.items()):
                part = own[own["check"] == check].set_index("value").reindex(values)
                x, grey = np.arange(len(values)) + 0.16 * (i - 1.5), str(0.18 * i)
                share = (100 * part[name] for name in ("unsafe_share", "ci_low", "ci_high"))
                look = {"color": grey, "mfc": "none" if i % 2 else grey, "ms": 4, "lw": 0.8}
                look |= {"marker": mark, "capsize": 0, "label": CHECKS[check]}
                intervals(axis, x, *share, **look)
            axis.set_xticks(range(len(values)), [v.replace(" ", "\n") for v in values])
            axis.set(ylim=(-3, 103), xlim=(-0.5, len(values) - 0.5))
    for axis, heading in zip(axes[-1], GROUPS.values(), strict=True):
        axis.set_xlabel(heading)
    common_legend(figure, loc="outside upper center", ncols=4, fontsize=7)
    style.save(figure, output, facts)


def main(job):
    table = gather(json.loads(job.params.runs))
    write_table(table, job.output.ratios)
    found = compare(table, job.params.resamples, job.params.seed)
    write_table(found, job.output.table)
    draw_ratios(found, [job.output.png, job.output.pdf], job.input.facts)
    draw_groups(found, [job.output.groups_png, job.output.groups_pdf], job.input.facts)


run(main, globals())
