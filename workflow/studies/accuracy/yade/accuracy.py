"""Entry point: the same cases at many node counts, steps and ways of driving, each timed.

    python3 yade_scripts accuracy --plan plan.json --output runs.csv

The plan is a JSON file with `scenes` (case files by model), `motions` (floor-motion files by
record) and `runs`: case, model, record, direction, pga_g, method, nodes, step_fraction, factor.
Methods:

default, nodes and step   planar scene, supports driven by YADE's own engine
python drive              the supports' velocities set from Python at every step
lag not compensated       without `stiffness.lag_factors`
full 3D                   six freedoms and two columns of nodes
Polyhedra                 YADE's volumetric law instead of nodes (W1; see `polyhedra`)
"""

import contextlib
import os
import sys

import numpy as np

from yade_scripts.commands import command, shaking
from yade_scripts.commands.tables import KEY, to_csv
from yade_scripts.engine import adapter, loop, polyhedra, simulate
from yade_scripts.files import read_case, read_json, write_atomic
from yade_scripts.model import facade, floor_motions, registry
from yade_scripts.model.models import with_nodes
from yade_scripts.model.motion import amplitude
from yade_scripts.model.scene import DOFS

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
METHODS = (
    "default",
    "nodes and step",
    "lag not compensated",
    "python drive",
    "full 3D",
    "Polyhedra",
)


def drive_from_python(motions):
    """Set-up that replaces YADE's drive by a Python function called at every step.

    The support's velocity at half steps is the integral of the piecewise-linear acceleration, so
    both ways prescribe the same motion.
    """

    def setup(built):
        w = adapter.load_yade()
        omega = built.omega
        drives = [e for e in omega.engines if isinstance(e, w.InterpolatingDirectedForceEngine)]
        table, dt = [], omega.dt
        for drive, name in zip(drives, sorted(motions), strict=True):
            t, velocity = motions[name].time_s, motions[name].velocity_m_s
            half_steps = np.arange(0.5 * dt, t[-1] + dt, dt)
            states = [omega.bodies[i].state for i in drive.ids]
            for state in states:
                state.blockedDOFs = DOFS
            table.append((states, np.interp(half_steps, t, velocity).tolist()))
        last = len(table[0][1]) - 1

        def move():
            step = min(omega.iter, last)
            for states, velocity in table:
                for state in states:
                    state.vel = (0.0, velocity[step], 0.0)

        kept = [e for e in omega.engines if e not in drives]
        at = next(i for i, e in enumerate(kept) if isinstance(e, w.NewtonIntegrator))
        omega.engines = [*kept[:at], loop.runner(move, 1), *kept[at:]]

    return setup


def run_case(case, time_s, columns, spec):
    """History of one run of the plan, and its step over the critical one."""
    numerics = dict(case["numerics"])
    if spec["step_fraction"]:
        numerics.update(step_fraction=spec["step_fraction"], step_s=None)
    method = spec["method"]
    if method not in METHODS:
        raise ValueError(f"plan: method '{method}': expected one of {', '.join(METHODS)}")
    scene = facade.facade_scene(
        {**case, "numerics": numerics}, case["model"], case["beta_s"], planar=method != "full 3D"
    )
    factor = spec["factor"] * amplitude(columns["ground"], spec["direction"], spec["pga_g"])
    shaken = shaking.set_up(scene, numerics, time_s, columns, factor)
    ratio = shaken.step_s / shaken.critical_step_s
    if method == "Polyhedra":
        with _silent():
            motion = shaken.motions[floor_motions.GROUND]
            return polyhedra.run(scene, motion, shaken.step_s), ratio
    history = shaken.run(
        simulate.Making(
            full_rotation=method == "full 3D", compensate_lag=method != "lag not compensated"
        ),
        setup=drive_from_python(shaken.motions) if method == "python drive" else None,
    )
    return history, ratio


@contextlib.contextmanager
def _silent():
    """Leave the volumetric law's flood of warnings, which C++ writes, out of the log."""
    terminal = os.dup(2)
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 2)
    try:
        yield
    finally:
        os.dup2(terminal, 2)
        os.close(quiet)
        os.close(terminal)


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
