"""Entry point: the incremental dynamic analysis of one model, record and direction.

Runs under YADE's own Python, all intensities in one process:

    python3 yade_scripts ida --scene scenes/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --journal cache/W2_RRS228_neg.jsonl --output ida.csv
"""

import argparse
import csv
import io
import json
import math
import sys
from pathlib import Path

import numpy as np

from yade_scripts.engine import adapter, ledger, memory, simulate
from yade_scripts.files import write_atomic
from yade_scripts.model import models
from yade_scripts.model.motion import SIGNS, amplitude
from yade_scripts.model.scene import to_json
from yade_scripts.sources import digest
from yade_scripts.studies.intensities import DIGITS, next_intensity
from yade_scripts.studies.journal import Journal, run_key

RETRY_SAMPLING = 0.1  # of the sampling interval, for a run tried once more
COLUMNS = (
    "model",
    "record",
    "direction",
    "pga_g",
    "d_over_b",
    "collapsed",
    "status",
    "dt_s",
    "steps",
    "wall_s",
)


def read_motion(path):
    """Read a floor-motion file (contract: smdof/{record}_{n}dof.csv).

    Returns
    -------
    time_s : ndarray, shape (nt,)
    accelerations : dict of str to ndarray
        "ground", "floor1", … [m/s²].

    Raises
    ------
    ValueError
        One line that names the file if a column is missing or a value is not finite.
    """
    with open(path, newline="") as handle:
        header = handle.readline().strip().split(",")
    if header[:2] != ["time_s", "ground_m_s2"]:
        raise ValueError(f"{path}: expected columns time_s, ground_m_s2, …, got {header[:3]}")
    data = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    if len(data) < 2 or data.shape[1] != len(header) or not np.all(np.isfinite(data)):
        raise ValueError(f"{path}: expected at least two complete rows of finite numbers")
    columns = {name.replace("_m_s2", ""): data[:, i] for i, name in enumerate(header) if i}
    return data[:, 0], columns


def scaled_motions(time_s, columns, names, factor):
    """Motions of the named supports, scaled by one factor (its sign is the direction)."""
    missing = [name for name in names if name not in columns]
    if missing:
        raise ValueError(f"the motion file has no column for {', '.join(missing)}")
    return {name: adapter.Motion(time_s, factor * columns[name]) for name in names}


def _end_of_shaking(time_s, motions, still_m_s2):
    """Time from which no support accelerates more than `still_m_s2` [s]."""
    n = len(time_s)
    moving = np.zeros(n, bool)
    for motion in motions.values():
        moving |= np.abs(motion.acceleration_m_s2[:n]) > still_m_s2
    return float(time_s[np.flatnonzero(moving)[-1]]) if moving.any() else 0.0


def stop_rules(scene, numerics, time_s, motions):
    """Stop rules of an earthquake run.

    A motion is over when no support accelerates more than quiet_ratio·min(g b/h, peak):
    g b/h lifts the façade, and below uplift the motion's own peak rules its response.
    What follows cannot raise the peak d/b of a façade at rest.

    Parameters
    ----------
    scene : Scene
    numerics : dict
        Section numerics of the configuration.
    time_s : ndarray
        Times of the motion file [s].
    motions : dict of str to adapter.Motion

    Returns
    -------
    simulate.StopRules
    """
    speed = max(m.peak_speed() for m in motions.values())
    peak = max(float(np.max(np.abs(m.acceleration_m_s2))) for m in motions.values())
    uplift = scene.gravity_m_s2 * scene.thickness_m / scene.monitor_point_m[2]
    return simulate.StopRules(
        motion_s=_end_of_shaking(time_s, motions, numerics["quiet_ratio"] * min(uplift, peak)),
        limit_s=float(time_s[-1]) + numerics["after_motion_s"],
        overturn_ratio=numerics["overturn_ratio"],
        rest_velocity_m_s=numerics["rest_velocity_m_s"],
        rest_time_s=numerics["rest_time_s"],
        max_speed_m_s=numerics["max_speed_ratio"] * (speed + 1.0),
    )


def run_one(scene, time_s, columns, factor, numerics):
    """One intensity; a numerical failure is retried once at half the step if so configured.

    The retry is sampled more often too: the ledger's integral over samples may have missed the
    push of a short impact, which looks like energy from nowhere whatever the step.

    Returns
    -------
    simulate.History
    """
    motions = scaled_motions(time_s, columns, scene.motions, factor)
    rules = stop_rules(scene, numerics, time_s, motions)
    step, _ = simulate.choose_step(scene, numerics)
    history = _attempt(scene, motions, step, rules, numerics)
    if history.status == simulate.FAILED and numerics["retry_half_step"]:
        finer = {**numerics, "sample_interval_s": RETRY_SAMPLING * numerics["sample_interval_s"]}
        retried = _attempt(scene, motions, 0.5 * step, rules, finer)
        retried.steps += history.steps
        retried.wall_s += history.wall_s
        retried.reason += f"; at half the step, after {history.reason}"
        return retried
    return history


