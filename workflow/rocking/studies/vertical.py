"""What the vertical motion of the ground changes in collapse, as ratios of intensities."""

import numpy as np
import pandas as pd

from rocking.collapse.case import Variant
from rocking.collapse.motion import Motion
from rocking.collapse.ratios import Ratios, spread
from rocking.collapse.varied import collapses
from rocking.runtime.drawing import drawing
from yade_scripts.model.registry import MODELS

SHARES = {"none": 0.0, "hundredth": 0.01, "whole": 1.0}  # of the vertical motion
MEASURES = ("p10", "median")
KEY = ["record", "station", "model", "direction", "vertical_over_horizontal"]
COLUMNS = [*KEY[:4], "vertical", KEY[4], *(f"pga_{name}_g" for name in MEASURES), "runs_planar"]
SUMMARY = {
    **{"n": "n", "n_censored": "n_censored", "ratio_median": 50, "ratio_p10": 10},
    **{"ratio_p90": 90, "ratio_min": 0, "ratio_max": 100, "scatter": "scatter"},
    "within_5_percent": lambda found: Ratios(np.abs(found.known - 1.0)).share(high=0.05),
}
LINES = ("-", "--", "-.", ":")
LEAST = 1.4  # the axes of ratios reach so far to both sides of one, or to the last ratio
TICKS = (0.1, 0.2, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.4, 1.7, 2.0, 3.0, 5.0, 10.0)


def variants():
    """Every share of the vertical motion, that without it first."""
    return [Variant(n, motion={"vertical": s}, about={"vertical": n}) for n, s in SHARES.items()]


def collapse(cases, motion, directions, station, table, treatment):
    """Collapse without, with a hundredth of, and with the vertical motion of a record: COLUMNS.

    That of the records table is read anew, treated (baseline, seed) as the record was.
    """
    both = Motion.named(motion.name, table, **{**treatment, "vertical_motion": "on"})
    record = both.record
    size = np.abs(record.vertical_m_s2).max() / np.abs(record.acceleration_m_s2).max()
    found = pd.DataFrame(collapses(cases, both, directions, variants=variants()))
    return found.assign(station=station, vertical_over_horizontal=size)[COLUMNS]


def ratios(table):
    """Collapse PGA over that without vertical motion, one row a curve, measure and share of it.

    NaN where one of the two never collapsed.
    """
    parts = []
    for name in MEASURES:
        wide = table.pivot(index=KEY, columns="vertical", values=f"pga_{name}_g")
        wide = wide.div(wide["none"], axis=0).drop(columns="none")
        long = wide.melt(ignore_index=False, var_name="vertical", value_name="ratio")
        parts.append(long.assign(measure=name).reset_index())
    return pd.concat(parts, ignore_index=True)


def summary(table):
    """Distribution of the ratios of `ratios`, by model, measure and share of the motion: SUMMARY.

    `scatter` is the standard deviation of ln ratio. That of a hundredth of the vertical motion,
    which is no load worth naming, is what the scatter of histories near collapse alone makes.
    """
    return spread(ratios(table), ["model", "measure", "vertical"], SUMMARY)


@drawing
def draw(table):
    """Draw collapse PGA with over without vertical motion: its distribution, and by its size."""
    import matplotlib.pyplot as plt

    from rocking.figures import style
    from rocking.figures.panels import distribution, ticks

    found = ratios(table)
    found = found[found["measure"] == "median"]
    reach = max(LEAST, 1.03 * float(np.exp(np.log(found["ratio"]).abs().max())))
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.0, 3.4))
    for i, model in enumerate(dict.fromkeys(found["model"])):
        kind, ls = MODELS[model], LINES[i % len(LINES)]
        of_model = found[found["model"] == model]
        for share, look, label in (
            ("hundredth", {"color": style.GREY, "lw": 0.9}, f"{model}, a hundredth of it"),
            ("whole", {"color": kind.colour}, model),
        ):
            part = of_model[of_model["vertical"] == share]
            look = {"ls": ls, "drawstyle": "steps-mid", "label": label, **look}
            distribution(left, part["ratio"], **look)
        look = {"color": kind.colour, "mfc": "none" if i % 2 else kind.colour, "label": model}
        x, y = part["vertical_over_horizontal"], part["ratio"]
        right.plot(x, y, ls="", marker=kind.marker, ms=4, **look)
    left.axvline(1.0, color=style.GREY, lw=0.8, zorder=0)
    right.axhline(1.0, color=style.GREY, lw=0.8, zorder=0)
    label = "collapse PGA, with over without vertical motion [-]"
    left.set(ylim=(0, 1), ylabel="share of curves [-]")
    right.set(xlabel="PGA, vertical over horizontal [-]")
    left.set(xscale="log", xlim=(1.0 / reach, reach), xlabel=label)
    right.set(yscale="log", ylim=(1.0 / reach, reach), ylabel=label)
    for side in (left.xaxis, right.yaxis):
        ticks(side, [t for t in TICKS if 1.0 / reach < t < reach])
    left.legend(loc="upper left", fontsize=7)
    right.legend(loc="upper right", fontsize=7)
    figure.suptitle(f"components with their vertical motions: {table['record'].nunique()}")
    return figure
