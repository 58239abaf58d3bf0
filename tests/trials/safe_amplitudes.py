"""Does a façade fall below the amplitude that a scan calls safe? Far denser histories answer.

    .venv/bin/python tests/trials/safe_amplitudes.py --output safe.csv CLT_NS:W2:pos S07:W1:neg:1977

For every curve the dense scan with its power, then `--each` histories in every 1 % of amplitude
below its `pga_safe_g`, down to `--down` of it: how many fall, and in which windows more than the
bound. `--courses` takes the wall in four courses; `--finer 0.25 60` runs so many more in every 1 %
at a quarter of the step, and `--each` where more than the bound fell of these. Above the safe
amplitude `--above` of them in 1 %, up to where 90 % fall for sure: first crossings from those
alone, beside the scan's and the short climb's; 0: none. Motions by the names of the recorded suite,
or of `--records`; with a seed surrogates of `--surrogates`. Curves that `--output` holds are not
run again; `--keep` is a folder for the scans and the dense histories. A curve takes half a minute
to some minutes; a line says what all of them come to. The curves of docs/record.md#collapse:
`tests/trials/safe_amplitudes.sh`.
"""

import argparse
import math
import time
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion, collapse_curve
from rocking.collapse.crossing import first_crossing
from rocking.collapse.curve import run_by
from rocking.collapse.hidden import WINDOW
from rocking.collapse.probability import LEVELS, probability
from rocking.collapse.quick import crossings
from rocking.configuration.study import as_in_the_study
from rocking.tables import write_table

SUITE = "config/suites/recorded_suite.tsv"
SURROGATES = "config/suites/surrogate_suite.tsv"
COURSES = {"facade.courses": 4, "facade.courses_growth": 1.5}
BUILDING_KG = 66000.0  # behind the façade of a model that pushes it
SPREAD = 0.01
MOST = 4000  # histories above the safe amplitude
KEY = ["wall", "model", "record", "direction"]


def dense(screen, low_g, high_g, each):
    """So many histories in every 1 % of amplitude, at places that the scan has not."""
    count = max(1, math.ceil(math.log(high_g / low_g) / WINDOW - 1e-6))
    places = np.arange(count)[:, None] + (np.arange(each) + 0.37) / each
    return screen.run((low_g * np.exp(WINDOW * places)).ravel(), True)


def beneath(table, each, bound):
    """Falls below the safe amplitude by windows of 1 %."""
    fell = table["collapsed"].to_numpy().reshape(-1, each)
    share = fell.mean(axis=1)
    worst = int(share.argmax())
    return {
        "histories_below": fell.size,
        "fell_below": int(fell.sum()),
        "windows": len(share),
        "windows_fell": int((share > 0.0).sum()),
        "windows_over": int((share > bound).sum()),
        "largest_share": share[worst],
        "at_g": table["pga_g"].iloc[worst * each] if share[worst] else math.nan,
    }


def looked_at_again(screen, finer, each, args):
    """Windows in which few histories fall above the bound, with as many as the others have."""
    low_g = finer["pga_g"].to_numpy().reshape(-1, each)[:, 0] * math.exp(-0.37 * WINDOW / each)
    over = finer["collapsed"].to_numpy().reshape(-1, each).mean(axis=1) > args.bound
    if not over.any():
        return {}
    tables = [dense(screen, g, g * math.exp(WINDOW), args.each) for g in low_g[over]]
    again = beneath(pd.concat(tables), args.each, args.bound)
    return {f"finer_{name}": again[name] for name in ("windows_over", "largest_share", "at_g")}


def climbs(case, motion, direction):
    """Short climbs with the long step and with the scan's: crossings and cost."""
    out = {}
    for name, step in (("quick", {}), ("climb", {"step": None})):
        began = time.process_time()
        ends = crossings(case, motion, direction, ends=True, **step)
        out |= {f"{name}_{of}_g": ends[f"pga_{of}_g"] for of in ("p10", "median")}
        out |= {f"{name}_{of}_g": ends[f"pga_median_{of}_g"] for of in ("low", "high")}
        out |= {f"{name}_runs": ends["runs_planar"], f"{name}_cpu_s": time.process_time() - began}
    return out


def wall(args):
    """What stands for the façade."""
    return "courses" if args.courses else "E/h"


def told(table):
    """One line on all curves of a table."""
    fell, over = (table["fell_below"] > 0).sum(), (table["windows_over"] > 0).sum()
    line = f"{len(table)} curves, {(table['peak_below'] >= 0.6).sum()} with peaks from 0.6 on: "
    line += f"{over} with a window over the bound, {fell} in which any falls "
    line += f"({table['fell_below'].sum()} of {table['histories_below'].sum()} histories)"
    if "finer_fell_below" in table and (fine := table.dropna(subset="finer_fell_below")).size:
        line += f"; at the finer step {(fine['finer_windows_over'] > 0).sum()} over the bound, "
        line += f"{(fine['finer_fell_below'] > 0).sum()} with any of {len(fine)}"
    return line


