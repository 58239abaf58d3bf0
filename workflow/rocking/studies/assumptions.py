"""What an assumption is worth: variants of a scene, and ratios between collapse intensities.

A ratio above 1 says that a model stands more shaking than the one it is held against: as a
substitute it is on the unsafe side.
"""

import copy
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from rocking.collapse import probability
from yade_scripts.model.registry import MODELS

MEASURES = ("collapse", "p10", "median", "p90", "all")
CAPACITY = [f"pga_{name}_g" for name in MEASURES]
SIDE = (*MEASURES, "mean")  # of models side by side, whose whole curve is known
KEY = ["record", "direction"]
BASE = "as configured"


@dataclass(frozen=True)
class Variant:
    """One assumption at another level.

    Attributes
    ----------
    name : str
        In file names.
    assumption, level : str
        In charts.
    changes : callable
        From a scene file and the building stage's answers to values by dotted key.
    models : tuple of str
        Driven models that have this assumption.
    massive : bool
        Run the massive twin.
    surrogate : bool
        Run the record's surrogate.
    """

    name: str
    assumption: str
    level: str
    changes: Callable = lambda job, stage: {}
    models: tuple = ("W2", "W3")
    massive: bool = False
    surrogate: bool = False


def _friction(degrees):
    keys = ("facade.friction_deg", "return_wall.friction_deg", "w3.friction_deg")
    return lambda job, stage: dict.fromkeys(keys, degrees)


def _back(factor):
    """Stiffness of the back joint: L of W2's E/L, the front joints' stiffness of W3."""
    return lambda job, stage: {
        "return_wall.length_m": (job["return_wall"]["length_m"] or 0.5 * job["facade"]["height_m"])
        / factor,
        **{f"w3.{k}": factor * job["w3"][k] for k in ("jkn_pa_m", "jks_pa_m") if "w3" in job},
    }


def _set(**values):
    """Fixed values; a double underscore stands for the dot of a key."""
    return lambda job, stage: {key.replace("__", "."): value for key, value in values.items()}


W3 = ("W3",)
VARIANTS = (
    Variant("two_way", "return walls feel the façade", "building's mass", massive=True),
    Variant(
        "two_way_51t",
        "return walls feel the façade",
        "51 t",
        _set(return_wall__building_mass_kg=51e3),
        massive=True,
    ),
    Variant(
        "two_way_97t",
        "return walls feel the façade",
        "97 t",
        _set(return_wall__building_mass_kg=97e3),
        massive=True,
    ),
    Variant(
        "motion_middle",
        "motion of the walls",
        "storey's middle",
        _set(return_wall__motion="middle"),
    ),
    Variant(
        "motion_interpolated",
        "motion of the walls",
        "by height",
        _set(return_wall__motion="interpolated"),
    ),
    Variant("headers_sliding", "headers", "sliding", _set(w3__header_joint="sliding"), W3),
    Variant("headers_bonded", "headers", "bonded", _set(w3__header_joint="bonded"), W3),
    Variant("headers_study", "headers", "bonded, cut bricks", _set(w3__header_joint="study"), W3),
    Variant("inclined_none", "inclined courses", "none", _set(w3__lower_courses=0), W3),
    Variant("inclined_nine", "inclined courses", "lowest 9", _set(w3__lower_courses=9), W3),
    Variant("friction_20", "friction", "20°", _friction(20.0)),
    Variant("friction_40", "friction", "40°", _friction(40.0)),
    Variant("back_half", "stiffness behind", "half", _back(0.5)),
    Variant("back_double", "stiffness behind", "double", _back(2.0)),
    Variant("beta_eq5", "law of β", "eq. 5", _set(damping__law="eq5")),
    Variant("beta_fitted", "law of β", "fitted", _set(damping__law="fitted")),
    Variant(
        "t1_stage",
        "T1",
        "building stage",
        lambda job, stage: {"smdof.period_s": stage["period_s"]},
    ),
    Variant(
        "t1_complete",
        "T1",
        "complete building",
        lambda job, stage: {"smdof.period_s": stage["complete_period_s"]},
    ),
    Variant("damping_2", "building's damping", "2 %", _set(smdof__damping_ratio=0.02)),
    Variant("damping_10", "building's damping", "10 %", _set(smdof__damping_ratio=0.10)),
    Variant("width_6", "width", "6 m", _set(facade__width_m=6.0)),
    Variant("width_8", "width", "8 m", _set(facade__width_m=8.0)),
    Variant("surrogate", "record", "surrogate", surrogate=True),
)


def variants(model):
    """Variants of a driven model, by name."""
    return {v.name: v for v in VARIANTS if model in v.models}


def varied(job, variant, stage):
    """A scene file with a variant's changes; β and numerics are the caller's to choose anew.

    Parameters
    ----------
    job : dict
    variant : Variant
    stage : dict
        Answers of the building stage: period_s, complete_period_s [s], mass_kg.

    Returns
    -------
    dict
    """
    new = copy.deepcopy(job)
    for key, value in variant.changes(job, stage).items():
        section, name = key.split(".")
        if section in new:
            new[section][name] = value
    if variant.massive:
        same = MODELS[job["model"]]
        new["model"] = next(m.name for m in MODELS.values() if m.massive and m.driven == same.name)
        if not new["return_wall"]["building_mass_kg"]:
            new["return_wall"]["building_mass_kg"] = stage["mass_kg"]
    return new


