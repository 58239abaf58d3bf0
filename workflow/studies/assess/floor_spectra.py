"""The code's floor spectrum beside the exact one of the chain that it approximates."""

import numpy as np
import pandas as pd
from rocking.records import G_M_S2
from rocking.records.floors import chain_motions

from smdof.spectra import response_spectrum
from studies.assess.demand import RecordDemand, floor_demand

PERIOD_RATIOS = np.geomspace(0.1, 8.0, 20)  # T over T1
VARIANTS: dict[str, dict] = {  # keywords of `floor_demand`
    "first mode": {},
    "all modes": {"modes": "all"},
    "all modes, without the ground's bound": {"modes": "all", "bounded": False},
    "first mode, γ1 z/H": {"modes": "linear"},
}
COLUMNS = ["record", "floor", "t_over_t1", "variant", "formula_g", "exact_g"]


def formula_and_exact(record, chain, damping_ratio=0.05, period_ratios=PERIOD_RATIOS):
    """Formula and exact pseudo-acceleration on every floor of a chain, at the record's own PGA.

    `chain` is section smdof, the damping that of the oscillator on the floor. Columns are COLUMNS,
    both accelerations in g.
    """
    n, t1 = chain["n_dof"], chain["period_s"]
    motion = chain_motions(record, chain)
    ground = RecordDemand(record.acceleration_m_s2, record.dt_s)
    dt = record.dt_s / motion.refine
    rows = []
    for j in range(1, n + 1):
        exact = response_spectrum(motion.floors_m_s2[j - 1], dt, period_ratios * t1, damping_ratio)
        for name, options in VARIANTS.items():
            floor = floor_demand(ground, j / n, chain, **options)
            for ratio, value in zip(period_ratios, exact.psa_m_s2 / G_M_S2, strict=True):
                formula = floor.acceleration(ratio * t1, damping_ratio)
                rows.append((record.name, j, ratio, name, formula, value))
    return pd.DataFrame(rows, columns=COLUMNS)


def spread(table):
    """Median, 16th and 84th percentile of formula/exact, share below one, by floor and period."""
    table = table.assign(ratio=table["formula_g"] / table["exact_g"])
    by = table.groupby(["variant", "floor", "t_over_t1"], sort=False)["ratio"]
    found = by.quantile([0.16, 0.5, 0.84]).unstack()
    found.columns = ["ratio_p16", "ratio_median", "ratio_p84"]
    found["share_below_1"] = by.apply(lambda v: float((v < 1.0).mean()))
    found["n"] = by.size()
    return found.reset_index()
