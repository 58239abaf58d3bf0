"""Peaks of the compiled solver and of YADE beside a solver written apart: courses, W1, W2, W2m.

    .venv/bin/python tests/trials/yardsticks/survey.py --output survey.csv --seed 65 --histories 60
    .venv/bin/python tests/trials/yardsticks/survey.py --output survey.csv --yade 20
    .venv/bin/python tests/trials/yardsticks/survey.py --output after.csv \
        --again tests/trials/yardsticks/histories.csv

What is drawn: in a third of the histories the study's façade before a building of 64 t and 0.27 s;
in the others height, thickness, E, friction, β by eq. 5, mass and period of the building. Four
courses, each 1.5 times as high as the one below. Motions of stations that chose neither nodes nor
step (`MOTIONS`), cut to their strong part, in both directions. Amplitude: a share drawn from 0.3 to
0.97 of the lowest collapse that a climb of the compiled solver finds.

The yardstick is `reference_solver.stack` with 65 nodes a joint (`--nodes`), which stand for even
springs; of W2 near collapse they leave 1 %, 129 a tenth of that. A
history repeats where its peak stands below b, half the step moves that by less than 0.2 %, and the
peaks at 1, 1 ± 1e-4 and 1 ± 1e-3 of the amplitude lie within 0.2 % of one straight line: peaks of
courses have spikes in amplitude that are a thousandth wide, which no smaller change meets. The
compiled solver has no say. `steady` is the older rule, 1e-6 of amplitude in place of the line. Of
those that are steady the compiled solver runs at its own step, at a half, a quarter and a sixteenth
of it. `--models` may run side by side, each with a table of its own. `--again TABLE` takes what
repeats from another table, as that beside this file, and runs both solvers once each: so two states
of the code meet the same histories. `--yade` runs so many of the repeating ones in YADE, at the
step as shipped and at a third of it, or at one of them (`--yade-steps`); `--yade-nodes 65` those of
them that are more than 0.5 % off, with so many nodes along every edge. A row is written as soon as
it is known; what the table holds is not run again. 60 of each model take some 40 minutes of
processor time, YADE a quarter of a minute a history.
"""

import argparse
import math
import time
from pathlib import Path

import numpy as np
import pandas as pd
from reference_solver.stack import StackSolver
from rocking import Case, Motion
from rocking.collapse import search
from rocking.collapse.curve import run_by
from rocking.configuration.schema import ConfigError
from rocking.configuration.study import as_in_the_study
from rocking.solver import peaks
from rocking.tables import write_table

from yade_scripts.model.models import build_scene
from yade_scripts.model.motion import amplitude

SUITE = Path(__file__).resolve().parents[3] / "config/suites/recorded_suite.tsv"
MODELS = ("W1", "W2", "W2m")
MOTIONS = ("AQG_NS", "AQG_WE", "AQV_NS", "IS105_Lo", "IS105_Tr", "IS108_Lo", "IS108_Tr")
MOTIONS += ("NRC_EW", "NRC_NS")
DIRECTIONS = ("pos", "neg")
SHARES = (0.3, 0.97)  # of the lowest collapse
CLIMB = {"level_ratio": 0.05, "beyond": 1.0, "max_pga_g": 3.0}
ARIAS, TAPER_S = (2e-3, 0.95), 0.5  # what of a motion is kept
NODES, STEP_S, MOVED = 65, 8e-5, 2e-3  # of the yardstick; it counts at half that step
YARDSTICK = {"nodes": NODES}
AMPLITUDE = 1e-6  # that a steady history bears
LINE = (-1e-3, -1e-4, 1e-4, 1e-3)  # about the amplitude, of a history that repeats
FRACTIONS = {"own": 1.0, "half": 0.5, "quarter": 0.25, "sixteenth": 1.0 / 16.0}
YADE = {"yade_own": 1.0, "yade_fine": 1.0 / 3.0}
WITHIN = 0.01
COLUMNS = [
    "seed",
    "number",
    "model",
    "record",
    "direction",
    "drawn",
    "height_m",
    "thickness_m",
    "e_mpa",
]
COLUMNS += ["friction_deg", "beta_s", "mass_kg", "period_s", "share", "pga_g", "steady", "repeats"]
COLUMNS += ["yardstick", "moved_step", "moved_amplitude", "slope", "off_line", "lowest", "highest"]
COLUMNS += [*FRACTIONS, *YADE, "yade_s", "yade_nodes", "yade_many"]
NODE_KEYS = ("nodes_thickness", "nodes_height", "nodes_per_block")


