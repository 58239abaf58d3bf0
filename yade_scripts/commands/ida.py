"""Entry point: the incremental dynamic analysis of one model, record and direction.

Runs under YADE's own Python, all intensities in one process, the perturbed ensemble that follows
them too; the complete building's case holds its scene:

    python3 yade_scripts ida --scene cases/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --journal cache/W2_RRS228_neg.jsonl --output ida.csv
        --ensemble
"""

import math

from yade_scripts.commands import command, ensemble
from yade_scripts.commands.journal import Journal
from yade_scripts.commands.runner import Runner
from yade_scripts.commands.search import intensities, next_level
from yade_scripts.commands.tables import KEY, RUN_COLUMNS, to_csv
from yade_scripts.engine import adapter
from yade_scripts.files import read_json, write_atomic

COLUMNS = {**KEY, **RUN_COLUMNS}


def analyse(runner, plan=None):
    """Rows of a curve, by a plan's list of intensities or the case's own; see `intensities`.

    A case that holds a whole scene, such as the complete building, whose run takes a minute where a
    planar one takes a millisecond, has a plan with start_g and ranges; see `next_level`.
    """
    plan, case = plan or {}, runner.case
    rows: list[dict] = []
    done: dict[float, str] = {}

    def run(pga_g):
        row = runner.run(pga_g)
        if runner.history is not None:
            peak = "" if row["d_over_b"] is None else f"d/b {row['d_over_b']:.3f}, "
            outcome = f"{row['status']}, {peak}{runner.history.reason}"
            runner.say(f"run {runner.count}: {pga_g:.3f} g {outcome} ({row['wall_s']:.1f} s)")
        rows.append(row)
        done[pga_g] = row["status"]

    if "start_g" in plan:
        levels = case["complete"], plan["start_g"], plan["ranges"]
        while (pga_g := next_level(done, *levels)) is not None:
            run(pga_g)
    else:
        for pga_g in intensities(case["ida"], plan.get("runs")):
            run(pga_g)
    runner.told()
    return rows


def main(arguments=None):
    """Parse the command line, run the analysis, write the table; return the exit status."""
    parser = command.parser(__doc__, *command.CURVE, "journal", output="table to write (CSV)")
    parser.add_argument("--plan", help="from the dense scan (JSON)")
    parser.add_argument(
        "--ensemble",
        action="store_true",
        help="run the ensemble too; writes …_ensemble.csv beside the output",
    )
    args = parser.parse_args(arguments)
    case, time_s, columns = command.opened(args)
    plan = read_json(args.plan) if args.plan else {}
    if not isinstance(plan, dict) or (args.plan and not {"runs", "start_g"} & set(plan)):
        raise ValueError(f"{args.plan}: expected an object with runs, or with start_g and ranges")
    if not math.isfinite(case.get("beta_s", 0.0)):
        raise ValueError(f"{args.scene}: beta_s must be finite")
    start = plan.get("start_g", 1.0)
    if not isinstance(start, (int, float)) or not 0.0 < start < math.inf:
        raise ValueError(f"{args.plan}: start_g must be positive, got {start!r}")
    if "scene" in case:
        columns = {"ground": columns["ground"]}  # a building takes no other motion
    adapter.load_yade()
    say = command.progress(f"{case['model']} {args.record} {args.direction}")
    runner = Runner(case, time_s, columns, args.record, args.direction, Journal(args.journal), say)
    rows = sorted(analyse(runner, plan), key=lambda r: r["pga_g"])
    write_atomic(args.output, to_csv(rows, COLUMNS))
    if args.ensemble:
        runner.count = runner.reused = 0  # its realisations are told of apart
        varied = ensemble.analyse(runner, rows, plan)
        runner.told()
        varied.sort(key=lambda r: (r["pga_g"], r["realisation"]))
        stem = args.output.removesuffix(".csv")
        write_atomic(f"{stem}_ensemble.csv", to_csv(varied, ensemble.COLUMNS))
    return 0
