"""Entry point: the incremental dynamic analysis of the complete building.

    python3 yade_scripts complete --scene complete/CB_6_bricks.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --plan screening/W2m/RRS228_neg.json
        --journal cache/complete/CB_RRS228_neg.jsonl --output ida/CB/RRS228_neg.csv

A run takes a minute where a planar one takes a millisecond, so the curve begins where the same
façade before the building's masses first collapses: see `search.next_level`.
"""

import math

from yade_scripts.engine import adapter, memory
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model.scene import from_dict
from yade_scripts.studies import command
from yade_scripts.studies.ida import COLUMNS, curve
from yade_scripts.studies.journal import Journal
from yade_scripts.studies.search import next_level, one_by_one
from yade_scripts.studies.tables import to_csv


def main(arguments=None):
    """Parse the command line, run the analysis, write the table; return the exit status."""
    parser = command.parser(
        __doc__,
        *command.CURVE,
        "journal",
        plan="levels from the dense scan (JSON)",
        output="table to write (CSV)",
    )
    args = parser.parse_args(arguments)
    plan, (job, time_s, columns) = read_json(args.plan), command.opened(args)
    start_g = plan["start_g"]
    if not (math.isfinite(start_g) and start_g > 0.0):
        raise ValueError(f"{args.plan}: start_g must be positive, got {start_g}")
    adapter.load_yade()
    rows = curve(
        from_dict(job["scene"]),
        job["numerics"],
        time_s,
        {"ground": columns["ground"]},  # a building takes no other motion
        (job["model"], args.record, args.direction),
        one_by_one(lambda done: next_level(done, job["complete"], start_g, plan["islands"])),
        __file__,
        Journal(args.journal),
        command.speaker(job, args),
        memory.start_afresh,
    )
    write_atomic(args.output, to_csv(sorted(rows, key=lambda r: r["pga_g"]), COLUMNS))
    return 0
