"""Drifts of a house that TREMURI computed, predicted by one storey that yields.

    .venv/bin/python tests/trials/tremuri/predict.py [--wall slender] [--swap]

Period, strength V/W and law are chosen on half of the stations, every other one in the order of the
table, and judged on the other half; `--swap` turns the halves. The storey is that of the compiled
march, with 5 % of critical damping on the initial stiffness and 2 % hardening.
"""

import argparse
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case
from rocking.records import load
from rocking.solver.storeys import march

from yade_scripts.model.storeys import LAWS, chain_of, largest_drift

TABLE = Path(__file__).with_name("set_a1.csv")
SUITE = "config/suites/recorded_suite.tsv"
PERIODS_S = (0.05, 0.07, 0.10, 0.14, 0.18, 0.23, 0.30, 0.40)
STRENGTHS = (0.10, 0.15, 0.20, 0.25, 0.30, 0.40, 0.60)
TALL_M, STEP_S = 2.82, 0.001


def case_of(period_s, ratio, law, damping):
    """Case file, as far as a chain needs it."""
    chain = {"n_dof": 1, "period_s": period_s, "damping_ratio": damping, "damping_model": "modal"}
    loops = {"base_shear_ratio": ratio, "loops": law, "hardening": 0.02, "unloading": 0.0}
    falls = {"flag_share": 0.3, "loss_drift_ratio": None, "lost_drift_ratio": 0.02, "residual": 1.0}
    return {
        **Case.configured("W2", {"facade.height_m": TALL_M}).sections,
        "smdof": {**chain, **loops, **falls},
    }


def motions_of(records):
    """Ground accelerations at the step [m/s²], by record."""
    found = {}
    for name in records:
        record = load(name, SUITE)
        times = record.dt_s * np.arange(len(record))
        fine = np.arange(0.0, times[-1], STEP_S)
        found[name] = np.interp(fine, times, record.acceleration_m_s2)
    return found


def drifts_mm(motions, what, damping):
    """Largest drift under each motion [mm]."""
    chain = chain_of(case_of(*what, damping), STEP_S)
    return np.array(
        [1e3 * largest_drift(march(chain, a, [1.0])[1][0])[0] for a in motions.values()]
    )


def main():
    """Choose on one half, judge on the other."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wall", default="slender", choices=("slender", "squat"))
    parser.add_argument("--swap", action="store_true", help="turn the halves")
    parser.add_argument("--damping", type=float, default=0.05, help="share of the critical one")
    args = parser.parse_args()
    table = pd.read_csv(TABLE, comment="#")
    seen = table[f"{args.wall}_mm"].to_numpy()
    names = list(dict.fromkeys(table["station"]))
    chooses = table["station"].isin(names[args.swap :: 2]).to_numpy()
    motions, known = motions_of(table["record"]), np.isfinite(seen)
    rows = []
    for what in product(PERIODS_S, STRENGTHS, LAWS):
        off = np.log(drifts_mm(motions, what, args.damping) / seen)
        row = dict(zip(("period_s", "base_shear_ratio", "loops"), what, strict=True))
        for half, mine in (("chosen", chooses & known), ("judged", ~chooses & known)):
            row |= {
                f"{half}_rms": np.sqrt(np.mean(off[mine] ** 2)),
                f"{half}_median": np.exp(np.median(off[mine])),
                f"{half}_scatter": np.std(off[mine], ddof=1),
            }
        rows.append(row)
    found = pd.DataFrame(rows).sort_values("chosen_rms")
    print(f"{args.wall}: {chooses.sum()} components choose, {(~chooses).sum()} judge")
    print(found.head(8).to_string(index=False, float_format="%.3f"))
    best = found.groupby("loops", sort=False).head(1)
    print(best.to_string(index=False, float_format="%.3f"))


if __name__ == "__main__":
    main()
