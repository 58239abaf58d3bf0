"""Code against dynamics: ratios of the PGA a check allows to the PGA that fells the façade.

A ratio above 1 is unsafe: the check still passes where the façade has fallen. Either PGA may lie
beyond the largest that was run; such a ratio is an interval, and enters the lognormal fit and the
share on the unsafe side as far as it is known.
"""

import math

import numpy as np
import pandas as pd
from rocking.stations import FEWEST, interval, resampled
from rocking.tables import read_frame, read_tables

from studies.shared.fragility import fit

EXACT = 1e-6  # relative half width of the interval that stands for an exact ratio
COLUMNS = [
    *("model", "level", "check", "n", "n_facades", "n_censored"),
    *("median_ratio", "log_scatter", "unsafe_share", "ci_low", "ci_high"),
]
CHECKED_AG_G = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30)  # a_g of the code's checks
SITE = (2.5, 0.3, "B")  # F0, T_C*, subsoil
REFERENCE_G = 0.15  # a_g at which the mechanism that governs by hand is found
CHECKS_BY_HAND = ("kinematic_fc", "kinematic_fc1", "kinematic_ground_fc")
KEYS = ["record", "direction"]
QUANTILES = {"pga_p10_g": "p10", "pga_median_g": "median"}
FACTS = ("height_m", "slenderness", "period_s")


def gather(runs):
    """One row a run, model, record, direction, check and level, for `compare`.

    By run come FACTS and the files checks (one), collapse and parts (one a model). Façades of which
    a part governs are left to `parts_against_whole`: these checks are the whole's.
    """
    parts = []
    for name, facts in runs.items():
        if len(read_tables(facts["parts"])):
            continue
        checks = read_frame(facts["checks"])
        for path in facts["collapse"]:
            given = [*KEYS, "model", "pga_max_g"]
            long = read_frame(path).melt(given, [*QUANTILES], "level", "pga_dynamic_g")
            both = long.assign(level=long["level"].map(QUANTILES)).merge(checks, on=KEYS)
            parts.append(both.assign(**{key: facts[key] for key in FACTS}, run=name))
    return pd.concat(parts, ignore_index=True)


def intervals(check_g, dynamic_g, max_g):
    """Ratio check/dynamic as low and high, 0 and ∞ where open; NaN is above `max_g`."""
    known_check, known_dynamic = np.isfinite(check_g), np.isfinite(dynamic_g)
    low = np.where(known_check, check_g, max_g) / np.where(known_dynamic, dynamic_g, np.inf)
    high = np.where(known_check, check_g, np.inf) / np.where(known_dynamic, dynamic_g, max_g)
    exact = known_check & known_dynamic
    return np.where(exact, low * (1 - EXACT), low), np.where(exact, high * (1 + EXACT), high)


def unsafe(low, high):
    """1 where a ratio exceeds 1, 0 where it does not, NaN where its interval cannot tell."""
    return np.where(low > 1.0, 1.0, np.where(high <= 1.0 + 2 * EXACT, 0.0, np.nan))


def share_interval(flags, stations, resamples, seed, confidence=0.95):
    """Share of ones and the ends of its interval, stations drawn with replacement.

    A station's components, and the façades that they shake, are drawn together. Where all flags are
    alike every draw is, too; then the open end is the exact binomial one for as many trials as
    there are stations, 1 − (tail)^(1/n). Fewer than `FEWEST` stations give no interval.
    """
    flags, stations = np.asarray(flags, float), np.asarray(stations)
    keep = np.isfinite(flags)
    if not keep.any():
        return math.nan, math.nan, math.nan
    flags, stations = flags[keep], stations[keep]
    number, share = len(set(stations)), float(flags.mean())
    if number >= FEWEST and share in (0.0, 1.0):
        reach = 1.0 - (0.5 * (1.0 - confidence)) ** (1.0 / number)
        return (0.0, 0.0, reach) if share == 0.0 else (1.0, 1.0 - reach, 1.0)
    draws = resampled(stations, resamples, seed)
    low, high = interval(draws @ flags / draws.sum(axis=1), number, confidence)
    return share, float(low), float(high)