def standing(pga_g, share):
    """Mean collapse intensity, ∫(1 − P) dPGA [g]; NaN where the curve ends before all collapse.

    Where outcomes reverse, first crossings say where trouble begins; this says how much of the
    range of amplitudes a façade stands in all.
    """
    pga_g, share = np.asarray(pga_g, float), np.asarray(share, float)
    if not share.size or share[-1] < 1.0:
        return np.nan
    return float(pga_g[0] + np.trapezoid(1.0 - share, pga_g))


def given(table):
    """Collapse intensities of one curve of which only probabilities are known.

    Parameters
    ----------
    table : DataFrame
        Columns of tables/collapse_probability.csv; YADE's share where the planar one is blank, its
        columns may be missing.

    Returns
    -------
    dict
        pga_collapse_g … pga_all_g, pga_mean_g, runs.
    """
    table = table.reindex(columns=probability.PROBABILITY_COLUMNS).sort_values("pga_g")
    share = table["probability"].fillna(table["probability_yade"])
    pga_g, share = table["pga_g"].to_numpy()[share.notna()], share.dropna().to_numpy()
    fell, stood = pga_g[share > 0.0], pga_g[share < 1.0]
    above = pga_g[pga_g > (stood.max() if stood.size else 0.0)]
    crossings = [probability.first_crossing(pga_g, share, level) for level in probability.LEVELS]
    runs = table["members"].fillna(table["members_yade"]).fillna(1.0).sum()
    return {
        "pga_collapse_g": fell.min() if fell.size else np.nan,
        **dict(zip(("pga_p10_g", "pga_median_g", "pga_p90_g"), crossings, strict=True)),
        "pga_all_g": above.min() if fell.size and above.size else np.nan,
        "pga_mean_g": standing(pga_g, share),
        "runs": int(runs),
    }


def beside(capacity, reference):
    """Add what each model stands over what the reference stands, by measure.

    Parameters
    ----------
    capacity : DataFrame
        model, record, direction and the intensities of `SIDE`, as far as known.
    reference : str
        A model of it; where it is missing the ratios are blank.

    Returns
    -------
    DataFrame
        With reference, ratio_collapse … ratio_mean, side ("safe", "unsafe"; of the median, within
        its own scatter "even").
    """
    table = capacity.reset_index(drop=True).copy()
    names = [name for name in SIDE if f"pga_{name}_g" in capacity]
    columns = [f"pga_{name}_g" for name in names]
    other = capacity[capacity["model"] == reference].set_index(KEY)[columns]
    other = other.reindex(pd.MultiIndex.from_frame(table[KEY])).reset_index(drop=True)
    table["reference"] = reference
    for name in names:
        table[f"ratio_{name}"] = table[f"pga_{name}_g"] / other[f"pga_{name}_g"]
    side = np.where(table["pga_median_g"] > other["pga_p90_g"], "unsafe", "even")
    side = np.where(table["pga_median_g"] < other["pga_p10_g"], "safe", side)
    table["side"] = np.where(table["ratio_median"].notna(), side, "")
    table.loc[table["model"] == reference, "side"] = ""
    return table


def losses(capacity):
    """How much of the capacity the building takes, and how much of that its assumption.

    The loss is 1 − W2/W1 as the study has it, driven, and 1 − W2m/W1 with walls that feel the
    façade; the second is what the building's motion takes, the rest is the assumption.

    Returns
    -------
    DataFrame
        record, direction, measure, pga_w1_g, pga_w2_g, pga_w2m_g, loss_driven, loss_two_way,
        assumption; curves of which all three are known.
    """
    rows = []
    for measure in ("collapse", "median", "mean", "all"):
        if f"pga_{measure}_g" not in capacity:
            continue
        wide = capacity.pivot(index=KEY, columns="model", values=f"pga_{measure}_g")
        if not {"W1", "W2", "W2m"} <= set(wide):
            break
        wide = wide[["W1", "W2", "W2m"]].dropna().reset_index()
        wide.columns = [*KEY, "pga_w1_g", "pga_w2_g", "pga_w2m_g"]
        wide.insert(2, "measure", measure)
        wide["loss_driven"] = 1.0 - wide["pga_w2_g"] / wide["pga_w1_g"]
        wide["loss_two_way"] = 1.0 - wide["pga_w2m_g"] / wide["pga_w1_g"]
        wide["assumption"] = wide["loss_driven"] - wide["loss_two_way"]
        rows.append(wide)
    columns = [*KEY, "measure", "pga_w1_g", "pga_w2_g", "pga_w2m_g"]
    columns += ["loss_driven", "loss_two_way", "assumption"]
    return pd.concat(rows) if rows else pd.DataFrame(columns=columns)


def spread_of(table, columns, by):
    """Number, percentiles and share above 1 of ratios, by group.

    Returns
    -------
    DataFrame
        by, measure, curves, low, median, high (10, 50, 90 %), share_unsafe (ratio above 1).
    """
    rows = []
    for key, group in table.groupby(by, sort=False):
        named = dict(zip(by, key if isinstance(key, tuple) else (key,), strict=True))
        for column in columns:
            known = group[column].dropna()
            if len(known):
                low, middle, high = np.percentile(known, [10.0, 50.0, 90.0])
                share = float((known > 1.0).mean())
                row = (column.removeprefix("ratio_"), len(known), low, middle, high, share)
                names = ("measure", "curves", "low", "median", "high", "share_unsafe")
                rows.append({**named, **dict(zip(names, row, strict=True))})
    return pd.DataFrame(rows)
