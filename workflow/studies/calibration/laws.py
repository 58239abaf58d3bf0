"""Which groups the fitted β depends on: power laws compared, and the one that is taken."""

import numpy as np
from rocking.mechanics import beta

GROUPS = ("slenderness", "return_wall_ratio", "stiffness_ratio", "base_stiffness")
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
    GROUPS,
)
WORTH = 0.10  # more groups have to lower the leave-one-out error by this share
FITTED = ("reference", "ratio", "stiffness")  # roles of the walls that a law describes
COLUMNS = ["form", "walls", "parameters", "coefficients", "half_widths_95", "residual_std"]
COLUMNS += ["loo_error", "chosen"]


def compare(table):
    """Fit every form to the walls of beta_walls.csv, and eq. 5 for comparison.

    Walls without a fit or with a remark are left out. The law that is taken has the fewest groups
    of the forms whose leave-one-out error is within WORTH of the least; rows are COLUMNS, numbers
    as text.
    """
    table = table[table.role.isin(FITTED) & table.beta_fit_s.notna() & table.remark.isna()]
    reference = table[table.role == "reference"]
    laws = [_fit(table, form) for form in FORMS]
    least = min(law.loo_error for law in laws)
    enough = [law for law in laws if (1.0 - WORTH) * law.loo_error <= least]
    chosen = min(enough, key=lambda law: (len(law.names), law.loo_error))
    rows = [_row(law, len(table)) | {"chosen": int(law is chosen)} for law in laws]
    rows.append(_of_equation_5("all walls", table))
    rows.append(_of_equation_5("reference ratio", reference))
    for form in FORMS[:2]:
        rows.append(_row(_fit(reference, form), len(reference), ", reference ratio"))
    return chosen, rows


def _fit(table, form):
    walls = table[[*GROUPS, "omega_c_rad_s"]].to_dict("records")
    return beta.fit_law(walls, table.beta_fit_s.to_numpy(), form)


def _row(law, walls, of=""):
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


def _of_equation_5(label, table):
    """Row of eq. 5 as printed."""
    fitted = table.beta_fit_s.to_numpy()
    off = np.sqrt(np.mean(np.log(fitted / table.beta_eq5_s.to_numpy()) ** 2))
    return {
        "form": f"eq. 5 as printed, {label}",
        "walls": len(table),
        "parameters": 5,
        "residual_std": f"{off:.4f}",
        "chosen": 0,
    }