def _attempt(scene, motions, step, rules, numerics):
    """One run with the energy ledger beside it: energy from nowhere is never a collapse."""
    check = ledger.EnergyLedger(scene, motions)
    history = simulate.run(
        scene,
        motions,
        step,
        rules,
        sample_s=numerics["sample_interval_s"],
        node_radius_m=numerics["node_radius_m"],
        check=check,
    )
    if check.reason and history.status != simulate.FAILED:
        history.status, history.reason = simulate.FAILED, check.reason
        history.peak_d_over_b = math.nan
    return history


def as_row(model, record, direction, pga_g, history):
    """Return the contract's row of one run; d/b stays blank where the run failed."""
    failed = history.status == simulate.FAILED
    return {
        "model": model,
        "record": record,
        "direction": direction,
        "pga_g": f"{pga_g:.4f}",
        "d_over_b": "" if failed else f"{min(history.peak_d_over_b, 1.0):.6f}",
        "collapsed": "" if failed else str(int(history.status == simulate.OVERTURNED)),
        "status": history.status,
        "dt_s": f"{history.dt_s:.6e}",
        "steps": str(history.steps),
        "wall_s": f"{history.wall_s:.3f}",
    }


def to_csv(rows):
    """Rows as CSV text, by ascending intensity."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(sorted(rows, key=lambda r: float(r["pga_g"])))
    return text.getvalue()


def analyse(job, time_s, columns, record, direction, journal, say, renew=None):
    """Run all intensities the strategy asks for; rows already in the journal are reused.

    Parameters
    ----------
    job : dict
        A scene file: model, beta_s and the configuration's sections.
    journal : Journal
    say : callable
        Receives one progress line a run.
    renew : callable, optional
        Called between runs when this process has grown too large; see `memory`.

    Returns
    -------
    list of dict
        Rows of the contract.
    """
    model, settings = job["model"], dict(job["ida"])
    if settings["start_g"] is None:
        settings["start_g"] = round(0.5 * models.static_multiplier(job), DIGITS)
    scene, numerics = models.build_scene(job), models.numerics(job)
    columns = models.motion_columns(scene, columns)
    motion_bytes = b"".join(columns[n].tobytes() for n in scene.motions) + time_s.tobytes()
    base_key = run_key(to_json(scene), motion_bytes, numerics, direction, digest(__file__))
    rows: list[dict] = []
    done: dict[float, str] = {}
    reused = 0
    ceiling = memory.Ceiling()
    while (pga_g := next_intensity(done, settings)) is not None:
        key = run_key(base_key, pga_g)
        row = journal.get(key)
        if row is None:
            factor = amplitude(columns["ground"], direction, pga_g)
            history = run_one(scene, time_s, columns, factor, numerics)
            row = as_row(model, record, direction, pga_g, history)
            journal.put(key, row, history.reason)
            outcome = f"d/b {row['d_over_b'][:5]}" if row["d_over_b"] else history.reason
            say(
                f"run {len(rows) + 1}: {pga_g:.3f} g {row['status']}, {outcome} "
                f"({history.wall_s:.1f} s)"
            )
            if renew is not None and ceiling.reached():
                renew()
        else:
            reused += 1
        rows.append(row)
        done[pga_g] = row["status"]
    if reused:
        say(f"{reused} of {len(rows)} runs taken from earlier work")
    return rows


def main(arguments=None):
    """Parse the command line, run the analysis, write the table; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scene", required=True, help="scene file (JSON)")
    parser.add_argument("--motion", required=True, help="floor motions (CSV)")
    parser.add_argument("--record", required=True)
    parser.add_argument("--direction", required=True, choices=tuple(SIGNS))
    parser.add_argument("--journal", required=True, help="finished runs (JSON lines)")
    parser.add_argument("--output", required=True, help="table to write (CSV)")
    args = parser.parse_args(arguments)
    try:
        job = json.loads(Path(args.scene).read_text())
    except (ValueError, OSError) as error:
        print(f"error: {args.scene}: {error}", file=sys.stderr)
        return 1

    def say(text):
        print(
            f"[{job['model']} {args.record} {args.direction}] {text}", file=sys.stderr, flush=True
        )

    time_s, columns = read_motion(args.motion)
    if not math.isfinite(job["beta_s"]):
        raise ValueError(f"{args.scene}: beta_s must be finite")
    adapter.load_yade()
    rows = analyse(
        job,
        time_s,
        columns,
        args.record,
        args.direction,
        Journal(args.journal),
        say,
        memory.start_afresh,
    )
    write_atomic(args.output, to_csv(rows))
    return 0
