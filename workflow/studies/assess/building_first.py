"""Which falls first, façade or building: what a building that yields does at the demand's PGA.

The building is the model's chain without a façade before it (`rocking.collapse.building`). It has
fallen where a storey comes to `smdof.fallen_drift_ratio`.
"""

import numpy as np
import pandas as pd
from rocking.stations import FEWEST

from studies.assess.comparison import EXACT
from studies.assess.dynamic_answer import CONFIDENCE
from studies.shared.fragility import bootstrap, brackets_about, fit

COLUMNS = ["model", "curves", "stations", "building_median_g", "building_dispersion"]
COLUMNS += ["building_fell_at_demand", "building_probability", "building_low", "building_high"]
COLUMNS += ["building_first", "facade_median_g", "beyond_building"]


def answer(table, stations, demand_g, resamples, seed):
    """What the building does at the demand, beside the façade: a row of COLUMNS, None if elastic.

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
    known = table["building_max_g"].notna()
    if not known.any():
        return None
    building, facade = table["pga_building_g"], table["pga_median_g"]
    low, high = brackets_about(building, table["building_max_g"], EXACT)
    found, place = fit(low, high), table["record"].map(stations)
    own = fit(*brackets_about(facade, table["pga_max_g"], EXACT)).median
    first = building.fillna(np.inf) < facade.fillna(np.inf)
    row = {
        "model": table["model"].iloc[0],
        "curves": len(table),
        "stations": place.nunique(),
        "building_median_g": found.median,
        "building_dispersion": found.dispersion,
        "building_fell_at_demand": int((building <= demand_g).sum()),
        **dict.fromkeys(("building_probability", "building_low", "building_high"), np.nan),
        "building_first": float(first.mean()),
        "facade_median_g": own,
        "beyond_building": float(own > found.median),
    }
    if place.nunique() >= FEWEST and np.isfinite(found.median):
        draws = bootstrap(low, high, place, resamples, seed)
        row["building_probability"] = float(found.probability(demand_g))
        ends = draws.band([demand_g], CONFIDENCE)
        (row["building_low"],), (row["building_high"],) = ends
    return row


def answers(collapse, demanded, *given):
    """Rows of `answer` by model; `demanded` is the façade's table with all its mechanisms."""
    about = ["record", "direction"]
    rows = []
    for model, own in demanded.groupby("model", sort=False):
        whole = collapse[collapse["model"] == model]
        building = whole[[*about, "pga_building_g", "building_max_g"]]
        rows.append(answer(own.merge(building, on=about, how="left"), *given))
    return pd.DataFrame([row for row in rows if row], columns=COLUMNS)


def said(data):
    """The answer for the first page; empty where the building stays elastic."""
    table = data.tables["building_first"]
    own = table[table["model"] == data.relied]
    if own.empty:
        own = table
    if own.empty:
        return ""
    row = next(own.itertuples())
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
