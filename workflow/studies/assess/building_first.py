"""Which falls first, façade or building: what a building that yields does at the demand's PGA.

The building is the model's chain without a façade before it (`rocking.collapse.building`). It has
fallen where a storey comes to `smdof.fallen_drift_ratio`.
"""

import numpy as np
import pandas as pd

from studies.assess import dynamic_answer
from studies.assess.comparison import EXACT
from studies.shared.fragility import brackets_about, fit

COLUMNS = ["model", "curves", "stations", "building_median_g", "building_dispersion"]
COLUMNS += ["building_fell_at_demand", "building_probability", "building_low", "building_high"]
COLUMNS += ["building_first", "facade_median_g", "beyond_building"]
OF_BUILDING = {  # columns by keys of `dynamic_answer.answer`
    "median_pga_g": "building_median_g",
    "dispersion": "building_dispersion",
    "fell_at_demand": "building_fell_at_demand",
    "probability": "building_probability",
    "probability_low": "building_low",
    "probability_high": "building_high",
}


def answer(table, stations, demand_g, resamples, seed):
    """What the building does at the demand, beside the façade: a row with COLUMNS, None if elastic.

    Parameters
    ----------
    table : DataFrame
        A row a curve of one model: record, pga_median_g of the façade (NaN where nothing fell),
        pga_building_g (NaN where no storey came to its drift), building_max_g, up to where it was
        tried.
    stations : dict of str to str
        By record; those of one station are drawn together.
    demand_g : float
    resamples, seed : int

    `building_first` is the share of curves in which the building falls below the façade's PGA;
    `beyond_building` is 1 where the façade's median lies beyond the building's: it is then the
    median of a façade whose building is down.
    """
    if not table["building_max_g"].notna().any():
        return None
    building, facade = table["pga_building_g"], table["pga_median_g"]
    alike = table.assign(pga_median_g=building, pga_max_g=table["building_max_g"], runs_planar=0)
    row, _, _ = dynamic_answer.answer(alike, stations, demand_g, {}, resamples, seed)
    if len(table) == 1:  # which has a collapse and no median, as the façade's
        row["median_pga_g"] = np.nan
    facade_median_g = fit(*brackets_about(facade, table["pga_max_g"], EXACT)).median
    first = building.fillna(np.inf) < facade.fillna(np.inf)
    return {
        **{OF_BUILDING.get(key, key): value for key, value in row.items()},
        "building_first": float(first.mean()),
        "facade_median_g": facade_median_g,
        "beyond_building": float(facade_median_g > row["median_pga_g"]),
    }


def answers(collapse, demanded, *given):
    """Rows of `answer` by model; `demanded` is the façade's table with all its mechanisms."""
    about = ["record", "direction"]
    rows = []
    for model, table in demanded.groupby("model", sort=False):
        whole = collapse[collapse["model"] == model]
        building = whole[[*about, "pga_building_g", "building_max_g"]]
        rows.append(answer(table.merge(building, on=about, how="left"), *given))
    return pd.DataFrame([row for row in rows if row], columns=COLUMNS)


def said(data):
    """The answer for the first page; empty where the building stays elastic."""
    table = data.tables["building_first"]
    rows = table[table["model"] == data.relied]
    if rows.empty:
        rows = table
    if rows.empty:
        return ""
    row = next(rows.itertuples())
    share = row.building_probability
    if not np.isfinite(share):
        share = row.building_fell_at_demand / row.curves
    words = data.say(
        "page.building.first",
        drift=100.0 * data.config["smdof"]["fallen_drift_ratio"],
        share=share,
        model=row.model,
        before=row.building_first,
    )
    if row.beyond_building:
        medians = {"facade_g": row.facade_median_g, "building_g": row.building_median_g}
        words += " " + data.say("page.building.beyond", **medians)
    return words
