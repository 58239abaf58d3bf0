"""What a run says of fragility: brackets in every measure, fits, efficiency and sufficiency."""

import numpy as np
import pandas as pd
from rocking import stations
from rocking.collapse import probability
from rocking.collapse.equivalent import cells

from studies.shared import fragility, sufficiency

POINTS = 121
REACH = 3.5  # dispersions either side of the median
# readings of a curve: the share that falls at x, its first crossing
SHARE, FIRST = "share", "first"
BRACKETS = [*probability.KEY, "station", "im", "reading", "low", "high", "weight"]
FITS = ["model", "im", "median", "dispersion", "ci_low", "ci_high"]
FITS += ["n", "n_censored", "n_records", "n_stations", "median_first", "dispersion_first", "remark"]
FACTORS = ["record", "station", "im", "per_pga"]
EFFICIENCY = ["model", "im", "dispersion", "ci_low", "ci_high", "less_than_pga"]
EFFICIENCY += ["n", "n_records", "n_stations"]
CURVES = ["model", "im", "intensity", "probability", "band_low", "band_high", "share"]
SLOPES = ["model", "im", "against", "slope", "ci_low", "ci_high", "sufficient", "n"]


def brackets(curves, dense, factors, measures, stations_of, slope):
    """Collapse of every curve as weighted intervals in every measure, by both readings: BRACKETS.

    `curves` and `dense` are tables/ida_collapse.csv and collapse_probability.csv; `factors` the
    measure over PGA [unit of the measure/g] by record and name; the slope is that of the hazard by
    which a curve that stands again above a collapse is read, see `probability.brackets`. low = 0
    and high = ∞ where open, weights of a curve and reading sum to one.
    """
    rows = []
    for key, table, row in by_curve(curves, dense):
        labels = (*key, stations_of[row["record"]])
        for reading, by in ((SHARE, slope), (FIRST, None)):
            for low, high, weight in probability.brackets(table, row, slope=by):
                for name in measures:
                    factor = factors[row["record"]][name]
                    rows.append((*labels, name, reading, low * factor, high * factor, weight))
    return pd.DataFrame(rows, columns=BRACKETS)


def by_curve(curves, dense):
    """Key of every curve, its rows of the collapse probability, its row of intensities."""
    tables = dict(list(dense.groupby(probability.KEY)))
    for row in curves.to_dict("records"):
        key = tuple(row[name] for name in probability.KEY)
        yield key, tables.get(key, dense[:0]), row


def shares(curves, dense, per_pga):
    """Collapse probability of every curve against a measure: intensity and share by its key.

    See `probability.dense_share`; without curves of which every run failed.
    """
    unscaled = {
        key: (per_pga[row["record"]], *probability.dense_share(table, row))
        for key, table, row in by_curve(curves, dense)
    }
    return {key: (factor * x, share) for key, (factor, x, share) in unscaled.items() if x.size}


def building_shares(curves, dense, per_pga):
    """Of every curve with a building that yields: intensity, share that falls, share of it down.

    By key; without curves whose building stays elastic or was not followed.
    """
    of_curves: dict[tuple, tuple] = {}
    if "probability_building" not in dense:  # tables of other programs
        return of_curves
    for key, table, row in by_curve(curves, dense):
        known = table[table["probability_building"].notna()]
        if len(known):
            x, fell = probability.dense_share(known, row)
            down = np.interp(x, known["pga_g"], known["probability_building"])
            of_curves[key] = per_pga[row["record"]] * x, fell, down
    return of_curves


def share_at(of_curves, intensity):
    """Share of curves (`shares`) that fall at intensities (n,), each by its own probability there.

    NaN above what some curve was run to without falling for good there.
    """
    at, rows = np.asarray(intensity, float), []
    for x, share in of_curves:
        low, _ = cells(x)
        place = np.searchsorted(low, at, side="right") - 1
        fallen = np.where(place < 0, 0.0, share[np.maximum(place, 0)])
        rows.append(np.where((at > x[-1]) & (share[-1] < 1.0), np.nan, fallen))
    return np.mean(rows, axis=0)


