"""Fitting the formula to an atlas, and its error at façades and stations that had no part.

Of every façade the mean over motions of ln(PGA50/tan α) is fitted by least squares, and the
dispersion is the pooled standard deviation within façades. In another measure a motion's intensity
is a factor of its PGA, so that the means differ by that factor's mean alone.
"""

import itertools

import numpy as np
import pandas as pd
from rocking import stations as by_station
from rocking.formula import groups
from rocking.formula.law import MEASURES

TERMS = {  # as few as the error of left-out façades allows; the study atlas has the reasons
    "W1": ("1", "ln p", "ln z"),
    "W2": ("1", "ln p", "ln z", "G", "ln T1"),
    "W2m": ("1", "ln p", "ln z", "G", "ln T1", "m/M", "m/M ln T1"),
}
OF_SA = ("ln T1", "ln2 T1")  # Sa(T1) over PGA bends with T1, for models on the ground too
AT_T1 = ("sa_t1_g", "sa_avg_2s_t1_g")  # measures with Sa(T1) in them
OF_BLOCK = ("1", "G")  # of the ratio between two bases: what a base too soft takes grows with Γ
OF_STACK = ("1",)  # courses are the elastic wall, and `column` follows it at any Γ
HALVES = 20  # draws of half of the stations; façades are left out one by one
P16 = 15.865525  # % of a normal distribution below one standard deviation under its mean
CONFIDENCE = 0.90
RESAMPLES = 400
SEED = 1  # of the halves


def wide(table, design, model, base, factor=None):
    """Ln(IM/tan α) of every façade (rows) under every motion (columns: record, direction).

    Of a table of the atlas (`studies.atlas.COLUMNS`) and its façades (`groups.DIMENSIONS`);
    `factor` is the measure over PGA, by façade (rows) and record. NaN where a façade stood up to
    the largest intensity.
    """
    part = table[(table["model"] == model) & (table["base"] == base)]
    medians = part.pivot(index="facade", columns=["record", "direction"], values="pga_median_g")
    if factor is not None:
        medians = (
            medians * factor.loc[medians.index, medians.columns.get_level_values(0)].to_numpy()
        )
    slender = design["slenderness"].loc[medians.index]
    return np.log(medians.mul(slender, axis=0))


def matrix(design, names):
    """Values of terms by façade, shape (façades, terms)."""
    rows = [groups.terms(row) for row in design.to_dict("records")]
    return pd.DataFrame(rows, index=design.index)[list(names)].to_numpy()


def solve(terms, values, weights=None):
    """Least squares of the means over motions, shape (k,).

    Terms are of shape (façades, k), values (façades, motions) and NaN where a curve is not known;
    `weights` say how often each façade and each motion counts.
    """
    rows, columns = weights or (np.ones(values.shape[0]), np.ones(values.shape[1]))
    known = np.isfinite(values)
    mean = np.nansum(values * columns, axis=1) / (known @ columns)
    root = np.sqrt(rows)
    return np.linalg.lstsq(terms * root[:, None], mean * root, rcond=None)[0]


def pooled(values):
    """Standard deviation over motions within façades, pooled."""
    return float(np.sqrt(np.nanmean(np.nanvar(values, axis=1, ddof=1))))


