"""Statistics of perturbed ensembles: bands of d/b, share of collapses.

An ensemble table has one row a realisation and intensity (columns pga_g, realisation,
d_over_b, collapsed, status). Failed runs say nothing about the façade and are
left out; an overturned run counts as d/b = 1.
"""

import numpy as np
import pandas as pd


def _valid(rows):
    """Rows as a table, without failed runs, overturned ones at d/b = 1."""
    table = pd.DataFrame(rows)
    if table.empty:
        return table
    table = table[table["status"] != "failed"].copy()
    table["pga_g"] = table["pga_g"].astype(float)
    table["collapsed"] = table["collapsed"].astype(float)
    table["d_over_b"] = table["d_over_b"].astype(float).where(table["collapsed"] == 0.0, 1.0)
    return table


def bands(ensemble_rows, percentiles=(10.0, 90.0)):
    """Median and percentiles [%] of d/b and the share of collapses, by ascending PGA."""
    columns = ["pga_g", "realisations", "probability"]
    columns += [f"d_over_b_{name}" for name in ("low", "median", "high")]
    table = _valid(ensemble_rows)
    if table.empty:
        return pd.DataFrame(columns=columns)
    out = []
    for pga_g, group in table.groupby("pga_g", sort=True):
        low, middle, high = np.percentile(group["d_over_b"], [percentiles[0], 50.0, percentiles[1]])
        out.append((pga_g, len(group), group["collapsed"].mean(), low, middle, high))
    return pd.DataFrame(out, columns=columns)
