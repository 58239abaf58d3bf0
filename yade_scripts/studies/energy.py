"""Entry point: the energy balance of one run, at a share of the intensity that fells the façade.

    python3 yade_scripts energy --scene scenes/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --curve ida/W2/RRS228_neg.csv --share 0.8
        --output energy/W2/RRS228_neg_0.8.csv

The terms are explained in `balance`.
"""

import argparse
import csv
import io

from yade_scripts.engine import adapter, balance
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import floor_motions, models
from yade_scripts.model.motion import SIGNS, amplitude
from yade_scripts.studies import shaking
from yade_scripts.studies.ensemble import read_curve
from yade_scripts.studies.intensities import DIGITS, fallen_or_highest

HEAD = ("model", "record", "direction", "pga_g", "status", "dt_s", "overturning_j")


def balanced_run(job, time_s, columns, factor):
    """One run with its books.

    Parameters
    ----------
    job : dict
        A scene file: model, beta_s and the configuration's sections.
    time_s, columns
        See `floor_motions.read`.
    factor : float
        On the motion's amplitude; its sign is the direction.

    Returns
    -------
    history : simulate.History
    books : balance.EnergyBalance
    overturning_j : float
        See `Scene.overturning_energy_j`.
    """
    scene, numerics = models.build_scene(job), models.numerics(job)
    case = shaking.prepare(scene, numerics, time_s, columns, factor)
    books = balance.EnergyBalance(case.scene, case.sample_s, case.motions)
    history = case.run(setup=books.attach)
    return history, books, scene.overturning_energy_j


def to_csv(facts, rows):
    """History as CSV text; what does not change stands in the first columns."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow((*HEAD, *balance.COLUMNS))
    for row in rows:
        writer.writerow((*facts, f"{row[0]:.6f}", *(f"{value:.6g}" for value in row[1:])))
    return text.getvalue()


def main(arguments=None):
    """Parse the command line, run, write the history; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, text in (
        ("scene", "scene file (JSON)"),
        ("motion", "floor motions (CSV)"),
        ("record", "name"),
        ("curve", "finished IDA table (CSV)"),
        ("output", "history to write (CSV)"),
    ):
        parser.add_argument(f"--{name}", required=True, help=text)
    parser.add_argument("--direction", required=True, choices=tuple(SIGNS))
    parser.add_argument("--share", required=True, type=float, help="of the collapse intensity")
    args = parser.parse_args(arguments)
    if not 0.0 < args.share <= 10.0:
        raise ValueError(f"--share {args.share:g}: expected a number from 0 to 10")
    job = read_json(args.scene)
    time_s, columns = floor_motions.read(args.motion)
    pga_g = round(args.share * fallen_or_highest(read_curve(args.curve)[0]), DIGITS)
    factor = amplitude(columns["ground"], args.direction, pga_g)
    adapter.load_yade()
    history, books, overturning_j = balanced_run(job, time_s, columns, factor)
    facts = (
        job["model"],
        args.record,
        args.direction,
        f"{pga_g:.4f}",
        history.status,
        f"{history.dt_s:.6e}",
        f"{overturning_j:.6g}",
    )
    write_atomic(args.output, to_csv(facts, books.rows))
    return 0
