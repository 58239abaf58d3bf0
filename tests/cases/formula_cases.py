"""Façades of the formula: one, and many within its limits."""

import numpy as np
from rocking.formula import law

ROW = {
    "height_m": 6.5,
    "slenderness": 14.0,
    "e_mpa": 1800.0,
    "density_kg_m3": 1800.0,
    "friction_deg": 30.0,
    "period_s": 0.3,
    "mass_ratio": 6.0,
    "contact_damping": 1.0,
    "storeys": 3,
}


def drawn(count, seed=7):
    """Façades within the limits of the shipped formula."""
    rng, limits = np.random.default_rng(seed), law.read()["limits"]
    rows = [{name: rng.uniform(*ends) for name, ends in limits.items()} for _ in range(count)]
    return [{**row, "storeys": round(row["storeys"])} for row in rows]