def left_out(terms, values, stations):
    """Errors at façades and stations of which neither had a part, by façade and half.

    Every façade is foretold by the others under the other stations, for `HALVES` halves of the
    stations, drawn at random: one division alone may come out lower or higher by a third. (To leave
    each station out in turn, and to compare the mean over all of a façade, is no test of stations:
    the mean is linear in the curves, so that it comes to `facades_out`.) An error has two parts:
    that of the level, which a handful of left-out motions has by chance and all façades share, and
    that of the façade.

    Columns are fold, at (row of the façade), error (ln of what was run over what was foretold, of
    the mean), level (mean over façades in the fold), of_facade (error − level), p16 (likewise of
    the 16 % fractile, by the dispersion of the others). `stations` has that of every motion.
    """
    names, rng = sorted(set(stations)), np.random.default_rng(SEED)
    size = (HALVES, len(names))
    drawn = rng.permuted(np.broadcast_to(np.arange(len(names)), size), axis=1)
    index = np.array([names.index(name) for name in stations])
    rows = []
    for fold, at in itertools.product(range(HALVES), range(len(values))):
        out = np.isin(index, drawn[fold, : len(names) // 2])
        others = np.delete(np.arange(len(values)), at)
        train, test = values[np.ix_(others, np.flatnonzero(~out))], values[at, out]
        foretold = terms[at] @ solve(terms[others], train)
        low = np.nanpercentile(test, P16)
        rows.append((fold, at, np.nanmean(test) - foretold, low - (foretold - pooled(train))))
    table = pd.DataFrame(rows, columns=["fold", "at", "error", "p16"])
    table["level"] = table.groupby("fold")["error"].transform("mean")
    table["of_facade"] = table["error"] - table["level"]
    return table


def facades_out(terms, values):
    """Errors at every façade, foretold by the others under the same motions.

    Of the mean, and of the 16 % fractile by the dispersion of the others.
    """
    errors, every = [], np.arange(len(values))
    for k in every:
        others = values[every != k]
        foretold = terms[k] @ solve(terms[every != k], others)
        low = np.nanpercentile(values[k], P16) + pooled(others)
        errors.append((np.nanmean(values[k]) - foretold, low - foretold))
    return np.transpose(errors)


def intervals(terms, values, stations, seed):
    """Ends that hold `CONFIDENCE`, shape (2, k): façades and stations drawn again, together."""
    facades = by_station.resampled(np.arange(len(values)), RESAMPLES, seed)
    motions = by_station.resampled(stations, RESAMPLES, seed + 1)
    coefficients = [solve(terms, values, pair) for pair in zip(facades, motions, strict=True)]
    tail = 50.0 * (1.0 - CONFIDENCE)
    return np.percentile(coefficients, (tail, 100.0 - tail), axis=0)


def rms(values):
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


def fitted(table, design, model, base, measure, factor, stations_of, seed):
    """What the file says of one model in one measure; arguments as of `wide`.

    That is terms, coefficients, low, high (their intervals), dispersion, error, and the checks.
    """
    names = TERMS[model]
    if measure in AT_T1:
        names = (*names, *(name for name in OF_SA if name not in names))
    values = wide(table, design, model, base, factor)
    stations = [stations_of[record] for record in values.columns.get_level_values(0)]
    terms, y = matrix(design.loc[values.index], names), values.to_numpy()
    both, (alone, fractile) = left_out(terms, y, stations), facades_out(terms, y)
    level = both.groupby("fold")["level"].first()
    spread = pooled(y)
    return {
        **_coefficients(names, terms, y, stations, seed),
        "dispersion": round(spread, 4),
        "error": round(float(np.hypot(rms(alone), spread / np.sqrt(len(set(stations))))), 4),
        "checks": {
            "facades_rms": round(rms(alone), 4),
            "facades_largest": round(float(np.abs(alone).max()), 4),
            "p16_rms": round(rms(fractile), 4),
            "both_rms": round(rms(both["error"]), 4),
            "both_of_facade_rms": round(rms(both["of_facade"]), 4),
            "both_of_facade_largest": round(float(both["of_facade"].abs().max()), 4),
            "level_rms": round(rms(level), 4),
            "facades": len(y),
            "motions": y.shape[1],
            "stations": len(set(stations)),
            "censored": int(np.isnan(y).sum()),
        },
    }


def ratio_of_bases(table, design, model, base, other, seed, stations_of, names=OF_BLOCK):
    """Law of half collapse on another base over that on the atlas's own, and its error."""
    pair = [wide(table, design, model, name) for name in (base, other)]
    ratio = pair[1] - pair[0].loc[pair[1].index, pair[1].columns]
    stations = [stations_of[record] for record in ratio.columns.get_level_values(0)]
    terms, y = matrix(design.loc[ratio.index], names), ratio.to_numpy()
    coefficients = _coefficients(names, terms, y, stations, seed)
    return coefficients | {"error": round(rms(facades_out(terms, y)[0]), 4), "facades": len(y)}


def _coefficients(names, terms, y, stations, seed):
    """Names of a sum's terms, its coefficients, and the ends of their intervals."""
    low, high = intervals(terms, y, stations, seed)
    numbers = {"coefficients": solve(terms, y), "low": low, "high": high}
    rounded = {key: [float(f"{v:.5g}") for v in values] for key, values in numbers.items()}
    return {"terms": list(names), **rounded}


def law(table, design, factors, stations_of, made_of, own_base="own"):
    """Content of the formula's file.

    `factors` are by measure, see `wide`, that of PGA left out; `made_of` is what the atlas is
    (base, seed, …), `own_base` the name of its base in the table.
    """
    seed, stacks = made_of["seed"], [r["name"] for r in made_of.get("others", ()) if r["courses"]]
    others = {
        name: OF_STACK if name in stacks else OF_BLOCK
        for name in table["base"].unique()
        if name != own_base
    }
    models = [name for name in TERMS if name in set(table["model"])]
    here = design.loc[sorted(table.loc[table["base"] == own_base, "facade"].unique())]
    # a drawn dimension has the ends of its range; one that follows from several has the least and
    # the largest value that came out
    came = {name: [float(here[name].min()), float(here[name].max())] for name in here}
    limits = {name: made_of["ranges"].get(name, came[name]) for name in groups.DIMENSIONS}
    return {
        "made_of": {**made_of, "facades": len(here)},
        "limits": {name: [float(f"{v:.4g}") for v in ends] for name, ends in limits.items()},
        "models": {
            model: {
                measure: fitted(
                    table, here, model, own_base, measure, factors.get(measure), stations_of, seed
                )
                for measure in MEASURES
            }
            for model in models
        },
        "bases": {
            base: {
                model: ratio_of_bases(table, here, model, own_base, base, seed, stations_of, names)
                for model in models
            }
            for base, names in others.items()
        },
    }
