"""Error of the compiled solver's step by kind of scene, on motions of stations that chose nothing.

    .venv/bin/python tests/trials/steps.py --output steps.csv --motions 6

Motions are drawn from every second station of the recorded suite; the other stations chose. Of each
curve histories are taken at shares of the lowest collapse that a climb by 8 % finds. A history
repeats where a change of amplitude by 1e-6 or 1e-4 moves its peak by at most ten times as much, and
half the yardstick's step by at most 1 %. The yardstick is an eighth of the step taken; `yardstick`
is what a quarter differs from it in 90 % of the histories. Times are of the processor, one kind
after the other, and so ratios at most. Six motions of all kinds take a quarter of an hour. A kind
is written as soon as it is known, and not run again where `--output` holds it.

    .venv/bin/python tests/trials/steps.py --output steps.csv --kinds --figure steps.png

draws a table that is there: of each kind the error that 95 % of its histories keep, against time.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion
from rocking.collapse.curve import run_by
from rocking.configuration.study import as_in_the_study
from rocking.records import read_table
from rocking.solver import peaks
from rocking.tables import write_table

SUITE = "config/suites/recorded_suite.tsv"
SHARES, RATIO, CLIMB_STEP = (0.5, 0.75, 0.9), 1.08, 0.5
FINE, TWIN, STEPS = 0.125, 0.25, (1.0, 0.75, 0.5)
LEAST = 0.02  # d/b below which a history is no swing
FOUR = {"facade.courses": 4, "facade.courses_growth": 1.5}
HEAVY = {"return_wall.building_mass_kg": 64e3}
TIE = {"facade.ties": [{"height_m": 6.0}]}
FLOOR = {"facade.floors": [{"height_m": 6.0, "load_kn": 20.0, "friction": 0.3}]}
SMOOTH = {"facade.friction_deg": 5.0, "return_wall.friction_deg": 5.0}
KINDS = {
    **{f"{model} courses": (model, FOUR, {}) for model in ("W1", "W2", "W2m")},
    "W2m courses, tie and floor": ("W2m", FOUR | TIE | FLOOR, {}),
    "W2m courses, friction 5°": ("W2m", FOUR | SMOOTH, {}),
    "W2m courses, gap 5 mm": ("W2m", FOUR | {"facade.gap_m": 5e-3}, {}),
    "W2m courses, vertical": ("W2m", FOUR, {"vertical_motion": "on"}),
    "W1 courses, 8 × 1.2": ("W1", {"facade.courses": 8, "facade.courses_growth": 1.2}, {}),
    **{f"{model} block on E/h": (model, {}, {}) for model in ("W1", "W2", "W2m")},
    "W1 block on the column's base": ("W1", {"facade.base": "column"}, {}),
    "W2m two pieces": ("W2m", {"facade.hinges_m": [3.24]}, {}),
}


def reporting(table):
    """Records of every second station."""
    names = list(read_table(table))
    return [name for k, name in enumerate(names) if k // 2 % 2]


def run(curves, pga_g, share):
    """Peaks d/b of a history for each curve, at a share of the step that its scan takes."""
    shaken = [curve.shaking(level) for curve, level in zip(curves, pga_g, strict=True)]
    motions = [own[0] for own, _ in shaken]
    factors = np.ravel([factor for _, factor in shaken])
    first = curves[0]
    how = {"carried": first.carried, "step_s": share * first.steps_s[0]}
    found = peaks(first.planes[0], motions, first.numerics, factors, **how)
    return np.minimum(found.d_over_b, 1.0)


def lowest(curves, levels=60, ahead=6):
    """Lowest collapse of each curve by a climb [g], NaN where none falls."""
    pga_g = 0.5 * curves[0].static_g * RATIO ** np.arange(levels)
    found, left = np.full(len(curves), np.nan), list(range(len(curves)))
    for first in range(0, levels, ahead):
        some = pga_g[first : first + ahead]
        asked = [curves[i] for i in left for _ in some]
        fell = run(asked, np.tile(some, len(left)), CLIMB_STEP).reshape(len(left), -1) >= 1.0
        for i, row in zip(left, fell, strict=True):
            found[i] = some[row.argmax()] if row.any() else np.nan
        left = [i for i, row in zip(left, fell, strict=True) if not row.any()]
        if not left:
            break
    return found


def rows_of(kind, shaken):
    """Rows of a kind of scene, one a step."""
    model, given, how = KINDS[kind]
    case = Case.configured(
        model, as_in_the_study({**given, **(HEAVY if model.endswith("m") else {})})
    )
    curves = [run_by("planar", case, Motion.named(name, SUITE, **how), d) for name, d in shaken]
    falls = lowest(curves)
    pairs = [(c, share * g) for c, g in zip(curves, falls, strict=True) for share in SHARES]
    curves, pga_g = zip(*[(c, g) for c, g in pairs if np.isfinite(g)], strict=True)
    pga_g = np.array(pga_g)
    fine, twin = run(curves, pga_g, FINE), run(curves, pga_g, TWIN)
    repeats = (fine > LEAST) & (fine < 1.0) & (np.abs(twin / fine - 1.0) < 0.01)
    for change in (1e-6, 1e-4):
        other = run(curves, pga_g * (1.0 + change), TWIN)
        repeats &= np.abs(other - twin) <= 10.0 * change
    mine = np.flatnonzero(repeats)
    curves, pga_g, fine = [curves[i] for i in mine], pga_g[mine], fine[mine]
    moved = float(np.quantile(np.abs(twin[mine] / fine - 1.0), 0.9))
    for share in STEPS:
        began = time.process_time()
        error = np.abs(run(curves, pga_g, share) / fine - 1.0)
        yield {
            **{"kind": kind, "step": share, "histories": len(repeats), "repeat": len(mine)},
            **{"error_median": np.median(error), "error_95": np.quantile(error, 0.95)},
            **{"error_worst": error.max(), "within_half": np.mean(error <= 5e-3)},
            **{"within_1": np.mean(error <= 1e-2), "yardstick": moved},
            "ms": 1e3 * (time.process_time() - began) / len(mine),
        }


def draw(table, path):
    """Error in d/b that 95 % of the histories keep, against time over that of the step taken."""
    from rocking.figures.style import LOOKS, plain_numbers, plt

    groups = {"courses": [], "one block, pieces": []}
    for kind in dict.fromkeys(table["kind"]):
        groups["courses" if "courses" in kind else "one block, pieces"].append(kind)
    figure, panels = plt.subplots(1, 2, figsize=(8.0, 3.4), sharey=True, layout="constrained")
    for axes, (title, kinds) in zip(panels, groups.items(), strict=True):
        for k, kind in enumerate(kinds):
            part = table[table["kind"] == kind].sort_values("step")
            taken = part.loc[(part["step"] - 1.0).abs().idxmin(), "ms"]
            colour, _, marker = LOOKS[k % len(LOOKS)]
            line = "-" if k < len(LOOKS) else "--"
            cost, error = part["ms"] / taken, 100.0 * part["error_95"]
            axes.plot(cost, error, line, color=colour, marker=marker, ms=3, label=kind)
        axes.axhline(0.5, color="0.65", lw=0.8, zorder=0)
        axes.axvline(1.0, color="0.65", lw=0.8, zorder=0)
        axes.set(title=title, xlabel="time over that of the step taken", yscale="log")
        axes.legend(fontsize=6)
    panels[0].set_ylabel("error in d/b that 95 % keep [%]")
    plain_numbers(figure)
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", required=True)
    parser.add_argument("--motions", type=int, default=6)
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--kinds", nargs="*", default=list(KINDS))
    parser.add_argument("--figure", help="draw what the table then holds")
    args = parser.parse_args()
    every = [(name, d) for name in reporting(SUITE) for d in ("pos", "neg")]
    order = np.random.default_rng(args.seed).permutation(len(every))[: args.motions]
    rows = pd.read_csv(args.output).to_dict("records") if Path(args.output).is_file() else []
    known = {row["kind"] for row in rows}
    for kind in (kind for kind in args.kinds if kind not in known):
        for row in rows_of(kind, [every[i] for i in order]):
            rows.append(row)
            print(", ".join(f"{k} {v:.3g}" if k != "kind" else v for k, v in row.items()))
        write_table(pd.DataFrame(rows), args.output, digits="%.4g")
    if args.figure:
        draw(pd.DataFrame(rows), args.figure)


if __name__ == "__main__":
    main()