def drawn(draw, model, number):
    """Case of courses: every third the study's façade, else one that the configuration allows."""
    fixed = {"facade.courses": 4, "facade.courses_growth": 1.5}
    if number % 3 == 0:
        return Case.configured(
            model, as_in_the_study(fixed | {"return_wall.building_mass_kg": 64e3})
        )
    while True:
        height = float(draw.uniform(3.5, 9.0))
        friction = float(draw.uniform(20.0, 40.0))
        facade = {
            "facade.height_m": height,
            "facade.thickness_m": height / float(draw.uniform(11.0, 20.0)),
            "facade.e_mpa": float(10.0 ** draw.uniform(2.8, 3.5)),
            "facade.friction_deg": friction,
            "return_wall.friction_deg": friction,
            "return_wall.building_mass_kg": float(draw.uniform(40e3, 120e3)),
            "smdof.period_s": float(draw.uniform(0.15, 0.5)),
            "damping.law": "eq5",
        }
        try:
            return Case.configured(
                model, as_in_the_study(fixed | {k: _short(v) for k, v in facade.items()})
            )
        except (ConfigError, ValueError):  # outside the law's range, or too slender to stand
            continue


def _short(value):
    return value if isinstance(value, str) else float(f"{value:.4g}")


def strong(name):
    """Motion of a record between two shares of its Arias intensity, tapered at both ends."""
    record = Motion.named(name, SUITE).record
    a, dt = np.asarray(record.acceleration_m_s2, float), record.dt_s
    share = np.cumsum(a**2) / np.sum(a**2)
    first, last = np.searchsorted(share, ARIAS)
    n = round(TAPER_S / dt)
    part = a[max(0, first - n) : last + n].copy()
    ramp = 0.5 - 0.5 * np.cos(np.pi * np.arange(n) / n)
    part[:n] *= ramp
    part[-n:] *= ramp[::-1]
    return Motion.sampled(part, dt, "m/s2", name=name)


def solver_of(case, motion):
    """The reference solver of stacks, of a case with its nodes."""
    numerics = {**case["numerics"], **dict.fromkeys(NODE_KEYS, YARDSTICK["nodes"])}
    scene = build_scene({**case.sections, "numerics": numerics})
    return StackSolver(scene, *motion.columns(case))


def straight(peaks_):
    """Of peaks at the amplitude and along `LINE`: slope of d/b by amplitude, largest departure.

    Both relative to the first; the line is the best one through all of them.
    """
    x, y = np.array([0.0, *LINE]), np.asarray(peaks_, float)
    slope, level = np.polyfit(x, y, 1)
    return slope / y[0], float(np.abs(y - level - slope * x).max() / y[0])


def yardstick(case, motion, factor):
    """Peak at half the step, how far step and amplitude move it, and whether it counts."""
    solver = solver_of(case, motion)
    step_s = min(STEP_S, 1.5 * solver.step_s)
    first, other = solver.peaks([factor, factor * (1.0 + AMPLITUDE)], step_s=step_s).d_over_b
    found = {"steady": 0, "repeats": 0, "yardstick": first, "moved_amplitude": other / first - 1.0}
    if not abs(found["moved_amplitude"]) < MOVED or first >= 1.0:
        return found
    value = solver.peaks([factor], step_s=0.5 * step_s).d_over_b[0]
    found |= {"yardstick": value, "moved_step": value / first - 1.0}
    if not abs(found["moved_step"]) < MOVED:
        return found
    beside = solver.peaks([factor * (1.0 + e) for e in LINE], step_s=step_s).d_over_b
    slope, off = straight([first, *beside])
    found |= {"steady": 1, "repeats": int(off < MOVED), "slope": slope, "off_line": off}
    return found | {"lowest": min(beside), "highest": max(beside)}


