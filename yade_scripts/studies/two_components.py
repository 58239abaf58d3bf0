"""Entry point: a façade in three dimensions under both components, where the compiled solver ran.

    python3 yade_scripts two_components --scene scenes/W1_two_components.json
        --motion smdof/GMN_NS_4dof.csv --second smdof/GMN_WE_4dof.csv
        --curves two_components/GMN_NS.csv --record GMN_NS --direction pos
        --output two_components/W1_GMN_NS_pos_yade.csv

Runs half_g, last_g and two_g of its curve; d_over_b_compiled is 1 where that solver's façade fell.
"""

import csv

from yade_scripts.engine import adapter
from yade_scripts.files import write_atomic
from yade_scripts.model import floor_motions, models
from yade_scripts.studies import command
from yade_scripts.studies.shaking import run_at
from yade_scripts.studies.tables import RUN_COLUMNS, to_csv

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
    args = command.parser(
        __doc__,
        *command.CURVE,
        second="floor motions along the façade (CSV)",
        curves="of the compiled solver (CSV)",
        output="table to write (CSV)",
    ).parse_args(arguments)
    job, *first = command.opened(args)
    time_s, columns = models.with_second(*first, *floor_motions.read(args.second))
    adapter.load_yade()
    scene, numerics, rows = models.build_scene(job), models.numerics(job), []
    for pga_g, compiled in levels(args.curves, job["model"], args.direction):
        names = job["model"], args.record, args.direction
        row, _ = run_at(scene, numerics, time_s, columns, names, pga_g)
        rows.append({**row, "d_over_b_compiled": min(compiled, 1.0)})
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
