"""Fragility of every model by every intensity measure, and how efficient the measures are.

Writes tables/fragility.csv, tables/intensity_measures.csv and tables/im_sufficiency.csv (slopes of
the collapse intensity on properties of the motion), and what they rest on:
fragility/brackets.csv (the collapse intervals of the curves, in every measure) and
fragility/curves.csv (fitted probability with its band).
"""

import numpy as np
import pandas as pd
from rocking.collapse import probability
from rocking.mechanics.closed_forms import block
from rocking.records import read_csv
from rocking.records.intensity_measures import per_pga, record_measures
from rocking.runtime.script import run
from rocking.studies import fragility, sufficiency
from rocking.tables import write_table

POINTS = 121
REACH = 3.5  # dispersions either side of the median


def brackets(curves, dense, factors, measures):
    """Collapse of every curve as weighted intervals in every measure, one row each."""
    rows = []
    tables = dict(list(dense.groupby(probability.KEY)))
    for row in curves.to_dict("records"):
        key = tuple(row[name] for name in probability.KEY)
        for low, high, weight in probability.brackets(tables.get(key, dense[:0]), row):
            for name in measures:
                factor = factors[row["record"]][name]
                rows.append((*key, name, low * factor, high * factor, weight))
    return pd.DataFrame(rows, columns=[*probability.KEY, "im", "low", "high", "weight"])


def remark(found, part, settings):
    """What the reader of a row has to know, in a few words."""
    words = []
    records = part["record"].nunique()
    censored = np.average(np.isinf(part["high"]), weights=part["weight"])
    if not np.isfinite(found.median):
        words.append("not determined: no collapse" if censored == 1.0 else "not determined")
    elif censored > 0.5:
        words.append("median extrapolated: most curves do not collapse")
    if records < settings["min_records"]:
        words.append(f"indicative: {records} record{'s' if records > 1 else ''}")
    return "; ".join(words)


def slopes(curves, factors, properties, settings):
    """Whether the collapse intensity in each measure still depends on what the motion is."""
    rows = []
    for model, part in curves.groupby("model", sort=False):
        records = part["record"].to_numpy()
        for name in settings["measures"]:
            factor = np.array([factors[record][name] for record in records])
            intensity = np.log(part["pga_median_g"].to_numpy(float) * factor)
            for against in sufficiency.PROPERTIES:
                x = np.log([properties[record][against] for record in records])
                draws = (settings["confidence"], settings["resamples"], settings["seed"])
                found = sufficiency.slope(x, intensity, records, *draws)
                zero = int(found.low <= 0.0 <= found.high) if np.isfinite(found.low) else np.nan
                row = (found.value, found.low, found.high, zero, found.n)
                rows.append((model, name, against, *row))
    columns = ["model", "im", "against", "slope", "ci_low", "ci_high", "sufficient", "n"]
    return pd.DataFrame(rows, columns=columns)


def main(job):
    settings, confidence = job.params.fragility, job.params.fragility["confidence"]
    p_rad_s = block(job.params.facade["height_m"], job.params.facade["thickness_m"]).p_rad_s
    chain = job.params.smdof
    factors, properties = {}, {}
    for path in job.input.records:
        record = read_csv(path)
        properties[record.name] = sufficiency.properties(record)
        factors[record.name] = per_pga(
            record_measures(record, chain["period_s"], chain["damping_ratio"], p_rad_s)
        )
    found = [pd.read_csv(path) for path in (job.input.collapse, job.input.probability)]
    table = brackets(*found, factors, settings["measures"])
    write_table(slopes(found[0], factors, properties, settings), job.output.sufficiency)
    fits, efficiency, curves = [], [], []
    for model, of_model in table.groupby("model", sort=False):
        reference = None  # dispersions by PGA of the same draws, if PGA is among the measures
        for name in sorted(settings["measures"], key=lambda m: m != "pga_g"):
            part = of_model[of_model["im"] == name]
            low, high, weight = (part[column].to_numpy() for column in ("low", "high", "weight"))
            found = fragility.fit(low, high, weight)
            draws = fragility.bootstrap(
                low, high, part["record"], settings["resamples"], settings["seed"], weight
            )
            curves_used = len(part[probability.KEY].drop_duplicates())
            never = np.isinf(high) & (weight > 0.0)
            known = np.isfinite(found.median)
            blank = (np.nan, np.nan)
            median_ci = draws.interval("median", confidence) if known else blank
            spread_ci = draws.interval("dispersion", confidence) if known else blank
            if name == "pga_g":
                reference = draws.dispersion
            better = np.nan
            if known and reference is not None and name != "pga_g":
                better = np.mean(draws.dispersion < 0.999 * reference)
            fits.append(
                (
                    model,
                    name,
                    found.median,
                    found.dispersion,
                    *median_ci,
                    curves_used,
                    round(float(weight[never].sum()), 3),
                    part["record"].nunique(),
                    remark(found, part, settings),
                )
            )
            efficiency.append(
                (
                    model,
                    name,
                    found.dispersion,
                    *spread_ci,
                    better,
                    curves_used,
                    part["record"].nunique(),
                )
            )
            if known:
                x = found.median * np.exp(np.linspace(-REACH, REACH, POINTS) * found.dispersion)
                lower, upper = draws.band(x, confidence)
                curves += list(
                    zip(
                        [model] * POINTS,
                        [name] * POINTS,
                        x,
                        found.probability(x),
                        lower,
                        upper,
                        strict=True,
                    )
                )
    write_table(
        fits,
        job.output.fragility,
        [
            "model",
            "im",
            "median",
            "dispersion",
            "ci_low",
            "ci_high",
            "n",
            "n_censored",
            "n_records",
            "remark",
        ],
    )
    write_table(
        efficiency,
        job.output.measures,
        [
            "model",
            "im",
            "dispersion",
            "ci_low",
            "ci_high",
            "less_than_pga",
            "n",
            "n_records",
        ],
    )
    write_table(
        curves,
        job.output.curves,
        ["model", "im", "intensity", "probability", "band_low", "band_high"],
    )
    write_table(table, job.output.brackets)


run(main, globals())