def shaken(number, seed, motions):
    """Case, motion, direction and share of the lowest collapse of one history."""
    draw = np.random.default_rng([seed, number])
    case = drawn(draw, MODELS[number % len(MODELS)], number // len(MODELS))
    name, direction = str(draw.choice(MOTIONS)), str(draw.choice(DIRECTIONS))
    share = float(draw.uniform(*SHARES))
    if name not in motions:
        motions[name] = strong(name)
    return case, motions[name], direction, share


def compiled(scan, factor):
    """Peaks of the compiled solver by share of its step."""
    found = {}
    for key, part in FRACTIONS.items():
        how = {"carried": scan.carried, "step_s": part * scan.steps_s[0]}
        at = peaks(scan.planes[0], scan.motions, scan.numerics, [factor], **how)
        found[key] = at.d_over_b[0]
    return found


def again(row, motions):
    """The row with the peaks of both solvers anew, the reference's at its longer step.

    A scene may have another law in another state of the code.
    """
    case, motion, direction, _ = shaken(int(row["number"]), int(row["seed"]), motions)
    scan = run_by("planar", case, motion, direction)
    factor = float(amplitude(scan.ground, direction, row["pga_g"]))
    solver = solver_of(case, motion)
    value = solver.peaks([factor], step_s=min(STEP_S, 1.5 * solver.step_s)).d_over_b[0]
    return row | {"yardstick": value} | compiled(scan, factor)


def history(number, seed, motions):
    """One row; without the compiled solver's peaks where the history is not steady."""
    case, motion, direction, share = shaken(number, seed, motions)
    scan = run_by("planar", case, motion, direction)
    levels, _ = scan.seen(search.climb(0.5 * scan.static_g, CLIMB))
    fell = levels.loc[levels["collapsed"] == 1, "pga_g"]
    pga_g = float(f"{share * (fell.min() if len(fell) else CLIMB['max_pga_g']):.5g}")
    factor = float(amplitude(scan.ground, direction, pga_g))
    found = yardstick(case, motion, factor)
    facade = case["facade"]
    row = {
        **{
            "seed": seed,
            "number": number,
            "model": case.model,
            "record": motion.name,
            "direction": direction,
        },
        "drawn": int((number // len(MODELS)) % 3 != 0),
        **{key: facade[key] for key in ("height_m", "thickness_m", "e_mpa", "friction_deg")},
        "beta_s": case["beta_s"],
        "mass_kg": case["return_wall"]["building_mass_kg"],
        "period_s": case["smdof"]["period_s"],
        **{"share": share, "pga_g": pga_g},
    }
    return row | found | (compiled(scan, factor) if found["steady"] else {})


def in_yade(row, motions, limit_s, steps=tuple(YADE)):
    """Peaks of YADE of one row at its steps, NaN where it failed, and the time that they took."""
    case, motion, _, _ = shaken(int(row["number"]), int(row["seed"]), motions)
    found = {"yade_s": 0.0}
    for key in steps:
        part = YADE[key]
        sections = case.sections
        numerics = {**sections["numerics"]}
        numerics["step_fraction"] = part * numerics["step_fraction"]
        try:
            runs = run_by(
                "yade", Case({**sections, "numerics": numerics}), motion, row["direction"],
                limit_s=limit_s,
            )  # fmt: skip
            table = runs.run([row["pga_g"]])
            found[key] = float(table["d_over_b"].iloc[0])
            found["yade_s"] += float(table["wall_s"].iloc[0])
        except ValueError as error:
            print(f"{row['number']}: {error}", flush=True)
            break
    return found


def with_nodes(row, motions, limit_s, nodes):
    """Peak of YADE of one row at its step, with so many nodes along every edge."""
    case, motion, _, _ = shaken(int(row["number"]), int(row["seed"]), motions)
    numerics = {**case["numerics"], **dict.fromkeys(NODE_KEYS, nodes)}
    case = Case({**case.sections, "numerics": numerics})
    runs = run_by("yade", case, motion, row["direction"], limit_s=limit_s)
    found = float(runs.run([row["pga_g"]])["d_over_b"].iloc[0])
    return {"yade_nodes": nodes, "yade_many": found}


def summary(table):
    """Lines by model: how many of the repeating histories are within 1 %, how far others are."""
    lines = []
    for model, everyone in table.groupby("model"):
        for rule in ("repeats", "steady"):
            part = everyone[everyone[rule] == 1]
            lines.append(f"{model}: {len(part)} of {len(everyone)}, {rule}")
            lines += [
                errors(key, (part[key] / part["yardstick"] - 1.0).dropna())
                for key in (*FRACTIONS, *YADE, "yade_many")
                if part[key].notna().any()
            ]
    return "\n".join(lines)


def errors(key, error):
    """A line on the relative errors of one solver at one step."""
    size = error.abs()
    return (
        f"  {key:10s} {int((size <= WITHIN).sum())} of {len(size)} within 1 %, "
        f"{int((size <= 0.5 * WITHIN).sum())} within 0.5 %; "
        f"median {100 * size.median():.2f}, "
        f"95 % {100 * size.quantile(0.95, interpolation='higher'):.2f}, "
        f"worst {100 * error[size.idxmax()]:+.2f} %, mean {100 * error.mean():+.2f} %, "
        f"too large {int((error > 0.0).sum())}"
    )


def beside_yade(rows, motions, until, args):
    """The repeating rows in YADE, in the order of their numbers; the table after each."""
    wanted = [row for row in sorted(rows, key=lambda r: r["number"]) if row["repeats"]]
    for row in wanted[: args.yade]:
        if not row.get("yade_s", math.nan) > 0.0 and time.monotonic() < until:
            row |= in_yade(row, motions, args.limit, args.yade_steps)
            write_table(rows, args.output, COLUMNS)
    for row in wanted if args.yade_nodes else ():
        off = [abs(row.get(key, math.nan) / row["yardstick"] - 1.0) for key in YADE]
        if any(e > 0.5 * WITHIN for e in off) and not row.get("yade_many", math.nan) > 0.0:
            row |= with_nodes(row, motions, args.limit, args.yade_nodes)
            write_table(rows, args.output, COLUMNS)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--seed", type=int, default=65)
    parser.add_argument("--histories", type=int, default=0, help="repeating ones of each model")
    parser.add_argument("--models", nargs="+", choices=MODELS, default=MODELS)
    parser.add_argument("--yade", type=int, default=0, help="of all repeating ones")
    parser.add_argument("--yade-steps", nargs="+", choices=YADE, default=tuple(YADE))
    parser.add_argument("--yade-nodes", type=int, help="along an edge, of those that are far off")
    parser.add_argument("--limit", type=float, default=1800.0, help="of a history in YADE [s]")
    parser.add_argument("--again", type=Path, help="table whose histories are run again")
    parser.add_argument("--nodes", type=int, default=NODES, help="a joint, of the yardstick")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin no row after")
    args = parser.parse_args()
    until = time.monotonic() + 60.0 * args.minutes
    YARDSTICK["nodes"] = args.nodes
    table = pd.DataFrame(columns=COLUMNS)
    if args.output.exists():
        table = pd.read_csv(args.output)
    rows, motions, number = table.to_dict("records"), {}, 0
    known = {(row["seed"], row["number"]) for row in rows}
    if args.again:
        for row in pd.read_csv(args.again).to_dict("records"):
            if row["repeats"] and (row["seed"], row["number"]) not in known:
                rows.append(again(row, motions))
                write_table(rows, args.output, COLUMNS)
    while True:
        count = {m: sum(r["repeats"] for r in rows if r["model"] == m) for m in args.models}
        if min(count.values()) >= args.histories or time.monotonic() > until:
            break
        if (args.seed, number) not in known and count.get(
            MODELS[number % 3], math.inf
        ) < args.histories:
            rows.append(history(number, args.seed, motions))
            write_table(rows, args.output, COLUMNS)
        number += 1
    beside_yade(rows, motions, until, args)
    print(summary(pd.DataFrame(rows, columns=COLUMNS)))


if __name__ == "__main__":
    main()
