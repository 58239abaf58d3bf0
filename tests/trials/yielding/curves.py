"""Curves of drawn façades before buildings that yield: step, YADE, and the safe amplitude.

    .venv/bin/python tests/trials/yielding/curves.py step --output step.csv --from 0 --count 20

Façade, period, strength and (but for YADE) loops are drawn; motions are those of every second
station of the recorded suite, which chose no step. W2 and W2m take turns; `yade` and `safe` have
W2m alone. A drawn curve depends on its number alone.

step
    Half collapse with the step and with half of it, façade and chain: a list of 60 amplitudes finds
    it, `--each` ones within ± 8 % of it say where.
yade
    Peak of YADE, and of the compiled solver, at `--share` of the lowest collapse; a history repeats
    where 1e-6 and 1e-4 more of amplitude move its peak by at most ten times as much.
safe
    The dense scan of the compiled solver, then `--each` histories in every 1 % from the amplitude
    that it calls safe down to `--down` of it: how many fall.

Rows that `--output` holds are not run again.
"""

import argparse
import math
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion, collapse_curve
from rocking.collapse import probability
from rocking.collapse.crossing import first_crossing
from rocking.collapse.curve import run_by
from rocking.tables import write_table

from yade_scripts.model.storeys import LAWS, chain_of, largest_drift

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

from tests.trials.safe_amplitudes import beneath, dense
from tests.trials.steps import SUITE, reporting

SEED = 6707
COARSE = np.geomspace(0.05, 2.0, 60)
AROUND = 0.08
SPREAD = 0.01
FOUR = {"facade.courses": 4, "facade.courses_growth": 1.5}
BLOCK = {"facade.courses": 0}


def drawn(number, model, wall, loops=None):
    """Case, motion and direction of a number."""
    rng = np.random.default_rng([SEED, number])
    tall = rng.uniform(4.5, 9.0)
    about = {
        "facade.height_m": round(tall, 2),
        "facade.thickness_m": round(tall / rng.uniform(12.0, 20.0), 3),
        "facade.width_m": round(rng.uniform(3.5, 7.0), 1),
        "return_wall.building_mass_kg": round(1e3 * tall * rng.uniform(7.0, 14.0)),
        "smdof.period_s": round(0.0625 * tall**0.75 * math.exp(rng.normal(0.0, 0.25)), 3),
        "smdof.base_shear_ratio": round(math.exp(rng.uniform(math.log(0.1), math.log(0.4))), 3),
        "smdof.loops": loops or str(rng.choice(LAWS)),
    }
    names = reporting(SUITE)
    record, direction = str(rng.choice(names)), str(rng.choice(["pos", "neg"]))
    case = Case.configured(model, {**about, **(FOUR if wall == "courses" else BLOCK)}).calibrated()
    return case, Motion.named(record, SUITE), direction, about


def listed(case, motion, direction, levels):
    """Outcomes at some amplitudes."""
    return run_by("planar", case, motion, direction).run(levels, False)


def half(table):
    """Lowest amplitude at which half of those nearby fall; NaN where none."""
    at = table["pga_g"].to_numpy(float)
    share, _ = probability.probability(at, table["collapsed"].to_numpy(), at, SPREAD)
    return first_crossing(at, share, 0.5)


def half_step(case, motion, direction, levels):
    """Outcomes with half the step, of façade and chain."""
    screen = run_by("planar", case, motion, direction)
    for one in filter(None, (screen, screen.carrying)):
        one.steps_s = [0.5 * step for step in one.steps_s]
    return screen.run(levels, False)


def ductility(case, motion, direction, pga_g):
    """Largest drift of the chain alone over that at which it yields."""
    time_s, columns = motion.columns(case.varied({"smdof.base_shear_ratio": None}))
    chain = chain_of(case.sections, time_s[1] - time_s[0])
    factor = pga_g * 9.80665 / np.abs(columns["ground"]).max() * (1 if direction == "pos" else -1)
    from rocking.solver.storeys import march

    _, states = march(chain, columns["ground"], [factor], floors=False)
    return float(np.max(largest_drift(states[0]) / chain.storeys.yield_m))


