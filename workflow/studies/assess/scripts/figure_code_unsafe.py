"""Share of checks on the unsafe side, by what façades and records have in common."""

import numpy as np
from rocking.figures import style
from rocking.figures.panels import common_legend, intervals, panels
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.assess.catalogue import SAY

GROUPS = {"height": "height [m]", "slenderness": "h/b [-]", "T1": "T1 [s]"}
GROUPS |= {"pulse share": "pulse share [-]", "PGV/PGA": "PGV/PGA [s]"}
SHOWN = {"linear_ground": "o", "slv_ground": "s", "slv_both": "^", "slc_both": "D"}


def main(job):
    table = read_frame(job.input.table)
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
                look |= {"marker": mark, "capsize": 0, "label": SAY(f"table.check.{check}")}
                intervals(axis, x, *share, **look)
            axis.set_xticks(range(len(values)), [v.replace(" ", "\n") for v in values])
            axis.set(ylim=(-3, 103), xlim=(-0.5, len(values) - 0.5))
    for axis, heading in zip(axes[-1], GROUPS.values(), strict=True):
        axis.set_xlabel(heading)
    common_legend(figure, loc="outside upper center", ncols=4, fontsize=7)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