def row(curve, args):
    """One curve, and the tables behind it."""
    record, model, direction, *seed = curve.split(":")
    mass = {"return_wall.building_mass_kg": BUILDING_KG} if model.endswith("m") else None
    walls = COURSES if args.courses else {}
    case = Case.configured(model, as_in_the_study({**(mass or {}), **walls} or None))
    how = {"seed": int(seed[0])} if seed else {}
    motion = Motion.named(record, args.surrogates if seed else args.records, **how)
    # no curve pays for machine code that is made or loaded once
    few = {"pga_g": np.geomspace(0.01, 0.02, 32), "scatter": True}
    collapse_curve(case, motion, direction, search="list", settings=few)
    began = time.process_time()
    scan = collapse_curve(case, motion, direction)
    took, found = time.process_time() - began, scan.summary()
    record = "@".join((record, *seed))
    out = dict(zip(KEY, (wall(args), model, record, direction), strict=True))
    names = ("safe", "collapse", "p10", "median", "p90", "equivalent", "max")
    names += tuple(f"{of}_{end}" for of in ("p10", "median", "p90") for end in ("low", "high"))
    out |= {f"pga_{name}_g": found[f"pga_{name}_g"] for name in names}
    out |= {name: found[name] for name in ("safe_bound", "runs_planar")} | {"cpu_s": took}
    out |= climbs(case, motion, direction) if args.above or not args.each else {}
    if not args.each:
        return out, {"scan": scan.table}
    safe_g, screen = found["pga_safe_g"], run_by("planar", case, motion, direction)
    low = dense(screen, safe_g * math.exp(-WINDOW * round(-math.log(args.down) / WINDOW)), safe_g,
                args.each)  # fmt: skip
    out |= beneath(low, args.each, args.bound)
    tables = {"scan": scan.table, "below": low}
    stood = scan.table[(scan.table["pga_g"] < safe_g) & (scan.table["collapsed"] == 0)]
    out["peak_below"] = stood.loc[stood["pga_g"] > args.down * safe_g, "d_over_b"].max()
    if args.finer:
        step, each = args.finer[0], int(args.finer[1])
        screen.steps_s = [step * step_s for step_s in screen.steps_s]
        finer = dense(screen, low["pga_g"].min(), safe_g, each)
        out |= {f"finer_{k}": v for k, v in beneath(finer, each, args.bound).items()}
        out |= looked_at_again(screen, finer, each, args)
        tables["finer"] = finer
    if args.above and math.isfinite(found["pga_p90_g"]):
        high_g = 1.03 * np.nanmax([found["pga_p90_g"], found["pga_p90_high_g"]])
        few = max(10, int(MOST * WINDOW / math.log(high_g / safe_g)))
        high = dense(screen, safe_g, high_g, min(args.above, few))
        both = pd.concat([low, high]).sort_values("pga_g")
        pga_g, fell = both["pga_g"].to_numpy(), both["collapsed"].to_numpy()
        share, _ = probability(pga_g, fell, pga_g, SPREAD)
        levels = [first_crossing(pga_g, share, level) for level in LEVELS]
        out |= dict(zip(("dense_p10_g", "dense_median_g", "dense_p90_g"), levels, strict=True))
        tables["above"] = high
    return out, tables


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("curves", nargs="+", help="record:model:direction[:seed]")
    parser.add_argument("--records", default=SUITE, help="table of records")
    parser.add_argument("--surrogates", default=SURROGATES, help="table of surrogates")
    parser.add_argument(
        "--each", type=int, default=200, help="histories in 1 %% below; 0: climbs only"
    )
    parser.add_argument("--above", type=int, default=40, help="histories in 1 %% above")
    parser.add_argument("--down", type=float, default=0.8, help="of the safe amplitude")
    parser.add_argument("--courses", action="store_true", help="the wall in four courses")
    parser.add_argument("--finer", type=float, nargs=2, metavar=("STEP", "EACH"))
    parser.add_argument("--bound", type=float, default=0.03, help="share that may fall")
    parser.add_argument("--keep", help="folder of the tables behind a row")
    parser.add_argument("--output", required=True)
    args = parser.parse_args()
    if args.keep:
        Path(args.keep).mkdir(parents=True, exist_ok=True)
    there = Path(args.output).is_file()
    rows = pd.read_csv(args.output).to_dict("records") if there else []
    known = {tuple(row[name] for name in KEY) for row in rows}
    for curve in args.curves:
        record, model, direction, *seed = curve.split(":")
        if (wall(args), model, "@".join((record, *seed)), direction) in known:
            continue
        one, tables = row(curve, args)
        rows.append(one)
        if args.keep:
            for name, table in tables.items():
                stem = "_".join(str(one[k]) for k in KEY)
                path = Path(args.keep) / f"{stem.replace('/', '')}_{name}.csv"
                write_table(table, path, digits="%.8g")
        write_table(rows, args.output, digits="%.5g")  # nothing is lost when it is stopped
        print(one, flush=True)
    print(told(pd.DataFrame(rows)))


if __name__ == "__main__":
    main()