def about_half(case, motion, direction):
    """Where half of three neighbours first fall, by a coarse list [g]; NaN: nowhere."""
    fell = listed(case, motion, direction, COARSE)["collapsed"].to_numpy()
    near = np.convolve(fell, np.ones(3), "same") >= 2
    return float(COARSE[near][0]) if near.any() else math.nan


def step(case, motion, direction, args):
    """Half collapse by both steps."""
    centre = about_half(case, motion, direction)
    if math.isnan(centre):
        return {"half_g": math.nan}
    levels = centre * np.geomspace(1.0 - AROUND, 1.0 + AROUND, args.each)
    own = listed(case, motion, direction, levels)
    finer = half_step(case, motion, direction, levels)
    found = {"half_g": half(own), "half_fine_g": half(finer)}
    differ = (own["collapsed"] != finer["collapsed"]).mean()
    return found | {
        "moved": found["half_fine_g"] / found["half_g"] - 1.0,
        "outcomes_differ": differ,
        "ductility": ductility(case, motion, direction, centre),
    }


def yade(case, motion, direction, args):
    """Peaks of both solvers at shares of the lowest collapse."""
    table = listed(case, motion, direction, COARSE)
    fell = table.loc[table["collapsed"] == 1, "pga_g"]
    if not len(fell):
        return {"pga_g": math.nan}
    pga_g = args.share * float(fell.iloc[0])
    screen = run_by("planar", case, motion, direction)
    moved = (0.0, 1e-6, 1e-4)
    peaks = screen.run(pga_g * (1.0 + np.array(moved)), False)["d_over_b"].to_numpy()
    off = np.abs(peaks[1:] / peaks[0] - 1.0)
    repeats = bool(np.all(off <= 10.0 * np.array(moved[1:])))
    began = time.monotonic()
    other = run_by("yade", case, motion, direction).run([pga_g])
    return {
        "pga_g": pga_g,
        "compiled": peaks[0],
        "yade": other["d_over_b"].iloc[0],
        "error": other["d_over_b"].iloc[0] / peaks[0] - 1.0,
        "repeats": repeats,
        "status": other["status"].iloc[0],
        "ductility": ductility(case, motion, direction, pga_g),
        "yade_s": time.monotonic() - began,
    }


def safe(case, motion, direction, args):
    """What falls below the amplitude that a dense scan calls safe."""
    scan = collapse_curve(case, motion, direction)
    found = scan.summary()
    safe_g = found["pga_safe_g"]
    out = {"pga_safe_g": safe_g, "pga_collapse_g": found["pga_collapse_g"]}
    out |= {"pga_building_g": found["pga_building_g"], "runs_planar": scan.runs}
    if not math.isfinite(safe_g):
        return out
    low = dense(run_by("planar", case, motion, direction), args.down * safe_g, safe_g, args.each)
    out |= beneath(low.iloc[: len(low) // args.each * args.each], args.each, 0.03)
    return out | {"ductility": ductility(case, motion, direction, safe_g)}


DOES = {"step": step, "yade": yade, "safe": safe}


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=tuple(DOES))
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--wall", default="courses", choices=("courses", "block"))
    parser.add_argument("--each", type=int, default=160)
    parser.add_argument("--down", type=float, default=0.85)
    parser.add_argument("--share", type=float, default=0.9)
    args = parser.parse_args()
    there = args.output.is_file()
    rows = pd.read_csv(args.output).to_dict("records") if there else []
    known = {(row["number"], row["wall"]) for row in rows}
    for number in range(args.first, args.first + args.count):
        if (number, args.wall) in known:
            continue
        model = "W2m" if args.what != "step" or number % 2 else "W2"
        loops = "bilinear" if args.what == "yade" else None
        case, motion, direction, about = drawn(number, model, args.wall, loops)
        began = time.process_time()
        found = DOES[args.what](case, motion, direction, args)
        key = {"number": number, "wall": args.wall, "model": model, "record": motion.name}
        about = {name.split(".")[1]: value for name, value in about.items()}
        spent = {"cpu_s": time.process_time() - began}
        rows.append({**key, "direction": direction, **about, **found, **spent})
        write_table(rows, args.output, digits="%.6g")
        print({**key, **found, **spent}, flush=True)


if __name__ == "__main__":
    main()
