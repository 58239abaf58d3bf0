"""Chains that yield, by the compiled march and by OpenSees: peaks of drift, and their time.

    python3 -m venv /tmp/venv && /tmp/venv/bin/pip install openseespy numpy
    .venv/bin/python tests/trials/opensees/chains.py --python /tmp/venv/bin/python

The study's chain, four masses and 0.27 s, with bilinear storeys, under twelve components of the
recorded suite at two and at four times the PGA at which it yields. OpenSees takes a fifth of the
march's step.
"""

import argparse
import json
import subprocess
import time
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion
from rocking.configuration.study import as_in_the_study
from rocking.solver.storeys import march

from yade_scripts.model.chain import chain_matrices
from yade_scripts.model.storeys import chain_of, largest_drift

HERE = Path(__file__).resolve().parent
RECORDS = (
    *("CACS_H1", "GMN_NS", "BSC_WE", "IS101_Lo", "IS105_Tr", "IS113_Lo"),
    *("AQG_WE", "LPCC_H1", "NRC_EW", "T1214_NS", "TLM1_NS", "ACC_NS"),
)
SUITE, TIMES, FINER = "config/suites/recorded_suite.tsv", (2.0, 4.0), 5


def asked_of(case, chain, ground, factor):
    """What `chain_in_opensees.py` is asked."""
    mass, _, damping = chain_matrices(case["smdof"], 1.0)
    at, step = np.arange(ground.size), chain.step_s / FINER
    fine = np.interp(np.arange(0, ground.size - 1 + 1e-9, 1.0 / FINER), at, factor * ground)
    storeys = chain.storeys
    return {
        "mass_kg": np.diag(mass).tolist(),
        "damping": damping.tolist(),
        "k_n_m": storeys.k_n_m.tolist(),
        "yield_n": (storeys.k_n_m * storeys.yield_m).tolist(),
        "hardening": storeys.hardening,
        "step_s": step,
        "ground_m_s2": fine.tolist(),
    }


def main():
    """Run both and print a row a motion."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--python", required=True, help="a Python that has openseespy")
    parser.add_argument("--records", nargs="*", default=RECORDS)
    args = parser.parse_args()
    rows = []
    for times in TIMES:
        keys = {"smdof.base_shear_ratio": 0.25, "smdof.loops": "bilinear"}
        case = Case.configured("W2", as_in_the_study(keys))
        for name in args.records:
            time_s, columns = Motion.named(name, SUITE).columns(case)
            chain = chain_of(case, time_s[1] - time_s[0])
            ground = columns["ground"]
            factor = times * float(np.min(chain.storeys.yield_m / columns._elastic("ground")))
            march(chain, ground[:10], [factor])
            began = time.process_time()
            own = largest_drift(march(chain, ground, [factor])[1][0])
            own_s = time.process_time() - began
            asked = json.dumps([asked_of(case, chain, ground, factor)])
            done = subprocess.run(
                [args.python, str(HERE / "chain_in_opensees.py")],
                input=asked,
                capture_output=True,
                text=True,
                timeout=600,
            )
            (other,) = json.loads(done.stdout)
            off = np.abs(own / np.array(other["drift_m"]) - 1.0)
            row = {
                "times": times,
                "record": name,
                "pga_g": factor * abs(ground).max() / 9.80665,
            }
            row |= {"ductility": float(np.max(own / chain.storeys.yield_m)), "off": off.max()}
            largest = np.argmax(own)
            row |= {"off_largest": off[largest], "march_s": own_s, "opensees_s": other["cpu_s"]}
            rows.append(row | {"failed": other["failed"]})
            print(pd.DataFrame(rows[-1:]).to_string(index=False, header=len(rows) == 1))


if __name__ == "__main__":
    main()
