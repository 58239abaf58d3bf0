"""What the vertical motion of the ground changes in collapse, as ratios of intensities."""

import numpy as np
import pandas as pd
from rocking.collapse.case import Variant
from rocking.collapse.motion import Motion
from rocking.collapse.ratios import Ratios, spread
from rocking.collapse.varied import collapses

SHARES = {"none": 0.0, "hundredth": 0.01, "whole": 1.0}  # of the vertical motion
MEASURES = ("p10", "median")
KEY = ["record", "station", "model", "direction", "vertical_over_horizontal"]
COLUMNS = [*KEY[:4], "vertical", KEY[4], *(f"pga_{name}_g" for name in MEASURES), "runs_planar"]
SUMMARY = {
    **{"n": "n", "n_censored": "n_censored", "ratio_median": 50, "ratio_p10": 10},
    **{"ratio_p90": 90, "ratio_min": 0, "ratio_max": 100, "scatter": "scatter"},
    "within_5_percent": lambda group: Ratios(np.abs(group.known - 1.0)).share(high=0.05),
}


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
    rows = pd.DataFrame(collapses(cases, both, directions, variants=variants()))
    return rows.assign(station=station, vertical_over_horizontal=size)[COLUMNS]


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
