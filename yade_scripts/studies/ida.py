"""Entry point: the incremental dynamic analysis of one model, record and direction.

Runs under YADE's own Python, all intensities in one process:

    python3 yade_scripts ida --scene scenes/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --journal cache/W2_RRS228_neg.jsonl --output ida.csv
"""

import argparse
import math
import sys

from yade_scripts.engine import adapter, memory
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import floor_motions, models
from yade_scripts.model.motion import SIGNS, amplitude
from yade_scripts.model.scene import to_json
from yade_scripts.sources import digest
from yade_scripts.studies import shaking
from yade_scripts.studies.intensities import DIGITS, next_intensity
from yade_scripts.studies.journal import Journal, run_key
from yade_scripts.studies.tables import RUN_COLUMNS, run_row, to_csv

COLUMNS = {"model": "", "record": "", "direction": "", "pga_g": ".4f", **RUN_COLUMNS}


def analyse(job, time_s, columns, record, direction, journal, say, renew=None, plan=None):
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
    plan : sequence of float, optional
        See `next_intensity`.

    Returns
    -------
    list of dict
        Rows of the contract.
    """
    model, settings = job["model"], dict(job["ida"])
    if settings["start_g"] is None:
        settings["start_g"] = round(0.5 * models.static_multiplier(job), DIGITS)
    scene, columns = models.shaken(models.build_scene(job), columns)
    numerics = models.numerics(job)
    motion_bytes = b"".join(columns[n].tobytes() for n in scene.motions) + time_s.tobytes()
    base_key = run_key(to_json(scene), motion_bytes, numerics, direction, digest(__file__))
    rows: list[dict] = []
    done: dict[float, str] = {}
    reused = 0
    ceiling = memory.Ceiling()
    while (pga_g := next_intensity(done, settings, plan)) is not None:
        key = run_key(base_key, pga_g)
        row = journal.get(key)
        if row is None:
            factor = amplitude(columns["ground"], direction, pga_g)
            history = shaking.prepare(scene, numerics, time_s, columns, factor).retried()
            row = run_row(model, record, direction, pga_g, history)
            journal.put(key, row, history.reason)
            d_over_b = row["d_over_b"]
            outcome = history.reason if d_over_b is None else f"d/b {d_over_b:.3f}"
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
    parser.add_argument("--plan", help="intensities from the dense scan (JSON)")
    parser.add_argument("--output", required=True, help="table to write (CSV)")
    args = parser.parse_args(arguments)
    job = read_json(args.scene)

    def say(text):
        print(
            f"[{job['model']} {args.record} {args.direction}] {text}", file=sys.stderr, flush=True
        )

    time_s, columns = floor_motions.read(args.motion)
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
        read_json(args.plan)["runs"] if args.plan else None,
    )
    write_atomic(args.output, to_csv(sorted(rows, key=lambda r: r["pga_g"]), COLUMNS))
    return 0
