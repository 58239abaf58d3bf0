"""Entry point: members of an ensemble with the ties that a search has found, at one intensity.

    python3 yade_scripts strengthening --scene scenes/W2.json --motion smdof/1ST280_4dof.csv
        --record 1ST280 --direction neg --plan strengthening/W2/1ST280_neg.json
        --journal cache/strengthening.jsonl --output strengthening/W2/1ST280_neg_yade.csv

The plan has pga_g and cases, each with height_m, force_kn and the section facade it belongs to.
"""

import argparse
import sys

from yade_scripts.engine import adapter
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import floor_motions
from yade_scripts.model.motion import SIGNS
from yade_scripts.studies import ensemble, perturb
from yade_scripts.studies.journal import Journal
from yade_scripts.studies.tables import to_csv

COLUMNS = {"height_m": ".6g", "force_kn": ".6g", **ensemble.COLUMNS}


def main(arguments=None):
    """Parse the command line, run the members of every case, write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, text in (
        ("scene", "scene file (JSON)"),
        ("motion", "floor motions (CSV)"),
        ("record", "name"),
        ("plan", "intensity and cases (JSON)"),
        ("journal", "finished runs (JSON lines)"),
        ("output", "table to write (CSV)"),
    ):
        parser.add_argument(f"--{name}", required=True, help=text)
    parser.add_argument("--direction", required=True, choices=tuple(SIGNS))
    args = parser.parse_args(arguments)
    job, plan = read_json(args.scene), read_json(args.plan)
    time_s, columns = floor_motions.read(args.motion)
    adapter.load_yade()
    journal = Journal(args.journal)

    def say(text):
        print(f"[{job['model']} {args.record} {args.direction}] {text}", file=sys.stderr)

    rows = []
    for case in plan["cases"]:
        given = {**job, "facade": case["facade"]}
        runner = ensemble.Runner(given, time_s, columns, args.record, args.direction, journal, say)
        members = perturb.draw_members(job["ensemble"])
        found, _ = ensemble.run_members(runner, plan["pga_g"], members)
        about = {key: case[key] for key in ("height_m", "force_kn")}
        rows += [{**about, **row} for row in found]
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
