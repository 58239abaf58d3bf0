"""Entry point: the incremental dynamic analysis of the complete building.

    python3 yade_scripts complete --scene complete/CB_6_bricks.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --plan screening/W2m/RRS228_neg.json
        --journal cache/complete/CB_RRS228_neg.jsonl --output ida/CB/RRS228_neg.csv

A run takes a minute where a planar one takes a millisecond, so the curve begins where the same
façade before the building's masses first collapses: see `climb`.
"""

import argparse
import math
import sys

from yade_scripts.engine import adapter, memory
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import floor_motions
from yade_scripts.model.motion import SIGNS, amplitude
from yade_scripts.model.scene import from_dict, to_json
from yade_scripts.sources import digest
from yade_scripts.studies import shaking
from yade_scripts.studies.climb import next_level
from yade_scripts.studies.ida import COLUMNS
from yade_scripts.studies.journal import Journal, run_key
from yade_scripts.studies.tables import run_row, to_csv


def analyse(job, time_s, columns, record, direction, journal, say, start_g, islands, renew=None):
    """Run the levels that `climb.next_level` asks for; rows already in the journal are reused.

    Parameters
    ----------
    job : dict
        model, scene, numerics and the section complete.
    start_g : float
        Lowest collapse of the two-way model.
    islands : sequence of float
        Intensities beside it that its scan singles out.

    Returns
    -------
    list of dict
        Rows of an IDA table.
    """
    scene, model = from_dict(job["scene"]), job["model"]
    motion = columns["ground"].tobytes() + time_s.tobytes()
    base = run_key(to_json(scene), motion, job["numerics"], direction, digest(__file__))
    rows: list[dict] = []
    done: dict[float, str] = {}
    ceiling = memory.Ceiling()
    while (pga_g := next_level(done, job["complete"], start_g, islands)) is not None:
        key = run_key(base, pga_g)
        row = journal.get(key)
        if row is None:
            factor = amplitude(columns["ground"], direction, pga_g)
            case = shaking.prepare(scene, job["numerics"], time_s, columns, factor)
            history = case.retried()
            row = run_row(model, record, direction, pga_g, history)
            journal.put(key, row, history.reason)
            peak = row["d_over_b"]
            outcome = "" if peak is None else f", d/b {peak:.3f}"
            say(
                f"run {len(rows) + 1}: {pga_g:.3f} g {row['status']}{outcome}, "
                f"{history.reason} ({history.wall_s:.1f} s)"
            )
            if renew is not None and ceiling.reached():
                renew()
        rows.append(row)
        done[pga_g] = row["status"]
    return rows


def main(arguments=None):
    """Parse the command line, run the analysis, write the table; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scene", required=True, help="scene file (JSON)")
    parser.add_argument("--motion", required=True, help="floor motions (CSV); the ground's counts")
    parser.add_argument("--record", required=True)
    parser.add_argument("--direction", required=True, choices=tuple(SIGNS))
    parser.add_argument("--plan", required=True, help="levels from the dense scan (JSON)")
    parser.add_argument("--journal", required=True, help="finished runs (JSON lines)")
    parser.add_argument("--output", required=True, help="table to write (CSV)")
    args = parser.parse_args(arguments)
    job, plan = read_json(args.scene), read_json(args.plan)
    time_s, columns = floor_motions.read(args.motion)
    if not (math.isfinite(plan["start_g"]) and plan["start_g"] > 0.0):
        raise ValueError(f"{args.plan}: start_g must be positive, got {plan['start_g']}")

    def say(text):
        name = f"[{job['model']} {args.record} {args.direction}]"
        print(f"{name} {text}", file=sys.stderr, flush=True)

    adapter.load_yade()
    rows = analyse(
        job,
        time_s,
        {"ground": columns["ground"]},
        args.record,
        args.direction,
        Journal(args.journal),
        say,
        plan["start_g"],
        plan["islands"],
        memory.start_afresh,
    )
    write_atomic(args.output, to_csv(sorted(rows, key=lambda r: r["pga_g"]), COLUMNS))
    return 0
