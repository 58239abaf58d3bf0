"""What the vertical motion of the ground changes in collapse, as ratios of intensities."""

import numpy as np
import pandas as pd

SHARES = {"none": 0.0, "hundredth": 0.01, "whole": 1.0}  # of the recorded vertical motion
MEASURES = ("p10", "median")
COLUMNS = ["record", "station", "model", "direction", "vertical", "vertical_over_horizontal"]
COLUMNS += [*(f"pga_{name}_g" for name in MEASURES), "runs_planar"]
KEY = ["record", "station", "model", "direction", "vertical_over_horizontal"]
SUMMARY = ["model", "measure", "vertical", "n", "n_censored", "ratio_median", "ratio_p10"]
SUMMARY += ["ratio_p90", "ratio_min", "ratio_max", "scatter", "within_5_percent"]


def ratios(table):
    """Collapse PGA over that without vertical motion, one row a curve, measure and share of it.

    Parameters
    ----------
    table : DataFrame
        Columns as COLUMNS; `vertical` one of SHARES.

    Returns
    -------
    DataFrame
        KEY, measure, vertical, ratio; NaN where one of the two never collapsed.
    """
    parts = []
    for name in MEASURES:
        wide = table.pivot(index=KEY, columns="vertical", values=f"pga_{name}_g")
        wide = wide.div(wide["none"], axis=0).drop(columns="none")
        long = wide.melt(ignore_index=False, var_name="vertical", value_name="ratio")
        parts.append(long.assign(measure=name).reset_index())
    return pd.concat(parts, ignore_index=True)


def summary(table):
    """Distribution of the ratios of `ratios`, by model, measure and share of the motion.

    `scatter` is the standard deviation of ln ratio. That of a hundredth of the vertical motion,
    which is no load worth naming, is what the scatter of histories near collapse alone makes.

    Returns
    -------
    DataFrame
        Columns as SUMMARY.
    """
    rows = []
    for key, part in ratios(table).groupby(["model", "measure", "vertical"], sort=False):
        ratio = part["ratio"].dropna().to_numpy()
        ends = np.full(5, np.nan)
        if ratio.size:
            ends = np.percentile(ratio, [50, 10, 90, 0, 100])
        scatter = np.std(np.log(ratio), ddof=1) if ratio.size > 1 else np.nan
        near = np.mean(np.abs(ratio - 1.0) <= 0.05) if ratio.size else np.nan
        rows.append((*key, len(part), len(part) - ratio.size, *ends, scatter, near))
    return pd.DataFrame(rows, columns=SUMMARY)