def summary(table, resamples, seed):
    """Ratios of one part of the table of `compare`: median, scatter, share on the unsafe side."""
    low, high = intervals(
        *(table[k].to_numpy(float) for k in ("pga_fails_g", "pga_dynamic_g", "pga_max_g"))
    )
    known = (low > 0.0) | np.isfinite(high)
    fitted = fit(low[known], high[known]) if known.sum() > 1 else None
    share, below, above = share_interval(unsafe(low, high), table["station"], resamples, seed)
    return {
        "n": len(table),
        "n_facades": table["run"].nunique(),
        "n_censored": int(np.sum((low == 0.0) | np.isinf(high))),
        "median_ratio": fitted.median if fitted else math.nan,
        "log_scatter": fitted.dispersion if fitted else math.nan,
        "unsafe_share": share,
        "ci_low": below,
        "ci_high": above,
    }


def compare(table, resamples, seed):
    """Every model, level (`p10`, `median`) and check of a table of `gather`; see COLUMNS."""
    rows = [
        {"model": model, "level": level, "check": check, **summary(part, resamples, seed)}
        for (model, level, check), part in table.groupby(["model", "level", "check"], sort=False)
    ]
    return pd.DataFrame(rows, columns=COLUMNS)


def disagreements(levels):
    """How often the kinematic and the dynamic check of a façade differ, by model and check.

    A row a façade, model and a_g: run, model, CHECKS_BY_HAND and dynamic, 1 where they pass.
    """
    rows = []
    for model, part in levels.groupby("model", sort=False):
        for check in CHECKS_BY_HAND:
            passes, holds = part[check] == 1, part["dynamic"] == 1
            rows.append(
                {
                    "model": model,
                    "check": check,
                    "cases": len(part),
                    "facades": part["run"].nunique(),
                    "both_pass": int((passes & holds).sum()),
                    "both_fail": int((~passes & ~holds).sum()),
                    "kinematic_alone_passes": int((passes & ~holds).sum()),
                    "dynamic_alone_passes": int((~passes & holds).sum()),
                }
            )
    return pd.DataFrame(rows)


def parts_against_whole(levels, collapse):
    """What the whole façade alone would have said of façades that fall in part, by model and run.

    `levels` are as of `disagreements`, with part ("whole" is the whole façade); `collapse` has run,
    part (or none: the whole), model, record, direction, pga_median_g.

    A row a façade and model, and one of all façades ("all"): how many a_g were checked; at how many
    the whole passes and the part does not, by hand (FC 1.35) and dynamically; at how many the
    part's two checks differ, and which way; curves, median of half collapse of the part over that
    of the whole, share of curves in which the part falls first. Curves in which either never fell
    are left out of the median.
    """
    both = _beside_whole(levels, ["run", "model", "ag_g"])
    curves = _beside_whole(collapse.fillna({"part": "whole"}), ["run", "model", *KEYS])
    curves["ratio"] = curves["pga_median_g"] / curves["pga_median_g_whole"]
    curves["first"] = curves["pga_median_g"] < curves["pga_median_g_whole"].fillna(np.inf)
    rows = []
    for model in both["model"].unique():
        for run in [*both.loc[both["model"] == model, "run"].unique(), "all"]:
            at, of = (
                t[(t["model"] == model) & ((t["run"] == run) | (run == "all"))]
                for t in (both, curves)
            )
            whole_passes, whole_holds = at["kinematic_fc_whole"] == 1, at["dynamic_whole"] == 1
            passes, holds = at["kinematic_fc"] == 1, at["dynamic"] == 1
            rows.append(
                {
                    "run": run,
                    "model": model,
                    "part": at["part"].iloc[0] if run != "all" else "",
                    "levels": len(at),
                    "whole_alone_passes_by_hand": int((whole_passes & ~passes).sum()),
                    "whole_alone_passes_dynamic": int((whole_holds & ~holds).sum()),
                    "kinematic_alone_passes": int((passes & ~holds).sum()),
                    "dynamic_alone_passes": int((~passes & holds).sum()),
                    "curves": len(of),
                    "ratio_p10": of["ratio"].quantile(0.1),
                    "ratio_median": of["ratio"].median(),
                    "ratio_p90": of["ratio"].quantile(0.9),
                    "part_first": of["first"].mean(),
                }
            )
    return pd.DataFrame(rows)


def _beside_whole(table, keys):
    """Rows of parts, each beside the whole façade's with the same keys (columns `…_whole`)."""
    whole = table["part"] == "whole"
    return table[~whole].merge(table[whole], on=keys, suffixes=("", "_whole"))
