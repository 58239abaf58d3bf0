"""Entry point: the same cases at many node counts and steps, each timed.

    python3 yade_scripts accuracy --plan plan.json --output runs.csv

The plan is a JSON file with `scenes` (case files by model), `motions` (floor-motion files by
record) and `runs`: case, model, record, direction, pga_g, method, nodes, step_fraction, factor.
"""

import sys

from yade_scripts.commands import command, shaking
from yade_scripts.commands.tables import KEY, to_csv
from yade_scripts.engine import adapter
from yade_scripts.files import read_case, read_json, write_atomic
from yade_scripts.model import facade, floor_motions, registry
from yade_scripts.model.models import with_nodes
from yade_scripts.model.motion import amplitude

COLUMNS = {
    "case": "",
    **KEY,
    "method": "",
    "nodes": "d",
    "factor": ".9g",
    "dt_s": ".6e",
    "dt_over_dt_crit": ".5g",
    "d_over_b": ".6f",
    "status": "",
    "steps": "d",
    "simulated_s": ".3f",
    "wall_s": ".3f",
}


def run_case(case, time_s, columns, spec):
    """History of one run of the plan, and its step over the critical one."""
    numerics = dict(case["numerics"])
    if spec["step_fraction"]:
        numerics.update(step_fraction=spec["step_fraction"], step_s=None)
    scene = facade.facade_scene({**case, "numerics": numerics}, case["model"], case["beta_s"])
    factor = spec["factor"] * amplitude(columns["ground"], spec["direction"], spec["pga_g"])
    shaken = shaking.set_up(scene, numerics, time_s, columns, factor)
    return shaken.run(), shaken.step_s / shaken.critical_step_s


def as_row(spec, nodes, history, ratio):
    """Row of one run; `nodes` along an edge of the return walls' contact."""
    return {
        **{key: spec[key] for key in ("case", *KEY, "method", "factor")},
        "nodes": nodes,
        "dt_s": history.dt_s,
        "dt_over_dt_crit": ratio,
        "d_over_b": history.peak_d_over_b,
        "status": history.status,
        "steps": history.steps,
        "simulated_s": history.time_s[-1],
        "wall_s": history.wall_s,
    }


def main(arguments=None):
    """Parse the command line, carry out the plan, write the table; return the exit status."""
    texts = {"plan": "what to run (JSON)", "output": "table to write (CSV)"}
    args = command.parser(__doc__, **texts).parse_args(arguments)
    plan = read_json(args.plan, "scenes", "motions", "runs")
    cases = {m: read_case(p) for m, p in plan["scenes"].items()}
    motions = {r: floor_motions.read(p) for r, p in plan["motions"].items()}
    adapter.load_yade()
    rows = []
    for spec in plan["runs"]:
        time_s, columns = motions[spec["record"]]
        case = with_nodes(cases[spec["model"]], spec["nodes"])
        history, ratio = run_case(case, time_s, columns, spec)
        nodes = case["numerics"][registry.model(spec["model"]).nodes_up]
        rows.append(as_row(spec, nodes, history, ratio))
        print(to_csv(rows[-1:], COLUMNS).splitlines()[1], file=sys.stderr, flush=True)
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
