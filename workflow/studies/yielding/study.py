"""What a building that yields changes: collapse by V/W and loops, over the elastic building.

Every curve is run at the same amplitudes, single histories, and compared by its equivalent PGA
(`rocking.collapse.equivalent`). The loss from W1 to W2 is one less the ratio of the two. Ratios of
curves are averaged by their logarithms; intervals draw stations, each with all its curves.
"""

import math

import numpy as np
import pandas as pd
from rocking.collapse import probability
from rocking.collapse.case import Variant
from rocking.collapse.curve import collapse_curve
from rocking.collapse.varied import collapses
from rocking.stations import interval, resampled

ELASTIC = "elastic"
OWN = ["station", "period_s", "base_shear_ratio", "loops"]
PGA = [f"pga_{name}_g" for name in ("equivalent", "collapse", "median", "max", "building")]
COLUMNS = [*probability.KEY, *OWN, *PGA, "building_first", "runs_planar"]
CURVE = ["record", "direction"]
BY = ["model", "period_s", "base_shear_ratio", "loops"]
RESAMPLES, SEED, CONFIDENCE = 2000, 20250627, 0.9
GROUND = "W1"  # the model with walls that move with the ground


def variants(case, settings, station):
    """The elastic building, then every V/W with all loops; at other periods with the first."""
    own_period_s = case["smdof"]["period_s"]
    several = sorted({own_period_s, *settings["periods_s"]})
    changed = []
    for period in several if case.kind.chain else [own_period_s]:
        loops = settings["loops"] if period == own_period_s else settings["loops"][:1]
        pairs = [(r, law) for r in settings["base_shear_ratios"] for law in loops]
        for ratio, law in [(None, ELASTIC), *(pairs if case.kind.chain else [])]:
            changes = {"smdof.period_s": period, "smdof.base_shear_ratio": ratio}
            changes |= {} if law == ELASTIC else {"smdof.loops": law}
            about = dict(zip(OWN, (station, period, ratio, law), strict=True))
            changed.append(Variant(f"V/W {ratio}, {law}", changes=changes, about=about))
    return changed


def amplitudes(settings):
    """Amplitudes of every curve [g]."""
    low, high, count = (settings[key] for key in ("lowest_g", "highest_g", "amplitudes"))
    return np.geomspace(low, high, count)


def collapse(case, motion, direction, settings, station):
    """Collapse of a model under one motion by the building's strength: COLUMNS."""
    levels = {"pga_g": amplitudes(settings)}

    def find(varied, shaken, direction):
        curve = collapse_curve(varied, shaken, direction, search="list", settings=levels)
        return {**curve.summary(), "runs_planar": curve.runs}

    rows = collapses([case], motion, [direction], find, variants(case, settings, station))
    return pd.DataFrame(rows).reindex(columns=COLUMNS)


def against(table):
    """Every row with the equivalent PGA of its curve in W1, and in its model's elastic building."""
    measure = "pga_equivalent_g"
    ground = table[table["model"] == GROUND].set_index(CURVE)[measure]
    elastic = table[table["loops"] == ELASTIC]
    elastic = elastic.set_index(["model", *CURVE, "period_s"])[measure]
    keys = pd.MultiIndex.from_frame(table[CURVE])
    elastic_keys = pd.MultiIndex.from_frame(table[["model", *CURVE, "period_s"]])
    return table.assign(
        over_w1=table[measure] / ground.reindex(keys).to_numpy(float),
        over_elastic=table[measure] / elastic.reindex(elastic_keys).to_numpy(float),
    )


def summary(table):
    """Loss from W1 and change from the elastic building by model, V/W and loops.

    Columns: BY; own_period, 1 at the period of the run, which W1 has; curves; loss, loss_low,
    loss_high (one less the geometric mean over W1); over_elastic, …_low, …_high; pga_equivalent_g,
    the median over curves; building_first, the share of curves in which the building falls before
    the façade. Curves that never fall, or of which W1 never does, are left out of the ratios and
    counted in censored.
    """
    rows, own_periods_s = [], table.loc[table["model"] == GROUND, "period_s"].unique()
    for key, part in against(table).groupby(BY, sort=False, dropna=False):
        if key[0] == GROUND:
            continue
        loss, over = (_mean(part, name) for name in ("over_w1", "over_elastic"))
        rows.append(
            dict(zip(BY, key, strict=True))
            | {
                "own_period": int(key[1] in own_periods_s),
                "curves": len(part),
                "censored": int(part["over_w1"].isna().sum()),
                "loss": 1.0 - loss[0],
                "loss_low": 1.0 - loss[2],
                "loss_high": 1.0 - loss[1],
                "over_elastic": over[0],
                "over_elastic_low": over[1],
                "over_elastic_high": over[2],
                "pga_equivalent_g": part["pga_equivalent_g"].median(),
                "building_first": part["building_first"].mean(),
            }
        )
    return pd.DataFrame(rows)


def _mean(part, name):
    """Geometric mean of a ratio, and its interval by station."""
    known = part[np.isfinite(part[name])]
    if not len(known):
        return (math.nan,) * 3
    logs = np.log(known[name].to_numpy(float))
    counts = resampled(known["station"], RESAMPLES, SEED)
    with np.errstate(invalid="ignore"):
        draws = np.exp(counts @ logs / counts.sum(axis=1))
    low, high = interval(draws[:, None], known["station"].nunique(), CONFIDENCE)[:, 0]
    return float(np.exp(logs.mean())), float(low), float(high)
