"""Entry point: the incremental dynamic analysis of one model, record and direction.

Runs under YADE's own Python, all intensities in one process; the complete building's case holds
its scene:

    python3 yade_scripts ida --scene scenes/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --journal cache/W2_RRS228_neg.jsonl --output ida.csv
"""

import math

from yade_scripts.engine import adapter, memory
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import models
from yade_scripts.model.scene import from_dict, to_json
from yade_scripts.sources import digest
from yade_scripts.studies import command
from yade_scripts.studies.journal import Journal, run_key
from yade_scripts.studies.search import drive, next_level, next_listed, one_by_one
from yade_scripts.studies.shaking import run_at
from yade_scripts.studies.tables import RUN_COLUMNS, to_csv

COLUMNS = {"model": "", "record": "", "direction": "", "pga_g": ".4f", **RUN_COLUMNS}


def curve(scene, numerics, time_s, columns, names, strategy, study, journal, say, renew=None):
    """Run the intensities that a strategy asks for; rows already in the journal are reused.

    Parameters
    ----------
    scene, numerics, time_s, columns, names
        See `shaking.run_at`.
    strategy : generator
        See `search`.
    study : str
        File of the study, whose sources belong to the key of its rows.
    journal : Journal
    say : callable
        Receives one progress line a run.
    renew : callable, optional
        Called between runs when this process has grown too large; see `memory`.

    Returns
    -------
    list of dict
        Rows of an IDA table.
    """
    scene, columns = models.shaken(scene, columns)
    motion = b"".join(columns[n].tobytes() for n in scene.motions) + time_s.tobytes()
    base = run_key(to_json(scene), motion, numerics, names[-1], digest(study))
    rows: list[dict] = []
    reused, ceiling = 0, memory.Ceiling()

    def run(pga_g):
        nonlocal reused
        key = run_key(base, pga_g)
        row = journal.get(key)
        if row is None:
            row, history = run_at(scene, numerics, time_s, columns, names, pga_g)
            journal.put(key, row, history.reason)
            peak = "" if row["d_over_b"] is None else f"d/b {row['d_over_b']:.3f}, "
            outcome = f"{row['status']}, {peak}{history.reason}"
            say(f"run {len(rows) + 1}: {pga_g:.3f} g {outcome} ({history.wall_s:.1f} s)")
            if renew is not None and ceiling.reached():
                renew()
        else:
            reused += 1
        rows.append(row)
        return row["status"]

    drive(strategy, lambda ask: [run(pga_g) for pga_g in ask.pga_g])
    if reused:
        say(f"{reused} of {len(rows)} runs taken from earlier work")
    return rows


def analyse(case, time_s, columns, record, direction, journal, say, renew=None, plan=None):
    """Curve of a case file, by a plan's list of intensities or its own; see `next_listed`.

    A case that holds a whole scene, such as the complete building, whose run takes a minute where
    a planar one takes a millisecond, has a plan with start_g and ranges; see `next_level`.
    """
    plan = plan or {}
    if "scene" in case:
        scene, numerics = from_dict(case["scene"]), case["numerics"]
        columns = {"ground": columns["ground"]}  # a building takes no other motion
    else:
        scene, numerics = models.build_scene(case), models.numerics(case)
    if "start_g" in plan:
        own, start, ranges = case["complete"], plan["start_g"], plan["ranges"]
        strategy = one_by_one(lambda done: next_level(done, own, start, ranges))
    else:
        strategy = one_by_one(lambda done: next_listed(done, case["ida"], plan.get("runs")))
    return curve(
        scene,
        numerics,
        time_s,
        columns,
        (case["model"], record, direction),
        strategy,
        __file__,
        journal,
        say,
        renew,
    )


def main(arguments=None):
    """Parse the command line, run the analysis, write the table; return the exit status."""
    parser = command.parser(__doc__, *command.CURVE, "journal", output="table to write (CSV)")
    parser.add_argument("--plan", help="from the dense scan (JSON)")
    args = parser.parse_args(arguments)
    case, time_s, columns = command.opened(args)
    plan = read_json(args.plan) if args.plan else {}
    if not math.isfinite(case.get("beta_s", 0.0)):
        raise ValueError(f"{args.scene}: beta_s must be finite")
    start = plan.get("start_g", 1.0)
    if not (math.isfinite(start) and start > 0.0):
        raise ValueError(f"{args.plan}: start_g must be positive, got {start}")
    adapter.load_yade()
    rows = analyse(
        case,
        time_s,
        columns,
        args.record,
        args.direction,
        Journal(args.journal),
        command.speaker(case, args),
        memory.start_afresh,
        plan,
    )
    write_atomic(args.output, to_csv(sorted(rows, key=lambda r: r["pga_g"]), COLUMNS))
    return 0
