"""The least tie that keeps a façade standing at a stated intensity, by the planar solver.

At a height and a force of the tie the collapse probability is the share that falls of realisations
that differ in amplitude, node layout and step, as near collapse elsewhere. It does not fall
steadily with the force: a stronger tie changes the rhythm of the rocking. So every force is
tried, and the least tie is the weakest from which on all stronger ones hold.
"""

import math

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from rocking.collapse.case import Variant
from rocking.collapse.curve import collapse_curve

CONFIDENCE = 0.95
AHEAD = {"height_m": ".6g", "force_kn": ".6g"}  # columns of YADE's table
ROD_KEYS = ("count", "length_m", "yield_mpa", "elongation", "slack_mm")


def trial_heights(settings, height_m):
    """Heights of the row [m]: as stated, or a half, three quarters and all of the façade's."""
    return settings["heights_m"] or [share * height_m for share in (0.5, 0.75, 1.0)]


def trial_forces(settings, levels):
    """Forces of the row [kN]: none, then equal ratios between the stated ones."""
    low, high = settings["forces_kn"]
    return np.concatenate(([0.0], np.geomspace(low, high, levels)))


def row_of_rods(settings, height_m, force_kn):
    """Entry of facade.ties that yields at a force: φ = 2 √(F/(n π f_y)).

    Parameters
    ----------
    settings : dict
        Section strengthening: count, length_m, yield_mpa, elongation, slack_mm.
    height_m, force_kn : float
    """
    area_mm2 = 1e3 * force_kn / (settings["count"] * settings["yield_mpa"])
    return {
        "height_m": float(height_m),
        "diameter_mm": 2.0 * math.sqrt(area_mm2 / math.pi),
        "e_mpa": 2e5,
        "anchor_kn": None,
        **{key: settings[key] for key in ROD_KEYS},
    }


def tie(settings, height_m, force_kn):
    """Variant of a façade with one more row of ties; without force, as it is."""
    rows = [row_of_rods(settings, height_m, force_kn)] if force_kn else []
    about = {"height_m": height_m, "force_kn": force_kn}
    return Variant("tie", added={"facade.ties": rows}, about=about)


def realisations(case, motion, direction, settings):
    """How many realisations fell at the stated intensity, and of how many; failed ones apart."""
    spread = case["ensemble"]["amplitude_spread"]
    pga_g = settings["pga_g"] * np.linspace(1.0 - spread, 1.0 + spread, settings["realisations"])
    how = {"pga_g": pga_g, "scatter": True}
    found = collapse_curve(case, motion, direction, search="list", settings=how)
    valid = found.table[found.status != "failed"]
    return int(valid["collapsed"].sum()), len(valid)


def search(case, motion, direction, settings):
    """Collapse probability at the stated intensity, by height and force of the row.

    Parameters
    ----------
    case : Case
        Of a model with a planar counterpart.
    motion, direction
        See `collapse_curve`.
    settings : dict
        Section strengthening.

    Returns
    -------
    DataFrame
        height_m, force_kn, fell, realisations, probability, low, high (Wilson, 95 %); by height and
        force.
    """
    rows: list[tuple] = []
    bare: tuple | None = None
    for height in trial_heights(settings, case["facade"]["height_m"]):
        for force in trial_forces(settings, settings["levels"]):
            if force == 0.0 and bare:
                fell, n = bare
            else:
                tied = case.varied(tie(settings, height, force))
                fell, n = realisations(tied, motion, direction, settings)
                bare = bare or (fell, n)
            band = binomtest(fell, n).proportion_ci(CONFIDENCE, "wilson") if n else None
            low, high = (band.low, band.high) if band else (np.nan, np.nan)
            share = fell / n if n else np.nan
            rows.append((height, force, fell, n, share, low, high))
    names = ["height_m", "force_kn", "fell", "realisations", "probability", "low", "high"]
    return pd.DataFrame(rows, columns=names)


def least(table, probability):
    """Least force at each height from which on all stronger ones hold, and its interval.

    Parameters
    ----------
    table : DataFrame
        Of `search`.
    probability : float
        Accepted.

    Returns
    -------
    DataFrame
        height_m, force_kn by the share itself, force_low_kn and force_high_kn by the lower and
        the upper end of its interval; NaN where even the largest does not hold.
    """
    rows = []
    for height, part in table.groupby("height_m", sort=True):
        part = part.sort_values("force_kn")
        found = []
        for column in ("probability", "low", "high"):
            holds = (part[column] <= probability).to_numpy()
            last = np.flatnonzero(~holds)
            k = 0 if not last.size else int(last[-1]) + 1
            found.append(part["force_kn"].iloc[k] if k < len(part) else np.nan)
        rows.append((height, *found))
    names = ["height_m", "force_kn", "force_low_kn", "force_high_kn"]
    return pd.DataFrame(rows, columns=names)


def best(table):
    """Row of `least` with the least force, the highest of equals; None where none holds."""
    held = table.dropna(subset="force_kn").sort_values(["force_kn", "height_m"])
    weakest = held[held["force_kn"] == held["force_kn"].min()]
    return None if weakest.empty else weakest.iloc[-1]


def weakest(table, choice):
    """Height and forces that YADE confirms: the least tie, and the strongest weaker one."""
    if choice is None:
        return []
    part = table[table["height_m"] == choice["height_m"]].sort_values("force_kn")
    weaker = part.loc[part["force_kn"] < choice["force_kn"], "force_kn"].tail(1).tolist()
    return [(float(choice["height_m"]), float(f)) for f in (*weaker, choice["force_kn"])]


def to_confirm(case, table, choice, settings):
    """Cases for YADE's study `runs`: the ties of `weakest`, realisations of an ensemble each."""
    return [
        {
            "about": {"height_m": round(z, 6), "force_kn": round(force, 6)},
            "pga_g": [settings["pga_g"]],
            "changes": {"facade": case.varied(tie(settings, z, force))["facade"]},
            "realisations": True,
        }
        for z, force in weakest(table, choice)
    ]


def curve(case, motion, direction, settings, height_m):
    """Collapse intensities against the force of a row at one height.

    Returns
    -------
    DataFrame
        height_m, force_kn, pga_safe_g, pga_collapse_g, pga_p10_g, pga_median_g, pga_p90_g,
        pga_all_g, pga_max_g.
    """
    rows = []
    for force in trial_forces(settings, settings["curve_levels"]):
        variant = tie(settings, height_m, force)
        found = collapse_curve(case.varied(variant), motion, direction).summary()
        rows.append({**variant.about, **found})
    names = ("safe", "collapse", "p10", "median", "p90", "all", "max")
    return pd.DataFrame(rows)[["height_m", "force_kn", *(f"pga_{name}_g" for name in names)]]