def fits(table, settings):
    """Rows of fitted fragilities, of how efficient the measures are, and of the fitted curves.

    They are FITS, EFFICIENCY and CURVES, by the share that falls at an intensity; median_first and
    dispersion_first are those of first crossings. NaN where the brackets determine no fit.
    less_than_pga is the share of resamples with less dispersion than by PGA; it and all intervals
    are NaN from too few stations (`rocking.stations`).
    """
    confidence, rows, efficiency, curves = settings["confidence"], [], [], []
    for model, of_model in table.groupby("model", sort=False):
        by_pga = None  # dispersions of the same draws, if PGA is among the measures
        for name in sorted(settings["measures"], key=lambda m: m != "pga_g"):
            of_measure = of_model[of_model["im"] == name]
            part = of_measure[of_measure["reading"] == SHARE]
            fit, draws = fragility.fit_table(part, settings)
            known, better = np.isfinite(fit.median), np.nan
            if name == "pga_g":
                by_pga = draws.dispersion
            elif known and by_pga is not None and draws.stations >= stations.FEWEST:
                better = np.mean(draws.dispersion < 0.999 * by_pga)
            both = {
                **{"model": model, "im": name, "dispersion": fit.dispersion},
                "n": len(part[probability.KEY].drop_duplicates()),
                "n_records": part["record"].nunique(),
                "n_stations": draws.stations,
            }
            ends = {
                of: dict(zip(("ci_low", "ci_high"), draws.interval(v, confidence), strict=True))
                for of, v in (("median", draws.median), ("dispersion", draws.dispersion))
                if known
            }
            row = {"median": fit.median, "n_censored": round(never(part), 3)}
            row |= first(of_measure[of_measure["reading"] == FIRST])
            row["remark"] = remark(fit, part, settings)
            rows.append(both | row | ends.get("median", {}))
            efficiency.append(both | {"less_than_pga": better} | ends.get("dispersion", {}))
            if known:
                points = fragility.points(fit, draws, confidence, POINTS, REACH)
                curves += [dict(zip(CURVES, (model, name, *p), strict=False)) for p in points]
    return rows, efficiency, curves


def never(part):
    """Curves that never collapse, parts of curves included."""
    return float(part["weight"][np.isinf(part["high"]) & (part["weight"] > 0.0)].sum())


def first(part):
    """Median and dispersion of first crossings."""
    fit = fragility.fit(*(part[name].to_numpy() for name in ("low", "high", "weight")))
    return {"median_first": fit.median, "dispersion_first": fit.dispersion}


def remark(fit, part, settings):
    """What the reader of a row has to know, in a few words."""
    words = []
    many = part["record"].nunique(), part["station"].nunique()
    censored = np.average(np.isinf(part["high"]), weights=part["weight"])
    if not np.isfinite(fit.median):
        words.append("not determined: no collapse" if censored == 1.0 else "not determined")
    elif censored > 0.5:
        words.append("median extrapolated: most curves do not collapse")
    few = stations.remark(*many, settings["min_stations"])
    return "; ".join([*words, few] if few else words)


def slopes(curves, factors, properties, settings, stations_of):
    """Whether the collapse intensity in each measure still depends on what the motion is: SLOPES.

    That of a curve is its equivalent one, by the same reading as the fits; `properties` are those
    of `sufficiency.properties` by record. sufficient is 1 where the interval of the slope holds
    zero.
    """
    rows = []
    draws = (settings["confidence"], settings["resamples"], settings["seed"])
    for model, part in curves.groupby("model", sort=False):
        records = part["record"].to_numpy()
        places = [stations_of[record] for record in records]
        for name in settings["measures"]:
            factor = np.array([factors[record][name] for record in records])
            intensity = np.log(probability.one_number(part).to_numpy(float) * factor)
            for against in sufficiency.PROPERTIES:
                x = np.log([properties[record][against] for record in records])
                slope = sufficiency.slope(x, intensity, places, *draws)
                zero = int(slope.low <= 0.0 <= slope.high) if np.isfinite(slope.low) else np.nan
                row = (slope.value, slope.low, slope.high, zero, slope.n)
                rows.append((model, name, against, *row))
    return pd.DataFrame(rows, columns=SLOPES)
