"""Does a façade fall below the amplitude that a scan calls safe? Far denser histories answer.

    .venv/bin/python tests/trials/safe_amplitudes.py --output safe.csv CLT_NS:W2:pos BSC_WE:W1:neg

For every curve the dense scan with its power, then `--each` histories in every 1 % of amplitude
below its `pga_safe_g`, as far down as a peak d/b reaches `FROM`. A row says how many fell there,
and the largest share within 1 %. Motions by the names of the recorded suite, or of `--records`. A
curve takes one to two minutes.
"""

import argparse
import math
import time

import numpy as np
from rocking import Case, Motion, collapse_curve
from rocking.collapse.curve import run_by
from rocking.collapse.hidden import WINDOW, windows
from rocking.tables import write_table

FROM = 0.2  # d/b
SUITE = "config/suites/recorded_suite.tsv"


def below(screen, table, safe_g, each):
    """Falls below `safe_g`: histories, falls, largest share within 1 %, and where [g]."""
    near = table["pga_g"][table["d_over_b"] >= FROM].min()
    low = windows(near, safe_g) if near * math.exp(WINDOW) < safe_g else np.zeros(0)
    low = safe_g * np.exp(-WINDOW * np.arange(1, low.size + 1))[::-1]  # they end at the safe one
    if not low.size:
        return 0, 0, 0.0, math.nan
    places = (np.arange(each) + 0.37) / each  # not those of the scan
    found = screen.run((low[:, None] * np.exp(WINDOW * places)).ravel(), True)
    fell = found["collapsed"].to_numpy().reshape(low.size, each)
    share = fell.mean(axis=1)
    worst = int(share.argmax())
    return fell.size, int(fell.sum()), share[worst], low[worst] if share[worst] else math.nan


def row(record, model, direction, table, each):
    """One curve."""
    case, motion = Case.configured(model), Motion.named(record, table)
    began = time.process_time()
    curve = collapse_curve(case, motion, direction)
    took = time.process_time() - began
    found = curve.summary()
    screen = run_by("planar", case, motion, direction)
    names = ("histories_below", "fell_below", "largest_share", "at_g")
    beneath = dict(zip(names, below(screen, curve.table, found["pga_safe_g"], each), strict=True))
    kept = ("pga_safe_g", "pga_collapse_g", "pga_p10_g", "safe_bound", "runs_planar")
    named = {"model": model, "record": record, "direction": direction}
    return named | {k: found[k] for k in kept} | {"cpu_s": took} | beneath


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("curves", nargs="+", help="record:model:direction")
    parser.add_argument("--records", default=SUITE, help="table of records")
    parser.add_argument("--each", type=int, default=40, help="histories in 1 %% of amplitude")
    parser.add_argument("--output", required=True)
    args = parser.parse_args()
    rows = []
    for curve in args.curves:
        rows.append(row(*curve.split(":"), args.records, args.each))
        write_table(rows, args.output, digits="%.4f")  # nothing is lost when it is stopped
        print(rows[-1], flush=True)


if __name__ == "__main__":
    main()
