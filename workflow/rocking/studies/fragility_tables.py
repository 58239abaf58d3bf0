"""What a run says of fragility: brackets in every measure, fits, efficiency and sufficiency."""

import numpy as np
import pandas as pd

from rocking import stations
from rocking.collapse import probability
from rocking.studies import fragility, sufficiency

POINTS = 121
REACH = 3.5  # dispersions either side of the median
BRACKETS = [*probability.KEY, "station", "im", "low", "high", "weight"]
FITS = ["model", "im", "median", "dispersion", "ci_low", "ci_high"]
FITS += ["n", "n_censored", "n_records", "n_stations", "remark"]
EFFICIENCY = ["model", "im", "dispersion", "ci_low", "ci_high", "less_than_pga"]
EFFICIENCY += ["n", "n_records", "n_stations"]
CURVES = ["model", "im", "intensity", "probability", "band_low", "band_high"]
SLOPES = ["model", "im", "against", "slope", "ci_low", "ci_high", "sufficient", "n"]


def brackets(curves, dense, factors, measures, stations_of):
    """Collapse of every curve as weighted intervals in every measure.

    Parameters
    ----------
    curves, dense : DataFrame
        `tables/ida_collapse.csv` and `tables/collapse_probability.csv` of a run.
    factors : dict of dict
        Measure over PGA [unit of the measure/g], by record and name of the measure.
    measures : sequence of str
        Names of `records.intensity_measures.MEASURES`.
    stations_of : mapping
        Station by record.

    Returns
    -------
    DataFrame
        Columns BRACKETS; low = 0 and high = ∞ where open, weights of a curve sum to one.
    """
    rows = []
    tables = dict(list(dense.groupby(probability.KEY)))
    for row in curves.to_dict("records"):
        key = tuple(row[name] for name in probability.KEY)
        own = (*key, stations_of[row["record"]])
        for low, high, weight in probability.brackets(tables.get(key, dense[:0]), row):
            for name in measures:
                factor = factors[row["record"]][name]
                rows.append((*own, name, low * factor, high * factor, weight))
    return pd.DataFrame(rows, columns=BRACKETS)


def fits(table, settings):
    """Fitted fragilities, how efficient the measures are, and the fitted curves.

    Parameters
    ----------
    table : DataFrame
        See `brackets`.
    settings : dict
        Section fragility: measures, confidence, resamples, min_stations; seed.

    Returns
    -------
    fits, efficiency, curves : list of dict
        Rows with the columns FITS, EFFICIENCY and CURVES; NaN where the brackets determine no fit.
        less_than_pga is the share of resamples with less dispersion than by PGA; it and all
        intervals are NaN from too few stations (`rocking.stations`).
    """
    confidence, rows, efficiency, curves = settings["confidence"], [], [], []
    for model, of_model in table.groupby("model", sort=False):
        by_pga = None  # dispersions of the same draws, if PGA is among the measures
        for name in sorted(settings["measures"], key=lambda m: m != "pga_g"):
            part = of_model[of_model["im"] == name]
            found, draws = fragility.fit_table(part, settings)
            known, better = np.isfinite(found.median), np.nan
            if name == "pga_g":
                by_pga = draws.dispersion
            elif known and by_pga is not None and draws.stations >= stations.FEWEST:
                better = np.mean(draws.dispersion < 0.999 * by_pga)
            both = {
                **{"model": model, "im": name, "dispersion": found.dispersion},
                "n": len(part[probability.KEY].drop_duplicates()),
                "n_records": part["record"].nunique(),
                "n_stations": draws.stations,
            }
            ends = {
                of: dict(zip(("ci_low", "ci_high"), draws.interval(v, confidence), strict=True))
                for of, v in (("median", draws.median), ("dispersion", draws.dispersion))
                if known
            }
            never = part["weight"][np.isinf(part["high"]) & (part["weight"] > 0.0)].sum()
            own = {"median": found.median, "n_censored": round(float(never), 3)}
            own["remark"] = remark(found, part, settings)
            rows.append(both | own | ends.get("median", {}))
            efficiency.append(both | {"less_than_pga": better} | ends.get("dispersion", {}))
            if known:
                points = fragility.points(found, draws, confidence, POINTS, REACH)
                curves += [dict(zip(CURVES, (model, name, *p), strict=True)) for p in points]
    return rows, efficiency, curves


def remark(found, part, settings):
    """What the reader of a row has to know, in a few words."""
    words = []
    many = part["record"].nunique(), part["station"].nunique()
    censored = np.average(np.isinf(part["high"]), weights=part["weight"])
    if not np.isfinite(found.median):
        words.append("not determined: no collapse" if censored == 1.0 else "not determined")
    elif censored > 0.5:
        words.append("median extrapolated: most curves do not collapse")
    few = stations.remark(*many, settings["min_stations"])
    return "; ".join([*words, few] if few else words)


def slopes(curves, factors, properties, settings, stations_of):
    """Whether the collapse intensity in each measure still depends on what the motion is.

    Parameters
    ----------
    curves, factors, stations_of
        As of `brackets`.
    properties : dict of dict
        See `sufficiency.properties`, by record.
    settings : dict
        As of `fits`.

    Returns
    -------
    DataFrame
        Columns SLOPES; sufficient is 1 where the interval of the slope holds zero.
    """
    rows = []
    draws = (settings["confidence"], settings["resamples"], settings["seed"])
    for model, part in curves.groupby("model", sort=False):
        records = part["record"].to_numpy()
        places = [stations_of[record] for record in records]
        for name in settings["measures"]:
            factor = np.array([factors[record][name] for record in records])
            intensity = np.log(part["pga_median_g"].to_numpy(float) * factor)
            for against in sufficiency.PROPERTIES:
                x = np.log([properties[record][against] for record in records])
                found = sufficiency.slope(x, intensity, places, *draws)
                zero = int(found.low <= 0.0 <= found.high) if np.isfinite(found.low) else np.nan
                row = (found.value, found.low, found.high, zero, found.n)
                rows.append((model, name, against, *row))
    return pd.DataFrame(rows, columns=SLOPES)
