"""Entry point: a façade in three dimensions under both components, where the compiled solver ran.

    python3 yade_scripts two_components --scene scenes/W1_two_components.json
        --motion smdof/GMN_NS_4dof.csv --second smdof/GMN_WE_4dof.csv
        --curves two_components/GMN_NS.csv --record GMN_NS --direction pos
        --output two_components/W1_GMN_NS_pos_yade.csv

Runs half_g, last_g and two_g of its curve; d_over_b_compiled is 1 where that solver's façade fell.
"""

import argparse
import csv

from yade_scripts.engine import adapter
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import floor_motions, models
from yade_scripts.model.motion import SIGNS, amplitude
from yade_scripts.studies import shaking
from yade_scripts.studies.tables import RUN_COLUMNS, run_row, to_csv

COLUMNS = {
    **{"model": "", "record": "", "direction": "", "pga_g": ".4f", "d_over_b_compiled": ".6g"},
    **RUN_COLUMNS,
}


def levels(path, model, direction):
    """PGA and compiled d/b of one curve, where it has them."""
    with open(path, newline="") as handle:
        rows = csv.DictReader(handle)
        row = next(r for r in rows if (r["model"], r["direction"]) == (model, direction))
    names = (("half_g", "d_two"), ("last_g", "last_d_two"), ("two_g", None))
    return [(float(row[g]), float(row[d]) if d else 1.0) for g, d in names if row[g]]


def main(arguments=None):
    """Parse the command line, run the levels, write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, text in (
        ("scene", "scene file with width_nodes (JSON)"),
        ("motion", "floor motions out of plane (CSV)"),
        ("second", "floor motions along the façade (CSV)"),
        ("curves", "of the compiled solver (CSV)"),
        ("record", "name"),
        ("output", "table to write (CSV)"),
    ):
        parser.add_argument(f"--{name}", required=True, help=text)
    parser.add_argument("--direction", required=True, choices=tuple(SIGNS))
    args = parser.parse_args(arguments)
    job = read_json(args.scene)
    time_s, columns = models.with_second(
        *floor_motions.read(args.motion), *floor_motions.read(args.second)
    )
    adapter.load_yade()
    scene, numerics, rows = models.build_scene(job), models.numerics(job), []
    for pga_g, compiled in levels(args.curves, job["model"], args.direction):
        factor = amplitude(columns["ground"], args.direction, pga_g)
        history = shaking.prepare(scene, numerics, time_s, columns, factor).retried()
        row = run_row(job["model"], args.record, args.direction, pga_g, history)
        rows.append({**row, "d_over_b_compiled": min(compiled, 1.0)})
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
