"""Does YADE confirm curves of W2m in courses, and does the safe amplitude keep its power on them?

    .venv/bin/python tests/trials/yielding/confirm.py --output confirm.csv --from 0 --count 40
    .venv/bin/python tests/trials/yielding/confirm.py --output elastic.csv --count 12 --elastic

Buildings, façades and motions are those of `curves.drawn` with bilinear loops; every fourth curve
has the default façade and building, with the drawn V/W. A motion longer than `LONGEST_S` gives way
to one that is not, drawn too: YADE takes minutes for a long one. `--elastic`: the same before a
building that stays elastic. For each curve the dense scan of the compiled solver, and

- YADE at 3 % below the lowest collapse, or below the safe amplitude where that is lower, and at the
  lowest collapse; where the façade stands there, also at the lowest amplitude about which all of
  the scan's histories fall, within ± 1 %;
- the peak below beside the compiled solver's: a history repeats where its peaks at 1, ±1e-4 and
  ±1e-3 of the amplitude lie within 0.2 % of a line, and the same with half the step;
- `--each` histories in every 1 % from the safe amplitude down to `--down` of it: how many fall.

Rows that `--output` holds are not run again; `--nodes` runs those again in YADE whose peaks repeat
and differ by more than 0.5 %, with so many nodes along every edge.
"""

import argparse
import math
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion, collapse_curve
from rocking.collapse.curve import run_by
from rocking.collapse.hidden import WINDOW
from rocking.collapse.plan import BELOW
from rocking.collapse.probability import from_scan
from rocking.records import read_table
from rocking.tables import write_table

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

from tests.trials.safe_amplitudes import beneath, dense
from tests.trials.steps import SUITE, reporting
from tests.trials.yardsticks.survey import LINE, MOVED, NODE_KEYS, straight
from tests.trials.yielding.curves import SEED, SPREAD, drawn, ductility

MODEL, BOUND, FEW, FAR, LONGEST_S = "W2m", 0.03, 8, 0.005, 40.0


def shaken(number, elastic):
    """Case, motion, direction and what was drawn, of a number."""
    _, motion, direction, about = drawn(number, MODEL, "courses", "bilinear")
    lasts = {name: read_table(SUITE)[name].targets["duration_s"] for name in reporting(SUITE)}
    if lasts[motion.name] > LONGEST_S:
        short = [name for name, duration_s in lasts.items() if duration_s <= LONGEST_S]
        motion = Motion.named(str(np.random.default_rng([SEED, number, 1]).choice(short)), SUITE)
    if number % 4 == 0:
        about = {"smdof.base_shear_ratio": about["smdof.base_shear_ratio"]}
    if elastic:
        about = {k: v for k, v in about.items() if k != "smdof.loops"}
        about["smdof.base_shear_ratio"] = None
    fixed = {"facade.courses": 4, "facade.courses_growth": 1.5}
    return Case.configured(MODEL, about | fixed).calibrated(), motion, direction, about


def surely(scan):
    """Lowest amplitude about which all of the scan's histories fall [g], NaN where none is."""
    table = from_scan(scan, SPREAD)
    sure = table[(table["probability"] >= 1.0) & (table["realisations"] >= FEW)]
    return float(sure["pga_g"].min())


def repeating(screen, pga_g):
    """Peak at an amplitude, by how much half the step moves it, and whether the history repeats."""
    around = pga_g * (1.0 + np.array([0.0, *LINE]))
    peaks = screen.run(around, False)["d_over_b"].to_numpy()
    _, off = straight(peaks)
    kept = screen.steps_s
    screen.steps_s = [0.5 * step for step in kept]
    finer = float(screen.run([pga_g], False)["d_over_b"].iloc[0])
    screen.steps_s = kept
    moved = finer / peaks[0] - 1.0
    found = {"compiled": peaks[0], "off_line": off, "half_step": moved}
    return found | {"repeats": int(off < MOVED and abs(moved) < MOVED and peaks.max() < 1.0)}


def in_yade(case, motion, direction, pga_g):
    """Table of YADE at some amplitudes."""
    return run_by("yade", case, motion, direction).run(pga_g)


def confirmed(case, motion, direction, scan, found):
    """YADE below and at the lowest collapse, beside the compiled solver."""
    fall_g = found["pga_collapse_g"]
    stand_g = BELOW * min(fall_g, found["pga_safe_g"])
    out = {"stand_g": stand_g} | repeating(run_by("planar", case, motion, direction), stand_g)
    began = time.monotonic()
    table = in_yade(case, motion, direction, [stand_g, fall_g])
    out |= {"yade": table["d_over_b"].iloc[0], "yade_stood": 1 - table["collapsed"].iloc[0]}
    out |= {"error": out["yade"] / out["compiled"] - 1.0, "yade_fell": table["collapsed"].iloc[1]}
    out["sure_g"] = surely(scan.table)
    if not out["yade_fell"] and math.isfinite(out["sure_g"]):
        again = in_yade(case, motion, direction, [out["sure_g"]])
        out["yade_fell_sure"] = again["collapsed"].iloc[0]
    return out | {"yade_s": time.monotonic() - began}


