"""Best-fitting β of walls as rows of tables, and what figures say of a fit."""

import math

import numpy as np
import pandas as pd
from rocking.mechanics import beta as calibration
from rocking.mechanics import closed_forms

from studies.calibration import free_rocking as study
from studies.calibration.laws import GROUPS
from studies.shared.restitution import TARGETS, misfit, read_archive
from yade_scripts.files import read_json

COLUMNS = (
    *("wall", "role", "b_m", "h_m", "e_mpa", "density_kg_m3", *GROUPS, "omega_c_rad_s"),
    *("release_ratio", "e_1sr", "beta_fit_s", "misfit"),
    *(f"e{n}_over_e1sr" for n in (1, 2, 3)),
    *(f"beta_{n}_s" for n in (1, 2, 3)),
    *("beta_min_s", "beta_max_s", "beta_eq5_s", "runs", "runs_with_three_impacts", "remark"),
)
CONTRACT = ("b_m", "h_m", "e_mpa", "beta_fit_s", "beta_eq5_s")
WALL_COLUMNS = ("source", "beta_s", "low_s", "high_s", "misfit", "remark")


def walls_of(cases, histories, role=None):
    """Walls of the files of cases and of YADE's runs of them, see `study.evaluate`; of one role."""
    wanted = [case for case in read_json(cases) if role in (None, case["about"]["role"])]
    names = {case["id"] for case in wanted}
    return study.evaluate(wanted, [h for h in read_archive(histories) if h["id"] in names])


def misfits(walls):
    """Misfit of every run of some walls: slenderness (h/b), beta_s, misfit.

    NaN with fewer than three impacts.
    """
    parts = []
    for wall in walls:
        facade = wall["case"]["config"]["facade"]
        part = {"slenderness": facade["height_m"] / facade["thickness_m"]}
        part |= {"beta_s": wall["beta_s"], "misfit": misfit(wall["e"] / wall["e_1sr"], 1.0)}
        parts.append(pd.DataFrame(part))
    return pd.concat(parts, ignore_index=True)


def printed(facade):
    """β of eq. 5 for a façade [s]."""
    return closed_forms.beta_one_sided(facade["thickness_m"], facade["height_m"], facade["e_mpa"])


def remark_on(fit, nowhere, at_edge):
    """Words on a fit that failed, or that lies at an end of the range."""
    if not math.isfinite(fit["beta_s"]):
        return nowhere
    return at_edge if fit["at_edge"] else ""


def row_of(wall):
    """Row of a wall of the study, see COLUMNS."""
    case, facade = wall["case"], wall["case"]["config"]["facade"]
    fit = study.best_fit(wall["beta_s"], wall["e"] / wall["e_1sr"])
    return {
        "wall": case["id"],
        "role": case["about"]["role"],
        "b_m": facade["thickness_m"],
        "h_m": facade["height_m"],
        "e_mpa": facade["e_mpa"],
        "density_kg_m3": facade["density_kg_m3"],
        **calibration.groups(case["config"]),
        "release_ratio": case["release_ratio"],
        "e_1sr": wall["e_1sr"],
        "beta_fit_s": fit["beta_s"],
        "misfit": fit["misfit"],
        **{f"e{n}_over_e1sr": v for n, v in enumerate(fit["ratio"], 1)},
        **{f"beta_{n}_s": v for n, v in enumerate(fit["single_s"], 1)},
        "beta_min_s": study.two_block_minimum(case["config"]),
        "beta_max_s": study.single_block_maximum(case["config"]),
        "beta_eq5_s": printed(facade),
        "runs": len(wall["found"]),
        "runs_with_three_impacts": sum(len(observed) >= 3 for observed in wall["found"]),
        "remark": remark_on(
            fit,
            "no β gives three impacts",
            "best β at the end of the range that could be judged",
        ),
    }


