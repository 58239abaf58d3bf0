"""Which groups the fitted β depends on, and the law that `damping.law: fitted` uses."""

import numpy as np
import pandas as pd
from rocking.calibration import beta
from rocking.calibration.beta import dimensional_error
from rocking.runtime.script import run
from rocking.tables import write_table

FORMS = (
    (),
    ("slenderness",),
    ("return_wall_ratio",),
    ("stiffness_ratio",),
    ("base_stiffness",),
    ("slenderness", "return_wall_ratio"),
    ("slenderness", "base_stiffness"),
    ("return_wall_ratio", "base_stiffness"),
    ("slenderness", "return_wall_ratio", "base_stiffness"),
    ("slenderness", "return_wall_ratio", "stiffness_ratio", "base_stiffness"),
)
WORTH = 0.10  # more groups have to lower the leave-one-out error by this share
COLUMNS = (
    "form",
    "walls",
    "parameters",
    "coefficients",
    "half_widths_95",
    "residual_std",
    "loo_error",
    "chosen",
)


def row_of(law, walls, of=""):
    """What the table says of a fitted law."""
    powers = "".join(f"·{name}^c{i}" for i, name in enumerate(law.names, 1))
    return {
        "form": f"beta·omega_c = exp(c0){powers}{of}",
        "walls": walls,
        "parameters": len(law.coefficients),
        "coefficients": " ".join(f"{c:.4f}" for c in law.coefficients),
        "half_widths_95": " ".join(f"{c:.4f}" for c in beta.half_widths(law)),
        "residual_std": f"{law.residual_std:.4f}",
        "loo_error": f"{law.loo_error:.4f}",
        "chosen": 0,
    }


def main(job):
    table = pd.read_csv(job.input.walls)
    table = table[table.role.isin(["reference", "ratio", "stiffness"])]
    table = table[table.beta_fit_s.notna() & table.remark.isna()]
    names = ["slenderness", "return_wall_ratio", "stiffness_ratio", "base_stiffness"]
    walls = table[[*names, "omega_c_rad_s"]].to_dict("records")
    betas = table.beta_fit_s.to_numpy()
    laws = [beta.fit_law(walls, betas, form) for form in FORMS]
    least = min(law.loo_error for law in laws)
    enough = [law for law in laws if (1.0 - WORTH) * law.loo_error <= least]
    chosen = min(enough, key=lambda law: (len(law.names), law.loo_error))
    rows = []
    for law in laws:
        rows.append(row_of(law, len(betas)) | {"chosen": int(law is chosen)})
    for label, part in (
        ("all walls", table),
        ("reference ratio", table[table.role == "reference"]),
    ):
        b, e_mpa, s = (part[c].to_numpy() for c in ("b_m", "e_mpa", "slenderness"))
        fitted = part.beta_fit_s.to_numpy()
        printed = np.sqrt(np.mean(np.log(fitted / part.beta_eq5_s.to_numpy()) ** 2))
        rows.append(
            {
                "form": f"eq. 5 as printed, {label}",
                "walls": len(part),
                "parameters": 5,
                "residual_std": f"{printed:.4f}",
                "chosen": 0,
            }
        )
        try:
            found, error, loo = dimensional_error(b, e_mpa, s, fitted)
        except beta.CalibrationError:
            continue
        rows.append(
            {
                "form": f"(b·c1 + E·c2 + c3)·exp(h/b·(E·c4 + c5)) refitted, {label}",
                "walls": len(part),
                "parameters": 5,
                "coefficients": " ".join(f"{c:.4g}" for c in found),
                "residual_std": f"{error:.4f}",
                "loo_error": f"{loo:.4f}",
                "chosen": 0,
            }
        )
    reference = table[table.role == "reference"]
    here = reference[[*names, "omega_c_rad_s"]].to_dict("records")
    for form in ((), ("slenderness",)):
        law = beta.fit_law(here, reference.beta_fit_s.to_numpy(), form)
        rows.append(row_of(law, len(here), ", reference ratio"))
    write_table(rows, job.output.table, COLUMNS)
    with open(job.output.law, "w") as handle:
        handle.write(beta.to_json({**beta.read_laws(job.input.others), job.params.base: chosen}))


run(main, globals())
