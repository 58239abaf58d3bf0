"""Fragility of every model by every intensity measure, and how efficient the measures are.

Writes tables/fragility.csv and tables/intensity_measures.csv, and what they rest on:
fragility/brackets.csv (the collapse intervals of the curves, in every measure) and
fragility/curves.csv (fitted probability with its band).
"""

import numpy as np
import pandas as pd
from rocking.curves import fragility
from rocking.curves.ida import collapse_row, read_curve
from rocking.curves.intensity_measures import per_pga, record_measures
from rocking.mechanics.closed_forms import block
from rocking.records import read_csv
from rocking.runtime.script import run

POINTS = 121
REACH = 3.5  # dispersions either side of the median
FORMAT = {"index": False, "float_format": "%.6g", "lineterminator": "\n"}


def brackets(ida, factors, measures):
    """Collapse interval of every curve in every measure, one row each."""
    rows = []
    for path in ida:
        row = collapse_row(read_curve(path))
        if row["pga_safe_g"] is None and row["pga_collapse_g"] is None:
            continue  # every run failed
        low = 0.0 if row["pga_safe_g"] is None else row["pga_safe_g"]
        high = np.inf if row["pga_collapse_g"] is None else row["pga_collapse_g"]
        for name in measures:
            factor = factors[row["record"]][name]
            rows.append(
                (row["model"], row["record"], row["direction"], name, low * factor, high * factor)
            )
    return pd.DataFrame(rows, columns=["model", "record", "direction", "im", "low", "high"])


def remark(found, part, settings):
    """What the reader of a row has to know, in a few words."""
    words = []
    records = part["record"].nunique()
    censored = np.isinf(part["high"])
    if not np.isfinite(found.median):
        words.append("not determined: no collapse" if censored.all() else "not determined")
    elif censored.mean() > 0.5:
        words.append("median extrapolated: most curves do not collapse")
    if records < settings["min_records"]:
        words.append(f"indicative: {records} record{'s' if records > 1 else ''}")
    return "; ".join(words)


def main(job):
    settings, confidence = job.params.fragility, job.params.fragility["confidence"]
    p_rad_s = block(job.params.facade["height_m"], job.params.facade["thickness_m"]).p_rad_s
    chain = job.params.smdof
    factors = {}
    for path in job.input.records:
        record = read_csv(path)
        factors[record.name] = per_pga(
            record_measures(record, chain["period_s"], chain["damping_ratio"], p_rad_s)
        )
    table = brackets(job.input.ida, factors, settings["measures"])
    fits, efficiency, curves = [], [], []
    for model, of_model in table.groupby("model", sort=False):
        reference = None  # dispersions by PGA of the same draws, if PGA is among the measures
        for name in sorted(settings["measures"], key=lambda m: m != "pga_g"):
            part = of_model[of_model["im"] == name]
            low, high = part["low"].to_numpy(), part["high"].to_numpy()
            found = fragility.fit(low, high)
            draws = fragility.bootstrap(
                low, high, part["record"], settings["resamples"], settings["seed"]
            )
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
                    len(part),
                    int(np.isinf(high).sum()),
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
                    len(part),
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
    pd.DataFrame(
        fits,
        columns=[
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
    ).to_csv(job.output.fragility, **FORMAT)
    pd.DataFrame(
        efficiency,
        columns=[
            "model",
            "im",
            "dispersion",
            "ci_low",
            "ci_high",
            "less_than_pga",
            "n",
            "n_records",
        ],
    ).to_csv(job.output.measures, **FORMAT)
    pd.DataFrame(
        curves, columns=["model", "im", "intensity", "probability", "band_low", "band_high"]
    ).to_csv(job.output.curves, **FORMAT)
    table.to_csv(job.output.brackets, **FORMAT)


run(main, globals())