def rows_of_own(fit, measured, config, law_file):
    """Yield the rows of a wall of one's own, see WALL_COLUMNS: its fit, then the two laws.

    `fit` is of `study.best_fit`; e was measured of none, some or all impacts. A law that cannot be
    used is left out.
    """
    remark = "targets: fractions of |e_1SR|"
    if measured:
        remark = f"measured e for {len(measured)} of 3 impacts"
    more = remark_on(
        fit,
        "; no β of the range gives three impacts",
        "; at the end of the range that could be judged",
    )
    known = {key: fit[key] for key in ("beta_s", "low_s", "high_s", "misfit")}
    yield {"source": "free rocking of this wall", **known, "remark": remark + more}
    if (equation := printed(config["facade"])) > 0.0:
        yield {"source": "eq. 5", "beta_s": equation}
    try:
        law = calibration.read_law(law_file, config["facade"]["base"])
    except calibration.CalibrationError:
        return
    groups = calibration.groups(config)
    beta, low, high = law.predict(groups)
    predicted = {"beta_s": beta, "low_s": low, "high_s": high}
    yield {"source": "fitted law", **predicted, "remark": law.outside(groups) or "band: 90 %"}


def rebounds_meant(wall):
    """Time [s], least and largest θ_n/α after each impact that the targets mean for a wall.

    The time is the best run's (`closed_forms.amplitude_after_impacts`).
    """
    error = misfit(wall["e"] / wall["e_1sr"], 1.0)
    best = wall["found"][int(np.nanargmin(error))]
    ends = [
        closed_forms.amplitude_after_impacts(best.release, np.array(limits) * wall["e_1sr"], n)
        for n, limits in enumerate(TARGETS, 1)
    ]
    return (best.peak_time_s[: len(TARGETS)], *np.array(ends).T)


def along_slenderness(settings, law, count=60):
    """What a law and eq. 5 say of the study's walls, from its least to its largest slenderness.

    Of section calibration at the reference return-wall ratio: b_m, e_mpa of each batch,
    slenderness, beta_s with low_s and high_s (90 % band), eq5_s, omega_c_rad_s.
    """
    x = np.linspace(min(settings["slenderness"]), max(settings["slenderness"]), count)
    parts = []
    for b, e_mpa in study.batches(settings):
        walls = [study.batch_wall(settings, b, e_mpa, s, settings["reference_ratio"]) for s in x]
        part = pd.DataFrame({"b_m": b, "e_mpa": e_mpa, "slenderness": x})
        part["beta_s"], part["low_s"], part["high_s"] = law.along(walls)
        part["eq5_s"] = [closed_forms.beta_one_sided(b, s * b, e_mpa) for s in x]
        part["omega_c_rad_s"] = [calibration.groups(w)["omega_c_rad_s"] for w in walls]
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def study_range(settings, b, e_mpa, slenderness):
    """Smallest and largest β of the study's range [s] for a batch, of shape (2, n)."""
    r = settings["reference_ratio"]
    walls = [study.batch_wall(settings, b, e_mpa, s, r) for s in slenderness]
    ends = study.two_block_minimum, study.single_block_maximum
    return np.array([[end(wall) for wall in walls] for end in ends])


def at_listed(wall, betas_s):
    """Return the numbers of a wall's runs that are nearest to some β, in ln β."""
    return [int(np.argmin(np.abs(np.log(wall["beta_s"] / beta)))) for beta in betas_s]


def by_ratio(walls):
    """Best fits of walls that differ in their return walls alone, by their thickness.

    Return-wall ratio, ascending; β that fits all impacts, and each alone [s].
    """
    rows = []
    for wall in walls:
        fit = study.best_fit(wall["beta_s"], wall["e"] / wall["e_1sr"])
        ratio = calibration.groups(wall["case"]["config"])["return_wall_ratio"]
        rows.append((ratio, fit["beta_s"], *fit["single_s"]))
    return np.array(sorted(rows))


def beta_of_one_sided(wall):
    """β [s] at which the first impact has e = |e_1SR|, linear in ln β between the runs."""
    ratio = wall["e"][:, 0] / wall["e_1sr"]
    known = np.isfinite(ratio)
    order = np.argsort(-ratio[known])
    x = np.log(wall["beta_s"])[known][order]
    return float(np.exp(np.interp(-1.0, -ratio[known][order], x)))
