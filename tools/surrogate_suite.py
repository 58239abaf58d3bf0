"""Writes config/suites/surrogate_suite.tsv: 44 sets of peaks for surrogates of an ordinary suite.

Not ground motions of any place: a rule for trying fragility curves without record files. Every
value is lognormal with a stated median and dispersion, independent of the others, and cut off where
no recorded motion lies or no surrogate can be made; PGA hardly matters, since analyses scale
it. Values of the study's own four motions are in brackets.

    PGA              0.30 g, 0.5                      [0.21–1.58 g]
    PGV/PGA          100 cm/s per g, 0.5; 30–350      [42–350]
    PGA·PGD/PGV²     2.4, 0.5; 1.2–8                  [0.86–7.4]
    duration         20 s, 0.3; 10–40 s               [14.9–29 s]

The seed is fixed, so the table never changes; a test compares it with the committed one.

    .venv/bin/python tools/surrogate_suite.py --output config/suites/surrogate_suite.tsv
"""

import numpy as np
from rocking.records import G_M_S2
from rocking.runtime.script import run

COUNT, SEED = 44, 44
COLUMNS = ("record", "pga_g", "pgv_cm_s", "pgd_cm", "duration_s")


def draw(rng, median, dispersion, low, high):
    """Lognormal value within limits, by rejection."""
    while True:
        value = median * np.exp(dispersion * rng.standard_normal())
        if low <= value <= high:
            return value


def suite(count=COUNT, seed=SEED):
    """Rows of the table."""
    rng = np.random.default_rng(seed)
    rows = []
    for i in range(1, count + 1):
        pga_g = draw(rng, 0.30, 0.5, 0.1, 1.2)
        pgv_cm_s = pga_g * draw(rng, 100.0, 0.5, 30.0, 350.0)
        ratio = draw(rng, 2.4, 0.5, 1.2, 8.0)
        pgd_cm = ratio * pgv_cm_s**2 / (pga_g * G_M_S2 * 100.0)
        duration_s = draw(rng, 20.0, 0.3, 10.0, 40.0)
        rows.append(
            (f"S{i:02d}", f"{pga_g:.3f}", f"{pgv_cm_s:.1f}", f"{pgd_cm:.2f}", f"{duration_s:.1f}")
        )
    return rows


def main(job):
    """Write the table."""
    lines = [COLUMNS, *suite()]
    with open(job.output[0], "w", encoding="utf-8") as handle:
        handle.write(
            "# Peaks of surrogates; written by tools/surrogate_suite.py, which states the rule.\n"
        )
        handle.writelines("\t".join(line) + "\n" for line in lines)


if __name__ == "__main__" or "snakemake" in globals():
    run(main, globals())