def row(number, args):
    """One curve."""
    case, motion, direction, about = shaken(number, args.elastic)
    began = time.process_time()
    scan = collapse_curve(case, motion, direction)
    found = scan.summary()
    out = {"number": number, "elastic": int(args.elastic), "record": motion.name}
    out |= {"direction": direction, "default": int(number % 4 == 0)}
    facade, wall, chain = case["facade"], case["return_wall"], case["smdof"]
    out |= {key: facade[key] for key in ("height_m", "thickness_m", "width_m")}
    out |= {"building_mass_kg": wall["building_mass_kg"], "period_s": chain["period_s"]}
    out["base_shear_ratio"] = chain["base_shear_ratio"]
    for name in ("safe", "collapse", "median", "building"):
        out[f"pga_{name}_g"] = found[f"pga_{name}_g"]
    out |= {"runs_planar": scan.runs, "scan_s": time.process_time() - began}
    if not math.isfinite(found["pga_safe_g"]):
        return out
    safe_g = found["pga_safe_g"]
    foot_g = safe_g * math.exp(-WINDOW * round(-math.log(args.down) / WINDOW))
    low = dense(run_by("planar", case, motion, direction), foot_g, safe_g, args.each)
    out |= beneath(low, args.each, BOUND)  # whole windows, the last one up to the safe amplitude
    if not args.elastic:
        out["ductility"] = ductility(case, motion, direction, safe_g)
    out["planar_s"] = time.process_time() - began
    if args.yade:
        out |= confirmed(case, motion, direction, scan, found)
    return out


def with_nodes(one, nodes):
    """Peak of YADE below the lowest collapse, with so many nodes along every edge."""
    case, motion, direction, _ = shaken(int(one["number"]), bool(one["elastic"]))
    finer = case.varied({f"numerics.{key}": nodes for key in NODE_KEYS})
    table = in_yade(finer, motion, direction, [one["stand_g"]])
    return {"yade_nodes": nodes, "yade_many": table["d_over_b"].iloc[0]}


def told(table):
    """Lines on all curves of a table."""
    known = table.dropna(subset="yade") if "yade" in table else table.iloc[:0]
    if known.empty:
        known = known.reindex(columns=[*known, "repeats", "error", "yade_stood", "yade_fell"])
    fine, low = known[known["repeats"] == 1], table.dropna(subset="histories_below")
    sure = known["yade_fell_sure"].eq(1).sum() if "yade_fell_sure" in known else 0
    size = fine["error"].abs()
    return (
        f"{len(table)} curves; YADE: {known['yade_stood'].sum():.0f} of {len(known)} stand below, "
        f"{known['yade_fell'].sum():.0f} fall at the lowest collapse, {sure} more where all fall; "
        f"{(size <= 0.01).sum()} of {len(fine)} repeating peaks within 1 %, "
        f"{(size <= FAR).sum()} within 0.5 %, largest {size.max():.4f}\n"
        f"{len(low)} curves: {low['fell_below'].sum():.0f} of {low['histories_below'].sum():.0f} "
        f"histories fall below the safe amplitude, in {(low['fell_below'] > 0).sum()} curves; "
        f"{(low['windows_over'] > 0).sum()} with a window over {BOUND:g}"
    )


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--count", type=int, default=0)
    parser.add_argument("--elastic", action="store_true", help="before an elastic building")
    parser.add_argument("--each", type=int, default=100, help="histories in 1 %% below")
    parser.add_argument("--down", type=float, default=0.85, help="of the safe amplitude")
    parser.add_argument("--yade", action=argparse.BooleanOptionalAction, default=True)
    parser.add_argument("--nodes", type=int, help="along an edge, of those that are far off")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin no row after")
    args = parser.parse_args()
    until = time.monotonic() + 60.0 * args.minutes
    rows = pd.read_csv(args.output).to_dict("records") if args.output.is_file() else []
    known = {one["number"] for one in rows}
    for number in range(args.first, args.first + args.count):
        if number not in known and time.monotonic() < until:
            rows.append(row(number, args))
            write_table(rows, args.output, digits="%.8g")
    for one in rows if args.nodes else ():
        off = abs(one["error"]) > FAR and one["repeats"] == 1
        if off and not one.get("yade_many", math.nan) > 0.0 and time.monotonic() < until:
            one |= with_nodes(one, args.nodes)
            write_table(rows, args.output, digits="%.8g")
    print(told(pd.DataFrame(rows)))


if __name__ == "__main__":
    main()
