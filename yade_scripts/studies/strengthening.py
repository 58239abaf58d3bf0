"""Entry point: members of an ensemble with the ties or the roof of a search, at its intensities.

    python3 yade_scripts strengthening --scene scenes/W2.json --motion smdof/1ST280_4dof.csv
        --record 1ST280 --direction neg --plan strengthening/W2/1ST280_neg.json
        --journal cache/strengthening.jsonl --output strengthening/W2/1ST280_neg_yade.csv

The plan has cases, each with height_m, force_kn, pga_g and the section facade it belongs to.
"""

from yade_scripts.engine import adapter
from yade_scripts.files import read_json, write_atomic
from yade_scripts.studies import command, ensemble, perturb
from yade_scripts.studies.journal import Journal
from yade_scripts.studies.tables import to_csv

COLUMNS = {"height_m": ".6g", "force_kn": ".6g", **ensemble.COLUMNS}


def main(arguments=None):
    """Parse the command line, run the members of every case, write the table."""
    args = command.parser(
        __doc__,
        *command.CURVE,
        "journal",
        plan="cases (JSON)",
        output="table to write (CSV)",
    ).parse_args(arguments)
    plan, (job, time_s, columns) = read_json(args.plan), command.opened(args)
    adapter.load_yade()
    journal, say, rows = Journal(args.journal), command.speaker(job, args), []
    for case in plan["cases"]:
        given = {**job, "facade": case["facade"]}
        runner = ensemble.Runner(given, time_s, columns, args.record, args.direction, journal, say)
        members = perturb.draw_members(job["ensemble"])
        found, _ = ensemble.run_members(runner, case["pga_g"], members)
        about = {key: case[key] for key in ("height_m", "force_kn")}
        rows += [{**about, **row} for row in found]
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
