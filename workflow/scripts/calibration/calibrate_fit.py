"""Best-fitting β of every wall of the study with its misfit, and the contract's shorter table."""

import math

from rocking.calibration import beta, study
from rocking.calibration.laws import GROUPS
from rocking.calibration.restitution import read_archive
from rocking.mechanics import closed_forms
from rocking.runtime.script import run
from rocking.tables import read_json, write_table

COLUMNS = (
    "wall",
    "role",
    "b_m",
    "h_m",
    "e_mpa",
    "density_kg_m3",
    *GROUPS,
    "omega_c_rad_s",
    "release_ratio",
    "e_1sr",
    "beta_fit_s",
    "misfit",
    "e1_over_e1sr",
    "e2_over_e1sr",
    "e3_over_e1sr",
    "beta_1_s",
    "beta_2_s",
    "beta_3_s",
    "beta_min_s",
    "beta_max_s",
    "beta_eq5_s",
    "runs",
    "runs_with_three_impacts",
    "remark",
)
CONTRACT = ("b_m", "h_m", "e_mpa", "beta_fit_s", "beta_eq5_s")


def row_of(wall):
    case, facade = wall["case"], wall["case"]["config"]["facade"]
    b, h, e_mpa = facade["thickness_m"], facade["height_m"], facade["e_mpa"]
    fit = study.best_fit(wall["beta_s"], wall["e"] / wall["e_1sr"])
    complete = sum(len(found) >= 3 for found in wall["found"])
    remark = ""
    if not math.isfinite(fit["beta_s"]):
        remark = "no β gives three impacts"
    elif fit["at_edge"]:
        remark = "best β at the end of the range that could be judged"
    groups = beta.groups(case["config"])
    return {
        "wall": case["id"],
        "role": case["about"]["role"],
        "b_m": b,
        "h_m": h,
        "e_mpa": e_mpa,
        "density_kg_m3": facade["density_kg_m3"],
        **{name: groups[name] for name in (*GROUPS, "omega_c_rad_s")},
        "release_ratio": case["release_ratio"],
        "e_1sr": wall["e_1sr"],
        "beta_fit_s": fit["beta_s"],
        "misfit": fit["misfit"],
        **{f"e{n}_over_e1sr": v for n, v in enumerate(fit["ratio"], 1)},
        **{f"beta_{n}_s": v for n, v in enumerate(fit["single_s"], 1)},
        "beta_min_s": study.two_block_minimum(case["config"]),
        "beta_max_s": study.single_block_maximum(case["config"]),
        "beta_eq5_s": closed_forms.beta_one_sided(b, h, e_mpa),
        "runs": len(wall["found"]),
        "runs_with_three_impacts": complete,
        "remark": remark,
    }


def main(job):
    rows = []
    for cases, histories in zip(job.input.cases, job.input.histories, strict=True):
        walls = study.evaluate(read_json(cases), read_archive(histories))
        rows += [row_of(wall) for wall in walls]
    write_table(rows, job.output.walls, COLUMNS)
    write_table([r for r in rows if r["role"] == "reference"], job.output.fit, CONTRACT)


run(main, globals())
