"""Entry point: the same cases at many node counts, steps and ways of driving, each timed.

    python3 yade_scripts accuracy --plan plan.json --output runs.csv

The plan is a JSON file with `scenes` (scene files by model), `motions` (floor-motion files by
record) and `runs`: case, model, record, direction, pga_g, method, nodes, step_fraction, factor.
Methods:

default, nodes and step   planar scene, supports driven by YADE's own engine
python drive              the supports' velocities set from Python at every step
lag not compensated       without `stiffness.lag_factors`
full 3D                   six freedoms and two columns of nodes
Polyhedra                 YADE's volumetric law instead of nodes (W1; see `polyhedra`)
"""

import argparse
import csv
import io
import json
import os
import sys
from pathlib import Path

import numpy as np

from yade_scripts.engine import adapter, loop, polyhedra, simulate
from yade_scripts.files import write_atomic
from yade_scripts.model.motion import amplitude
from yade_scripts.studies import ida

COLUMNS = (
    "case",
    "model",
    "record",
    "direction",
    "pga_g",
    "method",
    "nodes",
    "factor",
    "dt_s",
    "dt_over_dt_crit",
    "d_over_b",
    "status",
    "steps",
    "simulated_s",
    "wall_s",
)
METHODS = (
    "default",
    "nodes and step",
    "lag not compensated",
    "python drive",
    "full 3D",
    "Polyhedra",
)


def with_nodes(job, nodes):
    """Copy of a scene file with n nodes a return wall, 2n − 1 at the base; None: its own."""
    if nodes is None:
        return job
    numerics = {
        **job["numerics"],
        "nodes_thickness": 2 * nodes - 1,
        "nodes_height": nodes,
        "nodes_per_block": nodes,
    }
    return {**job, "numerics": numerics}


def drive_from_python(motions):
    """Set-up function that replaces YADE's drive by a Python function called at every step.

    The support's velocity at half steps is the integral of the piecewise-linear
    acceleration, so both ways prescribe the same motion.
    """

    def setup(built):
        w = adapter.load_yade()
        omega = built.omega
        drives = [e for e in omega.engines if isinstance(e, w.InterpolatingDirectedForceEngine)]
        table, dt = [], omega.dt
        for drive, name in zip(drives, sorted(motions), strict=True):
            t, a = motions[name].time_s, motions[name].acceleration_m_s2
            velocity = np.concatenate(([0.0], np.cumsum(0.5 * np.diff(t) * (a[1:] + a[:-1]))))
            half_steps = np.arange(0.5 * dt, t[-1] + dt, dt)
            states = [omega.bodies[i].state for i in drive.ids]
            for state in states:
                state.blockedDOFs = "xyzXYZ"
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


def run_case(job, time_s, columns, spec):
    """One run of the plan.

    Returns
    -------
    history : simulate.History
    ratio : float
        Step over critical step.
    """
    numerics = dict(job["numerics"])
    if spec["step_fraction"]:
        numerics.update(step_fraction=spec["step_fraction"], step_s=None)
    method = spec["method"]
    if method not in METHODS:
        raise ValueError(f"plan: method '{method}': expected one of {', '.join(METHODS)}")
    scene = facade.facade_scene(
        {**job, "numerics": numerics}, job["model"], job["beta_s"], planar=method != "full 3D"
    )
    factor = spec["factor"] * amplitude(columns["ground"], spec["direction"], spec["pga_g"])
    motions = ida.scaled_motions(time_s, columns, scene.motions, factor)
    step, critical = simulate.choose_step(scene, numerics)
    if method == "Polyhedra":
        return _polyhedra(scene, motions[facade.GROUND], step), step / critical
    history = simulate.run(
        scene,
        motions,
        step,
        ida.stop_rules(scene, numerics, time_s, motions),
        sample_s=numerics["sample_interval_s"],
        node_radius_m=numerics["node_radius_m"],
        full_rotation=method == "full 3D",
        compensate_lag=method != "lag not compensated",
        setup=drive_from_python(motions) if method == "python drive" else None,
    )
    return history, step / critical


def _polyhedra(scene, motion, step):
    """History of the volumetric law, its flood of warnings left out of the log."""
    terminal = os.dup(2)
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 2)
    try:
        peak, status, simulated, wall, steps = polyhedra.run(scene, motion, step, motion.duration_s)
    finally:
        os.dup2(terminal, 2)
        os.close(quiet)
        os.close(terminal)
    end = np.array([simulated])
    return simulate.History(end, 0 * end, 0 * end, 0 * end, peak, status, "", step, steps, wall)


def as_row(spec, nodes, history, ratio):
    """Row of one run; `nodes` along an edge of the return walls' contact."""
    return {
        **{k: spec[k] for k in ("case", "model", "record", "direction", "method")},
        "pga_g": f"{spec['pga_g']:.4f}",
        "nodes": str(nodes),
        "factor": f"{spec['factor']:.9g}",
        "dt_s": f"{history.dt_s:.6e}",
        "dt_over_dt_crit": f"{ratio:.5g}",
        "d_over_b": f"{history.peak_d_over_b:.6f}",
        "status": history.status,
        "steps": str(history.steps),
        "simulated_s": f"{history.time_s[-1]:.3f}",
        "wall_s": f"{history.wall_s:.3f}",
    }


def main(arguments=None):
    """Parse the command line, carry out the plan, write the table; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plan", required=True, help="what to run (JSON)")
    parser.add_argument("--output", required=True, help="table to write (CSV)")
    args = parser.parse_args(arguments)
    plan = json.loads(Path(args.plan).read_text())
    jobs = {m: json.loads(Path(p).read_text()) for m, p in plan["scenes"].items()}
    motions = {r: ida.read_motion(p) for r, p in plan["motions"].items()}
    adapter.load_yade()
    rows = []
    for spec in plan["runs"]:
        time_s, columns = motions[spec["record"]]
        job = with_nodes(jobs[spec["model"]], spec["nodes"])
        history, ratio = run_case(job, time_s, columns, spec)
        chain = registry.model(spec["model"]).chain
        nodes = job["numerics"]["nodes_per_block" if chain else "nodes_height"]
        rows.append(as_row(spec, nodes, history, ratio))
        print(", ".join(rows[-1][k] for k in COLUMNS), file=sys.stderr, flush=True)
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_atomic(args.output, text.getvalue())
    return 0
